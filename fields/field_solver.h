#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "core/parallel/comm.h"
#include "core/result.h"
#include "core/space/space.h"
#include "fields/cell_exchange.h"
#include "fields/field.h"
#include "fields/field_spec.h"
#include "fields/integrate.h"

namespace morula::fields {

/// What happened to one field in one interval; the same on every rank.
struct IntervalReport {
  IntegrationReport work;
  double amount_before = 0.0;                     ///< in the field [amol]
  double amount_after = 0.0;                      ///< in the field [amol]
  std::array<std::array<double, 2>, 3> inflow{};  ///< through each face, axis then low and high; negative: out [amol]
  double decayed = 0.0;                           ///< what reactions in the volume took [amol]
  double taken = 0.0;                             ///< by all cells, summed over the cells [amol]
  double minimum = 0.0, maximum = 0.0;            ///< of the concentration at the end [mM]; a negative minimum is not clipped
  double change = 0.0;    ///< largest of any voxel in the interval, over the largest concentration of start, faces and before
  double residual = 0.0;  ///< after − before + taken + decayed − inflow [amol]

  [[nodiscard]] double total_inflow() const {
    return inflow[0][0] + inflow[0][1] + inflow[1][0] + inflow[1][1] + inflow[2][0] + inflow[2][1];
  }
  /// |residual| over the larger of the amount in the field and the amount that passed.
  [[nodiscard]] double balance_error() const;
};

/// Integrates fields. A workspace: it keeps buffers, never results, and may be made anew at any time.
class FieldSolver {
 public:
  FieldSolver();
  ~FieldSolver();
  FieldSolver(FieldSolver&&) noexcept;
  FieldSolver& operator=(FieldSolver&&) noexcept;

  /// Integrate ∂c/∂t = D ∇²c − Σ r(c) − Σ_i u_i(c) w_i, r of reactions in the volume, u_i of those of cell i, over `interval` [s], the cells standing still. Collective.
  ///
  /// `cells` are this rank's cells, in any order; taken[i] [amol] and seen[i] [mM, at the end] belong to cells[i]. What the cells took,
  /// what decayed and what came in through the faces is integrated with the concentrations, so that amounts are kept to rounding,
  /// whatever the tolerance. field.next_step is read and written; nothing else carries over from interval to interval.
  /// The absolute tolerance is 10⁻³ of the relative one times the largest of initial, boundary and present concentrations.
  ///
  /// Errors: kInput for a spec that makes no sense (negative diffusion, values of reactions out of their ranges), kPhysics when the integrator
  /// gives up or the field is not finite, kStoppedEarly when `give_up` (asked between the integrator's steps, by all ranks together) says
  /// so; the field is then unchanged.
  Result<IntervalReport> advance(Field& field, const FieldSpec& spec, const Space& space, std::span<const CellSource> cells,
                                 double interval, const Comm& comm, std::span<double> taken, std::span<double> seen,
                                 const std::function<bool()>& give_up = {});

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

/// What the cells of this rank see, Σ w_iv c_v [mM], without integrating. Collective.
Status sample(const Field& field, const Space& space, std::span<const CellSource> cells, const Comm& comm, std::span<double> seen);

/// What is wrong with the numbers of a spec, if anything.
Status check(const FieldSpec& spec);

}  // namespace morula::fields
