#include <algorithm>
#include <cmath>

#include "study/build.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

Vec3d direction_of(BuildContext& c, const Given<Vec3d>& axis, const char* key) {
  if (norm2(axis.value) > 0.0) return normalized(axis.value);
  if (axis.known()) c.diagnostics.error(302, axis.place, std::string("'") + key + "' has no direction", "for example `[0, 0, 1]`");
  return {0, 0, 1};
}

/// Names the bits: marks first, then cavities whose faces are found by sight.
void name_marks(BuildContext& c) {
  std::vector<std::string>& names = c.study.model.mark_names;
  const auto add = [&](const std::string& name, const Place& place) {
    if (name == "lateral" || name == "whole" || name == "seen")
      c.diagnostics.error(555, place, "'" + name + "' has a meaning of its own and cannot be the name of a mark", "choose another name");
    else if (std::find(names.begin(), names.end(), name) != names.end())
      c.diagnostics.error(112, place, "a mark and a cavity are both called '" + name + "'", "each has a name of its own");
    names.push_back(name);
  };
  for (const auto& [name, place, mark] : c.draft.marks) add(name, place);
  for (const auto& [name, place, lumen] : c.draft.lumens)
    if (lumen.faces.value == "seen") add(name, place);
}

FaceMark rule_of(BuildContext& c, const std::string& name, const Place& place, const draft::Mark& m) {
  FaceMark rule;
  rule.always = m.when.value == "always" || m.touched;
  if (m.cone + m.band + m.ball + m.box + m.touched != 1) {
    c.diagnostics.error(111, place, "mark '" + name + "' needs exactly one rule",
                        "give one of `cone`, `band`, `ball`, `box`, `touched_by`");
    return rule;
  }
  if (m.cone) {
    rule.angle = m.angle.value;
    if (m.cone_axis.given) rule.axis = direction_of(c, m.cone_axis, "axis");
    if (m.cone_toward.given) rule.axis_from = FaceMark::Axis::kTowardPoint;
    if (m.cone_polarity.value) rule.axis_from = FaceMark::Axis::kPolarity;
    rule.center = m.cone_toward.value;
    if (m.cone_axis.given + m.cone_toward.given + m.cone_polarity.value != 1)
      c.diagnostics.error(111, place, "the cone of mark '" + name + "' needs exactly one axis",
                          "give one of `axis`, `toward`, `polarity: true`");
  } else if (m.band) {
    rule.rule = FaceMark::Rule::kBand;
    rule.axis = direction_of(c, m.band_axis, "axis");
    rule.half_width = m.half_width.value;
  } else if (m.ball) {
    rule.rule = FaceMark::Rule::kBall;
    rule.center = m.ball_center.value;
    rule.radius = m.ball_radius.value;
  } else if (m.box) {
    rule.rule = FaceMark::Rule::kBox;
    rule.center = m.box_center.value;
    rule.size = m.box_size.value;
  } else {
    rule.rule = FaceMark::Rule::kTouched;
    rule.keep = m.keep.value;
    if (m.material.known()) rule.material = find_cell_or_obstacle(c, m.material.value, m.material.place);
  }
  return rule;
}

void build_marks(BuildContext& c) {
  int bit = 0;
  for (auto& [name, place, m] : c.draft.marks) {
    if (m.touched && !m.when.given) m.when.text.clear();  // no meaning: not part of the resolved study
    FaceMark rule = rule_of(c, name, place, m);
    rule.mark = bit++;
    for (const std::string& type_name : m.types.value) {
      const int type = find_type(c, type_name, m.types.place);
      if (type < 0) continue;
      rule.type = static_cast<std::uint16_t>(type);
      if (!may_be_shell(c, static_cast<std::size_t>(type)))
        c.diagnostics.error(555, m.types.place, "mark '" + name + "' is for faces, and cells of '" + type_name + "' are always spheres",
                            "give the type `body: shell`");
      if (rule.axis_from == FaceMark::Axis::kPolarity && !c.draft.cell_types[static_cast<std::size_t>(type)].content.activity.has_polarity)
        c.diagnostics.error(555, place, "mark '" + name + "' lies about the polarity, and cells of '" + type_name + "' have none",
                            "give the type a `polarity`");
      if (rule.rule == FaceMark::Rule::kTouched && rule.material < 0) continue;
      c.study.model.marks.push_back(rule);
    }
  }
}

