// What cells of a type go through from their birth to their division.

#include "core/ball.h"
#include "coupling/behaviours/division_axis.h"
#include "coupling/behaviours/phases.h"
#include "study/build.h"
#include "study/law_keys.h"
#include "study/own_section.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

/// By which plane cells of a type divide, and what each daughter gets.
void set_division(BuildContext& c, const draft::CellType& t, CellType& type) {
  for (const auto& axis : c.options.laws->division_axes)
    if (axis->info.name == t.axis.value) type.axis = axis;
  std::vector<const std::vector<OwnKey>*> all;
  for (const auto& axis : c.options.laws->division_axes) all.push_back(&axis->keys);
  if (check_choice(c, type.axis->keys, all, t.axis_own, t.axis))
    if (auto values = own_values(c, type.axis->keys, t.axis_own)) type.axis_own = std::move(*values);
  if (type.axis->needs_polarity && !t.activity.has_polarity)
    c.diagnostics.error(558, t.axis.place, "cells of '" + type.name + "' divide by their polarity, and have none",
                        "give the type a `polarity`");
  if (type.axis == random_axis() && t.axis_spread.given && t.axis_spread.value > 0.0)
    c.diagnostics.error(515, t.axis_spread.place, "'axis_spread' has no effect here", "a random axis has no direction to stray from");
  type.axis_spread = t.axis_spread.value;
  type.division_share = {t.division_share.mean.value, t.division_share.spread.value};
  type.shells_divide = t.shells_divide.value == "cut";
  type.new_surface = t.new_surface.value;
}

/// The law of growth with the values of its own keys. E515 for keys of other laws.
void set_growth(BuildContext& c, const draft::CellType& t, CellType& type) {
  CellCycle& cycle = type.cycle;
  for (const auto& law : c.options.laws->growth)
    if (law->word == t.growth.value) cycle.growth = law;
  for (const KeySpec& key : cycle.growth->own)
    if (const auto own = t.growth_own.find(key.name); own != t.growth_own.end()) cycle.growth_values.set(key.name, own->second.value);
  check_law_keys(c, t.growth_own, choosable_growth_laws(*c.options.laws), cycle.growth->word, "growth");
}

/// The volume at which cells divide: E515, E701.
void set_size(BuildContext& c, const draft::Cycle& t, CellType& type) {
  CellCycle& cycle = type.cycle;
  const double radius = type.radius.mean, birth = ball_volume(radius);
  cycle.ratio = t.ratio.value;
  cycle.size_spread = t.volume_spread.value;
  cycle.control = t.control.value == "sizer" ? SizeControl::kSizer : t.control.value == "adder" ? SizeControl::kAdder : SizeControl::kTimer;
  if (cycle.control == SizeControl::kTimer) {
    if (t.volume.given)
      c.diagnostics.error(515, t.volume.place, "'volume' has no effect here", "it belongs to `control: sizer` or `control: adder`");
    return;
  }
  const bool sizer = cycle.control == SizeControl::kSizer;
  cycle.size = t.volume.known() ? t.volume.value : (sizer ? cycle.ratio : cycle.ratio - 1.0) * birth;
  if (sizer && t.volume.known() && !(cycle.size > birth))
    c.diagnostics.error(701, t.volume.place,
                        "cells of '" + type.name + "' are born with " + short_number(birth) + " um^3 and would divide at " + t.volume.text,
                        "a larger `volume`, or a smaller `radius`");
}

/// The factors of an `arrest`: E103, E401, E402, and what they say.
std::vector<CellArrest> build_arrest(BuildContext& c, const std::map<std::string, draft::OwnSection>& given, const Place& place) {
  std::vector<CellArrest> out;
  for (const auto& factor : c.options.laws->arrest) {
    const auto own = given.find(factor->section.name);
    if (own == given.end() || !own->second.present) continue;
    const auto missing = missing_keys(factor->keys, own->second);
    for (const std::string& key : missing)
      c.diagnostics.error(103, place, "`" + std::string(factor->section.name) + "` needs `" + key + "`",
                          "for example `" + std::string(factor->section.example) + "`");
    const auto values = missing.empty() ? own_values(c, factor->keys, own->second) : std::nullopt;
    if (!values) continue;
    if (const auto problem = factor->judge != nullptr ? factor->judge(*values) : std::nullopt) {
      tell_problem(c, *problem, own->second, place);
      continue;
    }
    out.emplace_back(factor, *values);
  }
  return out;
}

/// Growth that stops at a pressure already at which its factor is not 0 yet: E510.
void check_switch(BuildContext& c, const draft::CellType& t, const CellType& type) {
  if (!type.cycles) return;
  for (const CellArrest& one : type.cycle.arrest) {
    const double full = one.what->full_pressure != nullptr ? one.what->full_pressure(one.values) : 0.0;
    if (full > type.inhibit_pressure)
      c.diagnostics.error(510, t.pressure_above.place,
                          "growth of '" + type.name + "' stops at " + t.pressure_above.text + " already, below where its `arrest` is full",
                          "`inhibit_growth: {pressure_above: never}`");
  }
}

