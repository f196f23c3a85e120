#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/friction/contact_element.h"
#include "core/mesh/pipette.h"
#include "core/mesh/primitives.h"
#include "core/numbers/number_text.h"
#include "study/build.h"

namespace morula::scenarios {
namespace {

/// Length of the edges of curved bodies, as a part of the radius: they then lie within 0.3 % of a radius of the ideal surface.
constexpr double kEdgePerRadius = 0.15;
/// Icosphere with 2562 nodes.
constexpr int kSphereLevel = 4;

/// The mesh turned so that its z axis points along `axis` (any length but 0), then moved.
TriangleMesh placed(TriangleMesh mesh, const Vec3d& axis, const Vec3d& center) {
  const Vec3d w = normalized(axis);
  const Vec3d away = std::fabs(w.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d u = normalized(cross(away, w)), v = cross(w, u);
  for (Vec3d& p : mesh.position) p = center + u * p.x + v * p.y + w * p.z;
  return mesh;
}

TriangleMesh moved(TriangleMesh mesh, const Vec3d& center) {
  for (Vec3d& p : mesh.position) p += center;
  return mesh;
}

class PrimitiveBuilder {
 public:
  PrimitiveBuilder(BuildContext& context, const Place& place) : c_(context), place_(place) {}

  TriangleMesh build(const draft::Obstacle& o) {
    if (o.plane.present) return slab(o.plane);
    if (o.sphere.present) return sphere(o.sphere);
    if (o.box.present) return box(o.box);
    if (o.cylinder.present) return round(o.cylinder, false);
    if (o.pipette.present) return pipette(o);
    return round(o.capsule, true);
  }

 private:
  TriangleMesh take(Result<TriangleMesh> mesh) {
    if (mesh.ok()) return std::move(mesh).value();
    c_.diagnostics.error(302, place_, "this shape cannot be made: " + mesh.error().message, mesh.error().help);
    return {};
  }

  TriangleMesh slab(const draft::Shape& d) {
    if (!d.center.known() || !d.normal.known() || !d.radius.known()) return {};
    if (norm2(d.normal.value) == 0.0) {
      c_.diagnostics.error(302, d.normal.place, "'normal' has no direction", "for example `[0, 0, 1]`");
      return {};
    }
    const double size = d.radius.value, thickness = 0.1 * size;
    return placed(take(make_box({size, size, thickness}, thickness)), d.normal.value,
                  d.center.value - normalized(d.normal.value) * (0.5 * thickness));
  }

  TriangleMesh sphere(const draft::Shape& d) {
    if (!d.center.known() || !d.radius.known()) return {};
    return moved(take(make_sphere(d.radius.value, kSphereLevel)), d.center.value);
  }

  TriangleMesh box(const draft::Shape& d) {
    if (!d.center.known() || !d.size.known()) return {};
    const Vec3d size = d.size.value;
    return moved(take(make_box(size, 0.1 * std::fmax(size.x, std::fmax(size.y, size.z)))), d.center.value);
  }

  TriangleMesh round(const draft::Shape& d, bool round_ends) {
    if (!d.low_end.known() || !d.high_end.known() || !d.radius.known()) return {};
    const Vec3d axis = d.high_end.value - d.low_end.value;
    if (norm2(axis) == 0.0) {
      c_.diagnostics.error(302, d.high_end.place, "'from' and 'to' are the same point", "give the two ends of the axis");
      return {};
    }
    const double radius = d.radius.value, edge = kEdgePerRadius * radius;
    return placed(take(round_ends ? make_capsule(radius, norm(axis) + 2.0 * radius, edge) : make_cylinder(radius, norm(axis), edge)), axis,
                  (d.low_end.value + d.high_end.value) * 0.5);
  }

  TriangleMesh pipette(const draft::Obstacle& o) {
    const draft::Shape& d = o.pipette;
    if (!d.low_end.known() || !d.high_end.known() || !d.radius.known()) return {};
    const Vec3d axis = d.high_end.value - d.low_end.value;
    if (norm2(axis) == 0.0) {
      c_.diagnostics.error(302, d.high_end.place, "'from' and 'to' are the same point", "give the two ends of the axis");
      return {};
    }
    return placed(take(make_pipette(d.radius.value, o.pipette_wall.value, o.pipette_lip.value, norm(axis), o.pipette_edge.value)), axis,
                  d.low_end.value);
  }

  BuildContext& c_;
  const Place& place_;
};

void check_place(BuildContext& c, const std::string& name, const Place& place, const std::vector<Vec3d>& position) {
  if (!c.draft.domain.size.known() || position.empty()) return;
  Box box;
  for (const Vec3d& p : position) box.include(p);
  if (!c.study.model.space.box.overlaps(box))
    c.diagnostics.error(502, place, "obstacle '" + name + "' lies outside the domain: no cell can ever touch it",
                        "move it, or make the domain larger");
}

/// How far the plane b lies before the plane a at a time [µm].
double room_between(const BuildContext& c, std::size_t a, std::size_t b, const Vec3d& normal, double time) {
  const auto at = [&](std::size_t k) { return c.draft.geometry[k].content.plane.center.value + c.study.model.obstacles[k].way(0.0, time); };
  return dot(at(b) - at(a), normal);
}

/// The first time at which the planes a and b, that face each other across some room, have none between them; infinity: never [s].
double planes_meet(const BuildContext& c, std::size_t a, std::size_t b) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const draft::Shape &one = c.draft.geometry[a].content.plane, &other = c.draft.geometry[b].content.plane;
  if (norm2(one.normal.value) == 0.0 || norm2(other.normal.value) == 0.0) return kNever;
  const Vec3d normal = normalized(one.normal.value), apart = other.center.value - one.center.value;
  const bool facing = dot(normal, normalized(other.normal.value)) < -0.7 && dot(apart, normal) > 0.0;
  const double beside = norm(apart - normal * dot(apart, normal));
  if (!facing || beside > 0.5 * (one.radius.value + other.radius.value)) return kNever;
  const std::vector<ObstacleSpec>& obstacles = c.study.model.obstacles;
  double before = 0.0, room = dot(apart, normal);
  while (before < c.draft.time.end.value) {  // between the corners of both courses they go straight on
    const double time =
        std::min({obstacles[a].distance.next_point(before), obstacles[b].distance.next_point(before), c.draft.time.end.value});
    const double then = room_between(c, a, b, normal, time);
    if (then <= 0.0) return before + (time - before) * room / (room - then);
    before = time, room = then;
  }
  return kNever;
}

/// W706: plates between which no cell can be.
void check_planes(BuildContext& c) {
  if (!c.draft.time.end.known()) return;
  const auto is_plane = [&c](std::size_t k) {
    const draft::Shape& d = c.draft.geometry[k].content.plane;
    return d.present && d.center.known() && d.normal.known() && d.radius.known();
  };
  for (std::size_t b = 0; b < c.draft.geometry.size(); ++b)
    for (std::size_t a = 0; a < b; ++a) {
      if (!is_plane(a) || !is_plane(b)) continue;
      const double time = planes_meet(c, a, b);
      if (std::isinf(time)) continue;
      const bool last_moves = c.study.model.obstacles[b].moves();
      const auto& moving = c.draft.geometry[last_moves ? b : a];
      c.diagnostics.warning(706, moving.place,
                            "the planes '" + c.draft.geometry[a].name + "' and '" + c.draft.geometry[b].name + "' meet after " +
                                number_text("%.3g min", time / 60.0) + " and go through each other: no cell finds room between them",
                            "a way that ends before, by a cell that is pressed flat at least");
    }
}

}  // namespace

void build_geometry(BuildContext& c) {
  for (auto& [name, place, o] : c.draft.geometry) {
    const std::array<bool, 8> kinds{o.stl.given,        o.obj.given,       o.plane.present, o.sphere.present,
                                    o.cylinder.present, o.capsule.present, o.box.present,   o.pipette.present};
    int count = 0;
    for (const bool kind : kinds) count += kind;
    if (count != 1)
      c.diagnostics.error(111, place, "obstacle '" + name + "' has " + (count == 0 ? "no shape" : "more than one shape"),
                          "give one of `stl`, `obj`, `plane`, `sphere`, `cylinder`, `capsule`, `box`, `pipette`");
    const bool from_file = o.stl.given || o.obj.given;
    if (o.scale.given && !from_file)
      c.diagnostics.error(111, o.scale.place, "'scale' has no meaning without `stl` or `obj`", "leave it away");
    if (!from_file) o.scale.text.clear();  // its default has no meaning either: not part of the resolved study
    ObstacleSpec obstacle;
    obstacle.name = name;
    obstacle.inside = o.side.value == "inside";
    obstacle.velocity = o.velocity.value;
    build_motion_course(c, o, obstacle);
    if (o.direction.given && o.course.empty())
      c.diagnostics.error(515, o.direction.place, "'direction' has no effect without a course", "give `course`, or `velocity` alone");
    if (!o.direction.given && o.course.empty()) o.direction.text.clear();  // no meaning: not part of the resolved study
    TriangleMesh surface;
    if (count == 1) surface = from_file ? surface_from_file(c, o.stl.given ? o.stl : o.obj, o.scale) : PrimitiveBuilder(c, place).build(o);
    check_place(c, name, place, surface.position);
    obstacle.position = std::move(surface.position);
    obstacle.faces = std::move(surface.faces);
    if (c.draft.contact.friction.value == "objective" && obstacle.faces.size() > ContactElement::kMostTargetFaces)
      c.diagnostics.error(583, place,
                          "obstacle '" + name + "' has " + std::to_string(obstacle.faces.size()) +
                              " faces; with `contact: {friction: objective}` " + std::to_string(ContactElement::kMostTargetFaces) +
                              " is the most",
                          "use `friction: simple`, or a coarser surface");
    c.study.model.obstacles.push_back(std::move(obstacle));
  }
  check_planes(c);
}

}  // namespace morula::scenarios
