#include "scenarios/compare/run_group.h"

#include <algorithm>
#include <set>

#include "results/file_io.h"
#include "results/run_folder.h"

namespace morula::scenarios {
namespace fs = std::filesystem;
namespace {

Error wrong(std::string what, std::string help) { return {ErrorKind::kInput, std::move(what), std::move(help)}; }

Result<ComparedRun> read_run(const std::string& given) {
  MORULA_TRY_ASSIGN(const RunFolder folder, RunFolder::open(given, Comm()));
  ComparedRun run;
  run.path = folder.path();
  MORULA_TRY_ASSIGN(run.record, read_run_record(folder.record()));
  std::error_code missing;
  if (!fs::exists(folder.series(), missing))
    return wrong("'" + given + "' has no series.csv: there is nothing to compare", "runs that ended before their first output have none");
  MORULA_TRY_ASSIGN(run.series, read_series(folder.series()));
  if (run.series.rows() == 0 || run.series.find("time") == nullptr)
    return wrong("series.csv of '" + given + "' has no rows: there is nothing to compare", "wait for the first output of the run");
  MORULA_TRY_ASSIGN(const std::string resolved, read_file(folder.resolved_study()));
  MORULA_TRY_ASSIGN(run.settings, settings_of(resolved, folder.resolved_study().string()));
  return run;
}

/// The same study, whatever the seed.
bool belong_together(const ComparedRun& a, const ComparedRun& b) {
  return differing_paths({&a.settings, &b.settings}, kNotTheStudy).empty();
}

/// `NAME=RUN,RUN` in its parts; a name of a folder that is there is no such thing.
bool is_named(const std::string& given) {
  std::error_code error;
  return given.find('=') != std::string::npos && !fs::exists(given, error);
}

std::vector<std::string> parted(const std::string& list) {
  std::vector<std::string> out(1);
  for (const char c : list) {
    if (c == ',')
      out.emplace_back();
    else
      out.back() += c;
  }
  return out;
}

Result<RunGroup> named_group(const std::string& given) {
  const std::size_t equals = given.find('=');
  RunGroup group{given.substr(0, equals), {}};
  if (group.name.empty()) return wrong("'" + given + "' names a group without a name", "write NAME=RUN,RUN");
  for (const std::string& path : parted(given.substr(equals + 1))) {
    if (path.empty()) return wrong("group '" + group.name + "' has a run without a name", "write NAME=RUN,RUN without blanks");
    MORULA_TRY_ASSIGN(ComparedRun run, read_run(path));
    if (!group.runs.empty() && !belong_together(group.runs.front(), run)) {
      const auto paths = differing_paths({&group.runs.front().settings, &run.settings}, kNotTheStudy);
      return wrong("runs of group '" + group.name + "' differ in more than their seeds: `" + paths.front() + "` is '" +
                       setting(group.runs.front().settings, paths.front()) + "' in " + group.runs.front().path.string() + " and '" +
                       setting(run.settings, paths.front()) + "' in " + path,
                   "make two groups");
    }
    group.runs.push_back(std::move(run));
  }
  return group;
}

Status check_group(const RunGroup& group) {
  std::set<std::uint64_t> seeds;
  for (const ComparedRun& run : group.runs)
    if (!seeds.insert(run.record.seed).second)
      return wrong("two runs of group '" + group.name + "' have the seed " + std::to_string(run.record.seed) +
                       ": what they have in common says nothing about the spread",
                   "give each run of a group its own seed: `morula run study.yaml --seed 2`");
  return {};
}

Status check_groups(const std::vector<RunGroup>& groups) {
  std::set<fs::path> paths;
  std::set<std::string> names;
  for (const RunGroup& group : groups) {
    if (!names.insert(group.name).second)
      return wrong("two groups are called '" + group.name + "'", "give each its own name: NAME=RUN,RUN");
    for (const ComparedRun& run : group.runs) {
      std::error_code error;
      if (!paths.insert(fs::weakly_canonical(run.path, error)).second)
        return wrong("'" + run.path.string() + "' is given twice", "a run differs from itself in nothing");
    }
  }
  for (const RunGroup& group : groups) MORULA_TRY(check_group(group));
  if (groups.size() < 2)
    return wrong("there is one group of runs only; a comparison needs two",
                 groups.empty() || groups.front().runs.size() < 2
                     ? "`morula compare RUN RUN`"
                     : "these runs differ in nothing but the seed; name groups to compare them all the same: `a=RUN b=RUN`");
  return {};
}

}  // namespace

Result<std::vector<RunGroup>> read_groups(const std::vector<std::string>& given) {
  std::vector<RunGroup> groups;
  std::vector<char> grows;  // a group of single runs, to which others of its study belong
  for (const std::string& one : given) {
    if (is_named(one)) {
      MORULA_TRY_ASSIGN(RunGroup group, named_group(one));
      groups.push_back(std::move(group));
      grows.push_back(0);
      continue;
    }
    MORULA_TRY_ASSIGN(ComparedRun run, read_run(one));
    std::size_t g = 0;
    while (g < groups.size() && (grows[g] == 0 || !belong_together(groups[g].runs.front(), run))) ++g;
    if (g == groups.size()) {
      groups.push_back({run.path.filename().string(), {}});
      grows.push_back(1);
    }
    groups[g].runs.push_back(std::move(run));
  }
  MORULA_TRY(check_groups(groups));
  return groups;
}

}  // namespace morula::scenarios
