// Rules of exchange, death and migration that nobody ever meets.
#include <algorithm>
#include <limits>

#include "core/numbers/number_text.h"
#include "coupling/regions/region.h"
#include "fields/reaction.h"
#include "study/build.h"
#include "study/own_section.h"
#include "study/quantity_reader.h"

namespace morula::scenarios {
namespace {

void tell(BuildContext& c, const Place& place, const std::string& what, const std::string& help) {
  c.diagnostics.warning(694, place, what, help);
}

/// Between these all concentrations of a field stay, whatever its cells do. [mM]
struct Levels {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;

  void add(double level) {
    least = std::min(least, level);
    most = std::max(most, level);
  }
};

/// By the principle of the maximum: diffusion alone leaves a field between what it begins with and what its faces have; what takes substance may empty it,
/// and what makes some has no end.
Levels levels_of(const fields::FieldSpec& field, const Space& space) {
  Levels out;
  out.add(field.initial);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const fields::FaceCondition& face : field.boundary[axis]) {
      if (space.periodic(static_cast<int>(axis)) || face.kind != fields::FaceCondition::Kind::kValue) continue;
      if (field.course.empty()) out.add(face.value);
      for (const double factor : field.course.value) out.add(factor * face.value);
    }
  constexpr int kTried = 64;  // concentrations at which a reaction is asked what it does
  const double highest = out.most;
  bool takes = false, makes = false;
  for (const fields::FieldReaction& one : field.reactions) {
    const fields::ReactionCoefficients values = one.what->coefficients(one.values);
    for (int k = 0; k <= kTried; ++k) {
      const double taken = one.what->taken(values, highest * k / kTried);
      takes = takes || taken > 0.0;
      makes = makes || taken < 0.0;
    }
  }
  if (takes) out.least = 0.0;
  if (makes) out.most = std::numeric_limits<double>::infinity();
  return out;
}

/// A rule that compares a field with a level which no place ever has, or which all have.
void check_level(BuildContext& c, const Place& place, const std::string& rule, std::size_t field, double level, bool above) {
  const fields::FieldSpec& of = c.study.model.fields[field];
  const Levels has = levels_of(of, c.study.model.space);
  const bool nobody = above ? level >= has.most : level <= has.least, everybody = above ? level < has.least : level > has.most;
  if (!nobody && !everybody) return;
  const bool rises = nobody == above;  // to an end that is told; else it falls
  tell(c, place,
       (nobody ? "nobody ever meets " : "everybody meets ") + rule + ": '" + of.name +
           (rises ? "' never rises above " : "' never falls below ") +
           UnitSystem().format_value(rises ? has.most : has.least, Quantity::kConcentration),
       "see its `initial` and `boundary`, and what takes it up or makes it");
}

void check_levels(BuildContext& c) {
  const Swaps& swaps = c.study.model.swaps;
  for (std::size_t k = 0; k < swaps.triggers.size(); ++k) {
    const Trigger& t = swaps.triggers[k];
    const auto& promote = c.draft.coupling.triggers[k].content.promote;
    if (t.compares() && t.field >= 0)
      check_level(c, promote.place, "`" + promote.value + "`", static_cast<std::size_t>(t.field), t.promote, t.promote_above);
  }
  for (std::size_t k = 0; k < swaps.regions.size(); ++k) {
    const Region& r = swaps.regions[k];
    if (r.shape == level_region())
      check_level(c, c.draft.coupling.regions[k].place, "region '" + r.name + "'", static_cast<std::size_t>(r.values.number("field")),
                  r.values("level"), r.values.number("side") == 0);
  }
}

/// Whether cells of a type make some of a field.
bool makes(const fields::FieldSpec& field, std::size_t type) {
  return std::ranges::any_of(field.reactions, [type](const fields::FieldReaction& one) {
    return one.what->where == fields::Reaction::Where::kCells && one.type == type &&
           one.what->taken(one.what->coefficients(one.values), 0.0) < 0.0;
  });
}

/// What cells answer to in a field that gives no cause for it, or another one.
void check_answers(BuildContext& c) {
  for (std::size_t i = 0; i < c.study.model.types.size(); ++i) {
    const CellType& type = c.study.model.types[i];
    const draft::CellType& d = c.draft.cell_types[i].content;
    for (const CellBehaviour& one : type.behaviours) {
      if (one.what != starvation() || !one.may_act()) continue;
      const fields::FieldSpec& field = c.study.model.fields[static_cast<std::size_t>(one.values.number("field"))];
      const double least = levels_of(field, c.study.model.space).least;
      if (one.values("below") <= least)
        tell(c, place_of_key(d.behaviours.at("death"), "below"),
             "no cell of '" + type.name + "' dies: '" + field.name + "' never falls below " +
                 UnitSystem().format_value(least, Quantity::kConcentration),
             "cells that take it up, or a larger `below`");
    }
    if (const int sensed = type.migration.sensed_field(); sensed >= 0) {
      const fields::FieldSpec& field = c.study.model.fields[static_cast<std::size_t>(sensed)];
      if (makes(field, i) && field.voxel > type.radius.mean)
        c.diagnostics.warning(512, c.draft.fields[static_cast<std::size_t>(sensed)].place,
                              "cells of '" + type.name + "' go by '" + field.name + "', which they make, and its voxels of " +
                                  number_text("%.3g um", field.voxel) +
                                  " are wider than their radius: each is drawn to the middle of its voxel by its own",
                              "`voxel: " + number_text("%.2g um", 0.8 * type.radius.mean) + "`");
      const Levels has = levels_of(field, c.study.model.space);
      if (has.most <= has.least)
        tell(c, d.migration_law.place,
             "cells of '" + type.name + "' walk at random: '" + field.name + "' is the same everywhere and at all times",
             "a `boundary` with different faces, or cells that take it up or make it");
    }
  }
}

/// The first region in which a cell is decides: behind one that holds everybody nothing else is asked.
void check_behind_everything(BuildContext& c) {
  const Swaps& swaps = c.study.model.swaps;
  const auto& drafts = c.draft.coupling;
  for (std::size_t k = 0; k < swaps.regions.size(); ++k) {
    const Region& all = swaps.regions[k];
    if (all.shape != everything_region()) continue;
    const std::string behind = "': region '" + all.name + "' comes before it and holds every cell";
    for (std::size_t i = k + 1; i < swaps.regions.size(); ++i)
      if (all.from <= swaps.regions[i].from && swaps.regions[i].until <= all.until)
        return tell(c, drafts.regions[i].place,
                    "no cell is a " + drafts.regions[i].content.body.value + " by region '" + swaps.regions[i].name + behind,
                    "the region that holds every cell last");
    if (!swaps.triggers.empty() && all.from <= 0.0 && c.study.time.end <= all.until)
      return tell(c, drafts.triggers.front().place,
                  "no trigger is asked: region '" + all.name + "' holds every cell, and regions come first",
                  "leave the region away, or the triggers");
  }
}

}  // namespace

void check_rules(BuildContext& c) {
  check_levels(c);
  check_answers(c);
  check_behind_everything(c);
}

}  // namespace morula::scenarios
