#pragma once
#include <cstdint>
#include <functional>

#include "core/parallel/comm.h"
#include "core/result.h"
#include "fields/brick_operator.h"
#include "fields/brick_vector.h"
#include "fields/multigrid.h"

namespace morula::fields {

/// How an interval is integrated.
enum class Method : std::uint8_t {
  kExplicit,  ///< Bogacki–Shampine 3(2), steps below the stability limit
  kImplicit,  ///< ESDIRK 3(2), L-stable and stiffly accurate, Newton with conjugate gradients preconditioned by the diagonal or multigrid
};

/// The name of a method for logs.
const char* name_of(Method method);

/// The method that should need less work for this interval [s]: stages of the explicit method against multiplications of the implicit one.
/// A pure function of numbers that are the same on all ranks. `largest_rate` bounds the spectrum of the right-hand side,
/// `smallest_rate` is its slowest mode [1/s].
Method cheaper_method(double interval, double largest_rate, double smallest_rate);

/// Work done by an integration.
struct IntegrationReport {
  Method method = Method::kExplicit;
  std::int64_t steps = 0;
  std::int64_t failed_steps = 0;       ///< attempts that missed the tolerance
  std::int64_t evaluations = 0;        ///< of the right-hand side
  std::int64_t linear_iterations = 0;  ///< of the conjugate gradients
  double next_step = 0.0;              ///< to begin the next interval with [s]
};

struct IntegrationSettings {
  Method method = Method::kExplicit;
  double interval = 0.0;    ///< [s]
  double first_step = 0.0;  ///< [s]; 0: chosen by the integrator
  double relative_tolerance = 0.0;
  double absolute_tolerance = 0.0;  ///< [mM]
  double largest_rate = 0.0;        ///< of all ranks [1/s]
  Multigrid* multigrid = nullptr;   ///< to precondition with where that is cheaper than the diagonal
  std::function<bool()> give_up;    ///< asked after every step, by all ranks together; true: the integration ends there with kStoppedEarly
};

/// Integrate the unknowns (Layout) over an interval with ARKODE (Reynolds et al. 2023, doi:10.1145/3594632); collective.
///
/// The amounts get the same stage weights as the concentrations, so that Σ V c + taken + decayed − inflow is kept to rounding,
/// whatever the tolerances. Every call starts afresh: no history, the result is a function of the arguments.
/// Errors: kPhysics when the integrator gives up, with its own message; kStoppedEarly. The unknowns are unchanged then.
Result<IntegrationReport> integrate(BrickOperator& op, const BrickVectorSpace& space, const IntegrationSettings& settings,
                                    std::vector<double>& unknowns);

}  // namespace morula::fields
