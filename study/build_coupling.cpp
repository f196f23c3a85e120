#include <cmath>
#include <optional>

#include "study/build.h"
#include "study/quantity_reader.h"

namespace morula::scenarios {
namespace {

/// `subject > quantity`, as a trigger writes it.
struct Comparison {
  bool above = true;
  int field = -1;  ///< −1: pressure
  double value = 0.0;
  std::string subject, value_text;
};

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
  const bool pressure = comparison.subject == "pressure";
  if (!pressure) {
    std::vector<std::string> allowed{"pressure"};
    for (std::size_t i = 0; i < c.draft.fields.size(); ++i) {
      allowed.push_back(c.draft.fields[i].name);
      if (c.draft.fields[i].name == comparison.subject) comparison.field = static_cast<int>(i);
    }
    if (comparison.field < 0) {
      c.diagnostics.error(402, given.place, "there is no field '" + comparison.subject + "' to compare",
                          suggest(comparison.subject, allowed));
      return std::nullopt;
    }
  }
  const auto value =
      read_quantity(units, comparison.value_text, pressure ? Quantity::kPressure : Quantity::kConcentration, comparison.subject,
                    pressure ? "pressure > 1 kPa" : comparison.subject + " < 0.05 mM", given.place, c.diagnostics);
  if (!value) return std::nullopt;
  comparison.value = *value;
  return comparison;
}

void check_thresholds(BuildContext& c, const UnitSystem& units, const draft::Trigger& t, const Comparison& up, const Comparison& down) {
  const Quantity quantity = up.field < 0 ? Quantity::kPressure : Quantity::kConcentration;
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

void build_trigger(BuildContext& c, const UnitSystem& units, const draft::Trigger& t, const Place& place) {
  Trigger trigger;
  trigger.hold = t.hold.value;
  if (t.type.given) {
    if (t.promote.given || t.demote.given)
      c.diagnostics.error(111, place, "a trigger has either `type`, or `promote` and `demote`", "make two triggers");
    trigger.value = Trigger::Value::kType;
    const int type = t.type.known() ? find_type(c, t.type.value, t.type.place) : 0;
    trigger.type = static_cast<std::uint16_t>(std::max(0, type));
    c.study.model.swaps.triggers.push_back(trigger);
    return;
  }
  if (!t.promote.given || !t.demote.given) {
    c.diagnostics.error(111, place, "a trigger needs `promote` and `demote`, or `type`",
                        "for example `{promote: pressure > 1 kPa, demote: pressure < 600 Pa}`");
    return;
  }
  const auto up = t.promote.known() ? read_comparison(c, units, "promote", t.promote) : std::nullopt;
  const auto down = t.demote.known() ? read_comparison(c, units, "demote", t.demote) : std::nullopt;
  if (!up || !down) return;
  check_thresholds(c, units, t, *up, *down);
  trigger.value = up->field < 0 ? Trigger::Value::kPressure : Trigger::Value::kField;
  trigger.field = up->field;
  trigger.promote_above = up->above;
  trigger.promote = up->value;
  trigger.demote = down->value;
  c.study.model.swaps.triggers.push_back(trigger);
}

bool region_shape_known(BuildContext& c, const draft::Region& r, const Place& place) {
  const auto need = [&](bool given, const char* key) {
    if (!given) c.diagnostics.error(103, place, std::string("a region of shape '") + r.shape.value + "' needs `" + key + "`", "");
    return given;
  };
  const auto refuse = [&](bool given, const Place& at, const char* key) {
    if (given) c.diagnostics.error(111, at, std::string("a region of shape '") + r.shape.value + "' has no `" + key + "`", "leave it away");
  };
  const bool sphere = r.shape.value == "sphere", box = r.shape.value == "box", half = r.shape.value == "half_space";
  refuse(!sphere && r.radius.given, r.radius.place, "radius");
  refuse(!box && r.size.given, r.size.place, "size");
  refuse(!half && r.normal.given, r.normal.place, "normal");
  if (sphere && !need(r.radius.given, "radius")) return false;
  if (box && !need(r.size.given, "size")) return false;
  if (half && !need(r.normal.given, "normal")) return false;
  if (half && r.normal.known() && norm2(r.normal.value) == 0.0) {
    c.diagnostics.error(302, r.normal.place, "'normal' has no direction", "for example `[0, 0, 1]`");
    return false;
  }
  return (!sphere || r.radius.known()) && (!box || r.size.known()) && (!half || r.normal.known()) && r.center.known();
}

void check_inside_domain(BuildContext& c, const draft::Region& r, const Region& region) {
  if (!c.draft.domain.size.known() || region.follow_tissue || region.shape == RegionShape::kEverything) return;
  const Box& domain = c.study.model.space.box;
  bool outside = false;
  if (region.shape == RegionShape::kHalfSpace) {  // the corner that lies farthest against the normal decides
    const Vec3d n = region.normal;
    const Vec3d corner{n.x > 0 ? domain.low.x : domain.high.x, n.y > 0 ? domain.low.y : domain.high.y,
                       n.z > 0 ? domain.low.z : domain.high.z};
    outside = dot(corner - region.center, n) > 0.0;
  } else {
    const Vec3d half = region.shape == RegionShape::kSphere ? Vec3d{region.radius, region.radius, region.radius} : region.size * 0.5;
    outside = !domain.overlaps({region.center - half, region.center + half});
  }
  if (outside)
    c.diagnostics.error(502, r.center.given ? r.center.place : r.shape.place,
                        "region '" + region.name + "' lies outside the domain: no cell can ever be in it",
                        "the domain reaches from " + std::to_string(static_cast<long>(domain.low.x)) + ", " +
                            std::to_string(static_cast<long>(domain.low.y)) + ", " + std::to_string(static_cast<long>(domain.low.z)) +
                            " um to " + std::to_string(static_cast<long>(domain.high.x)) + ", " +
                            std::to_string(static_cast<long>(domain.high.y)) + ", " + std::to_string(static_cast<long>(domain.high.z)) +
                            " um");
}

void build_region(BuildContext& c, const draft::Region& r, const Place& place) {
  Region region;
  region.name = r.name.value;
  if (r.shape.known() && region_shape_known(c, r, place)) {
    region.shape = r.shape.value == "box"          ? RegionShape::kBox
                   : r.shape.value == "half_space" ? RegionShape::kHalfSpace
                   : r.shape.value == "everything" ? RegionShape::kEverything
                                                   : RegionShape::kSphere;
    region.center = r.center.value;
    region.radius = r.radius.value;
    region.size = r.size.value;
    if (region.shape == RegionShape::kHalfSpace) region.normal = normalized(r.normal.value);
    region.body = r.body.value == "sphere" ? BodyKind::kSphere : BodyKind::kShell;
    region.margin = r.margin.value;
    region.follow_tissue = r.follow_tissue.value;
    region.from = r.from.value;
    region.until = r.until.value;
    if (r.from.known() && r.until.known() && !(region.from < region.until))
      c.diagnostics.error(510, r.until.given ? r.until.place : r.from.place, "region '" + region.name + "' ends before it begins",
                          "set until after from");
    check_inside_domain(c, r, region);
  }
  for (const Region& other : c.study.model.swaps.regions)
    if (r.name.known() && other.name == region.name)
      c.diagnostics.error(112, r.name.place, "two regions are called '" + region.name + "'", "give each its own name");
  c.study.model.swaps.regions.push_back(std::move(region));
}

}  // namespace

void build_coupling(BuildContext& c) {
  const UnitSystem units;
  const draft::Coupling& coupling = c.draft.coupling;
  c.study.model.swaps.max_shells = coupling.max_shells.value;
  c.study.model.swaps.hold = coupling.hold.value;
  for (const auto& [name, place, region] : coupling.regions) build_region(c, region, place);
  for (const auto& [name, place, trigger] : coupling.triggers) build_trigger(c, units, trigger, place);
}

}  // namespace morula::scenarios
