#include <cmath>

#include "core/mesh/pseudonormal.h"
#include "core/mesh/topology.h"

namespace morula {
namespace {

Vec3d mean_position(std::span<const Vec3d> position) {
  Vec3d sum;
  for (const Vec3d& x : position) sum += x;
  return sum / static_cast<double>(position.size());
}

/// N = (x1−x0)×(x2−x0): twice the area times the outward normal.
Vec3d area_vector(const Triangle& face, std::span<const Vec3d> position) {
  return cross(position[face[1]] - position[face[0]], position[face[2]] - position[face[0]]);
}

}  // namespace

double enclosed_volume(std::span<const Triangle> faces, std::span<const Vec3d> position, const Vec3d& origin) {
  double six_volumes = 0.0;
  for (const auto& [a, b, c] : faces) six_volumes += dot(position[a] - origin, cross(position[b] - origin, position[c] - origin));
  return six_volumes / 6.0;
}

SymMat3<double> second_moments(std::span<const Vec3d> position, std::span<const Triangle> faces) {
  std::vector<std::pair<Vec3d, double>> middles;
  Vec3d center;
  double whole = 0.0;
  for (const auto& [i, j, k] : faces) {
    const Vec3d &a = position[i], &b = position[j], &c = position[k], middle = (a + b + c) / 3.0;
    const double area = 0.5 * norm(cross(b - a, c - a));
    middles.emplace_back(middle, area);
    center += middle * area;
    whole += area;
  }
  center = center / whole;
  SymMat3<double> out;
  for (const auto& [middle, area] : middles) out += area * outer(1.0, middle - center);
  return out;
}

Vec3d volume_centroid(std::span<const Triangle> faces, std::span<const Vec3d> position) {
  // Tetrahedra from a point in the middle: their centroids lie at a quarter of the sum of the other three corners.
  const Vec3d origin = mean_position(position);
  double six_volumes = 0.0;
  Vec3d moment;
  for (const auto& face : faces) {
    const Vec3d a = position[face[0]] - origin, b = position[face[1]] - origin, c = position[face[2]] - origin;
    const double tetrahedron = dot(a, cross(b, c));
    six_volumes += tetrahedron;
    moment += (a + b + c) * tetrahedron;
  }
  return origin + moment / (4.0 * six_volumes);
}

std::shared_ptr<const ReferenceShape> make_reference_shape(std::shared_ptr<const Topology> topology, std::vector<Vec3d> position) {
  const auto faces = topology->faces();
  const Vec3d center = volume_centroid(faces, position);
  const double volume = enclosed_volume(faces, position, center);
  if (!(volume > 0.0) || !std::isfinite(volume)) return nullptr;
  const double scale = 1.0 / std::cbrt(volume);
  for (Vec3d& x : position) x = (x - center) * scale;

  auto shape = std::make_shared<ReferenceShape>();
  shape->face_area.reserve(faces.size());
  for (const Triangle& face : faces) shape->face_area.push_back(0.5 * norm(area_vector(face, position)));
  shape->edge_length.reserve(topology->edge_count());
  shape->hinge_angle.reserve(topology->edge_count());
  for (const Edge& edge : topology->edges()) {
    const Vec3d along = position[edge.j] - position[edge.i];
    const Vec3d left = area_vector(faces[edge.left], position), right = area_vector(faces[edge.right], position);
    shape->edge_length.push_back(norm(along));
    shape->hinge_angle.push_back(turning_angle(left, right, along));
  }
  shape->topology = std::move(topology);
  shape->position = std::move(position);
  return shape;
}

}  // namespace morula
