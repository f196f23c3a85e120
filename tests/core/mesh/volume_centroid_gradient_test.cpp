#include "core/mesh/volume_centroid_gradient.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/mesh/topology.h"

namespace morula {
namespace {

/// A cell without any symmetry, far from the origin.
std::vector<Vec3d> bent(const ReferenceShape& shape) {
  std::vector<Vec3d> out;
  for (const Vec3d& p : shape.position)
    out.push_back(Vec3d{6.0 * p.x + 2.0 * p.y * p.y, 9.0 * p.y + std::sin(3.0 * p.z), 7.0 * p.z - 1.5 * p.x * p.y} + Vec3d{40, -20, 5});
  return out;
}

TEST(VolumeCentroidGradient, IsThatOfFiniteDifferences) {
  ShapeLibrary library;
  const auto shape = library.icosphere(162).value();
  const auto faces = shape->topology->faces();
  std::vector<Vec3d> x = bent(*shape);
  const auto gradient = volume_centroid_gradient(faces, x);
  const double h = 1e-4;
  for (const std::uint32_t node : {0u, 17u, 80u, 161u})
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double here = x[node][axis];
      x[node][axis] = here + h;
      const Vec3d ahead = volume_centroid(faces, x);
      x[node][axis] = here - h;
      const Vec3d behind = volume_centroid(faces, x);
      x[node][axis] = here;
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(gradient[node][k][axis], (ahead[k] - behind[k]) / (2.0 * h), 1e-8);
    }
}

TEST(VolumeCentroidGradient, SumsUpToTheUnitMatrix) {
  ShapeLibrary library;
  const auto shape = library.icosphere(162).value();
  std::array<Vec3d, 3> sum{};
  for (const CentroidGradient& of_node : volume_centroid_gradient(shape->topology->faces(), bent(*shape)))
    for (std::size_t k = 0; k < 3; ++k) sum[k] += of_node[k];
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(sum[k][axis], k == axis ? 1.0 : 0.0, 1e-12);
}

/// On a ball ∂x̄/∂x of a small part of the surface is 3 dA/(4πR²) n nᵀ: nothing along the surface, to the angles of a mesh of 2,562 nodes.
TEST(VolumeCentroidGradient, OfABallActsAlongItsNormals) {
  ShapeLibrary library;
  const auto shape = library.icosphere(2562).value();
  const auto gradient = volume_centroid_gradient(shape->topology->faces(), shape->position);
  const double part = 3.0 / static_cast<double>(gradient.size());
  for (std::size_t i = 0; i < gradient.size(); i += 61) {
    const Vec3d n = normalized(shape->position[i]);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(norm(gradient[i][k] - n * (part * n[k])), 0.25 * part) << i;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d along = gradient[i][k] - n * dot(n, gradient[i][k]);
      EXPECT_LT(norm(along), 0.01 * part) << i;
    }
  }
}

}  // namespace
}  // namespace morula
