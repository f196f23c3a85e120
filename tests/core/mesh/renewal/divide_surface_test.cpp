#include "core/mesh/renewal/divide_surface.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/mesh/renewal/transfer_marks.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/mesh/renewal/deformed_shapes.h"

namespace morula {
namespace {

std::shared_ptr<const ReferenceShape> icosphere(int level) {
  ShapeLibrary library;
  return library.icosphere(level == 2 ? 162 : 642).value();
}

TriangleMesh mesh_of(std::span<const Vec3d> position, const Topology& topology) {
  return {{position.begin(), position.end()}, {topology.faces().begin(), topology.faces().end()}};
}

/// Largest distance of points of one mesh from another one by a loop over all faces: nodes, middles of edges and of faces.
double farthest(const TriangleMesh& from, const TriangleMesh& to) {
  double largest2 = 0.0;
  const auto ask = [&](const Vec3d& p) {
    double least2 = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : to.faces)
      least2 = std::min(least2, closest_point_on_triangle(p, to.position[a], to.position[b], to.position[c]).distance2);
    largest2 = std::max(largest2, least2);
  };
  for (const Vec3d& p : from.position) ask(p);
  for (const auto& [a, b, c] : from.faces) {
    const Vec3d &x = from.position[a], &y = from.position[b], &z = from.position[c];
    ask((x + y + z) * (1.0 / 3.0));
    if (a < b) ask((x + y) * 0.5);
    if (b < c) ask((y + z) * 0.5);
    if (c < a) ask((z + x) * 0.5);
  }
  return std::sqrt(largest2);
}

double least_quality_of(const TriangleMesh& mesh) {
  double least = 1.0;
  for (const auto& [a, b, c] : mesh.faces) {
    const double ab = norm(mesh.position[b] - mesh.position[a]), bc = norm(mesh.position[c] - mesh.position[b]),
                 ca = norm(mesh.position[a] - mesh.position[c]);
    const double s = 0.5 * (ab + bc + ca), area = std::sqrt(std::max(0.0, s * (s - ab) * (s - bc) * (s - ca)));  // Heron
    least = std::min(least, 4.0 * std::sqrt(3.0) * area / (ab * ab + bc * bc + ca * ca));
  }
  return least;
}

double area_of(const TriangleMesh& mesh, std::span<const char> marked) {
  double sum = 0.0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& [a, b, c] = mesh.faces[f];
    if (marked[f]) sum += 0.5 * norm(cross(mesh.position[b] - mesh.position[a], mesh.position[c] - mesh.position[a]));
  }
  return sum;
}

/// Everything that must hold for the daughters of a cut. A cut that is refused is counted, and must be refused as what the connectivity
/// cannot hold.
void expect_sound_daughters(const TestSurface& mother, const ReferenceShape& shape, const Vec3d& normal, double share, int& refused) {
  const auto division = divide_surface(mother.view(), {.normal = normal, .share = share, .shape = &shape});
  if (!division.ok()) {
    EXPECT_EQ(division.error().kind, ErrorKind::kPhysics) << division.error().message;
    ++refused;
    return;
  }
  const double volume = mother.volume();
  double volumes = 0.0;
  for (std::size_t side = 0; side < 2; ++side) {
    const Daughter& daughter = division->daughter[side];
    const TriangleMesh mesh = mesh_of(daughter.position, *shape.topology), &half = division->cut.half[side].mesh;
    const double own = enclosed_volume(mesh.faces, mesh.position, volume_centroid(mesh.faces, mesh.position));
    volumes += own;
    EXPECT_NEAR(own / (volume * (side == 0 ? share : 1.0 - share)), 1.0, 1e-12);
    EXPECT_GE(least_quality_of(mesh), 0.3);
    EXPECT_NEAR(daughter.report.least_quality, least_quality_of(mesh), 1e-9);
    const double edge = daughter.report.mean_edge;
    EXPECT_LE(std::max(farthest(mesh, half), farthest(half, mesh)), 0.5 * edge);
    EXPECT_TRUE(find_self_intersections(mesh.position, mesh.faces, 1).empty());
    EXPECT_LT(std::abs(daughter.report.area_change), 0.05);  // the sharp rim of a small share is rounded off by the new edge
    // The new interface looks away from the daughter and is as large as the cut.
    Vec3d cap;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const auto& [a, b, c] = mesh.faces[f];
      if (daughter.is_cap[f]) cap += cross(mesh.position[b] - mesh.position[a], mesh.position[c] - mesh.position[a]) * 0.5;
    }
    EXPECT_NEAR(area_of(mesh, daughter.is_cap), division->cut.cap_area, 0.5 * edge * edge);
    EXPECT_GT(dot(cap, normal) * (side == 0 ? -1.0 : 1.0), 0.85 * division->cut.cap_area * norm(normal));
  }
  EXPECT_NEAR(volumes / volume, 1.0, 1e-12);
}

