#include "coupling/loads.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace morula {
namespace {

constexpr double kTie = 1e-9;  // of a shape that encloses the volume 1

Vec3d area_vector(const Triangle& t, std::span<const Vec3d> x) { return cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]) * 0.5; }
Vec3d middle(const Triangle& t, std::span<const Vec3d> x) { return (x[t[0]] + x[t[1]] + x[t[2]]) * (1.0 / 3.0); }

/// Function(face, area vector) for every face.
template <class F>
void for_faces(const Topology& topology, std::span<const Vec3d> x, F&& function) {
  for (const Triangle& t : topology.faces()) function(t, area_vector(t, x));
}

/// Function(face, area vector) for every face with a mark.
template <class F>
void for_marked_faces(const Topology& topology, std::span<const Vec3d> x, const MarkSets& marks, int mark, F&& function) {
  for (std::size_t f = 0; f < marks.size(); ++f)
    if (marks.has(f, mark)) function(topology.faces()[f], area_vector(topology.faces()[f], x));
}

void add_to_corners(const Triangle& t, const Vec3d& whole, std::span<Vec3d> force) {
  for (const std::uint32_t node : t) force[node] += whole * (1.0 / 3.0);
}

void add_traction(const CellLoad& load, const Topology& topology, std::span<const Vec3d> x, double peak, std::span<Vec3d> force) {
  const Vec3d center = volume_centroid(topology.faces(), x);
  for_faces(topology, x, [&](const Triangle& t, const Vec3d& area) {
    const Vec3d from = middle(t, x) - center;
    const double along = dot(from, load.axis);
    add_to_corners(t, area * (peak * along * along / norm2(from)), force);
  });
}

void add_pull(const CellLoad& load, const ReferenceShape& shape, double size, std::span<Vec3d> force) {
  const auto add = [&](const Vec3d& outward) {
    const auto nodes = end_nodes(shape, outward, load.part);
    for (const std::uint32_t node : nodes) force[node] += outward * (size / static_cast<double>(nodes.size()));
  };
  if (load.end != LoadEnd::kLow) add(load.axis);
  if (load.end != LoadEnd::kHigh) add(load.axis * -1.0);
}

void add_patch(const CellLoad& load, const ReferenceShape& shape, std::span<const Vec3d> x, const MarkSets& marks, double strength,
               std::span<Vec3d> force) {
  if (load.mark < 0) {
    const auto nodes = end_nodes(shape, load.axis, load.part);
    for (const std::uint32_t node : nodes) force[node] += load.force * (strength / static_cast<double>(nodes.size()));
    return;
  }
  double whole = 0.0;
  for_marked_faces(*shape.topology, x, marks, load.mark, [&](const Triangle&, const Vec3d& area) { whole += norm(area); });
  for_marked_faces(*shape.topology, x, marks, load.mark,
                   [&](const Triangle& t, const Vec3d& area) { add_to_corners(t, load.force * (strength * norm(area) / whole), force); });
}

void add_pressure(const CellLoad& load, const ReferenceShape& shape, std::span<const Vec3d> x, const MarkSets& marks, double strength,
                  std::span<Vec3d> force) {
  const auto press = [&](const Triangle& t, const Vec3d& area) {
    const Vec3d at = middle(t, x);
    if (load.within && !lies_within(load, at)) return;
    add_to_corners(t, area * (-strength * (load.size + dot(load.gradient, at - load.origin))), force);
  };
  if (load.mark >= 0) return for_marked_faces(*shape.topology, x, marks, load.mark, press);
  std::vector<char> chosen(x.size(), load.part >= 1.0);
  const auto choose = [&](const Vec3d& outward) {
    for (const std::uint32_t node : end_nodes(shape, outward, load.part)) chosen[node] = 1;
  };
  if (load.part < 1.0 && load.end != LoadEnd::kLow) choose(load.axis);
  if (load.part < 1.0 && load.end != LoadEnd::kHigh) choose(load.axis * -1.0);
  for_faces(*shape.topology, x, [&](const Triangle& t, const Vec3d& area) {
    if (chosen[t[0]] && chosen[t[1]] && chosen[t[2]]) press(t, area);
  });
}

}  // namespace

