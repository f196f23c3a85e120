#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace morula::calibrate {

/// Residuals of parameters; always the same number of them.
using Residuals = std::function<void(std::span<const double> parameters, std::vector<double>& out)>;

/// Least squares within bounds: Σ r². A parameter whose bounds are equal stays.
struct LeastSquares {
  Residuals residuals;
  std::vector<double> low, high;
};

/// Where a search ended.
struct Minimum {
  std::vector<double> parameters;
  double loss = 0.0;       ///< Σ r²
  bool converged = false;  ///< false: the search ran out of evaluations
};

/// Searches downhill from `start`: sequential quadratic programming (Kraft 1994, doi:10.1145/192115.192124, in NLopt's version) with gradients
/// from central differences, begun anew from where it ended until that changes nothing. Parameters are expected to be of order one (logarithms).
/// Deterministic: no random numbers, one thread.
Minimum minimise(const LeastSquares& problem, std::span<const double> start);

/// ∂r/∂θ by central differences, one row for each residual.
std::vector<std::vector<double>> jacobian(const LeastSquares& problem, std::span<const double> at);

}  // namespace morula::calibrate