TEST(DivideSurface, DaughtersOfDeformedSpheresKeepTheIcosphere) {
  const auto shape = icosphere(2);
  std::mt19937_64 engine(21);
  std::uniform_real_distribution<double> share(0.3, 0.7);
  int refused = 0;
  for (const TestSurface& mother : {sphere(2), ellipsoid(2, {1.6, 0.8, 0.8}), ellipsoid(2, {1.3, 1.0, 0.7}), bumpy(2, 0.2, 0.7)})
    for (int n = 0; n < 4; ++n)
      expect_sound_daughters(mother, *shape, random_direction(engine) * 3.0, n == 0 ? 0.5 : share(engine), refused);
  EXPECT_EQ(refused, 0);
}

/// Between two plates, by planes across them: the loops have straight sides.
TEST(DivideSurface, DaughtersBetweenPlates) {
  const auto shape = icosphere(2);
  int refused = 0;
  for (const Vec3d& normal : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{1, 2, 0}, Vec3d{3, -1, 0}})
    expect_sound_daughters(flattened(2, 0.5), *shape, normal, 0.5, refused);
  EXPECT_LE(refused, 1);
}

/// The sharp rim of a lens of a tenth of a sphere is finer than the edges of its mesh: such a daughter may be refused, never be bad.
TEST(DivideSurface, UnequalSharesDownToATenth) {
  const auto shape = icosphere(2);
  std::mt19937_64 engine(22);
  int refused = 0;
  for (const double share : {0.1, 0.2, 0.8, 0.9}) {
    expect_sound_daughters(sphere(2), *shape, random_direction(engine), share, refused);
    expect_sound_daughters(ellipsoid(2, {1.2, 1.0, 0.9}), *shape, random_direction(engine), share, refused);
  }
  EXPECT_LE(refused, 2);
}

TEST(DivideSurface, SixHundredNodesAndOtherNodesThanTheMother) {
  std::mt19937_64 engine(23);
  int refused = 0;
  expect_sound_daughters(bumpy(3, 0.2, 1.4), *icosphere(3), random_direction(engine), 0.5, refused);
  expect_sound_daughters(ellipsoid(3, {1.3, 1.0, 0.7}), *icosphere(2), random_direction(engine), 0.4, refused);
  EXPECT_EQ(refused, 0);
}

