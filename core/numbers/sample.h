#pragma once
#include <cmath>
#include <limits>
#include <span>

namespace morula {

/// Mean of a sample; no number of none.
inline double mean_of_sample(std::span<const double> values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(values.size());
}

/// Variance of what a sample was drawn from, over n − 1; no number of less than two values [as the values, squared].
inline double variance_of_sample(std::span<const double> values) {
  if (values.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  const double mean = mean_of_sample(values);
  double sum = 0.0;
  for (const double v : values) sum += (v - mean) * (v - mean);
  return sum / static_cast<double>(values.size() - 1);
}

/// A spread or an error, 0 where it is nothing but the rounding of the value that it belongs to: as it is told, not as it is judged.
inline double told_spread(double spread, double value) {
  constexpr double kRounding = 1e-9;  // part of the value
  return spread < kRounding * std::abs(value) ? 0.0 : spread;
}

}  // namespace morula
