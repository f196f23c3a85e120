#include "scenarios/verify/run_study.h"

#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "results/file_io.h"
#include "scenarios/measures/single_cell.h"
#include "scenarios/run/driver.h"
#include "study/study.h"

namespace morula::scenarios {
namespace {

namespace fs = std::filesystem;

FoundInRun run_text(const std::string& name, const std::string& text) {
  const fs::path folder = fs::temp_directory_path() / ("morula-verify-" + std::to_string(getpid()) + "-" + name);
  FoundInRun out;
  const auto study = read_study_text(name, text, folder);
  if (study.ok()) {
    RunRequest request;
    request.out = folder / "run";
    std::error_code ignored;
    fs::create_directories(folder, ignored);
    if (const auto done = run(*study, request, Comm()); done.ok()) {
      auto moments = all_snapshots(done->path);
      auto series = read_series(done->path / "series.csv");
      auto events = read_file(done->path / "events.jsonl");
      auto lives = read_lineage(done->path / "results.h5", done->path / "events.jsonl");
      if (moments.ok() && series.ok() && events.ok() && lives.ok())
        out = {std::move(*moments), std::move(*series), events_of_lines(*events), std::move(*lives)};
    }
    fs::remove_all(folder, ignored);
  }
  return out;
}

}  // namespace

const Snapshot* FoundInRun::at(double time) const {
  for (const Snapshot& moment : moments)
    if (std::abs(moment.time - time) < 1e-6) return &moment;
  return nullptr;
}

double FoundInRun::column(const char* name, double time) const {
  const SeriesColumn *values = series.find(name), *times = series.find("time");
  for (std::size_t i = 0; values != nullptr && times != nullptr && i < times->values.size(); ++i)
    if (std::abs(times->values[i] - time) < 1e-6) return values->values[i];
  return std::nan("");
}

const FoundInRun& StudyToRun::found() {
  if (!found_) found_ = std::make_unique<FoundInRun>(run_text(name_, text_));
  return *found_;
}

std::shared_ptr<StudyToRun> study_to_run(const char* name, const std::string& text) {
  return std::make_shared<StudyToRun>(name, "schema: 1\nstudy: " + std::string(name) + "\n" + text + "output: {report: false}\n");
}

}  // namespace morula::scenarios
