#pragma once
#include <string>
#include <vector>

namespace morula::scenarios {

/// The range of an axis with the numbers written along it.
struct Ticks {
  double low = 0.0, high = 1.0;
  std::vector<double> at;
  std::vector<std::string> text;
};

/// Linear axis that covers low..high: steps of 1, 2, 5 × 10^k, about `wanted` of them; widened to whole steps where `widen`.
Ticks linear_ticks(double low, double high, int wanted, bool widen);

/// Logarithmic axis that covers low..high (both > 0): powers of ten, with 2 and 5 between where there are few decades.
Ticks log_ticks(double low, double high, bool widen);

}  // namespace morula::scenarios
