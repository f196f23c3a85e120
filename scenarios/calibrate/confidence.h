#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "scenarios/calibrate/fit.h"

namespace morula::calibrate {

/// A range of a parameter; the data do not bound it on a side that is infinite (or 0, of a parameter that is positive).
struct Interval {
  double low = 0.0, high = 0.0;
};

/// Covariance of the logarithms of E, W and the increments of p_c (Gauss–Newton, (JᵀJ)⁻¹ of the residuals at the best fit, times Fit::dispersion()). A direction that the
/// residuals do not see has an infinite variance; an increment at its lower bound is left out (variance 0).
struct Covariance {
  std::vector<std::vector<double>> matrix;
  double young_error = 0.0, adhesion_error = 0.0;  ///< relative standard errors of E and W
  double correlation = 0.0;                        ///< of E and W
};
[[nodiscard]] Covariance covariance(const Data& data, const Fit& fit);

/// Largest loss above the least one of a 95 % interval of one parameter: χ²(0.95; 1) times Fit::dispersion().
[[nodiscard]] double profile_rise(const Fit& fit);

/// The loss along one parameter, all others at their best for each of its values.
struct Profile {
  struct Point {
    double value = 0.0, loss = 0.0;
  };
  Interval interval;           ///< 95 %; infinite or 0 where the loss stays below the limit up to the bounds of the search
  std::vector<Point> points;   ///< in the order of the values, for a figure
  std::vector<double> better;  ///< logarithms of a place with a lower loss than the fit, if the walk met one; else empty
};
/// Of E (0) or W (1).
[[nodiscard]] Profile profile(const Data& data, const Fit& fit, int parameter);

/// Block bootstrap: experiments drawn with replacement, those of pairs, of packings and of clusters each among themselves, and fitted from the best fit.
struct Bootstrap {
  int samples = 0;
  std::vector<std::vector<double>> logarithms;  ///< of each sample
  Interval young, adhesion;                     ///< from the 2.5th to the 97.5th percentile
  std::vector<Interval> pressure;               ///< of the knots [kPa]
  bool possible = false;                        ///< false: a single experiment of pairs cannot be drawn from
};
[[nodiscard]] Bootstrap bootstrap(const Data& data, const Fit& fit, int samples, std::uint32_t seed);

/// The fit with all that is known about how sure it is. A profile that meets a lower loss moves the fit there, and begins anew.
struct SureFit {
  Fit fit;
  Covariance covariance;
  Profile young, adhesion;
  Bootstrap bootstrap;
};
Result<SureFit> fit_with_confidence(const Data& data, const FitOptions& options, int samples = 200);

}  // namespace morula::calibrate
