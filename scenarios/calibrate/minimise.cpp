#include "scenarios/calibrate/minimise.h"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace morula::calibrate {
namespace {

/// Step of central differences in parameters of order one: the cut-off error is about its square, the rounding 1e-16 over it.
constexpr double kDifference = 1e-5;

double sum_of_squares(const std::vector<double>& r) {
  double sum = 0.0;
  for (const double x : r) sum += x * x;
  return sum;
}

/// What NLopt hands to the objective. It searches in θ_k/scale_k.
struct Search {
  const LeastSquares* problem;
  std::vector<double> scale;
  std::vector<double> at{}, residuals{}, ahead{}, behind{};
};

/// Changes of all residuals with parameter k, 2 × step apart, into `ahead` and `behind`.
void differ(Search& search, std::size_t k) {
  const double here = search.at[k];
  search.at[k] = here + kDifference;
  search.problem->residuals(search.at, search.ahead);
  search.at[k] = here - kDifference;
  search.problem->residuals(search.at, search.behind);
  search.at[k] = here;
}

bool is_fixed(const LeastSquares& problem, std::size_t k) { return problem.low[k] == problem.high[k]; }

double objective(unsigned count, const double* scaled, double* gradient, void* data) {
  Search& search = *static_cast<Search*>(data);
  const LeastSquares& problem = *search.problem;
  if (!std::all_of(scaled, scaled + count, [](double x) { return std::isfinite(x); })) {  // a search that is lost in a plain
    if (gradient != nullptr) std::fill_n(gradient, count, 0.0);
    return std::numeric_limits<double>::infinity();
  }
  search.at.resize(count);
  for (unsigned k = 0; k < count; ++k) search.at[k] = std::clamp(scaled[k] * search.scale[k], problem.low[k], problem.high[k]);
  problem.residuals(search.at, search.residuals);
  if (gradient != nullptr) {
    for (unsigned k = 0; k < count; ++k) {
      gradient[k] = 0.0;
      if (is_fixed(problem, k)) continue;
      differ(search, k);
      for (std::size_t i = 0; i < search.residuals.size(); ++i)
        gradient[k] += search.scale[k] * search.residuals[i] * (search.ahead[i] - search.behind[i]) / kDifference;
    }
  }
  return sum_of_squares(search.residuals);
}

/// Units in which the loss bends alike along all parameters, 1/√(2 Σ (∂r/∂θ)²): the search begins with the unit matrix for its second derivatives,
/// and would leap to the bounds where the loss is steep. Along a parameter that the residuals hardly see a unit is 3 (a factor 20) at most.
void find_scale(Search& search, std::span<const double> parameters) {
  search.at.assign(parameters.begin(), parameters.end());
  for (std::size_t k = 0; k < search.at.size(); ++k) {
    search.scale[k] = 1.0;
    if (is_fixed(*search.problem, k)) continue;
    differ(search, k);
    double square = 0.0;
    for (std::size_t i = 0; i < search.ahead.size(); ++i) {
      const double slope = (search.ahead[i] - search.behind[i]) / (2.0 * kDifference);
      square += slope * slope;
    }
    search.scale[k] = 1.0 / std::max(std::sqrt(2.0 * square), 1.0 / 3.0);
  }
}

struct DestroyOptimiser {
  void operator()(nlopt_opt_s* optimiser) const { nlopt_destroy(optimiser); }
};

}  // namespace

Minimum minimise(const LeastSquares& problem, std::span<const double> start) {
  const std::size_t count = start.size();
  Search search{&problem, std::vector<double>(count, 1.0)};
  Minimum best{{start.begin(), start.end()}, 0.0, false};
  for (std::size_t k = 0; k < count; ++k) best.parameters[k] = std::clamp(best.parameters[k], problem.low[k], problem.high[k]);
  problem.residuals(best.parameters, search.residuals);
  best.loss = sum_of_squares(search.residuals);
  for (int round = 0; round < 20 && !best.converged; ++round) {
    find_scale(search, best.parameters);
    std::vector<double> low(count), high(count), at(count);
    for (std::size_t k = 0; k < count; ++k) {
      low[k] = problem.low[k] / search.scale[k], high[k] = problem.high[k] / search.scale[k];
      at[k] = std::clamp(best.parameters[k] / search.scale[k], low[k], high[k]);
    }
    const std::unique_ptr<nlopt_opt_s, DestroyOptimiser> optimiser(nlopt_create(NLOPT_LD_SLSQP, static_cast<unsigned>(count)));
    nlopt_set_min_objective(optimiser.get(), &objective, &search);
    nlopt_set_lower_bounds(optimiser.get(), low.data());
    nlopt_set_upper_bounds(optimiser.get(), high.data());
    nlopt_set_xtol_abs1(optimiser.get(), 1e-10);
    nlopt_set_maxeval(optimiser.get(), 400);
    double loss = best.loss;
    // Limits of rounding end a search like its tolerances do; whether the place is a minimum is seen by the next round.
    nlopt_optimize(optimiser.get(), at.data(), &loss);
    best.converged = !(loss < best.loss * (1.0 - 1e-9));
    if (loss < best.loss) {
      best.loss = loss;
      for (std::size_t k = 0; k < count; ++k) best.parameters[k] = std::clamp(at[k] * search.scale[k], problem.low[k], problem.high[k]);
    }
  }
  return best;
}

std::vector<std::vector<double>> jacobian(const LeastSquares& problem, std::span<const double> at) {
  std::vector<double> theta(at.begin(), at.end()), ahead, behind;
  problem.residuals(theta, ahead);
  std::vector<std::vector<double>> out(ahead.size(), std::vector<double>(at.size(), 0.0));
  for (std::size_t k = 0; k < at.size(); ++k) {
    if (problem.low[k] == problem.high[k]) continue;
    theta[k] = at[k] + kDifference;
    problem.residuals(theta, ahead);
    theta[k] = at[k] - kDifference;
    problem.residuals(theta, behind);
    theta[k] = at[k];
    for (std::size_t i = 0; i < ahead.size(); ++i) out[i][k] = (ahead[i] - behind[i]) / (2.0 * kDifference);
  }
  return out;
}

}  // namespace morula::calibrate
