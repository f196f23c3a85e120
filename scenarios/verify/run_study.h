#pragma once
#include <memory>
#include <string>

#include "results/lineage.h"
#include "results/run_record.h"
#include "results/series_reader.h"
#include "results/snapshot.h"

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

/// A study that is run as a user runs it when the first of its numbers is asked for: its text is read, checked and run in a folder of its own, and
/// its results are read back. Nothing is found of a study that is refused or fails, so that its numbers are none.
class StudyToRun {
 public:
  StudyToRun(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {}
  const FoundInRun& found();

 private:
  std::string name_, text_;
  std::unique_ptr<FoundInRun> found_;
};

/// A study of this name without a report; `text`: all but its head.
std::shared_ptr<StudyToRun> study_to_run(const char* name, const std::string& text);

}  // namespace morula::scenarios
