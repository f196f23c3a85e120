#include "report/pictures/ticks.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "report/pictures/annotate.h"
#include "report/pictures/camera.h"

namespace morula::scenarios {
namespace {

/// The range with a number at each multiple of the step.
Ticks with_step(double low, double high, double step) {
  Ticks ticks{low, high, {}, {}};
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) {
    ticks.at.push_back(i * step);
    ticks.text.push_back(short_number(i * step, 6));
  }
  return ticks;
}

}  // namespace

Ticks time_ticks(double low, double high, int wanted, const std::string& unit) {
  static constexpr double kHours[] = {0.25, 0.5, 1, 2, 3, 6, 12, 24, 48, 96, 168, 336, 672};
  static constexpr double kMinutes[] = {0.25, 0.5, 1, 2, 5, 10, 15, 20, 30, 60, 120};
  const std::span<const double> steps = unit == "h" ? std::span<const double>(kHours) : std::span<const double>(kMinutes);
  const double raw = (high - low) / std::max(1, wanted);
  if ((unit != "h" && unit != "min") || !(raw >= 0.6 * steps.front()) || raw > steps.back()) return linear_ticks(low, high, wanted, false);
  return with_step(low, high, *std::find_if(steps.begin(), steps.end() - 1, [&](double step) { return step >= raw; }));
}

Ticks linear_ticks(double low, double high, int wanted, bool widen) {
  if (!(high - low > 1e-9 * std::max(std::abs(low), std::abs(high)))) {  // one value, but for its last digits
    const double half = low != 0.0 ? 0.1 * std::abs(low) : 1.0;
    low -= half;
    high += half;
  }
  const double raw = (high - low) / std::max(1, wanted);
  const double step = nice_below(raw * 1.5);
  return widen ? with_step(std::floor(low / step + 1e-9) * step, std::ceil(high / step - 1e-9) * step, step) : with_step(low, high, step);
}

Ticks log_ticks(double low, double high, bool widen) {
  if (!(high > low)) {
    low /= 2.0;
    high *= 2.0;
  }
  Ticks ticks{low, high, {}, {}};
  const double decades = std::log10(high / low);
  std::vector<double> multiples{1.0};
  if (decades < 3.0) multiples = {1.0, 2.0, 5.0};
  const int every = std::max(1, static_cast<int>(decades / 7.0));
  std::vector<double> all;
  const int first = static_cast<int>(std::floor(std::log10(low))), last = static_cast<int>(std::ceil(std::log10(high)));
  for (int k = first; k <= last; ++k)
    for (const double m : multiples)
      if ((k - first) % every == 0) all.push_back(m * std::pow(10.0, k));
  if (widen) {
    for (const double t : all) {
      if (t <= low * (1.0 + 1e-9)) ticks.low = t;
      if (t >= high * (1.0 - 1e-9)) {
        ticks.high = t;
        break;
      }
    }
  }
  for (const double t : all) {
    if (t < ticks.low * (1.0 - 1e-9) || t > ticks.high * (1.0 + 1e-9)) continue;
    ticks.at.push_back(t);
    ticks.text.push_back(short_number(t, 3));
  }
  return ticks;
}

}  // namespace morula::scenarios
