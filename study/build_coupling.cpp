#include <algorithm>
#include <optional>
#include <set>

#include "coupling/regions/outside_law.h"
#include "coupling/regions/region.h"
#include "study/own_section.h"
#include "study/quantity_reader.h"

namespace morula::scenarios {
namespace {

/// `subject > quantity`, as a trigger writes it.
struct Comparison {
  bool above = true;
  std::shared_ptr<const TriggerValue> of;
  int field = -1;
  double value = 0.0;
  std::string subject, value_text;
};

/// Finds what is compared: a value of the registry, or a field by its name.
bool find_subject(BuildContext& c, const Place& place, Comparison& comparison) {
  std::vector<std::string> allowed;
  for (const auto& one : c.options.laws->trigger_values) {
    if (one == field_value()) continue;
    allowed.push_back(one->info.name);
    if (comparison.subject == one->info.name) comparison.of = one;
  }
  for (std::size_t i = 0; i < c.draft.fields.size(); ++i) {
    allowed.push_back(c.draft.fields[i].name);
    if (comparison.of == nullptr && c.draft.fields[i].name == comparison.subject) comparison.field = static_cast<int>(i);
  }
  if (comparison.field >= 0) comparison.of = field_value();
  if (comparison.of == nullptr)
    c.diagnostics.error(402, place, "there is no field '" + comparison.subject + "' to compare", suggest(comparison.subject, allowed));
  return comparison.of != nullptr;
}

std::optional<Comparison> read_comparison(BuildContext& c, const UnitSystem& units, const char* key, const Given<std::string>& given) {
  const std::string& text = given.value;
  const std::string name = std::string("'") + key + "'";
  const std::size_t sign = text.find_first_of("<>");
  const auto trim = [](std::string word) {
    const std::size_t first = word.find_first_not_of(' '), last = word.find_last_not_of(' ');
    return first == std::string::npos ? std::string() : word.substr(first, last - first + 1);
  };
  if (sign == std::string::npos || trim(text.substr(0, sign)).empty()) {
    c.diagnostics.error(113, given.place, name + " is not a comparison: '" + text + "'", "for example `pressure > 1 kPa`");
    return std::nullopt;
  }
  Comparison comparison;
  comparison.above = text[sign] == '>';
  comparison.subject = trim(text.substr(0, sign));
  comparison.value_text = trim(text.substr(sign + 1));
  if (!find_subject(c, given.place, comparison)) return std::nullopt;
  // What was written, with the unit that it may lack.
  const std::string usual = comparison.field >= 0 ? "< 0.05 mM" : std::string(comparison.of->example);
  const std::string usual_value = trim(usual.substr(usual.find_first_of("<>") + 1));
  const bool bare = comparison.value_text.find_first_not_of("0123456789.eE+-") == std::string::npos && !comparison.value_text.empty();
  const std::size_t unit = usual_value.find(' ');
  const std::string example = comparison.subject + " " + text[sign] + " " +
                              (bare && unit != std::string::npos ? comparison.value_text + usual_value.substr(unit) : usual_value);
  const auto value =
      read_quantity(units, comparison.value_text, comparison.of->quantity, comparison.subject, example.c_str(), given.place, c.diagnostics);
  if (!value) return std::nullopt;
  comparison.value = *value;
  return comparison;
}

void check_thresholds(BuildContext& c, const UnitSystem& units, const draft::Trigger& t, const Comparison& up, const Comparison& down) {
  const Quantity quantity = up.of->quantity;
  if (up.subject != down.subject) {
    c.diagnostics.error(510, t.demote.place, "promote looks at '" + up.subject + "', but demote at '" + down.subject + "'",
                        "use one value, or two triggers");
  } else if (up.above == down.above) {
    c.diagnostics.error(
        501, t.demote.place,
        "cells would flip back and forth: promote and demote both ask for " + std::string(up.above ? "more" : "less") + " " + up.subject,
        "turn the sign of one of them");
  } else if (up.above ? down.value >= up.value : down.value <= up.value) {
    c.diagnostics.error(501, t.demote.place,
                        "cells would flip back and forth: the demote threshold (" + down.value_text + ") is not " +
                            (up.above ? "below" : "above") + " the promote threshold (" + up.value_text + ")",
                        std::string("set demote ") + (up.above ? "below" : "above") + " promote, for example `" + up.subject +
                            (up.above ? " < " : " > ") + units.format_value(up.value * (up.above ? 0.6 : 1.5), quantity) + "`");
  }
}

/// A threshold that no cell reaches, or that all are beyond from the start.
void warn_of_idle_threshold(BuildContext& c, const draft::Trigger& t, const Comparison& up) {
  const bool nobody = up.above ? up.value >= up.of->most : up.value <= up.of->least;
  const bool everybody = up.above ? up.value < up.of->least : up.value > up.of->most;
  if (nobody)
    c.diagnostics.warning(694, t.promote.place, "no cell ever has `" + t.promote.value + "`: nobody becomes a shell by this trigger",
                          "for example `" + std::string(up.of->example) + "`");
  if (everybody)
    c.diagnostics.warning(694, t.promote.place, "every cell has `" + t.promote.value + "`: all become shells by this trigger",
                          "`body: shell` of the type says the same");
}

/// Demotion by the short form `outside_law: 1.0`: spheres of default types rest in pairs at 0.81 of the range, and would not come back below that.
constexpr double kBackInside = 0.9;

/// Whether the cycle of some type has this phase; E405 where none has.
bool is_phase(BuildContext& c, const draft::Trigger& t) {
  std::vector<std::string> names;
  for (const CellType& type : c.study.model.types) {
    for (const CyclePhase& phase : type.cycle.phases) names.push_back(phase.name);
    if (type.cycle.quiescence.phase >= 0) names.emplace_back(kQuiescentPhase);
  }
  if (std::ranges::find(names, t.phase.value) != names.end()) return true;
  c.diagnostics.error(
      405, t.phase.place, "no type has a phase '" + t.phase.value + "'",
      names.empty() ? "give a type phases: `cycle: {model: phases, phases: {g1: {duration: 8 h}}}`" : suggest(t.phase.value, names));
  return false;
}

void build_trigger(BuildContext& c, const UnitSystem& units, const draft::Trigger& t, const Place& place) {
  Trigger trigger;
  t.plain.write_to(trigger);
  if (int{t.type.given} + int{t.phase.given} + int{t.outside_law.given} + int{t.promote.given || t.demote.given} > 1) {
    c.diagnostics.error(111, place, "a trigger has either `type`, `phase`, `outside_law`, or `promote` and `demote`", "make two triggers");
    return;
  }
  if (t.outside_law.given) {
    trigger.value = outside_law_value();
    trigger.promote_above = true;
    trigger.promote = t.outside_law.value;
    trigger.demote = kBackInside * t.outside_law.value;
    if (t.outside_law.known()) c.study.model.swaps.triggers.push_back(trigger);
    return;
  }
  if (t.type.given) {
    trigger.type = std::max(0, t.type.known() ? find_type(c, t.type.value, t.type.place) : 0);
    c.study.model.swaps.triggers.push_back(trigger);
    return;
  }
  if (t.phase.given) {
    trigger.phase = t.phase.value;
    if (t.phase.known() && is_phase(c, t)) c.study.model.swaps.triggers.push_back(trigger);
    return;
  }
  if (!t.promote.given || !t.demote.given) {
    c.diagnostics.error(111, place, "a trigger needs `promote` and `demote`, `outside_law`, `phase`, or `type`",
                        "for example `{promote: pressure > 1 kPa, demote: pressure < 600 Pa}`");
    return;
  }
  const auto up = t.promote.known() ? read_comparison(c, units, "promote", t.promote) : std::nullopt;
  const auto down = t.demote.known() ? read_comparison(c, units, "demote", t.demote) : std::nullopt;
  if (!up || !down) return;
  check_thresholds(c, units, t, *up, *down);
  warn_of_idle_threshold(c, t, *up);
  trigger.value = up->of;
  trigger.field = up->field;
  trigger.promote_above = up->above;
  trigger.promote = up->value;
  trigger.demote = down->value;
  c.study.model.swaps.triggers.push_back(trigger);
}

/// The keys of the region's own shape are there, and none of another.
bool has_keys_of_shape(BuildContext& c, draft::Region& r, const RegionShape& shape, const Place& place) {
  const std::string who = "a region of shape '" + shape.info.name + "' ";
  for (const auto& other : c.options.laws->region_shapes)
    for (const OwnKey& key : other->keys) {
      const std::string name = key.spec.name;
      if (std::ranges::any_of(shape.keys, [&](const OwnKey& one) { return name == one.spec.name; })) continue;
      if (!given_keys({key}, r.own).empty())
        c.diagnostics.error(111, place_of_key(r.own, name), who + "has no `" + name + "`", "leave it away");
      leave_away(r.own, name);
    }
  const auto missing = missing_keys(shape.keys, r.own);
  for (const std::string& key : missing) c.diagnostics.error(103, place, who + "needs `" + key + "`", example_of(shape.keys, {key}));
  return missing.empty();
}

/// Where a region lies is said once. A default without a meaning is not part of the resolved study.
void check_center(BuildContext& c, draft::Region& r, const RegionShape& shape) {
  const auto tell = [&](const char* key, const Place& place) {
    c.diagnostics.error(515, place, "'" + std::string(key) + "' has no effect here",
                        "leave it away: shape '" + shape.info.name + "' says where the region lies");
  };
  if (!shape.has_center) {
    if (norm2(r.center.value) > 0.0) tell("center", r.center.place);
    if (r.follow_tissue.value) tell("follow_tissue", r.follow_tissue.place);
    if (r.follow.given) tell("follow", r.follow.place);
    r.center.text.clear();
    r.follow_tissue.text.clear();
  }
  if (!shape.has_border()) {
    if (r.margin.given)
      c.diagnostics.error(515, r.margin.place, "'margin' has no effect here",
                          "leave it away: a region of shape '" + shape.info.name + "' has no border in space" +
                              (shape.of_cell == nullptr ? ", a cell leaves it one contact beyond its last" : ""));
    r.margin.text.clear();
  }
  if (r.follow.given && r.follow_tissue.value)
    c.diagnostics.error(111, r.follow.place, "a region follows either the tissue or an obstacle", "leave away `follow` or `follow_tissue`");
}

void check_inside_domain(BuildContext& c, const draft::Region& r, const Region& region) {
  if (!c.draft.domain.size.known() || region.follow_tissue || region.obstacle >= 0 || region.shape->meets == nullptr) return;
  const Box& domain = c.study.model.space.box;
  const bool outside = !region.shape->meets(region, domain);
  if (outside)
    c.diagnostics.error(502, r.center.given ? r.center.place : r.shape.place,
                        "region '" + region.name + "' lies outside the domain: no cell can ever be in it",
                        "the domain reaches from " + std::to_string(static_cast<long>(domain.low.x)) + ", " +
                            std::to_string(static_cast<long>(domain.low.y)) + ", " + std::to_string(static_cast<long>(domain.low.z)) +
                            " um to " + std::to_string(static_cast<long>(domain.high.x)) + ", " +
                            std::to_string(static_cast<long>(domain.high.y)) + ", " + std::to_string(static_cast<long>(domain.high.z)) +
                            " um");
}

void build_region(BuildContext& c, draft::Region& r, const Place& place) {
  Region region;
  region.name = r.name.value;
  const auto& shapes = c.options.laws->region_shapes;
  const auto shape = std::ranges::find_if(shapes, [&](const auto& one) { return r.shape.known() && one->info.name == r.shape.value; });
  const bool complete = shape != shapes.end() && has_keys_of_shape(c, r, **shape, place);
  const auto values = complete ? own_values(c, (*shape)->keys, r.own) : std::nullopt;
  if (values && r.center.known()) {
    region.shape = *shape;
    region.center = r.center.value;
    region.values = *values;
    if (region.shape->build != nullptr) region.shape->build(c.study.model, region);
    check_center(c, r, *region.shape);
    if (r.follow.known()) region.obstacle = find_obstacle(c, r.follow.value, r.follow.place);
    region.body = r.body.value == "sphere" ? BodyKind::kSphere : BodyKind::kShell;
    region.margin = r.margin.value;
    region.follow_tissue = r.follow_tissue.value;
    region.from = r.from.value;
    region.until = r.until.value;
    if (r.from.known() && r.until.known() && !(region.from < region.until))
      c.diagnostics.error(510, r.until.given ? r.until.place : r.from.place, "region '" + region.name + "' ends before it begins",
                          "set until after from");
    if (const auto& end = c.draft.time.end; r.from.given && r.from.known() && end.known() && !(region.from < end.value))
      c.diagnostics.warning(694, r.from.place,
                            "region '" + region.name + "' begins at " + r.from.text + ", and the run ends at " + end.text,
                            "nobody changes its body by it: begin earlier, or leave the region away");
    check_inside_domain(c, r, region);
  }
  for (const Region& other : c.study.model.swaps.regions)
    if (r.name.known() && other.name == region.name)
      c.diagnostics.error(112, r.name.place, "two regions are called '" + region.name + "'", "give each its own name");
  c.study.model.swaps.regions.push_back(std::move(region));
}

/// A region that names more cells than there may be shells, where nothing else decides who is one.
void warn_of_cells_left_out(BuildContext& c, const draft::Region& region, const Place& place) {
  const std::uint64_t most = c.study.model.swaps.max_shells;
  const auto is_shell = [](const auto& one) { return one.content.body.value == "shell"; };
  const auto is_sphere = [](const auto& one) { return one.content.body.value == "sphere"; };
  if (std::ranges::any_of(c.draft.cell_types, is_shell) || std::ranges::any_of(c.draft.initial, is_shell) ||
      std::ranges::any_of(c.draft.coupling.regions, is_sphere))
    return;
  std::set<std::string> named;
  for (const auto& [key, ids] : region.own.lists) named.insert(ids.value.begin(), ids.value.end());
  if (named.size() <= most) return;
  c.diagnostics.warning(694, place,
                        "region '" + region.name.value + "' names " + std::to_string(named.size()) + " cells, and `max_shells` allows " +
                            std::to_string(most) + " shells: the others stay spheres",
                        "a larger `coupling.max_shells`");
}

}  // namespace

void build_coupling(BuildContext& c) {
  const UnitSystem units;
  draft::Coupling& coupling = c.draft.coupling;
  coupling.swaps.write_to(c.study.model.swaps);
  c.study.model.swaps.gradual = coupling.exchange.value == "gradual";
  for (auto& [name, place, region] : coupling.regions) {
    build_region(c, region, place);
    warn_of_cells_left_out(c, region, place);
  }
  for (const auto& [name, place, trigger] : coupling.triggers) build_trigger(c, units, trigger, place);
}

}  // namespace morula::scenarios
