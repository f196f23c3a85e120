#include <algorithm>

#include "core/numbers/joined.h"
#include "coupling/loads/load.h"
#include "study/own_section.h"

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

/// Whether cells of this type may exchange their body: regions take everyone, triggers by type only theirs.
bool may_change_body(const BuildContext& c, std::size_t type) {
  if (!c.draft.coupling.regions.empty()) return true;
  const std::string& name = c.draft.cell_types[type].name;
  return std::ranges::any_of(c.draft.coupling.triggers,
                             [&](const auto& trigger) { return !trigger.content.type.given || trigger.content.type.value == name; });
}

/// A load on the surface needs shells; one on chosen nodes needs to know where these were at the start.
void check_bodies(BuildContext& c, const std::string& name, const Place& place, const CellLoad& load) {
  if (load.what->of_whole_cells()) return;
  const std::string who = "load '" + name + "' acts on the surface of '" + c.study.model.types[load.type].name + "'";
  const bool chosen = load.what->of_chosen_nodes != nullptr && load.what->of_chosen_nodes(load);
  for (const InitialCells& block : c.study.initial) {
    if (!block.may_have(load.type)) continue;
    const BodyKind body = block.body_given ? block.body : c.study.model.types[load.type].initial_body;
    if (body == BodyKind::kSphere && c.draft.coupling.regions.empty() && c.draft.coupling.triggers.empty()) {
      c.diagnostics.error(520, place, who + ", but cells of that type are spheres",
                          "place them `as: shell`, or use `body_force` or `trap`");
      return;
    }
    if (!chosen) continue;
    if (block.orientation != Orientation::kAligned) {
      c.diagnostics.error(520, place, who + " at chosen nodes, but its cells are turned at random",
                          "place them with `orientation: aligned`");
      return;
    }
  }
  const CellType& type = c.study.model.types[load.type];
  const char* why = may_change_body(c, load.type) ? "changes its body (`coupling` may ask for it)"
                    : type.cycles                 ? "divides"
                    : type.renew_mesh_below > 0.0 ? "renews its mesh"
                                                  : nullptr;
  if (chosen && why != nullptr)
    c.diagnostics.error(520, place, who + " at chosen nodes, which a cell that " + why + " would not keep",
                        "use a load on the whole cell, or cells that stay as they are");
  if (!chosen && may_change_body(c, load.type))
    c.diagnostics.warning(
        520, place,
        who + ", which those of its cells that `coupling` makes spheres do not have: while they are spheres they bear nothing of it",
        "use `body_force` or `trap` where all cells are meant");
}

/// The mark of the faces that bear the load; the type's shells must be able to carry it.
void check_mark(BuildContext& c, const draft::OwnSection& own, int type, int mark) {
  const Given<std::string>& name = own.texts.at("marked");
  if (mark >= 0 && type >= 0 && !may_carry_mark(c, type, mark))
    c.diagnostics.error(
        580, name.place,
        "no face of '" + c.draft.cell_types[static_cast<std::size_t>(type)].name + "' ever carries the mark '" + name.value + "'",
        "give the mark to shells of this type (`marks: " + name.value + ": types`)");
}

/// The kinds of force that a load has.
std::vector<std::shared_ptr<const Load>> kinds_of(const BuildContext& c, const draft::Load& d) {
  std::vector<std::shared_ptr<const Load>> out;
  for (const auto& kind : c.options.laws->loads) {
    const auto found = d.kinds.find(kind->section.name);
    if (found == d.kinds.end()) continue;  // the load is no map, which is told already
    const draft::OwnSection& own = found->second;
    if (kind->bare ? !given_keys(kind->keys, own).empty() : own.present) out.push_back(kind);
  }
  return out;
}

std::string all_kinds(const Laws& laws) {
  return listed(laws.loads, [](const auto& kind) { return kind->section.name; });
}

/// What the study says of the kind of a load; false where it could not be read.
bool build_kind(BuildContext& c, const draft::OwnSection& own, const Place& place, int type, CellLoad& load) {
  const auto values = own_values(c, load.what->keys, own);
  if (!values || !missing_keys(load.what->keys, own).empty()) return false;
  load.values = *values;
  load.mark = values->number("marked");
  if (load.mark >= 0) check_mark(c, own, type, load.mark);
  if (load.what->build != nullptr) load.what->build(load.values, load);
  if (load.what->judge != nullptr)
    for (const LawProblem& problem : load.what->judge(load, c.study.model)) tell_problem(c, problem, own, place);
  return true;
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
  const Given<double>& end = c.draft.time.end;
  if (out.time.size() > 1 && end.known() && out.time.front() >= end.value)
    c.diagnostics.warning(694, points.front().content.time.place,
                          "this course begins at " + points.front().content.time.text + ", and the run ends at " + end.text +
                              ": the value is that of its first point all the time",
                          "an earlier course, or a later `time.end`");
  return out;
}

void build_motion_course(BuildContext& c, const draft::Obstacle& o, ObstacleSpec& obstacle) {
  if (o.course.empty()) return;
  obstacle.direction = unit_axis(c, o.direction, "direction");
  obstacle.distance = build_course(c, o.course);
  if (obstacle.distance.empty() || obstacle.distance.value.front() == 0.0) return;
  const Given<double>& first = o.course.front().content.value;
  c.diagnostics.error(510, first.place,
                      "an obstacle begins where its shape says, and this course has it " + first.text + " from there at first",
                      "`distance: 0 um` in the first point, and the shape where the obstacle begins");
}

void build_loads(BuildContext& c) {
  for (auto& [name, place, d] : c.draft.loads) {
    const auto kinds = kinds_of(c, d);
    if (kinds.size() != 1) {
      c.diagnostics.error(111, place,
                          "load '" + name + "' " + (kinds.empty() ? "says nothing of a force" : "has more than one kind of force"),
                          "give one of " + all_kinds(*c.options.laws));
      continue;
    }
    const int type = d.type.known() ? find_type(c, d.type.value, d.type.place) : -1;
    CellLoad load;
    load.name = name;
    load.type = static_cast<std::uint16_t>(std::max(0, type));
    load.what = kinds.front();
    const draft::OwnSection& own = d.kinds.at(load.what->section.name);
    load.course = build_course(c, d.course);
    const bool read = build_kind(c, own, place, type, load);
    if (read && type >= 0 && static_cast<std::size_t>(type) < c.study.model.types.size()) check_bodies(c, name, place, load);
    c.study.model.loads.push_back(std::move(load));
  }
}

}  // namespace morula::scenarios
