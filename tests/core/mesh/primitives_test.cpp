#include "core/mesh/primitives.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/mesh/mesh_check.h"

namespace morula {
namespace {

using std::numbers::pi;

void expect_sound_and_closed(const TriangleMesh& mesh) {
  for (const MeshProblem& problem : check_mesh(mesh.position, mesh.faces)) ADD_FAILURE() << problem.message;
  const auto topology = Topology::build(static_cast<std::uint32_t>(mesh.position.size()), mesh.faces);
  ASSERT_TRUE(topology.ok()) << topology.error().message;
  EXPECT_EQ((*topology)->node_count() + (*topology)->face_count(), (*topology)->edge_count() + 2);
}

double volume(const TriangleMesh& mesh) { return enclosed_volume(mesh.faces, mesh.position, Vec3d{}); }

TEST(Primitives, BoxIsClosedAndHasItsVolume) {
  for (const double edge : {10.0, 1.0, 0.7}) {
    const TriangleMesh box = *make_box({2, 3, 4}, edge);
    expect_sound_and_closed(box);
    EXPECT_NEAR(volume(box), 24.0, 1e-12);
  }
}

TEST(Primitives, BoxHasNoEdgeAboveTheMarkAlongItsSides) {
  const TriangleMesh box = *make_box({2, 3, 4}, 0.7);
  for (const Triangle& face : box.faces)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_LE(norm(box.position[face[c]] - box.position[face[(c + 1) % 3]]), 0.7 * std::sqrt(2.0) + 1e-12);
}

TEST(Primitives, SphereIsClosedAtEveryLevelAndNearsItsVolume) {
  for (int level = 0; level <= 4; ++level) {
    const TriangleMesh sphere = *make_sphere(6.0, level);
    expect_sound_and_closed(sphere);
    EXPECT_EQ(sphere.position.size(), 10u * (1u << (2 * level)) + 2);
    for (const Vec3d& x : sphere.position) EXPECT_NEAR(norm(x), 6.0, 1e-14 * 6.0);
  }
  EXPECT_NEAR(volume(*make_sphere(6.0, 4)) / (4.0 / 3.0 * pi * 216.0), 0.997839, 1e-6);
}

TEST(Primitives, CylinderIsClosedAndConvergesWithTheSecondOrderOfTheEdge) {
  const double exact = pi * 4.0 * 10.0;
  double last = 0.0;
  for (const double edge : {1.0, 0.5, 0.25}) {
    const TriangleMesh cylinder = *make_cylinder(2.0, 10.0, edge);
    expect_sound_and_closed(cylinder);
    const double error = 1.0 - volume(cylinder) / exact;
    EXPECT_GT(error, 0.0);  // inscribed
    if (last > 0.0) {
      EXPECT_NEAR(last / error, 4.0, 0.5);
    }
    last = error;
    for (const Vec3d& x : cylinder.position) EXPECT_LE(std::abs(x.z), 5.0);
  }
}

TEST(Primitives, CapsuleIsClosedAndConvergesWithTheSecondOrderOfTheEdge) {
  const double exact = pi * 4.0 * 6.0 + 4.0 / 3.0 * pi * 8.0;
  double last = 0.0;
  for (const double edge : {1.0, 0.5, 0.25}) {
    const TriangleMesh capsule = *make_capsule(2.0, 10.0, edge);
    expect_sound_and_closed(capsule);
    const double error = 1.0 - volume(capsule) / exact;
    EXPECT_GT(error, 0.0);
    if (last > 0.0) {
      EXPECT_NEAR(last / error, 4.0, 0.6);
    }
    last = error;
    for (const Vec3d& x : capsule.position) {
      const double beyond = std::max(0.0, std::abs(x.z) - 3.0);
      EXPECT_NEAR(std::hypot(x.x, x.y, beyond), 2.0, 1e-14);
    }
  }
}

TEST(Primitives, ShortestCapsuleIsASphere) {
  const TriangleMesh capsule = *make_capsule(2.0, 4.0, 0.4);
  expect_sound_and_closed(capsule);
  for (const Vec3d& x : capsule.position) EXPECT_NEAR(norm(x), 2.0, 1e-14);
}

TEST(Primitives, CoarseAndThinOnesAreClosedToo) {
  expect_sound_and_closed(*make_cylinder(1.0, 0.01, 5.0));
  expect_sound_and_closed(*make_cylinder(0.01, 3.0, 0.5));
  expect_sound_and_closed(*make_capsule(1.0, 2.01, 5.0));
  expect_sound_and_closed(*make_capsule(0.3, 30.0, 0.7));
}

TEST(Primitives, PlaneIsOpenAndFacesUp) {
  const TriangleMesh plane = *make_plane(4.0, 2.0, 0.5);
  MeshExpectation open;
  open.closed = false;
  EXPECT_TRUE(check_mesh(plane.position, plane.faces, open).empty());
  const auto problems = check_mesh(plane.position, plane.faces);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].kind, MeshProblemKind::kHole);
  double area = 0.0;
  for (const auto& [a, b, c] : plane.faces) {
    const Vec3d n = cross(plane.position[b] - plane.position[a], plane.position[c] - plane.position[a]);
    EXPECT_GT(n.z, 0.0);
    area += 0.5 * n.z;
  }
  EXPECT_NEAR(area, 8.0, 1e-13);
}

TEST(Primitives, RejectLengthsThatMakeNoBody) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(make_plane(0.0, 1.0, 1.0).ok());
  EXPECT_FALSE(make_box({1, -1, 1}, 1.0).ok());
  EXPECT_FALSE(make_sphere(nan, 2).ok());
  EXPECT_FALSE(make_sphere(1.0, 10).ok());
  EXPECT_FALSE(make_sphere(1.0, -1).ok());
  EXPECT_FALSE(make_cylinder(1.0, 1.0, 0.0).ok());
  EXPECT_FALSE(make_cylinder(1.0, 1.0, 1e-5).ok());
  EXPECT_FALSE(make_cylinder(1e-9, 1.0, 1e-8).ok());
  EXPECT_FALSE(make_capsule(2.0, 3.9, 1.0).ok());
  EXPECT_FALSE(make_capsule(2.0, INFINITY, 1.0).ok());
}

}  // namespace
}  // namespace morula
