#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "results/run_record.h"
#include "results/series_reader.h"
#include "scenarios/compare/settings.h"

namespace morula::scenarios {

/// Keys of a study that say nothing of the tissue: runs of one group may differ in them.
inline const std::vector<std::string> kNotTheStudy{"seed", "title"};

/// A run as a comparison looks at it.
struct ComparedRun {
  std::filesystem::path path;
  RunRecord record;
  SeriesTable series;
  Settings settings;
};

/// Runs of one study that differ in their seeds alone.
struct RunGroup {
  std::string name;
  std::vector<ComparedRun> runs;
};

/// Groups as a user names them: `NAME=RUN,RUN` is one group; single runs make up the others, those of one study with several seeds together, and a group of
/// these has the name of its first run. In the order in which they are given. kFile: a folder is no run, or is damaged; kInput: less than two groups, a run or a
/// name twice, a seed twice in one group, runs of one group that differ in more than the seed, a run without results.
Result<std::vector<RunGroup>> read_groups(const std::vector<std::string>& given);

}  // namespace morula::scenarios
