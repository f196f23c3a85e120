// Random sequences of local changes on random deformed meshes leave closed surfaces with the same volume.
#include "core/mesh/renewal/local_changes.h"

#include <gtest/gtest.h>

#include <array>

#include "core/mesh/remesh.h"
#include "core/mesh/renewal/change_guard.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/mesh/renewal/deformed_shapes.h"

namespace morula {
namespace {

/// A random deformed sphere of 42 or 162 nodes.
TestSurface random_surface(std::mt19937_64& engine) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double stretch = 1.0 + 1.5 * unit(engine), height = 0.3 * unit(engine), phase = 6.0 * unit(engine);
  return moved_sphere(unit(engine) < 0.5 ? 1 : 2, [&](const Vec3d& x) {
    const double bump = 1.0 + height * std::sin(3.0 * x.x + phase) * std::cos(2.5 * x.y - phase);
    return Vec3d{x.x * stretch, x.y / std::sqrt(stretch), x.z / std::sqrt(stretch)} * bump;
  });
}

/// Any change at any edge.
std::optional<MeshChange> random_change(const LiveMesh& mesh, std::mt19937_64& engine) {
  const auto edges = mesh.edges();
  const auto [a, b] = edges[engine() % edges.size()];
  const Vec3d pa = mesh.position(a), pb = mesh.position(b), middle = (pa + pb) * 0.5;
  switch (engine() % 5) {
    case 0:
      return split_edge(mesh, a, b);
    case 1:
      return bulge_edge(mesh, a, b);
    case 2:
      return flip_edge(mesh, a, b);
    case 3:
      return collapse_edge(mesh, a, b, middle);
    default:
      return slide_node(mesh, a, pa + (pb - pa) * 0.2);
  }
}

/// V − E + F of a mesh whose every edge has two faces.
int euler_number(const TriangleMesh& mesh) {
  const int faces = static_cast<int>(mesh.faces.size());
  return static_cast<int>(mesh.position.size()) - faces * 3 / 2 + faces;
}

double volume_of(const TriangleMesh& mesh) {
  return enclosed_volume(mesh.faces, mesh.position, volume_centroid(mesh.faces, mesh.position));
}

TEST(LocalChanges, KeepClosedSurfacesAndTheirVolumeInRandomSequences) {
  constexpr int kSequences = 300, kTries = 60;
  std::mt19937_64 engine(11);
  std::size_t made = 0;
  for (int sequence = 0; sequence < kSequences; ++sequence) {
    SCOPED_TRACE(sequence);
    const TestSurface start = random_surface(engine);
    const AskedSurface surface(start.view());
    if (!find_self_intersections(start.position, start.topology->faces(), 1).empty()) continue;
    const double area = surface.area();
    ChangeGuard guard(surface, {}, {.edge = edge_of_nodes(area, start.topology->node_count()), .area_change = 0.01});
    LiveMesh mesh(start.view());
    for (int k = 0; k < kTries; ++k) {
      const auto change = random_change(mesh, engine);
      if (!change) continue;
      EXPECT_LE(std::abs(volume_change(mesh, *change)), 1e-12 * start.volume()) << "of one change";
      if (guard.judge(mesh, *change) != ChangeRefusal::kNone) continue;
      guard.made();
      mesh.apply(*change);
      ++made;
    }
    const TriangleMesh end = mesh.mesh();
    EXPECT_EQ(end.position.size(), mesh.node_count());
    const auto topology = Topology::build(static_cast<std::uint32_t>(end.position.size()), end.faces);
    ASSERT_TRUE(topology.ok()) << "closed, oriented, every node with one ring: " << topology.error().message;
    EXPECT_EQ(euler_number(end), 2) << "no handles, one piece";
    EXPECT_NEAR(volume_of(end) / start.volume(), 1.0, 1e-10) << "of all changes";
    EXPECT_LE(std::abs(surface_area(end) / area - 1.0), 0.0101);
    EXPECT_NEAR(surface_area(end) - area, guard.area_change(), 1e-9 * area);
    EXPECT_TRUE(find_self_intersections(end.position, end.faces, 1).empty());
    EXPECT_GE(least_quality(end.faces, end.position), std::min(0.2, least_quality(start.topology->faces(), start.position)) - 1e-12);
  }
  EXPECT_GT(made, 2000u) << "or nothing is tested";
}

TEST(LocalChanges, AreRefusedWhereTheSurfaceWouldBePinchedOff) {
  // A tetrahedron: every edge that is turned or drawn together would leave no closed surface.
  const auto topology = Topology::build(4, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}).value();
  const std::vector<Vec3d> position = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
  const LiveMesh mesh(SurfaceView{position, topology.get()});
  for (const auto& [a, b] : mesh.edges()) {
    EXPECT_FALSE(flip_edge(mesh, a, b));
    EXPECT_FALSE(collapse_edge(mesh, a, b, position[a]));
  }
  EXPECT_EQ(mesh.edges().size(), 6u);
}

