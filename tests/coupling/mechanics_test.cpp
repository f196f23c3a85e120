#include "coupling/mechanics/mechanics.h"

#include <gtest/gtest.h>

#include "core/random/philox.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

using test::clusters_model;
using test::make_tissue;

/// Moves every point of a tissue by a small pseudo-random amount, so that nothing is symmetric.
void shake(Tissue& tissue, double amount) {
  std::uint64_t n = 0;
  const Random random(7, RandomStream::kInitialPosition);
  for (auto* positions : {&tissue.shells.position, &tissue.spheres.position})
    for (Vec3d& p : *positions) p += random.direction(CellId(1), n++) * amount;
}

struct Case {
  const char* name;
  std::vector<Vec3d> centers;
  std::vector<BodyKind> bodies;
  double attached;
};

class EveryPairOfBodies : public testing::TestWithParam<int> {};

TEST_P(EveryPairOfBodies, ForceIsMinusTheGradientOfTheWholeEnergy) {
  Model model = clusters_model(0.3);
  model.contact.range = 0.8;
  const std::vector<std::vector<BodyKind>> bodies{{BodyKind::kShell, BodyKind::kShell, BodyKind::kShell},
                                                  {BodyKind::kShell, BodyKind::kSphere, BodyKind::kShell},
                                                  {BodyKind::kSphere, BodyKind::kSphere, BodyKind::kSphere}};
  ShapeLibrary shapes;
  Tissue tissue = make_tissue(model, shapes, {{0, 0, 0}, {11.6, 0.3, 0.2}, {5.2, 10.4, 0.4}}, bodies[static_cast<std::size_t>(GetParam())]);
  shake(tissue, 0.05);
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  std::vector<Vec3d> force, unused;
  ASSERT_LT(mechanics.energy_and_forces(tissue, force), 1e6);
  double largest = 0.0;
  Vec3d total;
  for (const Vec3d& f : force) {
    largest = std::max(largest, norm(f));
    total += f;
  }
  EXPECT_LT(norm(total), 1e-12 * largest * static_cast<double>(force.size()));
  const Random random(11, RandomStream::kInitialPosition);
  std::uint64_t draw = 0;
  for (int direction = 0; direction < 20; ++direction) {
    std::vector<Vec3d> along(force.size());
    double predicted = 0.0;
    for (std::size_t i = 0; i < along.size(); ++i) {
      along[i] = random.direction(CellId(2), draw++);
      predicted -= dot(along[i], force[i]);
    }
    const double h = 1e-5;
    const auto energy_at = [&](double s) {
      Tissue moved = tissue;
      for (std::size_t i = 0; i < along.size(); ++i) {
        Vec3d& p = i < moved.shells.position.size() ? moved.shells.position[i] : moved.spheres.position[i - moved.shells.position.size()];
        p += along[i] * s;
      }
      Mechanics fresh(model, {}, shapes, Comm(), 1);
      return fresh.energy_and_forces(moved, unused);
    };
    const double measured = (energy_at(h) - energy_at(-h)) / (2.0 * h);
    double scale = 0.0;
    for (const Vec3d& f : force) scale += norm2(f);
    EXPECT_NEAR(measured, predicted, 1e-7 * std::sqrt(scale)) << "direction " << direction;
  }
}

INSTANTIATE_TEST_SUITE_P(ShellsAndSpheres, EveryPairOfBodies, testing::Values(0, 1, 2));

TEST(ImplicitStep, DoubletSpreadsAndNeverGainsEnergy) {
  const Model model = clusters_model(0.1);
  ShapeLibrary shapes;
  Tissue tissue = make_tissue(model, shapes, {{0, 0, 0}, {12.0, 0, 0}}, {BodyKind::kShell, BodyKind::kShell});
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  const std::vector<Vec3d> none(Mechanics::external_size(tissue));
  double energy = 1e300;
  for (int step = 0; step < 60; ++step) {
    const auto report = mechanics.step(tissue, 5.0, none);
    ASSERT_TRUE(report.ok()) << report.error().what;
    EXPECT_LE(report->energy, energy + 1e-9) << "step " << step;
    energy = report->energy;
    tissue.clock.time += 5.0;
    printf("%d newton %d lin %d halv %d disp %.4f E %.6f overlap %.4f\n", step, report->newton, report->linear_iterations, report->halvings, report->displacement, report->energy, report->overlap);
  }
  printf("CA %f\n", mechanics.values(tissue).contact_area[0]);
}

}  // namespace
}  // namespace morula
