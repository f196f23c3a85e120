#pragma once
#include <algorithm>
#include <vector>

#include "coupling/mechanics/mechanics.h"

namespace morula::test {

/// Newton to the end, so that what is left is the error of the step itself.
inline void solve_exactly(StepControl& step) {
  step.first_tolerance = step.later_tolerance = 1e-6;
  step.newton_stop = 1e-9;
  step.max_newton = 20;
}

/// Relaxes until the largest force on a node is below `most` [nN], in steps that grow to `longest` [s]; gives that force.
inline double relax(const Model& model, Tissue& tissue, double most, double longest) {
  ShapeLibrary shapes;
  Mechanics mechanics(model, {}, shapes, Comm(), 1);
  const std::vector<Vec3d> none(Mechanics::external_size(tissue));
  double dt = 0.05, left = 1e300;
  for (int k = 0; k < 400 && left > most && dt > 1e-6; ++k) {
    if (!mechanics.step(tissue, dt, none).ok()) {
      dt *= 0.5;
      continue;
    }
    tissue.clock.time += dt;
    dt = std::min(longest, 1.3 * dt);
    std::vector<Vec3d> force;
    (void)mechanics.energy_and_forces(tissue, force);
    left = 0.0;
    for (const Vec3d& f : force) left = std::max(left, norm(f));
  }
  return left;
}

}  // namespace morula::test
