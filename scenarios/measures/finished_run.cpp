#include "scenarios/measures/finished_run.h"

#include <algorithm>
#include <cmath>

#include "coupling/tissue_middle.h"
#include "results/file_io.h"
#include "results/run_files.h"
#include "results/snapshot_file.h"
#include "scenarios/measures/holds.h"

namespace morula::scenarios {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kKept = 4;    // snapshots
constexpr double kSameTime = 1e-6;  // two times that differ by less are one output; relative beyond a second

/// Moves the cells of a tissue that is on one side of a periodic domain to their images nearest to its middle.
void bring_together(Snapshot& snapshot, Space space) {
  constexpr double kOneSide = 0.5;  // of tissue_middle(): cells all around the domain have no middle
  if (!space.any_periodic() || snapshot.cells.empty()) return;
  if (snapshot.box.size().x > 0.0) space.box = snapshot.box;
  std::vector<Vec3d> center;
  std::vector<double> volume;
  for (const Snapshot::Cell& cell : snapshot.cells) center.push_back(cell.centroid), volume.push_back(cell.volume);
  const TissueMiddle middle = tissue_middle(space, center, volume, Comm());
  for (int axis = 0; axis < 3; ++axis)
    if (middle.directed[axis] < kOneSide) space.boundary[static_cast<std::size_t>(axis)].fill(BoundaryKind::kOpen);
  std::vector<Vec3d> shift(center.size());
  const Vec3d edges = space.box.size();
  for (std::size_t i = 0; i < center.size(); ++i) {
    const Vec3d from = center[i] - middle.at, way = space.nearest_image(from) - from;
    shift[i] = {edges.x * std::round(way.x / edges.x), edges.y * std::round(way.y / edges.y), edges.z * std::round(way.z / edges.z)};
    snapshot.cells[i].centroid += shift[i];
  }
  const auto move = [&](const std::vector<Snapshot::Shell>& shells, std::vector<Vec3d>& nodes) {
    for (const Snapshot::Shell& shell : shells)
      for (Vec3d& x : std::span(nodes).subspan(shell.first_node, shell.node_count)) x += shift[shell.cell];
  };
  move(snapshot.shells, snapshot.nodes);
  move(snapshot.nuclear_shells, snapshot.nuclear_nodes);
  for (Snapshot::Nucleus& nucleus : snapshot.nuclei) nucleus.center += shift[nucleus.cell];
}

}  // namespace

std::vector<std::size_t> Moments::among(const std::vector<double>& times) const {
  std::vector<std::size_t> out;
  if (times.empty()) return out;
  if (kind == Kind::kStart) return times.front() == 0.0 ? std::vector<std::size_t>{0} : out;
  if (kind == Kind::kEnd) return {times.size() - 1};
  if (kind == Kind::kHolds) {
    for (const Hold& hold : holds_of(course, times))
      if (hold.time >= from && hold.time <= until) out.push_back(hold.output);
    return out;
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double slack = kSameTime * std::max(1.0, times[i]);
    if (times[i] >= from - slack && times[i] <= until + slack) out.push_back(i);
  }
  return out;
}

Result<const SeriesTable*> FinishedRun::series() {
  if (!series_) {
    MORULA_TRY_ASSIGN(SeriesTable read, read_series(RunFiles(folder_).series()));
    series_ = std::move(read);
  }
  return &*series_;
}

Result<const std::vector<EventLine>*> FinishedRun::events() {
  if (!events_) {
    const fs::path file = RunFiles(folder_).events();
    std::string lines;
    if (fs::exists(file)) {  // else nothing has happened
      MORULA_TRY_ASSIGN(lines, read_file(file));
    }
    events_ = events_of_lines(lines);
  }
  return &*events_;
}

Result<const std::vector<double>*> FinishedRun::snapshot_times() {
  if (!times_) {
    MORULA_TRY_ASSIGN(const auto entries, list_snapshots(RunFiles(folder_).results()));
    times_.emplace();
    for (const SnapshotEntry& entry : entries) times_->push_back(entry.time);
  }
  return &*times_;
}

Result<std::shared_ptr<const Snapshot>> FinishedRun::snapshot(std::size_t index) {
  for (const auto& [number, one] : kept_)
    if (number == index) return one;
  MORULA_TRY_ASSIGN(Snapshot read, read_snapshot(RunFiles(folder_).results(), index));
  bring_together(read, study_.model.space);
  if (kept_.size() == kKept) kept_.pop_front();
  kept_.emplace_back(index, std::make_shared<const Snapshot>(std::move(read)));
  return kept_.back().second;
}

Result<std::shared_ptr<const Snapshot>> FinishedRun::snapshot_at(double time) {
  MORULA_TRY_ASSIGN(const std::vector<double>* const times, snapshot_times());
  const auto found = Moments{Moments::Kind::kBetween, time, time}.among(*times);
  if (found.empty()) return std::shared_ptr<const Snapshot>();
  return snapshot(found.front());
}

}  // namespace morula::scenarios
