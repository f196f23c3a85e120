#include <algorithm>

#include "study/build.h"

namespace morula::scenarios {
namespace {

Vec3d unit_axis(BuildContext& c, const Given<Vec3d>& axis, const char* key) {
  if (!axis.known()) return {1, 0, 0};
  if (norm2(axis.value) == 0.0) {
    c.diagnostics.error(302, axis.place, std::string("'") + key + "' has no direction", "for example `[1, 0, 0]`");
    return {1, 0, 0};
  }
  return normalized(axis.value);
}

LoadEnd end_of(const Given<std::string>& word) {
  return word.value == "high" ? LoadEnd::kHigh : word.value == "low" ? LoadEnd::kLow : LoadEnd::kBoth;
}

/// A load on the surface needs shells; one on chosen nodes needs to know where these were at the start.
/// `marked`: the load is for faces with a mark, known or not.
void check_bodies(BuildContext& c, const std::string& name, const Place& place, const CellLoad& load, bool marked) {
  if (load.kind == LoadKind::kBodyForce) return;
  const std::string who = "load '" + name + "' acts on the surface of '" + c.study.model.types[load.type].name + "'";
  const bool chosen =
      !marked && (load.kind == LoadKind::kPull || load.kind == LoadKind::kPatch || load.kind == LoadKind::kGrip || load.part < 1.0);
  for (const InitialCells& block : c.study.initial) {
    if (block.type != load.type && block.source != InitialCells::Source::kCsv) continue;
    const BodyKind body = block.body_given ? block.body : c.study.model.types[load.type].initial_body;
    if (body == BodyKind::kSphere && c.draft.coupling.regions.empty() && c.draft.coupling.triggers.empty()) {
      c.diagnostics.error(520, place, who + ", but cells of that type are spheres", "place them `as: shell`, or use `body_force`");
      return;
    }
    if (!chosen) continue;
    if (block.orientation != Orientation::kAligned) {
      c.diagnostics.error(520, place, who + " at chosen nodes, but its cells are turned at random",
                          "place them with `orientation: aligned`");
      return;
    }
  }
  const bool swaps = !c.draft.coupling.regions.empty() || !c.draft.coupling.triggers.empty();
  if (chosen && (swaps || c.study.model.types[load.type].cycles))
    c.diagnostics.error(520, place, who + " at chosen nodes, which a cell that divides or changes its body would not keep",
                        "use a load on the whole cell, or cells that stay as they are");
}

void build_grip(BuildContext& c, draft::Load& d, CellLoad& load) {
  load.center = d.grip_center.value;
  load.direction = unit_axis(c, d.grip_direction, "direction");
  load.way = build_course(c, d.way);
  for (int axis = 0; axis < 3; ++axis)
    if (c.study.model.space.periodic(axis)) {
      c.diagnostics.error(570, d.grip_center.place, std::string("a grip holds places, but the domain is periodic along ") + "xyz"[axis],
                          "use `open` or `wall` faces");
      return;
    }
}

/// The mark of the faces that bear a load, −1 where `name` is not given. `placed`: keys beside it that say where a load acts; a value that is
/// not the default contradicts it (the resolved study writes defaults out).
struct Placed {
  const Place& place;
  bool is_default;
};

int mark_of_load(BuildContext& c, const CellLoad& load, int type, const Given<std::string>& name, std::initializer_list<Placed> placed) {
  if (!name.given) return -1;
  for (const Placed& key : placed)
    if (!key.is_default)
      c.diagnostics.error(594, key.place, "load '" + load.name + "' acts on the faces marked '" + name.value + "', wherever they are",
                          "remove this key or `marked`");
  const int mark = find_mark(c, name.value, name.place);
  if (mark >= 0 && type >= 0 && !may_carry_mark(c, type, mark))
    c.diagnostics.error(
        580, name.place,
        "no face of '" + c.draft.cell_types[static_cast<std::size_t>(type)].name + "' ever carries the mark '" + name.value + "'",
        "give the mark to shells of this type (`marks: " + name.value + ": types`)");
  return mark;
}

void build_patch(BuildContext& c, const draft::Load& d, int type, CellLoad& load) {
  load.kind = LoadKind::kPatch;
  load.force = d.patch_force.value;
  load.axis = unit_axis(c, d.patch_ends.axis, "toward");
  load.part = d.patch_ends.part.value;
  load.end = LoadEnd::kHigh;
  const draft::LoadEnds& at = d.patch_ends;
  load.mark =
      mark_of_load(c, load, type, d.patch_mark, {{at.axis.place, at.axis.value == Vec3d{1, 0, 0}}, {at.part.place, at.part.value == 0.02}});
}

void build_pressure(BuildContext& c, const draft::Load& d, int type, CellLoad& load) {
  load.gradient = d.pressure_gradient.value;
  load.origin = d.pressure_origin.value;
  const draft::LoadEnds& at = d.pressure_ends;
  load.mark = mark_of_load(
      c, load, type, d.pressure_mark,
      {{at.axis.place, at.axis.value == Vec3d{1, 0, 0}}, {at.part.place, at.part.value == 1.0}, {at.ends.place, at.ends.value == "both"}});
  if (norm2(load.gradient) == 0.0 && norm2(load.origin) > 0.0)
    c.diagnostics.error(515, d.pressure_origin.place, "'origin' has no effect here",
                        "it is where a pressure with a `gradient` has its `value`");
  const double along[3] = {load.gradient.x, load.gradient.y, load.gradient.z};
  for (int axis = 0; axis < 3; ++axis)
    if (along[axis] != 0.0 && c.study.model.space.periodic(axis))
      c.diagnostics.error(570, d.pressure_gradient.place,
                          std::string("the pressure changes along ") + "xyz"[axis] + ", along which the domain is periodic",
                          "use `open` or `wall` faces");
}

void build_within(BuildContext& c, const draft::Shape& shape, CellLoad& load) {
  load.within = true;
  load.low_end = shape.low_end.value;
  load.high_end = shape.high_end.value;
  load.radius = shape.radius.value;
  if (shape.low_end.known() && shape.high_end.known() && norm2(load.high_end - load.low_end) == 0.0)
    c.diagnostics.error(302, shape.high_end.place, "'from' and 'to' are the same point", "give the two ends of the cylinder's axis");
}

}  // namespace

TimeCourse build_course(BuildContext& c, const std::vector<Named<draft::CoursePoint>>& points) {
  TimeCourse out;
  for (const auto& [name, place, point] : points) {
    if (!point.time.known() || !point.value.known()) return {};
    if (!out.time.empty() && point.time.value <= out.time.back()) {
      c.diagnostics.error(510, point.time.place,
                          "the times of a course must increase, but " + point.time.text + " is not after the one before it",
                          "sort the points by time");
      return {};
    }
    out.time.push_back(point.time.value);
    out.value.push_back(point.value.value);
  }
  if (out.time.size() == 1)
    c.diagnostics.error(510, points.front().place, "a course needs at least two points", "give where it begins and where it ends");
  return out;
}

void build_motion_course(BuildContext& c, const draft::Obstacle& o, ObstacleSpec& obstacle) {
  if (o.course.empty()) return;
  obstacle.direction = unit_axis(c, o.direction, "direction");
  obstacle.distance = build_course(c, o.course);
}

void build_loads(BuildContext& c) {
  for (auto& [name, place, d] : c.draft.loads) {
    const int kinds = d.traction + d.pull + d.patch + d.pressure + d.grip + d.body_force.given;
    if (kinds != 1) {
      c.diagnostics.error(111, place, "load '" + name + "' " + (kinds == 0 ? "says nothing of a force" : "has more than one kind of force"),
                          "give one of `traction`, `pull`, `patch`, `pressure`, `grip`, `body_force`");
      continue;
    }
    const int type = d.type.known() ? find_type(c, d.type.value, d.type.place) : -1;
    CellLoad load;
    load.name = name;
    load.type = static_cast<std::uint16_t>(std::max(0, type));
    if (d.traction) {
      load.kind = LoadKind::kTraction;
      load.size = d.peak.value;
      load.axis = unit_axis(c, d.traction_axis, "axis");
    } else if (d.patch) {
      build_patch(c, d, type, load);
    } else if (d.pull || d.pressure || d.grip) {
      const draft::LoadEnds& ends = d.pull ? d.pull_ends : d.pressure ? d.pressure_ends : d.grip_ends;
      load.kind = d.pull ? LoadKind::kPull : d.pressure ? LoadKind::kPressure : LoadKind::kGrip;
      load.size = d.pull ? d.pull_force.value : d.pressure ? d.pressure_value.value : d.grip_stiffness.value;
      load.axis = unit_axis(c, ends.axis, "axis");
      load.part = ends.part.value;
      load.end = end_of(ends.ends);
      if (d.grip) build_grip(c, d, load);
      if (d.pressure) build_pressure(c, d, type, load);
      if (d.pressure_within.present) build_within(c, d.pressure_within, load);
    } else {
      load.force = d.body_force.value;
    }
    load.course = build_course(c, d.course);
    if (type >= 0 && static_cast<std::size_t>(type) < c.study.model.types.size())
      check_bodies(c, name, place, load, d.patch_mark.given || d.pressure_mark.given);
    c.study.model.loads.push_back(std::move(load));
  }
}

}  // namespace morula::scenarios
