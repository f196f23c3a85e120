#include "coupling/mechanics/mechanics.h"

#include <gtest/gtest.h>

#include "core/random/philox.h"
#include "tests/coupling/energy_gradient.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

using test::clusters_model;
using test::expect_minus_gradient;
using test::make_tissue;

/// Moves every point of a tissue by a small pseudo-random amount, so that nothing is symmetric.
void shake(Tissue& tissue, double amount) {
  std::uint64_t n = 0;
  const Random random(7, RandomStream::kInitialPosition);
  for (auto* positions : {&tissue.shells.position, &tissue.spheres.position})
    for (Vec3d& p : *positions) p += random.direction(CellId(1), n++) * amount;
}

/// What the bodies are, and the law between them.
struct Bodies {
  const char* name;
  std::vector<BodyKind> kinds;
  std::shared_ptr<const SurfaceLaw> law;
};
const Bodies kBodies[] = {
    {"Shells", {BodyKind::kShell, BodyKind::kShell, BodyKind::kShell}, tent_law()},
    {"ShellsAndASphere", {BodyKind::kShell, BodyKind::kSphere, BodyKind::kShell}, tent_law()},
    {"Spheres", {BodyKind::kSphere, BodyKind::kSphere, BodyKind::kSphere}, tent_law()},
    {"ShellsByMaugisDugdale", {BodyKind::kShell, BodyKind::kShell, BodyKind::kShell}, maugis_dugdale_law()},
    {"ShellsAndASphereByMaugisDugdale", {BodyKind::kShell, BodyKind::kSphere, BodyKind::kShell}, maugis_dugdale_law()},
    {"ShellsByAFallingTraction", {BodyKind::kShell, BodyKind::kShell, BodyKind::kShell}, falling_law()},
};

/// Three bodies that touch each other, out of shape.
class EveryPairOfBodies : public testing::TestWithParam<Bodies> {
 protected:
  void SetUp() override {
    model.contact.range = 0.8;
    model.pairs[0].law = GetParam().law;
    model.pairs[0].own.set("modulus", 1.0);
    tissue = make_tissue(model, shapes, {{0, 0, 0}, {11.6, 0.3, 0.2}, {5.2, 10.4, 0.4}}, GetParam().kinds);
    shake(tissue, 0.05);
  }

  Model model = clusters_model(0.3);
  ShapeLibrary shapes;
  Tissue tissue;
};

TEST_P(EveryPairOfBodies, ForceIsMinusTheGradientOfTheWholeEnergy) {
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
  expect_minus_gradient(tissue, force, 20, 1e-7, [&](const Tissue& moved) {
    Mechanics fresh(model, {}, shapes, Comm(), 1);
    return fresh.energy_and_forces(moved, unused);
  });
}

/// dcm.md §16.4: cells that change places among themselves feel what those felt whose places they took, to rounding; which body of a pair
/// comes first, and which point is held against which face first, does not matter.
TEST_P(EveryPairOfBodies, ForcesDoNotKnowTheOrderOfTheBodies) {
  Tissue turned = tissue;
  const std::size_t shells = tissue.shells.size(), nodes = tissue.shells.position.size(), spheres = tissue.spheres.size();
  for (std::size_t s = 0; s < shells; ++s) {
    const auto from = std::as_const(tissue.shells).nodes(shells - 1 - s);
    std::copy(from.begin(), from.end(), turned.shells.nodes(s).begin());
  }
  for (std::size_t s = 0; s < spheres; ++s) turned.spheres.position[s] = tissue.spheres.position[spheres - 1 - s];
  std::vector<Vec3d> force, there;
  const double energy = Mechanics(model, {}, shapes, Comm(), 1).energy_and_forces(tissue, force);
  EXPECT_NEAR(Mechanics(model, {}, shapes, Comm(), 1).energy_and_forces(turned, there), energy, 1e-12 * std::abs(energy));
  double largest = 0.0;
  for (const Vec3d& f : force) largest = std::max(largest, norm(f));
  for (std::size_t s = 0; s < shells; ++s)
    for (std::uint32_t i = 0; i < 162; ++i) {
      const Vec3d &a = force[tissue.shells.first_node[shells - 1 - s] + i], &b = there[tissue.shells.first_node[s] + i];
      EXPECT_LT(norm(b - a), 1e-12 * largest) << "shell " << s << ", node " << i;
    }
  for (std::size_t s = 0; s < spheres; ++s) EXPECT_LT(norm(there[nodes + s] - force[nodes + spheres - 1 - s]), 1e-12 * largest);
}

INSTANTIATE_TEST_SUITE_P(Every, EveryPairOfBodies, testing::ValuesIn(kBodies),
                         [](const testing::TestParamInfo<Bodies>& given) { return std::string(given.param.name); });

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
  }
  EXPECT_LT(mechanics.deepest_overlap(), 0.05);
  EXPECT_GT(mechanics.values(tissue).contact_area[0], 10.0);  // fixed springs pin the line below the 20 µm² of a flowing cortex
}

TEST(ImplicitStep, NamesTheCellWhoseForcesAreNotNumbers) {
  const Model model = test::clusters_model();
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{-30, 0, 0}, {30, 0, 0}, {0, 40, 0}}, std::vector(3, BodyKind::kShell));
  const Tissue before = tissue;
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  std::vector<Vec3d> external(Mechanics::external_size(tissue));
  external[tissue.shells.first_node[1] + 7].y = std::nan("");
  const auto step = mechanics.step(tissue, 1.0, external);
  ASSERT_FALSE(step.ok());
  EXPECT_EQ(step.error().what, "forces are not numbers");
  EXPECT_FALSE(step.error().smaller_step_may_help);
  for (const BodyOfRow& body : bodies_of(tissue.cells)) EXPECT_EQ(step.error().cell == tissue.cells.rows[body.row].id, body.number == 1);
  EXPECT_EQ(tissue.shells.position, before.shells.position);
}

TEST(ImplicitStep, DoesNotDependOnWhenTheWorkspaceWasMade) {
  Model model = clusters_model(0.1);
  model.contact.range = 0.5;
  ShapeLibrary shapes;
  const std::vector<Vec3d> centers{{0, 0, 0}, {11.8, 0.4, 0.1}, {5.5, 10.2, 0.6}};
  const std::vector<BodyKind> bodies{BodyKind::kShell, BodyKind::kSphere, BodyKind::kShell};
  Tissue whole = make_tissue(model, shapes, centers, bodies);
  Tissue split = whole;
  const std::vector<Vec3d> none(Mechanics::external_size(whole));
  Mechanics kept(model, {}, shapes, Comm(), 1);
  for (int step = 0; step < 12; ++step) {
    ASSERT_TRUE(kept.step(whole, 0.2, none).ok());
    Mechanics fresh(model, {}, shapes, Comm(), 1);
    if (step % 3 == 0) (void)fresh.values(split);  // looking changes nothing
    ASSERT_TRUE(fresh.step(split, 0.2, none).ok());
    for (std::size_t i = 0; i < whole.shells.position.size(); ++i)
      ASSERT_EQ(whole.shells.position[i], split.shells.position[i]) << step << ' ' << i;
    ASSERT_EQ(whole.spheres.position[0], split.spheres.position[0]) << step;
    for (Tissue* t : {&whole, &split}) t->spheres.radius[0] *= 1.001;
    kept.parameters_changed();
  }
}

}  // namespace
}  // namespace morula
