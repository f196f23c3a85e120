#include "coupling/mechanics/held_nodes.h"

#include <gtest/gtest.h>

#include "coupling/simulation.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

TEST(HeldNodes, AddASpringAlongOneAxisTimesTheStep) {
  HeldNodes held;
  EXPECT_TRUE(held.empty());
  const Vec3d along{0.6, 0.0, 0.8};
  held.hold(1, along, 50.0);
  held.set_step(2.0);
  const std::vector<Float4> p{{1, 1, 1, 0}, {1, 2, 3, 0}};
  std::vector<Float4> q{{5, 6, 7, 0}, {5, 6, 7, 0}};
  held.add_product(p, q);
  EXPECT_EQ(q[0].x, 5.0f);
  EXPECT_NEAR(q[1].x, 5.0 + 100.0 * 3.0 * 0.6, 1e-4);  // 2 s · 50 nN/µm · (along · p = 3) along
  EXPECT_NEAR(q[1].y, 6.0, 1e-4);
  EXPECT_NEAR(q[1].z, 7.0 + 100.0 * 3.0 * 0.8, 1e-4);
  std::vector<SymMat3<float>> diagonal(2);
  held.add_diagonal(diagonal);
  EXPECT_NEAR(diagonal[1].xx, 36.0, 1e-4);
  EXPECT_NEAR(diagonal[1].xz, 48.0, 1e-4);
  EXPECT_NEAR(diagonal[1].zz, 64.0, 1e-4);
  EXPECT_EQ(diagonal[1].yy, 0.0f);
  EXPECT_EQ(diagonal[0].xx, 0.0f);
}

/// Four cells with fluid cortices come to rest, hundreds of their nodes on kinks of the contact energy. Without holding those, 20 minutes
/// take 3,680 steps, most of them of milliseconds.
TEST(HeldNodes, LetCellsWithFluidCorticesComeToRestInLargeSteps) {
  Model model = test::clusters_model(1.0);
  CellType& type = model.types[0];
  type.shell.spring_stiffness = 0.0;
  type.shell.hinge_stiffness = 0.0;
  type.shell.tension = 1.0;
  type.medium_friction = 0.1;
  model.pairs = {ContactPair{1.0, 0.1, 0.1}};
  model.contact.range = 0.5;
  model.contact.points_per_face = 3;
  ShapeLibrary shapes;
  const double a = 3.9;  // neighbours 2√2 a = 11.03 µm apart: touching, of radius 6
  const Tissue tissue =
      test::make_tissue(model, shapes, {{a, a, a}, {a, -a, -a}, {-a, a, -a}, {-a, -a, a}}, std::vector<BodyKind>(4, BodyKind::kShell));
  auto s = std::move(Simulation::create(model, tissue, Comm(), 1)).value();
  double largest = 0.0, motion = 0.0;
  std::vector<Vec3d> at_half;
  while (s->tissue().clock.time < 1200.0) {
    ASSERT_TRUE(s->step(s->tissue().clock.time < 600.0 ? 600.0 : 1200.0).ok());
    ASSERT_LT(s->tissue().clock.steps, 600u);
    if (s->tissue().clock.time == 600.0) at_half = s->tissue().shells.position;
    largest = std::max(largest, s->tissue().clock.next_step);
  }
  for (std::size_t i = 0; i < at_half.size(); ++i) motion = std::max(motion, norm(s->tissue().shells.position[i] - at_half[i]));
  EXPECT_GE(largest, 30.0);
  // A quarter of the range in 600 s: from one kink to the next. With other lengths of steps 0.081, 0.098, 0.084, 0.104 and 0.102 um.
  EXPECT_LT(motion, 0.125);
  const auto centers = s->centers();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j) EXPECT_NEAR(norm(centers[i] - centers[j]), norm(centers[1] - centers[0]), 0.1);
}

}  // namespace
}  // namespace morula
