#pragma once
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "results/snapshot_file.h"
#include "tests/scenarios/run_into.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {

/// The user's road: runs a study, and reads from its results what body each cell has in each snapshot, by time [s].
inline std::map<double, std::map<CellId, BodyKind>> bodies_of_run(const std::string& text) {
  std::map<double, std::map<CellId, BodyKind>> out;
  const Folder folder;
  const auto study = read(text);
  EXPECT_TRUE(study.ok()) << study.error().text();
  if (!study.ok() || !run_into(folder.path() / "run", *study)) return out;
  const auto entries = list_snapshots(folder.path() / "run/results.h5");
  EXPECT_TRUE(entries.ok());
  if (!entries.ok()) return out;
  for (const auto& entry : *entries) {
    const auto snapshot = read_snapshot(folder.path() / "run/results.h5", entry.index);
    EXPECT_TRUE(snapshot.ok());
    if (!snapshot.ok()) return out;
    for (const Snapshot::Cell& cell : snapshot->cells) out[entry.time][cell.id] = cell.body;
  }
  return out;
}

}  // namespace morula::scenarios::test
