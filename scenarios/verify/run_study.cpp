#include "scenarios/verify/run_study.h"

#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "core/numbers/number_text.h"
#include "results/file_io.h"
#include "results/run_files.h"
#include "scenarios/measures/single_cell.h"
#include "scenarios/run/driver.h"
#include "study/study.h"

namespace morula::scenarios {
namespace {

namespace fs = std::filesystem;

FoundInRun found_in(const fs::path& run) {
  auto moments = all_snapshots(run);
  auto series = read_series(RunFiles(run).series());
  auto events = read_file(RunFiles(run).events());
  auto lives = read_lineage(RunFiles(run).results(), RunFiles(run).events());
  if (!moments.ok() || !series.ok() || !events.ok() || !lives.ok()) return {};
  return {std::move(*moments), std::move(*series), events_of_lines(*events), std::move(*lives)};
}

FoundInRun run_in_folder(const fs::path& folder, const StudyInFolder& given) {
  const TemplateFile alone[] = {{"study.yaml", given.text}};
  if (!write_files(given.library != nullptr ? given.library->files : alone, folder).ok()) return {};
  ReadOptions options;
  options.overrides = given.overrides;
  const auto study = read_study(folder / given.study, options);
  if (!study.ok()) return {};
  RunRequest request;
  request.out = folder / "run";
  const auto done = run(*study, request, Comm());
  return done.ok() ? found_in(done->path) : FoundInRun{};
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
  if (found_) return *found_;
  const fs::path folder = fs::temp_directory_path() / ("morula-verify-" + std::to_string(getpid()) + "-" + name_);
  found_ = std::make_unique<FoundInRun>(run_in_folder(folder, study_));
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  return *found_;
}

std::shared_ptr<StudyToRun> study_to_run(const std::string& name, const std::string& text) {
  return std::make_shared<StudyToRun>(name, StudyInFolder{.text = "schema: 1\nstudy: " + name + "\n" + text + "output: {report: false}\n"});
}

std::shared_ptr<StudyToRun> library_study_to_run(const std::string& name, std::string_view library, const std::string& file,
                                                 std::vector<std::string> overrides) {
  StudyInFolder study{.text = "", .library = find_template(library), .study = file, .overrides = std::move(overrides)};
  for (const char* without : {"output.report=false", "criteria=[]", "plots=[]"}) study.overrides.emplace_back(without);
  return std::make_shared<StudyToRun>(name, std::move(study));
}

std::string list_of_places(std::span<const Vec3d> places) {
  std::string out;
  for (const Vec3d& at : places) {
    out += out.empty() ? "[" : ", [";
    for (int k = 0; k < 3; ++k) out += number_text("%.6f", at[k]) + (k < 2 ? " um, " : " um]");
  }
  return out;
}

}  // namespace morula::scenarios
