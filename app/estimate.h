#pragma once
#include <cstdint>
#include <string>

#include "scenarios/study/study.h"

namespace morula::app {

/// Size, memory and time of a run before it is run; a range where it cannot be known.
struct Estimate {
  double cells_start = 0.0, cells_end = 0.0;    ///< the latter if nothing inhibits growth and nothing dies
  double shells_start = 0.0, shells_end = 0.0;
  double nodes_end = 0.0, voxels = 0.0;
  double memory = 0.0;                          ///< at the end, over all ranks [B]
  double cpu_low = 0.0, cpu_high = 0.0;         ///< CPU time [s]
};

/// From the study alone, without placing a cell. Shells of a filled shape are counted by the part of the shape that lies in regions of
/// shells. Cells double once a cycle duration at most. CPU time: by node-hour and cell-step, with the spread of the measured benchmarks.
[[nodiscard]] Estimate estimate(const scenarios::Study& study);

/// A few lines for people.
[[nodiscard]] std::string estimate_text(const scenarios::Study& study, int ranks);

}  // namespace morula::app
