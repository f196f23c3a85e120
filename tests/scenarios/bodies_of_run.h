#pragma once
#include <map>
#include <string>

#include "tests/scenarios/snapshots_of_run.h"

namespace morula::scenarios::test {

/// The user's road: runs a study, and reads from its results what body each cell has in each snapshot, by time [s].
inline std::map<double, std::map<CellId, BodyKind>> bodies_of_run(const std::string& text) {
  std::map<double, std::map<CellId, BodyKind>> out;
  for (const auto& [time, snapshot] : snapshots_of_run(text))
    for (const Snapshot::Cell& cell : snapshot.cells) out[time][cell.id] = cell.body;
  return out;
}

}  // namespace morula::scenarios::test