TEST(DivideSurface, GivesTheSameBitsWhateverTheOrderOfTheNeighbours) {
  const auto shape = icosphere(2);
  const TestSurface mother = sphere(2);
  std::vector<TestSurface> around;
  for (const Vec3d& d : {Vec3d{1, 0, 0}, Vec3d{-0.5, 0.8, 0.3}, Vec3d{0, -0.6, 0.8}}) {
    around.push_back(mother);
    for (Vec3d& x : around.back().position) x += normalized(d) * 13.8;  // they overlap the mother by 0.2 µm
  }
  std::vector<SurfaceView> views;
  for (const TestSurface& one : around) views.push_back(one.view());
  DivisionPlan plan{.normal = {0.2, 0.1, 1.0}, .share = 0.5, .shape = shape.get(), .neighbours = views};
  const auto first = divide_surface(mother.view(), plan);
  std::ranges::reverse(views);
  const auto second = divide_surface(mother.view(), plan);
  plan.neighbours = {};
  const auto alone = divide_surface(mother.view(), plan);
  ASSERT_TRUE(first.ok() && second.ok() && alone.ok());
  double overlap = 0.0, overlap_alone = 0.0;
  for (std::size_t side = 0; side < 2; ++side) {
    EXPECT_EQ(first->daughter[side].position, second->daughter[side].position);
    for (const TestSurface& one : around) {
      const Vec3d center = volume_centroid(one.topology->faces(), one.position);
      for (const Vec3d& x : first->daughter[side].position) overlap = std::max(overlap, 7.0 - norm(x - center));
      for (const Vec3d& x : alone->daughter[side].position) overlap_alone = std::max(overlap_alone, 7.0 - norm(x - center));
    }
  }
  EXPECT_GT(overlap_alone, 0.05);
  EXPECT_LT(overlap, overlap_alone);  // walls push daughters out
}

TEST(DivideSurface, SaysWhyNot) {
  const auto shape = icosphere(2);
  const TestSurface mother = sphere(2);
  const auto too_good =
      divide_surface(mother.view(), {.normal = {0, 0, 1}, .share = 0.5, .shape = shape.get(), .limits = {.least_quality = 0.999}});
  ASSERT_FALSE(too_good.ok());
  EXPECT_EQ(too_good.error().kind, ErrorKind::kPhysics);
  EXPECT_NE(too_good.error().message.find("least quality"), std::string::npos);
  const auto two_lines = divide_surface(dumbbell(2, 0.3).view(), {.normal = {1, 0, 0}, .share = 0.15, .shape = shape.get()});
  ASSERT_FALSE(two_lines.ok());
  EXPECT_EQ(two_lines.error().kind, ErrorKind::kPhysics);
  EXPECT_FALSE(divide_surface(mother.view(), {.normal = {0, 0, 1}, .share = 0.05, .shape = shape.get()}).ok());
}

/// A sphere whose nodes were moved along it by up to a quarter of the edge comes back even, and where it was.
TEST(Redistribute, ADisturbedSphereComesBack) {
  std::mt19937_64 engine(31);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  for (const int level : {2, 3}) {
    TestSurface disturbed = sphere(level);
    const double edge = 7.0 * (level == 2 ? 0.30 : 0.15);
    for (Vec3d& x : disturbed.position) {
      const Vec3d n = normalized(x);
      Vec3d along{noise(engine), noise(engine), noise(engine)};
      along = along - n * dot(n, along);
      x = normalized(x + along * (0.25 * edge)) * 7.0;
    }
    const auto even = redistribute(disturbed.view());
    ASSERT_TRUE(even.ok()) << even.error().message;
    const TriangleMesh mesh = mesh_of(even->position, *disturbed.topology), old = disturbed.mesh();
    EXPECT_LT(least_quality_of(old), 0.7);
    EXPECT_GT(least_quality_of(mesh), 0.75);
    EXPECT_LT(std::max(farthest(mesh, old), farthest(old, mesh)), 0.12 * edge);
    EXPECT_NEAR(enclosed_volume(mesh.faces, mesh.position, {}) / disturbed.volume(), 1.0, 1e-12);
  }
}

TEST(Redistribute, ASphereAtRestStaysThroughAHundredPasses) {
  const TestSurface start = sphere(2);
  TestSurface now = start;
  const auto mean_radius = [](const TestSurface& s) {
    const Vec3d center = volume_centroid(s.topology->faces(), s.position);
    double sum = 0.0;
    for (const Vec3d& x : s.position) sum += norm(x - center);
    return sum / static_cast<double>(s.position.size());
  };
  for (int pass = 0; pass < 100; ++pass) {
    auto even = redistribute(now.view());
    ASSERT_TRUE(even.ok()) << even.error().message;
    now.position = std::move(even->position);
  }
  EXPECT_NEAR(mean_radius(now) / mean_radius(start), 1.0, 1e-3);
  EXPECT_NEAR(now.volume() / start.volume(), 1.0, 1e-10);
  EXPECT_LT(norm(volume_centroid(now.topology->faces(), now.position)), 1e-3 * 7.0);
}

