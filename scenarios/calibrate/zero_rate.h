#pragma once
#include <span>

#include "core/result.h"

namespace morula::calibrate {

/// A quantity at one rate of the experiment.
struct RateSample {
  double rate = 0.0;  ///< > 0
  double value = 0.0;
};

/// Largest quadratic part, relative to the scale, with which a line through the two slowest rates counts as straight.
inline constexpr double kStraightEnough = 0.02;

/// A quantity at rest, from runs at several rates.
struct AtRest {
  double value = 0.0;      ///< F_0 of F = F_0 + b v through the two slowest rates
  double slope = 0.0;      ///< b
  double remainder = 0.0;  ///< |F_0 − F_0 of the parabola through the three slowest| over the scale; infinite with two rates
  bool straight = false;   ///< remainder < 2 %
};

/// Extrapolates to no rate. The samples belong to one value of what the experiment controls, in any order; the scale is that of the curve as a
/// whole (the largest force of it), so that a value near 0 asks for nothing special. Errors (kInput): fewer than two rates, two rates alike,
/// rates that are not positive, values that are not numbers, a scale that is not positive.
Result<AtRest> to_zero_rate(std::span<const RateSample> samples, double scale);

}  // namespace morula::calibrate
