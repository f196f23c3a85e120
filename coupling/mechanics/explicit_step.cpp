#include <cmath>
#include <string>

#include "coupling/mechanics/step.h"

namespace morula {
namespace {

// Explicit Euler is the reference and has no second solve: forces on nodes without contact may be a thousandth of those in it (dcm.md §1).
constexpr double kTolerance = 1e-6;
constexpr int kMostIterations = 4000;

}  // namespace

Result<StepReport, StepFault> explicit_step(Workspace& work, Tissue& tissue, const StepTask& task, Evaluation now) {
  const OwnedPoints points = work.points();
  const std::vector<Vec3d> start = work.scene.position();
  const auto undo = [&](StepFault fault) { return undo_step(work, start, std::move(fault)); };
  StepReport report;
  report.step = task.dt;
  const Residual residual = residual_of(work, tissue, task, start, std::move(now), false);
  const auto solved = AssembledMatrix(work, tissue, 0.0).solve(residual.force, kTolerance, kMostIterations);
  if (!solved) return undo({solved.error().what, {}, true});
  if (!solved->converged) return undo({"the velocities are not found in " + std::to_string(kMostIterations) + " iterations", {}, false});
  report.linear_iterations = solved->iterations;
  report.newton = 1;
  work.scene.move_points([&](std::span<Vec3d> x) {
    const std::vector<Float4>& v = work.solver.velocity;
    points.for_all([&](std::uint32_t i) { x[i] += Vec3d{v[i].x, v[i].y, v[i].z} * task.dt; });
  });
  report.displacement = points.largest_of([&](std::uint32_t i) { return work.scene.position()[i] - start[i]; });
  report.way = report.displacement;
  if (!std::isfinite(report.displacement) || report.displacement > work.setting.model.contact.range)
    return undo({"points moved too far in one explicit step", {}, true});
  const Evaluation end = evaluate(work, tissue, {});
  const std::optional<CellId> through = find_crossed(work, tissue, start);
  if (work.setting.comm.any(through.has_value()))
    return undo({"a surface would pass through another", through.value_or(CellId()), true, through ? 1.0 : 0.0});
  if (const auto fault = find_fault(work, tissue); work.setting.comm.any(fault.has_value()))
    return undo(fault.value_or(StepFault{}));  // that of another rank is told
  finish_step(work, tissue, task, end.energy, report);
  return report;
}

}  // namespace morula
