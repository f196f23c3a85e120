/// Lists of contacts outlive a change of bodies, and no bit tells whether they were kept or made anew.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/contact/contact_layer.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

using test::clusters_model;
using test::make_tissue;

constexpr BodyKind kSphere = BodyKind::kSphere, kShell = BodyKind::kShell;

struct Cluster {
  Model model = clusters_model();
  ShapeLibrary shapes;
  Tissue tissue =
      make_tissue(model, shapes, {{0, 0, 0}, {12.2, 0, 0}, {6.1, 10.6, 0}, {6.1, 3.6, 10.0}, {-6.2, 10.7, 0.3}, {18.3, 10.7, 0}},
                  {kShell, kShell, kShell, kShell, kSphere, kShell});
  Mechanics kept{model, {}, shapes, Comm(), 1};

  void steps(Mechanics& mechanics, int count) {
    for (int k = 0; k < count; ++k) {
      const auto done = mechanics.step(tissue, 0.1, std::vector<Vec3d>(Mechanics::external_size(tissue)));
      ASSERT_TRUE(done.ok()) << done.error().what;
    }
  }
  [[nodiscard]] std::size_t pairs_with_lists() const {
    return static_cast<std::size_t>(std::ranges::count_if(
        kept.contacts().pairs(), [](const SurfacePair& pair) { return pair.built_at > -1e299 && pair.motion > 0.0; }));
  }
  /// The same steps go on with the lists that there are, and with new ones.
  void expect_same_bits() {
    const Tissue here = tissue;
    kept.bodies_changed();
    steps(kept, 6);
    const Tissue with_kept = tissue;
    tissue = here;
    Mechanics anew(model, {}, shapes, Comm(), 1);
    steps(anew, 6);
    EXPECT_EQ(with_kept.shells.position, tissue.shells.position);
    EXPECT_EQ(with_kept.spheres.position, tissue.spheres.position);
  }
};

TEST(KeptLists, GiveTheBitsOfNewOnesWhereNothingHasChanged) {
  Cluster cluster;
  cluster.steps(cluster.kept, 5);
  cluster.expect_same_bits();
}

TEST(KeptLists, StayWithThePairsThatStay) {
  Cluster cluster;
  cluster.steps(cluster.kept, 5);
  const std::size_t before = cluster.pairs_with_lists();
  auto cells = take_apart(cluster.tissue);
  std::erase_if(cells, [](const CellRecord& cell) { return cell.row.id == CellId::founder(6); });
  put_together(cluster.tissue, std::move(cells));
  cluster.kept.bodies_changed();
  cluster.kept.update_scene(cluster.tissue);
  EXPECT_GE(cluster.pairs_with_lists(), 4u);  // a pair that was made anew has not moved yet
  EXPECT_LT(cluster.pairs_with_lists(), before);
  cluster.expect_same_bits();
}

TEST(KeptLists, GiveTheBitsOfNewOnesAfterOtherOrdersAndOtherBodies) {
  Cluster cluster;
  cluster.steps(cluster.kept, 5);
  auto cells = take_apart(cluster.tissue);
  for (CellRecord& cell : cells) {
    cell.row.order = ~cell.row.order;  // the other way round along the curve
    if (cell.row.id != CellId::founder(5)) continue;
    cell.shell = spherical_shell(cluster.shapes.icosphere(162).value(), cell.sphere->position, 850.0, 850.0);
    cell.sphere.reset();
    cell.row.body = kShell;
  }
  put_together(cluster.tissue, std::move(cells));
  cluster.expect_same_bits();
}

/// A body that keeps its id and its number of nodes is another all the same: its faces join other nodes.
TEST(KeptLists, GoWithTheMeshThatTheyNumber) {
  Cluster cluster;
  cluster.steps(cluster.kept, 5);
  auto cells = take_apart(cluster.tissue);
  ShellRecord& shell = *std::ranges::find_if(cells, [](const CellRecord& cell) { return cell.row.id == CellId::founder(1); })->shell;
  std::vector<Triangle> faces(shell.shape->topology->faces().begin(), shell.shape->topology->faces().end());
  std::ranges::reverse(faces);
  auto topology = Topology::build(shell.shape->topology->node_count(), std::move(faces));
  ASSERT_TRUE(topology.ok());
  const auto other = make_reference_shape(std::move(topology).value(), shell.shape->position);
  shell = spherical_shell(other, volume_centroid(other->topology->faces(), shell.position), 850.0, 850.0);
  put_together(cluster.tissue, std::move(cells));
  cluster.expect_same_bits();
}

}  // namespace
}  // namespace morula