TEST(Redistribute, AStretchedSphereGetsEvenFacesOnTheSameSurface) {
  for (const Vec3d& axes : {Vec3d{1.59, 0.79, 0.79}, Vec3d{2.08, 0.69, 0.69}}) {  // aspect 2 and 3 at the volume of the sphere
    const TestSurface stretched = ellipsoid(2, axes);
    const auto even = redistribute(stretched.view());
    ASSERT_TRUE(even.ok()) << even.error().message;
    const TriangleMesh mesh = mesh_of(even->position, *stretched.topology), old = stretched.mesh();
    EXPECT_GT(least_quality_of(mesh), 0.5);
    EXPECT_LT(std::max(farthest(mesh, old), farthest(old, mesh)), 0.5 * even->report.mean_edge);
    EXPECT_NEAR(even->report.area_change, 0.0, 0.02);  // the tips of the ellipsoid, between coarse faces before, get more of them
    EXPECT_NEAR(enclosed_volume(mesh.faces, mesh.position, {}) / stretched.volume(), 1.0, 1e-12);
  }
}

/// A polar region of a daughter is as large on the new mesh as it was on the cut half, to 1 %, and lies where it lay.
TEST(TransferMarks, KeepAreaAndPlace) {
  std::mt19937_64 engine(41);
  const auto shape = icosphere(2);
  for (int n = 0; n < 4; ++n) {
    const TestSurface mother = n % 2 == 0 ? sphere(2) : bumpy(2, 0.2, 0.7);
    const Vec3d normal = random_direction(engine), axis = random_direction(engine);
    std::vector<char> marked(mother.topology->face_count());
    for (std::size_t f = 0; f < marked.size(); ++f) {
      const auto& [a, b, c] = mother.topology->faces()[f];
      marked[f] = dot(mother.position[a] + mother.position[b] + mother.position[c], axis) > 3.0;
    }
    const auto division = divide_surface(mother.view(), {.normal = normal, .share = 0.5, .shape = shape.get()});
    ASSERT_TRUE(division.ok());
    for (std::size_t side = 0; side < 2; ++side) {
      const ClosedHalf& half = division->cut.half[side];
      std::vector<char> old_marks(half.mesh.faces.size(), 0);  // the cap has none
      for (std::size_t f = 0; f < half.source_face.size(); ++f) old_marks[f] = marked[half.source_face[f]];
      const AskedSurface surface = AskedSurface::build(half.mesh).value();
      const Daughter& daughter = division->daughter[side];
      const std::vector<char> marks = transfer_marks(surface, old_marks, {daughter.position, shape->topology.get()});
      const TriangleMesh mesh = mesh_of(daughter.position, *shape->topology);
      const double edge = daughter.report.mean_edge, one_face = 0.433 * edge * edge;
      const double old_area = area_of(half.mesh, old_marks);
      EXPECT_NEAR(area_of(mesh, marks), old_area, std::max(0.01 * old_area, 0.75 * one_face));
      EXPECT_NEAR(area_of(mesh, marks) / surface.area(), old_area / surface.area(), 0.01);
      // Marked faces lie on marked ground but for the border's own.
      for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        if (marks[f]) {
          const auto& [a, b, c] = mesh.faces[f];
          const Vec3d middle = (mesh.position[a] + mesh.position[b] + mesh.position[c]) * (1.0 / 3.0);
          EXPECT_GT(dot(middle, axis), 1.0 - 1.5 * edge);
        }
    }
  }
}

}  // namespace
}  // namespace morula
