#include "core/contact/surface_curvature.h"

#include <cmath>
#include <numbers>

#include "core/mesh/pseudonormal.h"

namespace morula {
namespace {

constexpr double kFlat = 1e-6;  // turn of a surface that is rounding [rad]

/// What of a triangle is nearest to its corner; of an obtuse one a half or a quarter.
double voronoi_part(const Triangle& t, std::size_t corner, std::span<const Vec3d> position, double area) {
  const Vec3d &here = position[t[corner]], a = position[t[(corner + 1) % 3]] - here, b = position[t[(corner + 2) % 3]] - here, c = b - a;
  const double at_a = -dot(a, c), at_b = dot(b, c);
  if (dot(a, b) < 0.0) return 0.5 * area;
  if (at_a < 0.0 || at_b < 0.0) return 0.25 * area;
  return (norm2(a) * at_b + norm2(b) * at_a) / (16.0 * area);  // ⅛(|a|² cot B + |b|² cot A), cot = dot/2A
}

/// ∫H dA by face [µm].
std::vector<double> turned_by_face(const Topology& topology, std::span<const Vec3d> position, const SurfaceGeometry& geometry,
                                   std::span<const std::uint32_t> part_of_face) {
  std::vector<double> out(topology.face_count(), 0.0);
  for (const Edge& edge : topology.edges()) {
    if (part_of_face[edge.left] != part_of_face[edge.right]) continue;
    const Vec3d along = position[edge.j] - position[edge.i];
    const double angle = turning_angle(geometry.face_normal[edge.left], geometry.face_normal[edge.right], along);
    if (std::abs(angle) < kFlat) continue;
    for (const std::uint32_t face : {edge.left, edge.right}) out[face] += 0.25 * norm(along) * angle;
  }
  return out;
}

/// at_node(node, part) at the corners of each face.
template <class AtNode>
auto at_corners(const Topology& topology, std::span<const std::uint32_t> part_of_face, AtNode&& at_node) {
  std::vector<std::array<decltype(at_node(0u, 0u)), 3>> out(topology.face_count());
  for (std::uint32_t f = 0; f < topology.face_count(); ++f)
    for (std::size_t corner = 0; corner < 3; ++corner) out[f][corner] = at_node(topology.faces()[f][corner], part_of_face[f]);
  return out;
}

}  // namespace

std::vector<std::array<SurfaceCurvature, 3>> curvature_of_parts(const Topology& topology, std::span<const Vec3d> position,
                                                                const SurfaceGeometry& geometry,
                                                                std::span<const std::uint32_t> part_of_face) {
  const std::vector<double> turned = turned_by_face(topology, position, geometry, part_of_face);
  const auto faces = topology.faces();
  const auto at_node = [&](std::uint32_t node, std::uint32_t part) -> SurfaceCurvature {
    double sum = 0.0, area = 0.0, voronoi = 0.0, lack = 2.0 * std::numbers::pi;
    bool rim = false;
    for (const std::uint32_t face : topology.faces_of_node(node)) {
      if (part_of_face[face] != part) {
        rim = true;
        continue;
      }
      const Triangle& t = faces[face];
      const int corner = corner_of(t, node);
      sum += turned[face];
      area += geometry.face_area[face];
      lack -= corner_angle(t, corner, position);
      voronoi += voronoi_part(t, static_cast<std::size_t>(corner), position, geometry.face_area[face]);
    }
    if (sum == 0.0) return {};
    return {sum / area, rim ? 0.0 : lack / voronoi};
  };
  return at_corners(topology, part_of_face, at_node);
}

std::vector<std::array<Vec3d, 3>> normals_of_parts(const Topology& topology, std::span<const Vec3d> position,
                                                   const SurfaceGeometry& geometry, std::span<const std::uint32_t> part_of_face) {
  const auto faces = topology.faces();
  const auto at_node = [&](std::uint32_t node, std::uint32_t part) {
    Vec3d sum;
    for (const std::uint32_t face : topology.faces_of_node(node)) {
      if (part_of_face[face] != part) continue;
      const Triangle& t = faces[face];
      const auto corner = static_cast<std::size_t>(corner_of(t, node));
      const Vec3d a = position[t[(corner + 1) % 3]] - position[node], b = position[t[(corner + 2) % 3]] - position[node];
      sum += geometry.face_normal[face] * (geometry.face_area[face] / (norm2(a) * norm2(b)));
    }
    return normalized(sum);
  };
  return at_corners(topology, part_of_face, at_node);
}

}  // namespace morula
