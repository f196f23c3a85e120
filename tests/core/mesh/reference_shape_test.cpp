#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/mesh/icosphere.h"
#include "core/mesh/topology.h"

namespace morula {
namespace {

using std::numbers::pi;

struct Range {
  double mean = 0, min = 1e300, max = -1e300;
};

Range range_of(const std::vector<double>& values) {
  Range out;
  for (const double v : values) {
    out.mean += v / static_cast<double>(values.size());
    out.min = std::min(out.min, v);
    out.max = std::max(out.max, v);
  }
  return out;
}

std::vector<double> node_areas(const ReferenceShape& shape) {
  std::vector<double> area(shape.topology->node_count(), 0.0);
  for (std::size_t f = 0; f < shape.face_area.size(); ++f)
    for (const std::uint32_t node : shape.topology->faces()[f]) area[node] += shape.face_area[f] / 3.0;
  return area;
}

/// Published figures of an icosphere inscribed in a sphere; the table of the physics reference for R = 6 µm (computed independently there),
/// given to the digits below.
struct Figures {
  std::uint32_t nodes;
  double edge_mean, edge_min, edge_max;  // R = 6 µm
  double area_mean, area_min, area_max;  // R = 6 µm
  double volume_ratio, area_ratio;       // of the sphere through the nodes
  double node_radius;                    // for the volume of the unit sphere
  double unit_edge;                      // mean edge for unit node radius
};
void PrintTo(const Figures& figures, std::ostream* out) { *out << figures.nodes << " nodes"; }

class InscribedIcosphere : public testing::TestWithParam<Figures> {};

TEST_P(InscribedIcosphere, HasThePublishedFigures) {
  const Figures& want = GetParam();
  ShapeLibrary library;
  const auto found = library.icosphere(want.nodes);
  ASSERT_TRUE(found.ok());
  const ReferenceShape& shape = **found;
  ASSERT_EQ(shape.position.size(), want.nodes);
  double radius = 0.0;
  for (const Vec3d& x : shape.position) radius = std::max(radius, norm(x));
  for (const Vec3d& x : shape.position) EXPECT_NEAR(norm(x), radius, 1e-14);

  // Unit mesh volume: the sphere through the nodes has volume 1 / volume_ratio.
  EXPECT_NEAR(1.0 / (4.0 / 3.0 * pi * radius * radius * radius), want.volume_ratio, 1e-6);
  EXPECT_NEAR(radius / std::cbrt(3.0 / (4.0 * pi)), want.node_radius, 1e-7);
  double area = 0.0;
  for (const double a : shape.face_area) area += a;
  EXPECT_NEAR(area / (4.0 * pi * radius * radius), want.area_ratio, 1e-6);
  const Range edge = range_of(shape.edge_length);
  EXPECT_NEAR(edge.mean / radius, want.unit_edge, 1e-5);
  if (want.edge_mean == 0.0) return;
  const double s = 6.0 / radius;
  EXPECT_NEAR(edge.mean * s, want.edge_mean, 1e-4);
  EXPECT_NEAR(edge.min * s, want.edge_min, 1e-3);
  EXPECT_NEAR(edge.max * s, want.edge_max, 1e-3);
  const Range node = range_of(node_areas(shape));
  EXPECT_NEAR(node.mean * s * s, want.area_mean, 5e-5);
  EXPECT_NEAR(node.min * s * s, want.area_min, 1e-3);
  EXPECT_NEAR(node.max * s * s, want.area_max, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Nodes, InscribedIcosphere,
                         testing::Values(Figures{42, 0, 0, 0, 0, 0, 0, 0.873453, 0.928345, 1.0461327, 0.58228},
                                         Figures{162, 1.7960, 1.655, 1.950, 2.7400, 2.162, 2.921, 0.966161, 0.981178, 1.0115411, 0.29933},
                                         Figures{642, 0.9044, 0.830, 0.988, 0.70130, 0.545, 0.817, 0.991394, 0.995235, 1.0028853, 0.15073},
                                         Figures{2562, 0.4530, 0.415, 0.496, 0.17637, 0.137, 0.211, 0.997839, 0.998805, 1.0007213,
                                                 0.07550}),
                         [](const auto& test) { return std::to_string(test.param.nodes); });

TEST(ReferenceShape, HasUnitVolumeAndItsCentroidAtTheOriginWhateverItWasMadeFrom) {
  TriangleMesh mesh = make_icosphere(2);
  for (Vec3d& x : mesh.position) x = Vec3d{3.0 * x.x + 100.0, 1.5 * x.y + 0.2 * x.x - 40.0, (x.z > 0 ? 2.0 : 0.5) * x.z + 7.0};
  const auto topology = *Topology::build(162, mesh.faces);
  const auto shape = make_reference_shape(topology, mesh.position);
  ASSERT_NE(shape, nullptr);
  EXPECT_NEAR(enclosed_volume(topology->faces(), shape->position, Vec3d{}), 1.0, 1e-12);
  EXPECT_NEAR(norm(volume_centroid(topology->faces(), shape->position)), 0.0, 1e-12);
}

TEST(ReferenceShape, IsNullWhenTheFacesPointInwards) {
  TriangleMesh mesh = make_icosphere(1);
  for (Triangle& face : mesh.faces) std::swap(face[1], face[2]);
  EXPECT_EQ(make_reference_shape(*Topology::build(42, mesh.faces), mesh.position), nullptr);
}

TEST(ReferenceShape, HasThePositiveTurningAnglesOfARegularTetrahedron) {
  // The dihedral angle of a regular tetrahedron is arccos(1/3): its faces turn by π − arccos(1/3).
  const auto topology = *Topology::build(4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  const auto shape = make_reference_shape(topology, {{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}});
  ASSERT_NE(shape, nullptr);
  for (const double angle : shape->hinge_angle) EXPECT_NEAR(angle, pi - std::acos(1.0 / 3.0), 1e-14);
  // Volume 1 means edge (6√2)^(1/3).
  for (const double length : shape->edge_length) EXPECT_NEAR(length, std::cbrt(6.0 * std::numbers::sqrt2), 1e-14);
}

TEST(ReferenceShape, HasANegativeTurningAngleAtADent) {
  // An octahedron whose top is pushed in: the four edges at the top become valleys, the equator's stay ridges.
  const std::vector<Triangle> faces = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
  const auto topology = *Topology::build(6, faces);
  const auto shape = make_reference_shape(topology, {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -0.3}, {0, 0, -1}});
  ASSERT_NE(shape, nullptr);
  for (std::size_t e = 0; e < topology->edge_count(); ++e)
    EXPECT_EQ(shape->hinge_angle[e] < 0.0, topology->edges()[e].i == 4 || topology->edges()[e].j == 4);
}

TEST(EnclosedVolume, IsThatOfACubeFarFromTheOrigin) {
  const std::vector<Triangle> faces = {{0, 3, 2}, {0, 2, 1}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                       {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  std::vector<Vec3d> x = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}};
  for (Vec3d& p : x) p += Vec3d{1e6, -1e6, 5e5};
  EXPECT_NEAR(enclosed_volume(faces, x, x[0]), 8.0, 1e-12);
  const Vec3d centroid = volume_centroid(faces, x);
  EXPECT_NEAR(centroid.x - 1e6, 1.0, 1e-9);
  EXPECT_NEAR(centroid.y + 1e6, 1.0, 1e-9);
  EXPECT_NEAR(centroid.z - 5e5, 1.0, 1e-9);
}

TEST(ShapeLibrary, BuildsEachShapeOnceAndSharesIt) {
  ShapeLibrary library;
  EXPECT_EQ(*library.icosphere(162), *library.icosphere(162));
  EXPECT_NE(*library.icosphere(162), *library.icosphere(642));
  ShapeLibrary other;
  EXPECT_EQ((*library.icosphere(162))->topology->hash(), (*other.icosphere(162))->topology->hash());
  EXPECT_EQ((*library.icosphere(162))->position, (*other.icosphere(162))->position);
}

TEST(ShapeLibrary, ListsTheAllowedNumbersWhenAskedForAnother) {
  ShapeLibrary library;
  const auto result = library.icosphere(100);
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.error().message, testing::HasSubstr("100"));
  EXPECT_THAT(result.error().help, testing::HasSubstr("42, 162, 642 or 2562"));
}

}  // namespace
}  // namespace morula
