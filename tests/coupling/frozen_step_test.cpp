// A step in which nothing can move though forces are left is no step (time_stepping.md §7, §8): it is cut, and in the end refused by name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coupling/simulation.h"
#include "tests/coupling/patient_doublet.h"

namespace morula {
namespace {

constexpr double kNothing = 1e-4;  // motion of a step that is none, in units of the contact range
constexpr double kRest = 1e-2;     // largest force on a node at rest; cells at rest have some 1e-4 [nN]
constexpr double kShort = 0.1;     // step in which 1e-2 nN need not move a node that is glued to another [s]

double largest_force(const Model& model, const Tissue& tissue) {
  ShapeLibrary shapes;
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  std::vector<Vec3d> force;
  (void)mechanics.energy_and_forces(tissue, force);
  double out = 0.0;
  for (const Vec3d& f : force) out = std::max(out, norm(f));
  return out;
}

/// Two cells that are drawn flat onto each other by W/2γ = 0.9. `held`: their triangles keep their shape and their edges do not fold.
struct Doublet {
  Model model;
  ShapeLibrary shapes;
  std::unique_ptr<Simulation> simulation;

  Doublet(double range, bool held, double turnover_rate) : model(test::patient_doublet(0.9, range)) {
    dcm::ShellParameters& p = model.types[0].shell;
    p.turnover_rate = turnover_rate;
    if (!held) p.shape_stiffness = p.barrier_stiffness = 0.0;
    Tissue tissue = test::make_tissue(model, shapes, {{0, 0, -6}, {0, 0, 6}}, {BodyKind::kShell, BodyKind::kShell});
    simulation = std::move(Simulation::create(model, std::move(tissue), Comm(), 1)).value();
  }

  struct End {
    double time;
    std::string error;  ///< empty: it went on
    int frozen = 0;     ///< steps that were made though nothing moved under the forces that are left
    int resting = 0;    ///< steps in which nothing moved and nothing had to
  };
  End run(double until) {
    End out{0.0, {}};
    while (simulation->tissue().clock.time < until) {
      const auto step = simulation->step(until);
      if (!step.ok()) {
        out.error = step.error().message;
        break;
      }
      if (step->mechanics.displacement < kNothing * model.contact.range && step->mechanics.step > kShort)
        ++(largest_force(model, simulation->tissue()) > kRest ? out.frozen : out.resting);
    }
    out.time = simulation->tissue().clock.time;
    return out;
  }
};

/// Without what keeps triangles in shape the rim of a flowing cortex folds, and no motion of the nodes lowers the energy any more, with
/// forces of tenths of nN left. Accepted steps of no length would let the clock run on and the state look stable.
TEST(FrozenStep, IsRefusedWithTheNameOfTheCell) {
  for (const double range : {0.25, 0.5}) {
    Doublet doublet(range, false, 1.0 / 60.0);
    const Doublet::End end = doublet.run(900.0);
    EXPECT_EQ(end.frozen, 0) << range;
    ASSERT_LT(end.time, 900.0) << range;
    EXPECT_EQ(end.error.find("no step lowers the energy"), 0u) << end.error;
    EXPECT_NE(end.error.find("nN are left without balance (cell "), std::string::npos) << end.error;
    // The state that is left is the last good one, and refused again, as it is.
    Tissue tissue = doublet.simulation->tissue();
    EXPECT_GT(largest_force(doublet.model, tissue), 10.0 * kRest);
    Mechanics mechanics(doublet.model, {}, doublet.shapes, Comm(), 1);
    const std::vector<Vec3d> before = tissue.shells.position, none(Mechanics::external_size(tissue));
    const auto again = mechanics.step(tissue, 1e-3, none);
    ASSERT_FALSE(again.ok());
    EXPECT_TRUE(again.error().smaller_step_may_help);
    EXPECT_TRUE(again.error().cell.valid());
    EXPECT_EQ(tissue.shells.position, before);
  }
}

/// The same cells with elastic cortices come to rest: steps in which hardly anything moves are right there.
TEST(FrozenStep, IsNotOneAtRest) {
  Doublet doublet(0.25, true, 0.0);
  const Doublet::End end = doublet.run(3600.0);
  EXPECT_EQ(end.error, "");
  EXPECT_EQ(end.frozen, 0);
  EXPECT_GT(end.resting, 10);
}

/// A way that the iterations of a step cannot go to its end is not done by halves: a free cell goes as far as force and drag say, in
/// shorter steps, or the step is refused (dcm.md T9.2: V = F/(γ_ECM A) with 45.239 nN·s/µm for a sphere of 6 µm).
TEST(CutStep, IsRefused) {
  for (const double allowed : {0.3, 1.0, 2.0})
    for (const int iterations : {1, 3}) {
      Model model = test::clusters_model(0.0);
      model.contact.range = 0.3;
      model.step.max_displacement = allowed;
      model.step.max_newton = iterations;
      for (const double way : {0.1, 0.4, 0.8, 1.5, 3.0}) {
        ShapeLibrary shapes;
        Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kSphere});
        Mechanics mechanics(model, {}, shapes, Comm(), 1);
        constexpr double kStep = 10.0;
        const std::vector<Vec3d> force{{way / kStep * 45.239, 0, 0}};
        const auto done = mechanics.step(tissue, kStep, force);
        if (done.ok()) {
          EXPECT_NEAR(tissue.spheres.position[0].x / way, 1.0, 0.02) << way << ' ' << allowed << ' ' << iterations;
        } else {
          EXPECT_TRUE(done.error().smaller_step_may_help);
          EXPECT_EQ(tissue.spheres.position[0].x, 0.0);
          EXPECT_GT(way, 0.3 * std::min(allowed, 1.0)) << "an iteration goes as far as the contact range";
        }
      }
    }
}

}  // namespace
}  // namespace morula
