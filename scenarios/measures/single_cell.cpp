#include "scenarios/measures/single_cell.h"

#include <numbers>

#include "results/snapshot_file.h"

namespace morula::scenarios {

Result<std::vector<Snapshot>> all_snapshots(const std::filesystem::path& run) {
  const auto file = run / "results.h5";
  MORULA_TRY_ASSIGN(const auto entries, list_snapshots(file));
  if (entries.empty()) return Error{ErrorKind::kFile, "'" + file.string() + "' holds no snapshot", ""};
  std::vector<Snapshot> out;
  for (const auto& entry : entries) {
    MORULA_TRY_ASSIGN(Snapshot snapshot, read_snapshot(file, entry.index));
    out.push_back(std::move(snapshot));
  }
  return out;
}

std::vector<Hold> holds_of(const TimeCourse& course, const std::vector<Snapshot>& snapshots) {
  std::vector<double> times;
  for (const Snapshot& snapshot : snapshots) times.push_back(snapshot.time);
  return holds_of(course, times);
}

std::vector<Hold> holds_of(const TimeCourse& course, const std::vector<double>& times) {
  std::vector<Hold> out;
  const auto add = [&](double value, double from, double until) {
    for (std::size_t i = times.size(); i-- > 0;) {
      if (times[i] > until * (1.0 + 1e-12)) continue;
      if (times[i] > from) out.push_back({value, times[i], i});
      return;
    }
  };
  if (course.empty()) {
    add(1.0, 0.0, kNever);
    return out;
  }
  for (std::size_t i = 1; i < course.time.size(); ++i)
    if (course.value[i] == course.value[i - 1]) add(course.value[i], course.time[i - 1], course.time[i]);
  add(course.value.back(), course.time.back(), kNever);
  return out;
}

double spring_modulus(const CellType& type) { return 2.0 / std::numbers::sqrt3 * type.shell.spring_stiffness; }

bool is_fluid(double modulus) { return modulus <= 0.1; }

}  // namespace morula::scenarios
