#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

namespace morula::scenarios {

/// Value of a piecewise linear curve at x; NaN outside of it. xs increasing. An x that is beyond an end by rounding only is at the end.
inline double interpolated(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  if (xs.empty()) return std::nan("");
  const double slack = 1e-12 * std::max(std::abs(xs.front()), std::abs(xs.back()));
  if (std::abs(x - xs.front()) <= slack) return ys.front();
  if (std::abs(x - xs.back()) <= slack) return ys.back();
  for (std::size_t i = 1; i < std::min(xs.size(), ys.size()); ++i)
    if (x >= xs[i - 1] && x <= xs[i])
      return xs[i] == xs[i - 1] ? ys[i] : ys[i - 1] + (ys[i] - ys[i - 1]) * (x - xs[i - 1]) / (xs[i] - xs[i - 1]);
  return std::nan("");
}

}  // namespace morula::scenarios
