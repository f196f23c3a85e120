#pragma once
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/numbers/time_course.h"
#include "core/result.h"
#include "results/run_record.h"
#include "results/series_reader.h"
#include "results/snapshot.h"
#include "study/study.h"

namespace morula::scenarios {

/// Which outputs of a run are looked at.
struct Moments {
  enum class Kind { kStart, kEnd, kBetween, kHolds } kind = Kind::kEnd;
  double from = 0.0, until = 0.0;  ///< of kBetween and kHolds; the same for a single moment [s]
  TimeCourse course{};             ///< of kHolds: the last outputs of the times in which it rests

  /// Whether it is a single output, whatever the run.
  [[nodiscard]] bool is_one() const { return kind == Kind::kStart || kind == Kind::kEnd || (kind == Kind::kBetween && from == until); }
  /// The numbers of those among increasing times [s].
  [[nodiscard]] std::vector<std::size_t> among(const std::vector<double>& times) const;
};

/// The folder of a run that has ended, as measures look at it: series.csv and the snapshots of results.h5. A file is read when it is first
/// asked for; of the snapshots only the last few are kept, for those of a large tissue do not all have room.
class FinishedRun {
 public:
  FinishedRun(const Study& study, std::filesystem::path folder) : study_(study), folder_(std::move(folder)) {}

  [[nodiscard]] const Study& study() const { return study_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// kFile where the file is missing or damaged; so do the others.
  Result<const SeriesTable*> series();
  Result<const std::vector<double>*> snapshot_times();
  /// `index` as in snapshot_times(). A tissue that lies on one side of a periodic domain is in one piece, across a face or not: its cells are at their images
  /// nearest to its middle.
  Result<std::shared_ptr<const Snapshot>> snapshot(std::size_t index);
  /// The snapshot of time 0; null where there is none: a run that goes on from another begins later.
  Result<std::shared_ptr<const Snapshot>> start() { return snapshot_at(0.0); }
  /// The snapshot of a time [s]; null where there is none.
  Result<std::shared_ptr<const Snapshot>> snapshot_at(double time);
  /// Those of events.jsonl; lines that are not whole are left out.
  Result<const std::vector<EventLine>*> events();

 private:
  const Study& study_;
  std::filesystem::path folder_;
  std::optional<SeriesTable> series_;
  std::optional<std::vector<double>> times_;
  std::optional<std::vector<EventLine>> events_;
  std::deque<std::pair<std::size_t, std::shared_ptr<const Snapshot>>> kept_;
};

}  // namespace morula::scenarios