TEST(LocalChanges, SplitsLeaveTheSurfaceAndSlidesTheVolumeWhatItIs) {
  const TestSurface start = ellipsoid(1, {1.5, 1.0, 0.8});
  LiveMesh mesh(start.view());
  const auto [a, b] = mesh.edges()[7];
  const double area = surface_area(mesh.mesh());
  mesh.apply(split_edge(mesh, a, b));
  EXPECT_EQ(mesh.node_count(), 43u);
  EXPECT_NEAR(surface_area(mesh.mesh()) / area, 1.0, 1e-14);
  const Vec3d away = start.position[a] * 1.3;  // outwards, too
  const MeshChange slide = slide_node(mesh, a, away);
  EXPECT_NEAR(volume_change(mesh, slide), 0.0, 1e-12 * start.volume());
  EXPECT_LT(norm(slide.placed[0].place - start.position[a]), norm(away - start.position[a]))
      << "what leads out of the surface is left away";
}

/// A change that goes too far in one respect is refused for that.
TEST(ChangeGuard, TellsWhatIsAgainstAChange) {
  const TestSurface start = sphere(2);
  const AskedSurface surface(start.view());
  const double edge = edge_of_nodes(surface.area(), 162);
  const LiveMesh mesh(start.view());
  const auto moved = [&](std::uint32_t node, const Vec3d& place) {
    MeshChange out;
    out.gone.assign(mesh.faces_of(node).begin(), mesh.faces_of(node).end());
    for (const std::uint32_t slot : out.gone) out.fresh.push_back(mesh.face(slot));
    out.placed = {{node, place}};
    return out;
  };
  const auto judged = [&](const MeshChange& change, double area_change, std::span<const AskedSurface* const> walls = {}) {
    ChangeLimits limits{.edge = edge, .off_surface = 0.3, .area_change = area_change};
    return ChangeGuard(surface, walls, limits).judge(mesh, change);
  };
  const Vec3d x = start.position[40], outward = normalized(x);
  EXPECT_EQ(judged(moved(40, x), 1e-4), ChangeRefusal::kNone);
  EXPECT_EQ(judged(moved(40, x + outward * (0.2 * edge)), 1e-4), ChangeRefusal::kArea);
  EXPECT_EQ(judged(moved(40, x + outward * (0.2 * edge)), 1.0), ChangeRefusal::kNone);
  EXPECT_EQ(judged(moved(40, x + outward * (0.45 * edge)), 1.0), ChangeRefusal::kDistance);
  EXPECT_EQ(judged(moved(40, x - outward * (2.0 * edge)), 1.0), ChangeRefusal::kFold);
  const auto ring = mesh.neighbours_of(40);
  EXPECT_EQ(judged(moved(40, start.position[ring[0]] * 0.98 + x * 0.02), 1.0), ChangeRefusal::kShape);
  // A neighbour whose flat side is where this surface ends.
  TestSurface wall = sphere(2);
  for (Vec3d& p : wall.position) p += outward * 14.0;
  const AskedSurface other(wall.view());
  const std::array<const AskedSurface*, 1> walls = {&other};
  std::uint32_t nearest = 0;
  for (std::uint32_t n = 0; n < 162; ++n)
    if (dot(start.position[n], outward) > dot(start.position[nearest], outward)) nearest = n;
  EXPECT_EQ(judged(moved(nearest, start.position[nearest] + outward * (0.2 * edge)), 1.0, walls), ChangeRefusal::kOverlap);
}

}  // namespace
}  // namespace morula
