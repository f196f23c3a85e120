#include <array>
#include <cmath>

#include "scenarios/study/build.h"
#include "scenarios/study/obstacle_shapes.h"

namespace morula::scenarios {
namespace {

bool has_direction(BuildContext& c, const Given<Vec3d>& from, const Given<Vec3d>& to) {
  if (!from.known() || !to.known()) return false;
  if (norm2(to.value - from.value) > 0.0) return true;
  c.diagnostics.error(302, to.place, "'from' and 'to' are the same point", "give the two ends of the axis");
  return false;
}

TriangleMesh primitive(BuildContext& c, const draft::Obstacle& o) {
  if (o.plane.present && o.plane.center.known() && o.plane.normal.known() && o.plane.radius.known()) {
    if (norm2(o.plane.normal.value) > 0.0) return slab_surface(o.plane.center.value, o.plane.normal.value, o.plane.radius.value);
    c.diagnostics.error(302, o.plane.normal.place, "'normal' has no direction", "for example `[0, 0, 1]`");
  }
  if (o.sphere.present && o.sphere.center.known() && o.sphere.radius.known()) return sphere_surface(o.sphere.center.value, o.sphere.radius.value);
  if (o.box.present && o.box.center.known() && o.box.size.known()) return box_surface(o.box.center.value, o.box.size.value);
  if (o.cylinder.present && o.cylinder.radius.known() && has_direction(c, o.cylinder.low_end, o.cylinder.high_end))
    return cylinder_surface(o.cylinder.low_end.value, o.cylinder.high_end.value, o.cylinder.radius.value);
  if (o.capsule.present && o.capsule.radius.known() && has_direction(c, o.capsule.low_end, o.capsule.high_end))
    return capsule_surface(o.capsule.low_end.value, o.capsule.high_end.value, o.capsule.radius.value);
  return {};
}

void check_place(BuildContext& c, const std::string& name, const Place& place, const std::vector<Vec3d>& position) {
  if (!c.draft.domain.size.known() || position.empty()) return;
  Box box;
  for (const Vec3d& p : position) box.include(p);
  if (!c.study.model.space.box.overlaps(box))
    c.diagnostics.error(502, place, "obstacle '" + name + "' lies outside the domain: no cell can ever touch it", "move it, or make the domain larger");
}

}  // namespace

void build_geometry(BuildContext& c) {
  for (auto& [name, place, o] : c.draft.geometry) {
    const std::array<bool, 7> kinds{o.stl.given, o.obj.given, o.plane.present, o.sphere.present, o.cylinder.present, o.capsule.present, o.box.present};
    int count = 0;
    for (const bool kind : kinds) count += kind;
    if (count != 1)
      c.diagnostics.error(111, place, count == 0 ? "obstacle '" + name + "' has no shape" : "obstacle '" + name + "' has more than one shape",
                          "give one of `stl`, `obj`, `plane`, `sphere`, `cylinder`, `capsule`, `box`");
    if (o.scale.given && !o.stl.given && !o.obj.given)
      c.diagnostics.error(111, o.scale.place, "'scale' has no meaning without `stl` or `obj`", "leave it away");
    ObstacleSpec obstacle;
    obstacle.name = name;
    obstacle.inside = o.side.value == "inside";
    obstacle.velocity = o.velocity.value;
    TriangleMesh surface;
    if (count == 1) surface = o.stl.known() ? surface_from_file(c, o.stl, o.scale) : o.obj.known() ? surface_from_file(c, o.obj, o.scale) : primitive(c, o);
    check_place(c, name, place, surface.position);
    obstacle.position = std::move(surface.position);
    obstacle.faces = std::move(surface.faces);
    c.study.model.obstacles.push_back(std::move(obstacle));
  }
}

}  // namespace morula::scenarios