/// Contacts need a tension above half of the adhesion of their own, or something elastic.
void check_tension(BuildContext& c, std::size_t type, const TensionRegion& region, const Named<draft::TensionRegion>& item) {
  const Model& model = c.study.model;
  const draft::CellType& t = c.draft.cell_types[type].content;
  double most = 0.0;
  for (std::size_t other = 0; other < model.types.size() && !model.pairs.empty(); ++other)
    most = std::max(most, model.pair(type, other).adhesion);
  const double least = region.least();
  if (most == 0.0 || 2.0 * least > most) return;
  const std::string what = "the tension of '" + item.name + "' falls to " + short_number(least) +
                           " mN/m, half of the adhesion between cells (" + short_number(most) + " mJ/m^2) or less: ";
  const std::string help = "more tension there, or less adhesion";
  if (!resists_in_plane(t))
    c.diagnostics.error(556, item.content.tension.place, what + "a cortex that is not elastic has no rest there", help);
  else
    c.diagnostics.warning(556, item.content.tension.place, what + "only the elasticity of the cortex holds contacts there", help);
}

/// What contact takes from the tension of a fluid is an energy of the contact where nothing else differs along its surface (decision 0084).
bool lateral_adheres(const BuildContext& c, std::size_t type) {
  const auto& [name, place, t] = c.draft.cell_types[type];
  const auto is_mark = [](const auto& item) { return item.name != "lateral" && item.name != "whole"; };
  const auto adheres_by_marks = [&name](const auto& pair) {
    return !pair.content.regions.empty() && std::ranges::find(pair.content.between.value, name) != pair.content.between.value.end();
  };
  return !resists_in_plane(t) && std::ranges::none_of(t.tension_regions, is_mark) &&
         std::ranges::none_of(c.draft.contact.pairs, adheres_by_marks);
}

/// Of fluids: contacts that cannot hold, and those that lie a little beside Young's law, since a fluid bears no difference of tension along its surface
/// (measured with doublets of 162 and 642 nodes, tensions of 0.1 to 0.4 mN/m against 0.3: the difference counts by 82 to 92 % only).
void check_lateral(BuildContext& c, std::size_t type, const TensionRegion& region, const Named<draft::TensionRegion>& item) {
  const Model& model = c.study.model;
  const double difference = model.types[type].shell.tension - region.tension;
  if (region.mark != TensionRegion::kLateral || difference == 0.0 || resists_in_plane(c.draft.cell_types[type].content)) return;
  const double adhesion = model.pairs.empty() ? 0.0 : model.pair(type, type).adhesion, as_adhesion = adhesion + 2.0 * difference;
  const auto warn = [&](const std::string& what, const std::string& help) {
    c.diagnostics.warning(
        695, item.content.tension.place,
        "the tension in contact differs from that of the free surface by " + short_number(std::abs(difference)) + " mN/m, " + what, help);
  };
  if (!model.types[type].regional_tension.lateral_adheres)
    warn(
        "and a cortex that is not elastic flows to where it is higher: contact angles miss Young's law, as if a tenth to a fifth of the "
        "difference were not "
        "there",
        "no tension or adhesion by marks beside it, or an elastic cortex");
  else if (as_adhesion < 0.0)
    warn("more than half of the adhesion bears: such cells do not stick to each other, as if they had no adhesion",
         "less tension in contact, or an adhesion above " + short_number(-2.0 * difference) + " mJ/m^2");
}