/// What is said of a cycle that cells do not have: W515.
void tell_of_rest(BuildContext& c, const draft::CellType& t, const std::string& name) {
  const auto tell = [&](const Place& place, const std::string& word) {
    c.diagnostics.warning(515, place, "'" + word + "' has no effect here: cells of '" + name + "' rest",
                          "another `model`, or leave it away (where it comes by `like`: `" + word + ": default`)");
  };
  const auto idle = [&](const auto& key, const char* word) {
    if (key.is_changed()) tell(key.place, word);
  };
  idle(t.cycle_duration.mean, "duration");
  idle(t.growth, "growth");
  idle(t.cycle.ratio, "ratio");
  idle(t.cycle.control, "size");
  idle(t.axis, "axis");
  idle(t.division_share.mean, "share");
  idle(t.shells_divide, "shells");
  idle(t.new_surface, "new_surface");
  if (t.cycle.has_arrest && !t.cycle.arrest.empty()) tell(t.cycle_model.place, "arrest");
}

}  // namespace

std::vector<CellArrest> build_phase_arrest(BuildContext& c, const draft::CyclePhase& phase, const Place& place) {
  return build_arrest(c, phase.arrest, place);
}

/// What daughters of a type become, once all types are there: E401, E510, E515.
void build_fates(BuildContext& c, const draft::CellType& t, CellType& type) {
  double sum = 0.0;
  for (const auto& [name, place, fate] : t.fates) {
    if (!fate.share.known() || !fate.types.known()) continue;
    if (fate.types.value.size() != 2) {
      c.diagnostics.error(111, fate.types.place, "a division has two daughters", "for example `types: [stem, transit]`");
      continue;
    }
    Fate out{fate.share.value, {}};
    bool found = true;
    for (std::size_t k = 0; k < 2; ++k) {
      const int number = find_type(c, fate.types.value[k], fate.types.place);
      found = found && number >= 0;
      if (number < 0) continue;
      out.type[k] = static_cast<std::uint16_t>(number);
      if (c.study.model.types[out.type[k]].initial_body != type.initial_body) c.study.model.swaps.by_fate = true;
      if (c.study.model.types[out.type[k]].shell_nodes != type.shell_nodes)
        c.diagnostics.error(510, fate.types.place,
                            "daughters of '" + type.name + "' that become '" + fate.types.value[k] + "' would have another number of nodes",
                            "give both types the same `dcm.nodes`");
    }
    if (found) type.fates.all.push_back(out);
    sum += fate.share.value;
    if (sum > 1.0 + 1e-9)
      c.diagnostics.error(510, fate.share.place, "the fates of '" + type.name + "' are more than all of its divisions",
                          "shares of 100 % at most; what is left to that keeps the mother's type");
  }
  const std::string& polarity = t.daughter_polarity.value;
  type.fates.polarity = polarity == "mirrored" ? DaughterPolarity::kMirrored
                        : polarity == "new"    ? DaughterPolarity::kNew
                                               : DaughterPolarity::kKept;
  if (type.fates.polarity != DaughterPolarity::kKept && !t.activity.has_polarity)
    c.diagnostics.error(515, t.daughter_polarity.place, "'polarity' has no effect here",
                        "cells of '" + type.name + "' have none: give the type a `polarity`");
}

void build_cycle(BuildContext& c, const draft::CellType& t, const Place& place, CellType& type) {
  type.cycles = t.has_cycle && t.cycle_model.value != "none" && t.cycle_model.known();
  if (!t.has_cycle) return;
  if (t.cycle_model.value == "none") tell_of_rest(c, t, type.name);
  type.cycle_duration = {t.cycle_duration.mean.value, t.cycle_duration.spread.value, t.cycle_duration.correlation.value};
  if (t.cycle_duration.correlation.value != 0.0 && t.cycle_duration.spread.value == 0.0)
    c.diagnostics.error(515, t.cycle_duration.correlation.place, "'correlation' has no effect here",
                        "give `spread`: all cycles are alike without one");
  set_growth(c, t, type);
  set_size(c, t.cycle, type);
  type.cycle.arrest = build_arrest(c, t.cycle.arrest, place);
  check_switch(c, t, type);
  build_phases(c, t, type);
  set_division(c, t, type);
  if (type.cycles && type.cycle.phases.empty() && !type.cycle.growth->grows)
    c.diagnostics.error(700, t.growth.place, "cells of '" + type.name + "' never reach their division volume: they do not grow",
                        "`model: phases` for cells that divide by the clock, or another `growth`");
  const bool grows = type.cycle.growth->grows;
  if (type.cycles && !grows && !t.cycle.arrest.empty() && t.cycle.has_arrest)
    c.diagnostics.warning(515, t.growth.place,
                          "'arrest' has no effect here: it holds growth back, and cells of '" + type.name + "' do not grow",
                          "`arrest` of a phase holds that back");
  if (type.cycles && !grows && t.cycle.ratio.is_changed())
    c.diagnostics.warning(515, t.cycle.ratio.place, "'ratio' has no effect here: cells of '" + type.name + "' do not grow",
                          "leave it away");
  if (!paced_by_phases(type.cycle)) return;
  if (t.cycle_duration.mean.is_changed())
    c.diagnostics.error(515, t.cycle_duration.mean.place, "'duration' has no effect here",
                        "the phases say how long the cycle of '" + type.name + "' is; `duration: default` where it comes by `like`");
  if (t.cycle_duration.correlation.value != 0.0)
    c.diagnostics.error(515, t.cycle_duration.correlation.place, "'correlation' has no effect here",
                        "the phases say how long the cycle is");
}

}  // namespace morula::scenarios
