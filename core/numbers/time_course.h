#pragma once
#include <cstddef>
#include <limits>
#include <vector>

namespace morula {

/// A value over time: straight lines between given points, constant before the first and after the last of them.
struct TimeCourse {
  std::vector<double> time;   ///< increasing [s]
  std::vector<double> value;  ///< as many

  [[nodiscard]] bool empty() const { return time.empty(); }

  /// The value at a time; 1 where no point is given.
  [[nodiscard]] double at(double t) const {
    if (time.empty()) return 1.0;
    if (t <= time.front()) return value.front();
    for (std::size_t i = 1; i < time.size(); ++i)
      if (t < time[i]) return value[i - 1] + (value[i] - value[i - 1]) * (t - time[i - 1]) / (time[i] - time[i - 1]);
    return value.back();
  }

  /// The first of its points after t: steps land there, so that no corner is cut. Infinity when none is left.
  [[nodiscard]] double next_point(double t) const {
    for (const double point : time)
      if (point > t) return point;
    return std::numeric_limits<double>::infinity();
  }
};

}  // namespace morula
