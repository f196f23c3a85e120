/// A sphere against a shell, with factors on its foundation and on the adhesion.
#include <gtest/gtest.h>

#include "tests/coupling/energy_gradient.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

/// Forces on a sphere and on the nodes of a shell whose poles are `gap` apart; `energy` [nN·µm].
struct Pair {
  Model model;
  ShapeLibrary shapes;
  Tissue tissue;
  std::vector<Vec3d> force;
  double energy = 0.0;

  Pair(double adhesion, const cbm::WithShells& factors, double gap) : model(test::clusters_model(adhesion)) {
    model.types[0].sphere.with_shells = factors;
    tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {0, 0, 12.0 + gap}}, {BodyKind::kSphere, BodyKind::kShell});
    energy = energy_of(tissue, force);
  }
  double energy_of(const Tissue& now, std::vector<Vec3d>& out) {
    return Mechanics(model, {}, shapes, Comm(), 1).energy_and_forces(now, out);
  }
  /// Along the axis, on the sphere; > 0 draws it to the shell.
  [[nodiscard]] double pull() const { return force[tissue.shells.position.size()].z; }
};

TEST(MixedContact, GoesWithTheFactorOnAdhesionWhereNothingIsPressed) {
  const double whole = Pair(0.3, {1.0, 1.0}, 0.15).pull(), part = Pair(0.3, {1.0, 0.4}, 0.15).pull();
  ASSERT_GT(whole, 0.1);
  EXPECT_NEAR(part / whole, 0.4, 1e-12);
  EXPECT_NEAR(Pair(0.3, {7.0, 1.0}, 0.15).pull() / whole, 1.0, 1e-12) << "a foundation gives way under pressure only";
  EXPECT_EQ(Pair(0.3, {1.0, 0.0}, 0.15).pull(), 0.0);
}

TEST(MixedContact, GoesWithTheFactorOnStiffnessWhereNothingAdheres) {
  const double whole = Pair(0.0, {1.0, 1.0}, -0.4).pull();
  ASSERT_LT(whole, -0.1);
  EXPECT_NEAR(Pair(0.0, {0.4, 1.0}, -0.4).pull() / whole, 0.4, 1e-12);
  EXPECT_NEAR(Pair(0.0, {1.0, 0.2}, -0.4).pull() / whole, 1.0, 1e-12);
}

TEST(MixedContact, HasForcesThatAreMinusTheGradientAndSumToNothing) {
  Pair pair(0.3, {0.46, 0.75}, -0.2);
  Vec3d sum;
  double size = 0.0;
  for (const Vec3d& f : pair.force) sum += f, size += norm(f);
  EXPECT_LT(norm(sum), 1e-12 * size);
  std::vector<Vec3d> unused;
  test::expect_minus_gradient(pair.tissue, pair.force, 12, 1e-7, [&](const Tissue& moved) { return pair.energy_of(moved, unused); });
}

}  // namespace
}  // namespace morula
