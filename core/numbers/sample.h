#pragma once
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

}  // namespace morula
