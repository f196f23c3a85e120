#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "scenarios/calibrate/loss.h"

namespace morula::calibrate {

/// What a fit is told.
struct FitOptions {
  double poisson = 0.4;  ///< ν, which is not fitted: the data tell E* alone
  LossWeights weights{};
  int starts = 20;                ///< log-uniform, E 0.05–5 kPa and W 1e-3–1 nN/µm
  int knots = 8;                  ///< of the packing curve, where they are not given
  std::vector<double> packing{};  ///< φ of the knots, the onset first; empty: placed by the data
  std::uint32_t seed = 1;
};

/// JKR and a packing curve, fitted.
struct Fit {
  Parameters parameters;
  double poisson = 0.0;
  LossWeights weights;
  DataScales scales;
  double loss = 0.0;             ///< L at the end
  std::size_t residuals = 0;     ///< number of its terms
  int starts = 0, agreeing = 0;  ///< searches for E and W, and those that ended at the best place within 1e-4
  bool converged = false;
  std::vector<std::string> remarks;  ///< what a reader must know: bounds that were reached, parts without data

  /// How many times the weights' variance the residuals have, L/(terms − parameters), and 1 at least: a law that cannot take the data is known less
  /// well than their weights say, and variances grow by this factor (Birge 1932, Phys. Rev. 40:207).
  [[nodiscard]] double dispersion() const;
  /// E* of two such spheres [kPa].
  [[nodiscard]] double modulus() const;
  /// 1.5 πWR* [nN].
  [[nodiscard]] double pull_off(double reduced_radius) const;
};

/// Fits E and W to pairs (many starts), then the packing curve to packings with E and W as they are, then all together. Data without packings give
/// a fit without a curve. Errors (kInput): no pair point to fit, fewer than three of them, values that are not numbers, radii that are not
/// positive, knots that do not increase.
Result<Fit> fit(const Data& data, const FitOptions& options);

/// From the parameters of another fit, all together and from there alone: for the bootstrap. Scales and weights are that fit's.
[[nodiscard]] Fit fit_again(const Data& data, const Fit& from);

/// The loss of a fit's data as it was minimised last, for covariance and profiles.
[[nodiscard]] LeastSquares loss_of(const Data& data, const Fit& fit);

}  // namespace morula::calibrate
