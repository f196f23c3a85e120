#include "scenarios/pictures/ticks.h"

#include <algorithm>
#include <cmath>

#include "scenarios/pictures/annotate.h"
#include "scenarios/pictures/camera.h"

namespace morula::scenarios {

Ticks linear_ticks(double low, double high, int wanted, bool widen) {
  if (!(high > low)) {
    const double half = low != 0.0 ? 0.1 * std::abs(low) : 1.0;
    low -= half;
    high += half;
  }
  const double raw = (high - low) / std::max(1, wanted);
  const double step = nice_below(raw * 1.5);
  Ticks ticks{low, high, {}, {}};
  if (widen) {
    ticks.low = std::floor(low / step + 1e-9) * step;
    ticks.high = std::ceil(high / step - 1e-9) * step;
  }
  for (double i = std::ceil(ticks.low / step - 1e-9); i * step <= ticks.high + 1e-9 * step; ++i) {
    ticks.at.push_back(i * step);
    ticks.text.push_back(short_number(i * step, 6));
  }
  return ticks;
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