void build_tensions(BuildContext& c) {
  for (std::size_t i = 0; i < c.draft.cell_types.size(); ++i) {
    const draft::CellType& t = c.draft.cell_types[i].content;
    RegionalTension& out = c.study.model.types[i].regional_tension;
    out.easing = t.lateral_easing.value;
    out.lateral_adheres = lateral_adheres(c, i);
    // Renewal comes after each step, at the shape that this has found.
    if (const double rate = c.study.model.types[i].shell.turnover_rate; rate > 0.0)
      c.study.model.step.max_step = std::min(c.study.model.step.max_step, 0.1 / rate);
    for (const auto& item : t.tension_regions) {
      TensionRegion region;
      region.tension = item.content.tension.value;
      region.amplitude = item.content.amplitude.value;
      region.period = item.content.period.value;
      item.content.plain.write_to(region);
      region.course = build_course(c, item.content.course);
      if (item.content.amplitude.value > 0.0 && region.period == 0.0)
        c.diagnostics.error(515, item.content.amplitude.place, "'amplitude' has no effect without a period", "give `period`");
      if (region.phase != 0.0 && (region.period == 0.0 || region.amplitude == 0.0))
        c.diagnostics.error(515, item.place, "'phase' of '" + item.name + "' has no effect without a modulation",
                            "give `amplitude` and `period`, or leave it away");
      if (item.name == "lateral")
        region.mark = TensionRegion::kLateral;
      else if (item.name == "whole")
        region.mark = TensionRegion::kWhole;
      else if ((region.mark = find_mark(c, item.name, item.place)) < 0)
        continue;
      if (region.period > 0.0) c.study.model.step.max_step = std::min(c.study.model.step.max_step, region.period / 20.0);
      check_tension(c, i, region, item);
      check_lateral(c, i, region, item);
      out.regions.push_back(std::move(region));
    }
    // Resolved studies name the usual value in any case: it is part of the material that laws are fitted to.
    if (t.lateral_easing.given && t.lateral_easing.value != RegionalTension().easing && !out.eases_contact())
      c.diagnostics.error(515, t.lateral_easing.place, "'lateral_easing' has no effect here",
                          out.lateral() == nullptr
                              ? "it belongs to the region `lateral`"
                              : "surfaces of a cortex that is not elastic adhere by what contact takes from their tension, at once");
    if (!out.empty() && !may_be_shell(c, i))
      c.diagnostics.error(555, t.tension_regions.front().place,
                          "regions are of a surface, and cells of '" + c.draft.cell_types[i].name + "' are always spheres",
                          "give the type `body: shell`");
  }
}

void build_lumens(BuildContext& c) {
  for (const auto& [name, place, d] : c.draft.lumens) {
    Lumen lumen;
    lumen.name = name;
    lumen.by_sight = d.faces.value == "seen";
    lumen.mark = find_mark(c, lumen.by_sight ? name : d.faces.value, d.faces.given ? d.faces.place : place);
    lumen.center = d.center.value;
    d.plain.write_to(lumen);
    lumen.pressure = d.pressure.value;
    lumen.keeps_solute = d.solute.value == "kept";
    lumen.course = build_course(c, d.course);
    if (d.center.known() && !c.study.model.space.box.contains(lumen.center))
      c.diagnostics.error(502, d.center.place, "the cavity '" + name + "' lies outside the domain", "a point between the cells");
    if (d.pressure.known() && lumen.keeps_solute && lumen.pressure <= 0.0)
      c.diagnostics.error(557, d.pressure.place, "a cavity that keeps its solute has a positive pressure", "for example `20 Pa`");
    if (!may_have_shells(c))
      c.diagnostics.error(557, place, "the cavity '" + name + "' has no walls: no cell of this study is a shell",
                          "cells with `body: shell`");
    if (c.study.model.space.any_periodic())
      c.diagnostics.error(557, place, "the cavity '" + name + "' is in a domain with periodic faces, where nothing is outside",
                          "open faces or walls");
    const auto& boundary = c.study.model.space.boundary;
    const bool walls = std::ranges::any_of(boundary, [](const auto& axis) {
      return std::ranges::any_of(axis, [](BoundaryKind kind) { return kind == BoundaryKind::kWall; });
    });
    if (!lumen.by_sight && (walls || !c.draft.geometry.empty()))
      c.diagnostics.warning(698, place,
                            "the cavity '" + name + "' is bounded by the faces of a mark alone: where an obstacle closes it, it is open",
                            "`faces: seen`, which finds obstacles, too");
    if (const auto& end = c.draft.time.end; end.known() && !(lumen.from < end.value))
      c.diagnostics.warning(694, place, "the cavity '" + name + "' begins when the run has ended (" + end.text + ")",
                            "an earlier `from`, or no cavity");
    if (lumen.mark >= 0) c.study.model.lumens.push_back(std::move(lumen));
  }
}

