#pragma once
#include <chrono>
#include <string>

#include "scenarios/run/cost_model.h"

namespace morula::scenarios {

/// Where a run stands.
struct Progress {
  double time = 0.0, end = 0.0;  ///< simulated [s]
  std::int64_t cells = 0, shells = 0;
  double step = 0.0;  ///< last step [s]
  double wall = 0.0;  ///< since this program began the run [s]
  WallRange left;
};

/// ` 41 % ▕███████▊          ▏ t 39.4 h of 96 h · 1212 cells (87 DCM) · dt 18 s · left 35–50 min`
std::string live_line(const Progress& progress);
/// The same without the bar, for logs.
std::string plain_line(const Progress& progress);
/// Simulated time for people: `39.4 h`, `12 min`, `30 s`.
std::string time_text(double seconds);

/// Says when a plain line is due: each 5 % of the run or each 60 s, whichever comes first.
class PlainPace {
 public:
  bool due(const Progress& progress);

 private:
  int twentieth_ = -1;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace morula::scenarios
