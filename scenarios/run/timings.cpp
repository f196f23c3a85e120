#include "scenarios/run/timings.h"

#include <algorithm>
#include <cstdio>

namespace morula::scenarios {

Timings collect_timings(Simulation& simulation, const WorkDone& work, double wall) {
  const Comm& comm = simulation.comm();
  const auto mean = [&](double mine) {
    OrderFreeSum sum;
    sum.add(mine);
    return comm.sum(sum) / comm.size();
  };
  Timings out;
  for (std::size_t s = 0; s < kStageNames.size(); ++s)
    out.stages.emplace_back(std::string(kStageNames[s]), mean(simulation.timer().seconds(static_cast<Stage>(s))));
  out.wall = wall;
  out.work = work;
  const auto bytes = static_cast<double>(comm.sum(static_cast<std::int64_t>(simulation.mechanics().memory())));
  const auto nodes = static_cast<double>(comm.sum(static_cast<std::int64_t>(simulation.tissue().shells.node_count())));
  const auto cells = static_cast<double>(comm.sum(static_cast<std::int64_t>(simulation.tissue().cells.size())));
  if (nodes > 0.0)
    out.bytes_per_node = bytes / nodes;
  else if (cells > 0.0)
    out.bytes_per_cell = bytes / cells;
  return out;
}

std::string timings_table(const Timings& t) {
  char line[160];
  std::string out = "stage               seconds   share   ms per step\n";
  const double steps = static_cast<double>(std::max<std::uint64_t>(t.work.steps, 1));
  double sum = 0.0;
  const auto row = [&](const std::string& name, double seconds) {
    std::snprintf(line, sizeof line, "%-18s %8.2f  %5.1f %%  %11.3f\n", name.c_str(), seconds,
                  t.wall > 0.0 ? 100.0 * seconds / t.wall : 0.0, 1e3 * seconds / steps);
    out += line;
  };
  for (const auto& [name, seconds] : t.stages) {
    row(name, seconds);
    sum += seconds;
  }
  row("other", std::max(0.0, t.wall - sum));
  row("all", t.wall);
  std::snprintf(line, sizeof line, "%llu steps", static_cast<unsigned long long>(t.work.steps));
  out += line;
  const auto add = [&](double value, const char* unit) {
    if (value <= 0.0) return;
    std::snprintf(line, sizeof line, " · %.4g %s", value, unit);
    out += line;
  };
  if (t.work.node_steps > 0.0) add(1e9 * t.wall / t.work.node_steps, "ns per node-step");
  if (t.work.cell_steps > 0.0) add(1e9 * t.wall / t.work.cell_steps, "ns per cell-step");
  add(t.bytes_per_node, "bytes per node");
  add(t.bytes_per_cell, "bytes per cell");
  return out + '\n';
}

std::vector<std::pair<std::string, double>> timings_record(const Timings& t) {
  std::vector<std::pair<std::string, double>> out;
  for (const auto& [name, seconds] : t.stages) out.emplace_back(name + " [s]", seconds);
  out.emplace_back("wall [s]", t.wall);
  out.emplace_back("steps", static_cast<double>(t.work.steps));
  out.emplace_back("node steps", t.work.node_steps);
  out.emplace_back("cell steps", t.work.cell_steps);
  if (t.bytes_per_node > 0.0) out.emplace_back("bytes per node", t.bytes_per_node);
  if (t.bytes_per_cell > 0.0) out.emplace_back("bytes per cell", t.bytes_per_cell);
  return out;
}

}  // namespace morula::scenarios