void build_springs(BuildContext& c) {
  for (const auto& [name, place, d] : c.draft.apical) {
    ApicalSpring spring;
    spring.name = name;
    if (!d.mark.known()) continue;
    spring.mark = find_mark(c, d.mark.value, d.mark.place);
    d.plain.write_to(spring);
    if (spring.mark >= 0) c.study.model.apical_springs.push_back(std::move(spring));
  }
}

}  // namespace

std::vector<std::size_t> origins_of(const draft::Study& d, std::size_t type) {
  std::vector<std::size_t> out{type};
  const auto may_become = [&](std::size_t from, std::size_t to) {
    return std::ranges::any_of(d.cell_types[from].content.fates, [&](const auto& fate) {
      return std::ranges::find(fate.content.types.value, d.cell_types[to].name) != fate.content.types.value.end();
    });
  };
  for (std::size_t k = 0; k < out.size(); ++k)
    for (std::size_t from = 0; from < d.cell_types.size(); ++from)
      if (std::ranges::find(out, from) == out.end() && may_become(from, out[k])) out.push_back(from);
  return out;
}

bool may_be_shell(const BuildContext& c, std::size_t type) {
  const draft::Study& d = c.draft;
  if (!d.coupling.triggers.empty()) return true;
  for (const auto& region : d.coupling.regions)
    if (region.content.body.value == "shell") return true;
  for (const std::size_t origin : origins_of(d, type)) {
    if (d.cell_types[origin].content.body.value == "shell") return true;
    const BodyKind usual = c.study.model.types[origin].initial_body;
    const auto begins_as_shell = [&](const InitialCells& cells) { return cells.may_begin_as(origin, BodyKind::kShell, usual); };
    if (std::ranges::any_of(c.study.initial, begins_as_shell)) return true;
  }
  return false;
}

bool may_have_shells(const BuildContext& c) {
  for (std::size_t type = 0; type < c.draft.cell_types.size(); ++type)
    if (may_be_shell(c, type)) return true;
  return false;
}

int find_mark(BuildContext& c, const std::string& name, const Place& place) {
  const auto& names = c.study.model.mark_names;
  const auto at = std::find(names.begin(), names.end(), name);
  if (at != names.end()) return static_cast<int>(at - names.begin());
  c.diagnostics.error(401, place, "there is no mark '" + name + "'", names.empty() ? "declare it under `marks`" : suggest(name, names));
  return -1;
}

int find_cell_or_obstacle(BuildContext& c, const std::string& name, const Place& place) {
  std::vector<std::string> names;
  for (const auto& type : c.draft.cell_types) names.push_back(type.name);
  for (const auto& obstacle : c.draft.geometry) names.push_back(obstacle.name);
  const auto at = std::find(names.begin(), names.end(), name);
  if (at != names.end()) return static_cast<int>(at - names.begin());
  c.diagnostics.error(401, place, "there is no cell type or obstacle '" + name + "'", suggest(name, names));
  return -1;
}

void build_regions(BuildContext& c) {
  name_marks(c);
  build_marks(c);
  build_tensions(c);
  build_lumens(c);
  build_springs(c);
}

}  // namespace morula::scenarios
