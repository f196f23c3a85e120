// Cells that migrate in a run: T11.1 (dcm.md §11).
#include <gtest/gtest.h>

#include "coupling/behaviours/migration.h"
#include "coupling/simulation.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

constexpr double kForce = 1.0, kPersistence = 60.0;  // σ_F [nN], τ [s]
constexpr double kDrag = 45.239;                     // Γ = γ_ECM 4π R² [nN·s/µm]
constexpr double kDiffusion = 0.029318;              // σ_F² τ/Γ² a component [µm²/s]

/// T11.1: D = 0.029318 µm²/s = 105.5 µm²/h, and ⟨x²⟩ = 2D (t − τ (1 − e^(−t/τ))) on the way there, ±5 %. The mean of 6000 components is
/// good to 1.8 %. Forces are held over a step of τ/6, which adds (1/6)²/12 to D.
TEST(Migration, ForceMakesTheCellsOfARunDiffuseAsTheirDragSays) {
  Model model = test::clusters_model(0.0);
  model.space.box = {{-1000, -1000, -1000}, {1000, 1000, 1000}};
  model.types[0].migration.speed = std::sqrt(3.0) * kForce / kDrag;
  model.types[0].migration.own.set("persistence", kPersistence);
  model.step.initial_step = model.step.max_step = kPersistence / 6.0;
  model.contact.range = 5.0;  // nobody is near, and steps are long as the range is
  std::vector<Vec3d> centers;
  constexpr int kAlong = 20, kCells = kAlong * kAlong * 5;
  for (int i = 0; i < kCells; ++i)
    centers.push_back({60.0 * (i % kAlong - 10), 60.0 * (i / kAlong % kAlong - 10), 60.0 * (i / (kAlong * kAlong) - 2)});
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, centers, std::vector<BodyKind>(kCells, BodyKind::kSphere));
  for (std::size_t i = 0; i < kCells; ++i)
    tissue.cells.optional.migration_velocity.set(i, initial_migration_velocity(tissue.cells.rows[i].id, model.types[0], model.seed));
  const std::vector<Vec3d> start = tissue.spheres.position;
  auto simulation = Simulation::create(model, std::move(tissue), Comm(), 1).value();
  for (const double t : {60.0, 300.0, 1200.0}) {
    while (simulation->tissue().clock.time < t) ASSERT_TRUE(simulation->step(t).ok());
    double square = 0.0;
    for (std::size_t i = 0; i < kCells; ++i) square += norm2(simulation->tissue().spheres.position[i] - start[i]) / (3.0 * kCells);
    const double expected = 2.0 * kDiffusion * (t - kPersistence * (1.0 - std::exp(-t / kPersistence)));
    EXPECT_NEAR(square / expected, 1.0, 0.05) << "after " << t << " s";
  }
}

}  // namespace
}  // namespace morula
