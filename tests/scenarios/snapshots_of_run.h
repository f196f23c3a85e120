#pragma once
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "results/snapshot_file.h"
#include "tests/scenarios/run_into.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {

/// A snapshot and its time [s].
struct Moment {
  double time = 0.0;
  Snapshot snapshot;
};

/// The user's road: runs a study, and reads all its snapshots from its results; none where something failed, which is told.
inline std::vector<Moment> snapshots_of_run(const std::string& text) {
  const Folder folder;
  const auto study = read(text);
  EXPECT_TRUE(study.ok()) << study.error().text();
  if (!study.ok() || !run_into(folder.path() / "run", *study)) return {};
  const auto entries = list_snapshots(folder.path() / "run/results.h5");
  auto snapshots = read_snapshots(folder.path() / "run/results.h5");
  EXPECT_TRUE(entries.ok() && snapshots.ok());
  if (!entries.ok() || !snapshots.ok()) return {};
  std::vector<Moment> out;
  for (const auto& entry : *entries) out.push_back({entry.time, std::move((*snapshots)[entry.index])});
  return out;
}

/// A place as studies write it [µm], or another vector in its unit.
inline std::string place_text(const Vec3d& x, const std::string& unit = "um") {
  return "[" + std::to_string(x.x) + " " + unit + ", " + std::to_string(x.y) + " " + unit + ", " + std::to_string(x.z) + " " + unit + "]";
}

}  // namespace morula::scenarios::test
