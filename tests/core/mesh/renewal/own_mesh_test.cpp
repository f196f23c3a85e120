// Meshes with connectivity of their own: passes of local changes, and the way back.
#include "core/mesh/renewal/own_mesh.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/mesh/remesh.h"
#include "core/mesh/renewal/area_return.h"
#include "core/mesh/renewal/onto_ball.h"
#include "core/mesh/renewal/wanted_edges.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/mesh/renewal/deformed_shapes.h"

namespace morula {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Least angle of all faces by the law of cosines, apart from the code [rad].
double least_angle_of(const TestSurface& surface) {
  double least = 3.0;
  for (const auto& face : surface.topology->faces())
    for (std::size_t c = 0; c < 3; ++c) {
      const auto side = [&](std::size_t i, std::size_t j) { return norm(surface.position[face[i % 3]] - surface.position[face[j % 3]]); };
      const double a = side(c + 1, c + 2), b = side(c, c + 1), d = side(c, c + 2);
      least = std::min(least, std::acos((b * b + d * d - a * a) / (2.0 * b * d)));
    }
  return least;
}

/// Largest bend between two faces [rad].
double largest_bend(const TestSurface& surface) {
  double largest = 0.0;
  for (const Edge& edge : surface.topology->edges()) {
    const auto normal = [&](std::uint32_t f) {
      const auto& [a, b, c] = surface.topology->faces()[f];
      return normalized(cross(surface.position[b] - surface.position[a], surface.position[c] - surface.position[a]));
    };
    largest = std::max(largest, std::acos(std::min(1.0, dot(normal(edge.left), normal(edge.right)))));
  }
  return largest;
}

/// Pass after pass until nothing changes, or `most` of them. Each is checked against what was asked of it.
TestSurface renewed(TestSurface surface, std::uint32_t nodes, int most) {
  const double volume = surface.volume();
  for (int pass = 0; pass < most; ++pass) {
    SCOPED_TRACE(pass);
    const auto done = renew_connectivity(surface.view(), {}, {.nodes = nodes});
    if (!done.ok()) {
      EXPECT_EQ(done.error().kind, ErrorKind::kPhysics);
      break;
    }
    const TestSurface next{done->topology, done->position};
    const double area = surface_area(surface.mesh()), edge = edge_of_nodes(area, nodes);
    EXPECT_LE(std::abs(surface_area(next.mesh()) / area - 1.0), 1.01e-4) << "the energy of a tension, of a pass";
    EXPECT_NEAR(next.volume() / volume, 1.0, 1e-10);
    const AskedSurface old(surface.view());
    double off = 0.0;
    for (const Vec3d& x : next.position) off = std::max(off, std::sqrt(old.nearest(x).closest.distance2));
    // 0.02 edges beyond the chord error for a change, and as much again where the area is given back.
    EXPECT_LE(off, edge * (0.04 + std::min(1.0, largest_bend(surface)) / 8.0));
    EXPECT_NEAR(off, done->report.off_surface, 1e-9);
    EXPECT_TRUE(find_self_intersections(next.position, next.topology->faces(), 1).empty());
    EXPECT_GE(next.topology->node_count(), 0.7 * nodes);
    EXPECT_LE(next.topology->node_count(), 1.5 * nodes);
    EXPECT_NEAR(done->report.least_angle, least_angle_of(next), 1e-9);
    EXPECT_EQ(next.topology->node_count() * 3 - 6, next.topology->edge_count()) << "genus 0";
    surface = next;
  }
  return surface;
}

TEST(OwnMesh, MakesLongShapesEven) {
  // Stretched by these factors along one axis at constant volume: aspects 2.8, 5.2 and 8. The tips of the last are narrower than an edge.
  for (const auto& [stretch, degrees] : {std::pair(2.0, 25.0), {3.0, 25.0}, {4.0, 15.0}}) {
    SCOPED_TRACE(stretch);
    const TestSurface start = ellipsoid(2, {stretch, 1.0 / std::sqrt(stretch), 1.0 / std::sqrt(stretch)});
    EXPECT_LT(least_angle_of(start), (stretch > 2.5 ? 15.0 : 25.0) * kDegree);
    EXPECT_GT(least_angle_of(renewed(start, 162, 15)), degrees * kDegree);
  }
}

TEST(OwnMesh, MakesNecksEven) { EXPECT_GT(least_angle_of(renewed(dumbbell(2, 0.4), 162, 15)), 15.0 * kDegree); }

TEST(OwnMesh, LeavesABallAlone) {
  const TestSurface ball = sphere(2);
  EXPECT_FALSE(renew_connectivity(ball.view(), {}, {.nodes = 162}).ok());
}

TEST(OwnMesh, RandomTangledMeshesComeOutClean) {
  std::mt19937_64 engine(5);
  for (int k = 0; k < 20; ++k) {
    SCOPED_TRACE(k);
    TestSurface start = bumpy(2, 0.2, 0.3 * k);
    const AskedSurface smooth(start.view());
    for (Vec3d& x : start.position) x = smooth.nearest(x + random_direction(engine) * 0.5).closest.point;  // 0.3 edges along the surface
    if (!find_self_intersections(start.position, start.topology->faces(), 1).empty()) continue;
    EXPECT_GT(least_angle_of(renewed(start, 162, 10)), std::max(18.0 * kDegree, least_angle_of(start)));
  }
}

TEST(OwnMesh, GoesNoDeeperIntoNeighbours) {
  const TestSurface start = ellipsoid(2, {3.0, 0.577, 0.577});
  TestSurface wall = ellipsoid(2, {3.0, 0.577, 0.577}), far = wall;
  for (Vec3d& x : wall.position) x += Vec3d{0.0, 2.0 * 0.577 * 7.0 - 0.05, 0.0};
  for (Vec3d& x : far.position) x += Vec3d{0.0, -2.0 * 0.577 * 7.0 - 0.05, 0.0};
  const std::array<SurfaceView, 2> both = {wall.view(), far.view()}, turned = {far.view(), wall.view()};
  const auto depth = [&](std::span<const Vec3d> position, const TestSurface& other) {
    double deepest = 0.0;  // along y, on which both are bodies of revolution about parallel axes
    for (const Vec3d& x : position)
      for (const Vec3d& y : other.position)
        if (norm(Vec3d{x.x - y.x, 0.0, x.z - y.z}) < 0.5) deepest = std::max(deepest, (x.y - y.y) * (other.position[0].y > 0 ? 1.0 : -1.0));
    return deepest;
  };
  const auto done = renew_connectivity(start.view(), both, {.nodes = 162});
  ASSERT_TRUE(done.ok());
  EXPECT_LE(depth(done->position, wall), depth(start.position, wall) + 0.1);
  const auto same = renew_connectivity(start.view(), turned, {.nodes = 162});
  ASSERT_TRUE(same.ok());
  EXPECT_EQ(same->position, done->position) << "whatever the order of the neighbours";
}

TEST(AreaReturn, MeetsAreaAndVolumeAndLeavesABallAlone) {
  TestSurface rod = ellipsoid(2, {2.0, 0.7, 0.7});
  const double area = surface_area(rod.mesh()), volume = rod.volume();
  std::vector<Vec3d> x = rod.position;
  const double way = give_area_back(rod.topology->faces(), 0.9995 * area, volume, 0.1, x);
  EXPECT_GT(way, 0.0);
  EXPECT_NEAR(surface_area({x, rod.mesh().faces}) / area, 0.9995, 1e-9);
  EXPECT_NEAR(TestSurface({rod.topology, x}).volume() / volume, 1.0, 1e-13);
  double longest = 0.0;
  for (std::size_t n = 0; n < x.size(); ++n) longest = std::max(longest, norm(x[n] - rod.position[n]));
  EXPECT_DOUBLE_EQ(longest, way);
  TestSurface ball = sphere(2);
  EXPECT_LT(give_area_back(ball.topology->faces(), 0.99 * surface_area(ball.mesh()), ball.volume(), 0.1, ball.position), 0.0);
  EXPECT_EQ(ball.position, sphere(2).position);
}

TEST(WantedEdges, FollowTheCurvature) {
  // A ball of radius 7: 1/|H| = 7, and edges of 642 nodes are shorter than 0.3 of that.
  const TestSurface ball = sphere(3);
  const double edge = edge_of_nodes(surface_area(ball.mesh()), 642);
  for (const double wanted : wanted_edges(ball.view(), 642, 1e9, 0.5)) EXPECT_NEAR(wanted, edge, 1e-9 * edge);
  for (const double wanted : wanted_edges(ball.view(), 42, 1e9, 0.1))
    EXPECT_NEAR(wanted, 0.3 * 7.0, 0.03 * 7.0 * 0.3) << "of 42 they are longer";
  double needed = 2.0;  // a node stands for √3/2 L²
  for (const double wanted : wanted_edges(ball.view(), 642, 300, 0.5))
    needed += surface_area(ball.mesh()) / 642 / (std::sqrt(3.0) / 2.0 * wanted * wanted);
  EXPECT_NEAR(needed, 302, 5);
}

TEST(OntoBall, TakesARoundedShellBackToTheIcosphere) {
  // A rod with a mesh of its own is squeezed to nearly a ball: the same connectivity, another shape.
  TestSurface own = renewed(ellipsoid(2, {3.0, 0.577, 0.577}), 162, 10);
  for (Vec3d& x : own.position) x = {x.x / 2.5, x.y * 1.5, x.z * 1.6};
  EXPECT_NE(own.topology->node_count(), 162u);
  ShapeLibrary library;
  const auto shape = library.icosphere(162).value();
  const auto back = onto_ball(own.view(), {}, *shape, {.least_quality = 0.5, .most_distance = 0.25});
  ASSERT_TRUE(back.ok()) << back.error().message;
  const TestSurface now{shape->topology, back->position};
  EXPECT_NEAR(now.volume() / own.volume(), 1.0, 1e-12);
  EXPECT_GT(least_angle_of(now), 25.0 * kDegree);
  EXPECT_LT(std::abs(surface_area(now.mesh()) / surface_area(own.mesh()) - 1.0), 0.02) << "fewer nodes, and smoother";
}

TEST(OntoBall, TellsHowLongARodIs) {
  EXPECT_NEAR(elongation(ellipsoid(3, {3.0, 1.0, 1.0}).view()), 2.5707, 0.02) << "quadrature over the smooth ellipsoid";
  EXPECT_NEAR(elongation(sphere(3).view()), 1.0, 1e-3);
  EXPECT_NEAR(elongation(ellipsoid(3, {1.0, 1.0, 0.3}).view()), 1.0, 0.01) << "a plate is no rod";
}

}  // namespace
}  // namespace morula
