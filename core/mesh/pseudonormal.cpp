#include "core/mesh/pseudonormal.h"

#include <cmath>

namespace morula {

Vec3d unit_face_normal(const Triangle& face, std::span<const Vec3d> position) {
  const Vec3d normal = cross(position[face[1]] - position[face[0]], position[face[2]] - position[face[0]]);
  const double length = norm(normal);
  return length > 0.0 ? normal / length : Vec3d{};
}

double corner_angle(const Triangle& face, int corner, std::span<const Vec3d> position) {
  const auto node = [&](int c) { return position[face[static_cast<std::size_t>(c % 3)]]; };
  const Vec3d u = node(corner + 1) - node(corner), v = node(corner + 2) - node(corner);
  return std::atan2(norm(cross(u, v)), dot(u, v));  // atan2(0, 0) = 0
}

double turning_angle(const Vec3d& left_normal, const Vec3d& right_normal, const Vec3d& along) {
  // Walking along, a ridge turns the left normal into the right one about the direction of walking.
  return std::atan2(dot(cross(left_normal, right_normal), along) / norm(along), dot(left_normal, right_normal));
}

Vec3d pseudonormal(const Topology& topology, std::span<const Vec3d> position, std::uint32_t face, TriangleFeature feature) {
  const auto faces = topology.faces();
  if (feature == TriangleFeature::kFace) return unit_face_normal(faces[face], position);
  if (feature < TriangleFeature::kVertex0) {
    const auto opposite = static_cast<std::size_t>(feature) - static_cast<std::size_t>(TriangleFeature::kEdge0);
    const Edge& edge = topology.edges()[topology.face_edges()[face][opposite]];
    return unit_face_normal(faces[edge.left], position) + unit_face_normal(faces[edge.right], position);
  }
  const std::uint32_t node = faces[face][static_cast<std::size_t>(feature) - static_cast<std::size_t>(TriangleFeature::kVertex0)];
  Vec3d sum;
  for (const std::uint32_t f : topology.faces_of_node(node))
    sum += unit_face_normal(faces[f], position) * corner_angle(faces[f], corner_of(faces[f], node), position);
  return sum;
}

double signed_distance(const Topology& topology, std::span<const Vec3d> position, const Vec3d& p, std::uint32_t face,
                       const ClosestPoint& closest) {
  const double distance = std::sqrt(closest.distance2);
  return dot(p - closest.point, pseudonormal(topology, position, face, closest.feature)) < 0.0 ? -distance : distance;
}

}  // namespace morula
