#include "core/mesh/renewal/cut_halves.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/mesh/primitives.h"
#include "core/mesh/renewal/planar_triangulation.h"
#include "tests/core/mesh/renewal/deformed_shapes.h"

namespace morula {
namespace {

Vec3d area_vector(const TriangleMesh& mesh, std::size_t first, std::size_t end) {
  Vec3d sum;
  for (std::size_t f = first; f < end; ++f) {
    const auto& [a, b, c] = mesh.faces[f];
    sum += cross(mesh.position[b] - mesh.position[a], mesh.position[c] - mesh.position[a]) * 0.5;
  }
  return sum;
}

/// Area of a flat polygon, counter-clockwise about n (shoelace formula).
double polygon_area(std::span<const Vec3d> rim, const Vec3d& n) {
  Vec3d sum;
  for (std::size_t k = 0; k < rim.size(); ++k) sum += cross(rim[k] - rim[0], rim[(k + 1) % rim.size()] - rim[0]) * 0.5;
  return dot(sum, n);
}

double volume_of(const TriangleMesh& mesh) {
  return enclosed_volume(mesh.faces, mesh.position, volume_centroid(mesh.faces, mesh.position));
}

double mean_edge_of(const TestSurface& surface) {
  double sum = 0.0;
  for (const Edge& e : surface.topology->edges()) sum += norm(surface.position[e.j] - surface.position[e.i]);
  return sum / surface.topology->edge_count();
}

/// Everything that must hold for any cut: closed, oriented, of genus 0, volumes, the cap.
void expect_sound_halves(const TestSurface& surface, const Vec3d& normal, double share) {
  const double edge = mean_edge_of(surface), volume = surface.volume();
  const auto cut = cut_in_two(surface.view(), normal, share, 0.8 * edge);
  ASSERT_TRUE(cut.ok()) << cut.error().message;
  const Vec3d n = normalized(normal);
  double volumes = 0.0;
  for (const ClosedHalf& half : cut->half) {
    const auto topology = Topology::build(static_cast<std::uint32_t>(half.mesh.position.size()), half.mesh.faces);
    ASSERT_TRUE(topology.ok()) << topology.error().message;
    EXPECT_EQ(static_cast<int>((*topology)->node_count()) - static_cast<int>((*topology)->edge_count()) +
                  static_cast<int>((*topology)->face_count()),
              2);
    volumes += volume_of(half.mesh);
    EXPECT_NEAR(volume_of(half.mesh) / volume, half.above ? share : 1.0 - share, 1e-6);  // nodes near the plane: see cut_by_plane()
    // The cap faces away from the half, is as large as the polygon of its rim, and none of its faces is turned over.
    const Vec3d cap = area_vector(half.mesh, half.first_cap_face, half.mesh.faces.size()), outward = half.above ? -n : n;
    const double polygon = polygon_area(cut->rim, n);
    EXPECT_NEAR(dot(cap, outward), polygon, 1e-9 * polygon);
    EXPECT_NEAR(cut->cap_area, polygon, 1e-5 * polygon);
    for (std::size_t f = half.first_cap_face; f < half.mesh.faces.size(); ++f)
      EXPECT_GT(dot(area_vector(half.mesh, f, f + 1), outward), -1e-6 * edge * edge);
    for (std::uint32_t k = 0; k < half.first_rim_node; ++k) {
      const double height = dot(half.mesh.position[k] - cut->rim[0], n);
      EXPECT_GT(half.above ? height : -height, -1e-5 * edge);
    }
    EXPECT_EQ(half.source_face.size(), half.first_cap_face);
  }
  EXPECT_NEAR(volumes / volume, 1.0, 1e-12);
  // The same cap in both, opposite orientation: point by point.
  const ClosedHalf &above = cut->half[0], &below = cut->half[1];
  ASSERT_EQ(above.mesh.faces.size() - above.first_cap_face, below.mesh.faces.size() - below.first_cap_face);
  for (std::size_t f = 0; f < above.mesh.faces.size() - above.first_cap_face; ++f) {
    const Triangle &a = above.mesh.faces[above.first_cap_face + f], &b = below.mesh.faces[below.first_cap_face + f];
    EXPECT_EQ(above.mesh.position[a[0]], below.mesh.position[b[0]]);
    EXPECT_EQ(above.mesh.position[a[1]], below.mesh.position[b[2]]);
    EXPECT_EQ(above.mesh.position[a[2]], below.mesh.position[b[1]]);
  }
}

TEST(CutInTwo, RandomPlanesGiveTwoClosedHalvesOfTheWantedShare) {
  std::mt19937_64 engine(11);
  std::uniform_real_distribution<double> share(0.1, 0.9);
  for (const int level : {2, 3})
    for (const TestSurface& surface :
         {sphere(level), ellipsoid(level, {1.6, 0.8, 0.8}), ellipsoid(level, {1.3, 1.0, 0.6}), bumpy(level, 0.2, 0.7)})
      for (int n = 0; n < 12; ++n) expect_sound_halves(surface, random_direction(engine), share(engine));
}

TEST(CutInTwo, FlatPlatesAreCutAlongStraightLines) {
  std::mt19937_64 engine(12);
  for (const double height : {0.5, 0.3})
    for (const Vec3d& normal : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{1, 1, 0}, Vec3d{1, 0.3, 0.1}, Vec3d{0, 0, 1}})
      for (const double share : {0.5, 0.2}) expect_sound_halves(flattened(2, height), normal, share);
}

/// A box: every loop has straight sides, and at a share of one half the plane passes exactly through nodes.
TEST(CutInTwo, APlaneThroughNodesOfABoxCountsThemOnOneSide) {
  TriangleMesh mesh = *make_box({4, 4, 4}, 1.0);
  TestSurface box;
  box.position = mesh.position;
  box.topology = Topology::build(static_cast<std::uint32_t>(mesh.position.size()), mesh.faces).value();
  for (const Vec3d& normal : {Vec3d{1, 0, 0}, Vec3d{0, 0, -1}, Vec3d{1, 1, 0}, Vec3d{1, 1, 1}, Vec3d{3, 1, 0}})
    for (const double share : {0.5, 0.25, 0.3}) expect_sound_halves(box, normal, share);
}

TEST(CutInTwo, RefusesWhatCannotBeCut) {
  const TestSurface ball = sphere(2);
  const double inf = std::numeric_limits<double>::infinity();
  for (const Vec3d& normal : {Vec3d{}, Vec3d{inf, 0, 0}, Vec3d{std::nan(""), 0, 1}}) {
    const auto cut = cut_in_two(ball.view(), normal, 0.5, 1.0);
    ASSERT_FALSE(cut.ok());
    EXPECT_EQ(cut.error().kind, ErrorKind::kInput);
  }
  for (const double share : {0.0, 0.09, 0.91, 1.0, -0.5, std::nan("")}) EXPECT_FALSE(cut_in_two(ball.view(), {0, 0, 1}, share, 1.0).ok());
  TestSurface lost = ball;
  lost.position[5].y = std::nan("");
  EXPECT_FALSE(cut_in_two(lost.view(), {0, 0, 1}, 0.5, 1.0).ok());
  TestSurface inside_out = ball;
  for (Vec3d& x : inside_out.position) x = -x;
  const auto cut = cut_in_two(inside_out.view(), {0, 0, 1}, 0.5, 1.0);
  ASSERT_FALSE(cut.ok());
  EXPECT_EQ(cut.error().kind, ErrorKind::kInput);
}

TEST(CutInTwo, ADumbbellIsCutAcrossButNotBesideItsNeck) {
  const TestSurface surface = dumbbell(3, 0.3);
  expect_sound_halves(surface, {0, 0, 1}, 0.5);
  const auto beside = cut_in_two(surface.view(), {1, 0, 0}, 0.15, 1.0);  // a piece of each ball
  ASSERT_FALSE(beside.ok());
  EXPECT_EQ(beside.error().kind, ErrorKind::kPhysics);
}

/// Random polygons, round a point, with corners on straight sides and points inside: as many triangles as Euler's formula says, none turned
/// over, and together as large as the polygon.
TEST(PlanarTriangulation, FillsPolygonsWithStraightRuns) {
  std::mt19937_64 engine(13);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 60; ++round) {
    std::vector<PlanePoint> corner, polygon;
    const int corners = 4 + static_cast<int>(12 * unit(engine));
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.6 * unit(engine)) / corners, radius = 1.0 + 2.0 * unit(engine);
      corner.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    for (int k = 0; k < corners; ++k) {
      const PlanePoint &a = corner[static_cast<std::size_t>(k)], &b = corner[static_cast<std::size_t>((k + 1) % corners)];
      for (const double t : {0.0, 0.3, 0.30001, 0.8}) polygon.push_back({a.u + t * (b.u - a.u), a.v + t * (b.v - a.v)});
    }
    double twice = 0.0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const PlanePoint &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      twice += a.u * b.v - a.v * b.u;
    }
    auto triangulation = PlanarTriangulation::of_polygon(polygon);
    ASSERT_TRUE(triangulation.ok());
    std::size_t inner = 0;
    for (int k = 0; k < 25; ++k) inner += triangulation->insert({4 * unit(engine) - 2, 4 * unit(engine) - 2});
    const std::vector<Triangle> triangles = triangulation->triangles();
    EXPECT_EQ(triangles.size(), polygon.size() + 2 * inner - 2);
    const auto points = triangulation->points();
    const auto twice_area = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      return (points[b].u - points[a].u) * (points[c].v - points[a].v) - (points[c].u - points[a].u) * (points[b].v - points[a].v);
    };
    double sum = 0.0;
    for (const auto& [a, b, c] : triangles) {
      EXPECT_GT(twice_area(a, b, c), -1e-12);
      sum += twice_area(a, b, c);
    }
    EXPECT_NEAR(sum, twice, 1e-10);
  }
}

TEST(PlanarTriangulation, RefusesALineThatEnclosesNothing) {
  EXPECT_FALSE(PlanarTriangulation::of_polygon({{0, 0}, {1, 0}}).ok());
  EXPECT_FALSE(PlanarTriangulation::of_polygon({{0, 0}, {1, 0}, {2, 0}}).ok());
  EXPECT_FALSE(PlanarTriangulation::of_polygon({{0, 0}, {0, 1}, {1, 0}}).ok());  // clockwise
}

}  // namespace
}  // namespace morula