bool lies_within(const CellLoad& load, const Vec3d& point) {
  const Vec3d axis = load.high_end - load.low_end, from = point - load.low_end;
  const double along = dot(from, axis) / norm2(axis);
  return along >= 0.0 && along <= 1.0 && norm2(from - axis * along) <= load.radius * load.radius;
}

std::vector<std::uint32_t> end_nodes(const ReferenceShape& shape, const Vec3d& axis, double part) {
  const std::size_t all = shape.position.size();
  std::vector<double> along(all);
  for (std::size_t i = 0; i < all; ++i) along[i] = dot(shape.position[i], axis);
  std::vector<double> sorted = along;
  const auto wanted = static_cast<std::size_t>(std::llround(part * static_cast<double>(all)));
  const std::size_t count = std::clamp<std::size_t>(wanted, 1, all);
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count - 1), sorted.end(), std::greater<>());
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i < all; ++i)
    if (along[i] >= sorted[count - 1] - kTie) out.push_back(static_cast<std::uint32_t>(i));
  return out;
}

void add_shell_load(const CellLoad& load, const ReferenceShape& shape, std::span<const Vec3d> position, const MarkSets& marks,
                    double strength, std::span<Vec3d> force) {
  switch (load.kind) {
    case LoadKind::kTraction:
      return add_traction(load, *shape.topology, position, load.size * strength, force);
    case LoadKind::kPull:
      return add_pull(load, shape, load.size * strength, force);
    case LoadKind::kPatch:
      return add_patch(load, shape, position, marks, strength, force);
    case LoadKind::kPressure:
      return add_pressure(load, shape, position, marks, strength, force);
    case LoadKind::kBodyForce:
    case LoadKind::kGrip:
      return;  // on the whole cell: body_force(); held within the step: grip_anchors()
  }
}

Vec3d body_force(const Model& model, std::uint16_t type, double time) {
  Vec3d out{};
  for (const CellLoad& load : model.loads)
    if (load.kind == LoadKind::kBodyForce && load.type == type) out += load.force * load.course.at(time);
  return out;
}

void add_surface_loads(const Model& model, const Tissue& tissue, double time, std::span<Vec3d> external) {
  for (const CellLoad& load : model.loads) {
    const double strength = load.course.at(time);
    if (strength == 0.0 || load.kind == LoadKind::kBodyForce || load.kind == LoadKind::kGrip) continue;
    for (const auto [row, is_shell, shell] : bodies_of(tissue.cells)) {
      if (is_shell && tissue.cells.rows[row].type == load.type) {
        const std::uint32_t first = tissue.shells.first_node[shell], count = tissue.shells.first_node[shell + 1] - first;
        add_shell_load(load, *tissue.shells.shape[shell], tissue.shells.nodes(shell), tissue.shells.marks_of(shell), strength,
                       external.subspan(first, count));
      }
    }
  }
}

double next_corner(const Model& model, double time) {
  double next = kNever;
  for (const CellLoad& load : model.loads) next = std::min({next, load.course.next_point(time), load.way.next_point(time)});
  for (const ObstacleSpec& obstacle : model.obstacles) next = std::min(next, obstacle.distance.next_point(time));
  for (const Lumen& lumen : model.lumens) {
    next = std::min(next, lumen.course.next_point(time));
    if (lumen.from > time) next = std::min(next, lumen.from);
  }
  for (const CellType& type : model.types) {
    next = std::min(next, type.osmosis.course.next_point(time));
    for (const TensionRegion& region : type.regional_tension.regions) next = std::min(next, region.course.next_point(time));
  }
  return next;
}

}  // namespace morula
