#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "coupling/simulation.h"

namespace morula::scenarios {

/// Work that the time of the stages is divided by.
struct WorkDone {
  std::uint64_t steps = 0;
  double node_steps = 0.0, cell_steps = 0.0;  ///< over all ranks
};

/// Where the time of a run went; seconds are means over the ranks.
struct Timings {
  std::vector<std::pair<std::string, double>> stages;  ///< [s]
  double wall = 0.0;                                   ///< [s]
  WorkDone work;
  double bytes_per_node = 0.0, bytes_per_cell = 0.0;  ///< of the workspaces; by node where there are shells, else by cell
};

/// Collective.
Timings collect_timings(Simulation& simulation, const WorkDone& work, double wall);

/// The table that `run --timings` prints: seconds, share, per step; then ns per node-step and cell-step, bytes per node or cell.
std::string timings_table(const Timings& timings);

/// The same as names and numbers for run.json.
std::vector<std::pair<std::string, double>> timings_record(const Timings& timings);

}  // namespace morula::scenarios
