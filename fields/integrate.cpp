#include "fields/integrate.h"

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_erkstep.h>
#include <sundials/sundials_context.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "fields/brick_cg.h"

namespace morula::fields {

namespace {

/// What the callbacks of ARKODE see.
struct Problem {
  BrickOperator* op = nullptr;
  const IntegrationSettings* settings = nullptr;
  std::string message;  ///< last complaint of ARKODE
};

Problem& problem(void* user) { return *static_cast<Problem*>(user); }

int rate(double time, N_Vector y, N_Vector ydot, void* user) {
  problem(user).op->evaluate(time, unknowns_of(y), unknowns_of(ydot), true);
  return 0;
}
/// For Newton's residuals: without the rates of the amounts, which nothing in the iteration depends on.
int rate_of_concentrations(double time, N_Vector y, N_Vector ydot, void* user) {
  problem(user).op->evaluate(time, unknowns_of(y), unknowns_of(ydot), false);
  return 0;
}
int error_weights(N_Vector y, N_Vector weights, void* user) {
  const auto& s = *problem(user).settings;
  const double* c = unknowns_of(y);
  double* w = unknowns_of(weights);
  const auto n = static_cast<std::size_t>(problem(user).op->layout().unknowns());
  for (std::size_t i = 0; i < n; ++i) w[i] = 1.0 / (s.relative_tolerance * std::fabs(c[i]) + s.absolute_tolerance);
  return 0;
}
int linearize(double, N_Vector y, N_Vector, void* user) {
  problem(user).op->linearize(unknowns_of(y));
  return 0;
}
/// Never called: the linear solver takes its products from the operator. ARKODE asks for it to accept linearize().
int no_product(N_Vector, N_Vector, double, N_Vector, N_Vector, void*, N_Vector) { return -1; }
/// The largest step for which Bogacki–Shampine 3(2) is stable on the negative real axis: 2.51 (Hairer & Wanner 1996, IV.2).
constexpr double kExplicitStability = 2.5;
int stability(N_Vector, double, double* step, void* user) {
  *step = kExplicitStability / problem(user).settings->largest_rate;
  return 0;
}
void keep_message(int, const char*, const char*, char* text, void* user) { problem(user).message = text; }

/// Frees what SUNDIALS made, in the right order.
struct Session {
  SUNContext context = nullptr;
  N_Vector y = nullptr;
  SUNLinearSolver linear_solver = nullptr;
  void* arkode = nullptr;
  bool implicit = false;

  Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session() {
    if (arkode != nullptr) implicit ? ARKStepFree(&arkode) : ERKStepFree(&arkode);
    if (linear_solver != nullptr) SUNLinSolFree(linear_solver);
    if (y != nullptr) N_VDestroy(y);
    if (context != nullptr) SUNContext_Free(&context);
  }
};

Error failure(const std::string& what) {
  return Error{ErrorKind::kPhysics, "the time integration of a field failed: " + what,
               "look at the reactions and boundary values; another `tolerance` of the field, or a smaller `time.step`, may help"};
}

constexpr int kMostIterations = 500;
constexpr std::int64_t kMostSteps = 1'000'000;
/// Attempts at one step. A field at rest is gone through in steps as long as the interval; where a border or a source then begins to change, the first one is a
/// thousand times too long and more, and each attempt shortens it to a third at most.
constexpr int kMostFailedTests = 60;

bool set_up_implicit(Session& s, Problem& p, const BrickVectorSpace& space, double first_step) {
  s.implicit = true;
  s.arkode = ARKStepCreate(nullptr, rate, 0.0, s.y, s.context);
  const auto gamma = [&s] {
    double value = 0.0;
    ARKStepGetCurrentGamma(s.arkode, &value);
    return value;
  };
  s.linear_solver = make_brick_cg(*p.op, p.settings->multigrid, p.settings->largest_rate, space, gamma, kMostIterations, s.context);
  if (s.arkode == nullptr || s.linear_solver == nullptr) return false;
  bool ok = true;
  const auto set = [&](int flag) { ok = ok && flag >= 0; };
  set(ARKStepSetErrHandlerFn(s.arkode, keep_message, &p));
  set(ARKStepSetUserData(s.arkode, &p));
  set(ARKStepWFtolerances(s.arkode, error_weights));
  set(ARKStepSetTableNum(s.arkode, ARKODE_ESDIRK324L2SA_4_2_3, ARKODE_ERK_NONE));
  set(ARKStepSetInterpolantType(s.arkode, ARK_INTERP_LAGRANGE));
  set(ARKStepSetLinearSolver(s.arkode, s.linear_solver, nullptr));
  set(ARKStepSetJacTimes(s.arkode, linearize, no_product));
  if (p.op->is_linear())
    set(ARKStepSetLinear(s.arkode, 0));
  else
    set(ARKStepSetNlsRhsFn(s.arkode, rate_of_concentrations));
  set(ARKStepSetMaxErrTestFails(s.arkode, kMostFailedTests));
  set(ARKStepSetStopTime(s.arkode, p.settings->interval));
  if (first_step > 0.0) set(ARKStepSetInitStep(s.arkode, first_step));
  return ok;
}

bool set_up_explicit(Session& s, Problem& p, double first_step) {
  s.arkode = ERKStepCreate(rate, 0.0, s.y, s.context);
  if (s.arkode == nullptr) return false;
  bool ok = true;
  const auto set = [&](int flag) { ok = ok && flag >= 0; };
  set(ERKStepSetErrHandlerFn(s.arkode, keep_message, &p));
  set(ERKStepSetUserData(s.arkode, &p));
  set(ERKStepWFtolerances(s.arkode, error_weights));
  set(ERKStepSetTableNum(s.arkode, ARKODE_BOGACKI_SHAMPINE_4_2_3));
  set(ERKStepSetInterpolantType(s.arkode, ARK_INTERP_LAGRANGE));
  if (p.settings->largest_rate > 0.0) {
    set(ERKStepSetStabilityFn(s.arkode, stability, &p));
    set(ERKStepSetCFLFraction(s.arkode, 0.95));
    first_step = std::min(first_step, 0.95 * kExplicitStability / p.settings->largest_rate);
  }
  set(ERKStepSetMaxErrTestFails(s.arkode, kMostFailedTests));
  set(ERKStepSetStopTime(s.arkode, p.settings->interval));
  if (first_step > 0.0) set(ERKStepSetInitStep(s.arkode, first_step));
  return ok;
}

void count_work(const Session& s, IntegrationReport& report) {
  long value = 0, second = 0;
  if (s.implicit) {
    ARKStepGetNumErrTestFails(s.arkode, &value);
    report.failed_steps = value;
    ARKStepGetNumRhsEvals(s.arkode, &second, &value);
    report.evaluations = value;
    ARKStepGetNumLinIters(s.arkode, &value);
    report.linear_iterations = value;
  } else {
    ERKStepGetNumErrTestFails(s.arkode, &value);
    report.failed_steps = value;
    ERKStepGetNumRhsEvals(s.arkode, &value);
    report.evaluations = value;
  }
}

/// The step to begin the next interval with, from the first step of this one: both meet the same kind of jump, cells that moved.
/// h (1.5 e)^(−1/3) with the error estimate e of the step, as ARKODE's own controllers do, changed by a factor of 5 at most. (What ARKODE
/// would do after the last step is of no use: that step is cut to end with the interval.)
double next_first_step(const Session& s, double taken_step) {
  N_Vector error = N_VClone(s.y), weights = N_VClone(s.y);
  double norm = 1.0;
  if (error != nullptr && weights != nullptr) {
    s.implicit ? ARKStepGetEstLocalErrors(s.arkode, error) : ERKStepGetEstLocalErrors(s.arkode, error);
    s.implicit ? ARKStepGetErrWeights(s.arkode, weights) : ERKStepGetErrWeights(s.arkode, weights);
    norm = N_VWrmsNorm(error, weights);
  }
  N_VDestroy(weights);
  N_VDestroy(error);
  const double factor = norm > 0.0 ? 0.96 / std::cbrt(1.5 * norm) : 5.0;
  return taken_step * std::clamp(factor, 0.2, 5.0);
}

}  // namespace

const char* name_of(Method method) { return method == Method::kExplicit ? "explicit (Bogacki-Shampine 3(2))" : "implicit (ESDIRK 3(2))"; }

Method cheaper_method(double interval, double largest_rate, double smallest_rate) {
  // In units of one multiplication. Measured with 25³ voxels: an explicit stage with its vector sums costs 1.5 of them; the implicit
  // method needs about two steps of four solves, each of 3 + 2.4 √κ multiplications, κ the condition of 1 − γJ, and never more than with
  // multigrid, which is taken where it is cheaper (decision 0046).
  const double explicit_cost = 3.0 * 1.5 * std::max(2.0, interval * largest_rate / kExplicitStability);
  constexpr double steps = 2.0, solves = 4.0, diagonal = 0.4358665, multigrid = 30.0;
  const double gamma = diagonal * interval / steps;
  const double condition = (1.0 + gamma * largest_rate) / (1.0 + gamma * smallest_rate);
  const double implicit_cost = steps * solves * std::min(3.0 + 2.4 * std::sqrt(condition), multigrid);
  return explicit_cost <= implicit_cost ? Method::kExplicit : Method::kImplicit;
}

Result<IntegrationReport> integrate(BrickOperator& op, const BrickVectorSpace& space, const IntegrationSettings& settings,
                                    std::vector<double>& unknowns) {
  Problem p{&op, &settings, {}};
  Session s;
  if (SUNContext_Create(nullptr, &s.context) != 0) return failure("no SUNDIALS context");
  s.y = make_brick_vector(space, s.context);
  if (s.y == nullptr) return Error{ErrorKind::kResources, "no memory for a field's unknowns", ""};
  std::copy(unknowns.begin(), unknowns.end(), unknowns_of(s.y));
  const double first_step = std::min(settings.first_step, settings.interval);
  const bool ready = settings.method == Method::kImplicit ? set_up_implicit(s, p, space, first_step) : set_up_explicit(s, p, first_step);
  if (!ready) return failure("set-up: " + p.message);

  IntegrationReport report;
  report.method = settings.method;
  double time = 0.0;
  while (time < settings.interval) {
    const int flag = s.implicit ? ARKStepEvolve(s.arkode, settings.interval, s.y, &time, ARK_ONE_STEP)
                                : ERKStepEvolve(s.arkode, settings.interval, s.y, &time, ARK_ONE_STEP);
    if (flag < 0) return failure(p.message);
    if (report.steps == 0) report.next_step = next_first_step(s, time);
    if (++report.steps > kMostSteps) return failure("more than a million steps in one interval");
    if (flag == ARK_TSTOP_RETURN) break;
    if (settings.give_up && settings.give_up()) return Error{ErrorKind::kStoppedEarly, "the integration of a field was broken off", ""};
  }
  count_work(s, report);
  std::copy_n(unknowns_of(s.y), unknowns.size(), unknowns.begin());
  return report;
}

}  // namespace morula::fields
