// The four ways in which adhering shells went wrong before their cures, each shown with its cure and without (time_stepping.md §7, §9).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coupling/simulation.h"
#include "tests/coupling/patient_doublet.h"

namespace morula {
namespace {

struct Outcome {
  bool reached = false;      ///< the end of the run
  Error error;               ///< else
  double quality = 1.0;      ///< smallest 4√3 A/Σℓ² of a face in any state
  double overlap = 0.0;      ///< deepest, at the end [µm]
  double length = 0.0;       ///< of the doublet at the end, over 2 R0
  int steps_in_overlap = 0;  ///< steps until the overlap is below 0.1 µm
};

double smallest_quality(const Tissue& tissue) {
  double out = 1.0;
  for (std::size_t s = 0; s < tissue.shells.size(); ++s) {
    const auto x = tissue.shells.nodes(s);
    for (const Triangle& t : tissue.shells.topology(s).faces()) {
      const Vec3d a = x[t[1]] - x[t[0]], b = x[t[2]] - x[t[1]], c = x[t[0]] - x[t[2]];
      out = std::min(out, 2.0 * std::sqrt(3.0) * norm(cross(a, b)) / (norm2(a) + norm2(b) + norm2(c)));
    }
  }
  return out;
}

/// Two cells of the model, `distance` apart at the start.
Outcome run_doublet(const Model& model, double distance, double end) {
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, -0.5 * distance}, {0, 0, 0.5 * distance}}, {BodyKind::kShell, BodyKind::kShell});
  tissue.clock.capped = model.step.start_cap > 0.0;
  auto made = Simulation::create(model, std::move(tissue), Comm(), 1);
  Outcome out;
  if (!made) {
    out.error = made.error();
    return out;
  }
  Simulation& s = **made;
  while (s.tissue().clock.time < end) {
    const auto step = s.step(end);
    if (!step) {
      out.error = step.error();
      return out;
    }
    out.overlap = step->mechanics.overlap;
    if (out.overlap > 0.1) ++out.steps_in_overlap;
    out.quality = std::min(out.quality, smallest_quality(s.tissue()));
  }
  double low = 1e300, high = -1e300;
  for (const Vec3d& x : s.tissue().shells.position) {
    low = std::min(low, x.z);
    high = std::max(high, x.z);
  }
  double volume = 0.0;
  for (const double v : s.values().volume) volume += 0.5 * v;
  out.length = 0.5 * (high - low) / std::cbrt(0.75 * volume / std::numbers::pi);
  out.reached = true;
  return out;
}

/// Rim folding, and what came of it: a step that nothing can make is an error that names the cell, never a step of length zero.
TEST(RobustContact, RimDoesNotFoldWhileTrianglesKeepTheirShape) {
  Model model = test::patient_doublet(0.9, 0.5);
  model.types[0].shell.turnover_rate = 1.0 / 60.0;  // a cortex that flows does not hold its triangles
  const Outcome with = run_doublet(model, 12.0, 900.0);
  EXPECT_TRUE(with.reached) << with.error.message;
  EXPECT_GT(with.quality, 0.4);
  model.types[0].shell.shape_stiffness = model.types[0].shell.barrier_stiffness = 0.0;
  const Outcome without = run_doublet(model, 12.0, 900.0);
  EXPECT_LT(without.quality, 0.5 * with.quality);
  ASSERT_FALSE(without.reached);
  EXPECT_EQ(without.error.message.find("no step lowers the energy"), 0u) << without.error.message;
  EXPECT_NE(without.error.message.find("(cell "), std::string::npos) << without.error.message;
}

/// Springs with fixed rest lengths pin the contact line: with a cortex that is renewed the doublet reaches the length of Young's law, 1.5874 R0
/// per cell at W/2γ = 0.5 (dcm.md §8), without it stays 4 % and more above.
TEST(RobustContact, ContactLineIsNotPinnedWhereTheCortexTurnsOver) {
  Model model = test::patient_doublet(0.5, 0.5);
  model.types[0].shell.turnover_rate = 1.0 / 60.0;
  const Outcome with = run_doublet(model, 12.0, 1800.0);
  ASSERT_TRUE(with.reached) << with.error.message;
  EXPECT_NEAR(with.length / 1.5874, 1.0, 0.025);
  model.types[0].shell.turnover_rate = 0.0;
  const Outcome without = run_doublet(model, 12.0, 1800.0);
  ASSERT_TRUE(without.reached) << without.error.message;
  EXPECT_GT(without.length / 1.5874, 1.04);
}

/// Two balls of 12 µm that start 4 µm within each other: a capped traction lets them out, the full one folds them.
TEST(RobustContact, DeepOverlapIsLeftWithACappedStart) {
  Model model = test::patient_doublet(0.5, 0.5);
  model.types[0].shell.shape_stiffness = 0.15;  // the default of studies, 0.3 times the tension
  model.step.start_cap = 0.036;                 // `start_cap: auto` at this tension, mesh and repulsion
  const Outcome with = run_doublet(model, 8.0, 120.0);
  ASSERT_TRUE(with.reached) << with.error.message;
  EXPECT_LT(with.overlap, 0.1);
  EXPECT_LT(with.steps_in_overlap, 120);
  EXPECT_GT(with.quality, 0.3);
  model.step.start_cap = 0.0;
  const Outcome without = run_doublet(model, 8.0, 120.0);
  EXPECT_TRUE(!without.reached || without.overlap > 0.1 || without.quality < 0.3) << without.overlap << " " << without.quality;
}

}  // namespace
}  // namespace morula
