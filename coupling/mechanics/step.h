#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/result.h"
#include "coupling/mechanics/workspace.h"

namespace morula {

/// The balance of forces of a step at the present positions.
struct Residual {
  double energy = 0.0;       ///< E, as Evaluation::energy [fJ]
  double phi = 0.0;          ///< Φ = E − f·d + dᵀΓ_n d/(2Δt): what the step makes least [fJ]
  std::vector<Vec3d> force;  ///< −∂Φ/∂x = F + f − Γ_n d/Δt of owned points [nN]
};

/// The matrix Γ_n + Δt K̃ at the positions of an evaluation. It takes the place of what only forces need; solve() uses it up.
class AssembledMatrix {
 public:
  AssembledMatrix(Workspace& work, const Tissue& tissue, double dt);
  ~AssembledMatrix();
  AssembledMatrix(const AssembledMatrix&) = delete;
  AssembledMatrix& operator=(const AssembledMatrix&) = delete;

  /// Velocities for the forces `right` into Workspace::Solver::velocity, which is where the iterations start; every cluster that is not tied then gets
  /// the common velocity that it lacks (FreeClusters). Collective.
  Result<SolveReport, SolveFault> solve(std::span<const Vec3d> right, double tolerance, int max_iterations) &&;

 private:
  Workspace& work_;
};

/// A step begins at the present positions of the tissue, whose forces are `now`: friction is frozen, random forces are drawn from it, obstacles go
/// to where they are at the step's end, and the last velocities become the solver's start. Collective.
Evaluation begin_step(Workspace& work, const Tissue& tissue, StepTask& task, Evaluation now);
/// The random forces by point that a step of dt [s] from here would draw. Collective.
std::vector<Vec3d> random_forces(Workspace& work, const Tissue& tissue, double dt);
/// The residual of a step from `start` at the present positions. `moved`: false at the start itself, where only obstacles have rubbed.
/// Collective.
Residual residual_of(Workspace& work, const Tissue& tissue, const StepTask& task, std::span<const Vec3d> start, Evaluation now,
                     bool moved = true);
/// The second part of AssembledMatrix::solve(), while the matrix is there.
void conserve_momentum(Workspace& work, std::span<const Vec3d> right);
/// Way of the tissue as a whole from the tissue's positions to the scene's. Collective.
TissueMotion common_motion(const Workspace& work, const Tissue& tissue);
/// The step has come to its end: positions and velocities go to the tissue, and who adheres to whom is looked at again. Collective.
void finish_step(Workspace& work, Tissue& tissue, const StepTask& task, double energy, StepReport& report);
/// Back to the step's start after a fault.
StepFault undo_step(Workspace& work, std::span<const Vec3d> start, StepFault fault);

/// A step by Newton's method (time_stepping.md §8, §9), or by explicit Euler. On success the tissue holds the new positions and velocities; on
/// a fault it is unchanged. Collective.
Result<StepReport, StepFault> implicit_step(Workspace& work, Tissue& tissue, const StepTask& task, Evaluation now);
Result<StepReport, StepFault> explicit_step(Workspace& work, Tissue& tissue, const StepTask& task, Evaluation now);
/// A step from the tissue as it is, by whichever method the model asks for.
Result<StepReport, StepFault> advance(Workspace& work, Tissue& tissue, StepTask task);

}  // namespace morula
