// Random sequences of local changes on random deformed meshes leave closed surfaces with the same volume.
#include "core/mesh/renewal/local_changes.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/core/mesh/renewal/random_changes.h"

namespace morula {
namespace {

TEST(LocalChanges, KeepClosedSurfacesAndTheirVolumeInRandomSequences) {
  EXPECT_GT(check_random_sequences(300, 11), 2000u) << "or nothing is tested";
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
