#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/vec3.h"
#include "results/lineage.h"
#include "results/run_record.h"
#include "results/series_reader.h"
#include "results/snapshot.h"
#include "scenarios/library/library.h"

namespace morula::scenarios {

/// What a run left in its folder.
struct FoundInRun {
  std::vector<Snapshot> moments;
  SeriesTable series;
  std::vector<EventLine> events;
  std::vector<CellLife> lives;

  /// The snapshot of a time [s]; null where there is none.
  [[nodiscard]] const Snapshot* at(double time) const;
  /// A column of series.csv at a time; not a number where there is none.
  [[nodiscard]] double column(const char* name, double time) const;
};

/// What a user has in the folder of a study, and how it is run.
struct StudyInFolder {
  std::string text;                      ///< of study.yaml, where there is no library study
  const Template* library = nullptr;     ///< the files, where there is one
  std::string study = "study.yaml";      ///< which of them is run
  std::vector<std::string> overrides{};  ///< `key.path=value`
};

/// A study that is run as a user runs it when the first of its numbers is asked for: its files are written, read, checked and run in a folder of its own, and
/// its results are read back. Nothing is found of a study that is refused or fails, so that its numbers are none.
class StudyToRun {
 public:
  StudyToRun(std::string name, StudyInFolder study) : name_(std::move(name)), study_(std::move(study)) {}
  const FoundInRun& found();

 private:
  std::string name_;
  StudyInFolder study_;
  std::unique_ptr<FoundInRun> found_;
};

/// A study of this name without a report; `text`: all but its head.
std::shared_ptr<StudyToRun> study_to_run(const std::string& name, const std::string& text);
/// A file of a library study with these overrides, without a report, criteria and plots.
std::shared_ptr<StudyToRun> library_study_to_run(const std::string& name, std::string_view library, const std::string& file,
                                                 std::vector<std::string> overrides);
/// Places as the items of a study's `at`, to 1e-6 µm.
std::string list_of_places(std::span<const Vec3d> places);

}  // namespace morula::scenarios
