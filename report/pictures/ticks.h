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

/// Linear axis of a time in `unit` (h, min): steps that clocks have, 6 h and 15 min rather than 5 h and 20 min; other units as
/// linear_ticks.
Ticks time_ticks(double low, double high, int wanted, const std::string& unit);

/// Logarithmic axis that covers low..high (both > 0): powers of ten, with 2 and 5 between where there are few decades.
Ticks log_ticks(double low, double high, bool widen);

}  // namespace morula::scenarios
