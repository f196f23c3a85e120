#include "scenarios/experiments/found_curves.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/ball.h"
#include "results/run_files.h"
#include "results/series_reader.h"
#include "scenarios/measures/single_cell.h"

namespace morula::scenarios {
namespace {

Result<const SeriesColumn*> column(const SeriesTable& series, const char* name) {
  const SeriesColumn* out = series.find(name);
  if (out == nullptr)
    return Error{ErrorKind::kFile, std::string("series.csv has no column '") + name + "'", "the run is of another version"};
  return out;
}

}  // namespace

Result<std::vector<FoundPair>> pair_of_run(const Experiment& experiment, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto moments, all_snapshots(run));
  MORULA_TRY_ASSIGN(const auto series, read_series(RunFiles(run).series()));
  MORULA_TRY_ASSIGN(const SeriesColumn* times, column(series, "time"));
  MORULA_TRY_ASSIGN(const SeriesColumn* low, column(series, "grip_z_on_low"));
  MORULA_TRY_ASSIGN(const SeriesColumn* high, column(series, "grip_z_on_high"));
  std::vector<FoundPair> out;
  for (std::size_t i = 0; i < std::min(moments.size(), times->values.size()); ++i) {
    const Snapshot& moment = moments[i];
    if (moment.cells.size() != 2) return Error{ErrorKind::kFile, "a pair of '" + run.string() + "' has not two cells", ""};
    const double area = 0.5 * (moment.cells[0].contact_area + moment.cells[1].contact_area);
    out.push_back({.time = moment.time,
                   .overlap = experiment.radius_a + experiment.radius_b - norm(moment.cells[1].centroid - moment.cells[0].centroid),
                   .force = 0.5 * (low->values[i] - high->values[i]),
                   .area = area,
                   .touching = area > 0.0});
  }
  return out;
}

Result<calibrate::Relaxation> relaxation_of_run(const Experiment& experiment, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto moments, all_snapshots(run));
  calibrate::Relaxation out{.radius = experiment.radius_a,
                            .medium_friction = drag_of(experiment.friction, experiment.radius_a),
                            .contact_friction = experiment.friction.approach,
                            .time = {},
                            .overlap = {}};
  for (const Snapshot& moment : moments) {
    if (moment.cells.size() != 2) return Error{ErrorKind::kFile, "a pair of '" + run.string() + "' has not two cells", ""};
    out.time.push_back(moment.time);
    out.overlap.push_back(experiment.radius_a + experiment.radius_b - norm(moment.cells[1].centroid - moment.cells[0].centroid));
  }
  return out;
}

double FoundCluster::distance(std::span<const Vec3d> of) const {
  double sum = 0.0, pairs = 0.0;
  for (std::size_t i = 0; i < centers.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (norm(centers[i] - centers[j]) < 2.0 * radius) sum += norm(of[i] - of[j]), pairs += 1.0;
  return pairs > 0.0 ? sum / pairs : 2.0 * radius;
}

Result<FoundCluster> cluster_of_run(const Experiment& experiment, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto moments, all_snapshots(run));
  FoundCluster out{.radius = experiment.radius_a, .held_out = experiment.held_out, .centers = {}};
  if (moments.size() < 2) return Error{ErrorKind::kFile, "the cluster of '" + run.string() + "' has no end", ""};
  const auto& before = moments[moments.size() - 2].cells;
  for (std::size_t i = 0; i < moments.back().cells.size(); ++i) {
    out.centers.push_back(moments.back().cells[i].centroid);
    if (i < before.size()) out.still = std::max(out.still, norm(out.centers.back() - before[i].centroid));
  }
  return out;
}

Result<calibrate::PressedCluster> pressed_of_run(const Experiment& experiment, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto series, read_series(RunFiles(run).series()));
  MORULA_TRY_ASSIGN(const SeriesColumn* times, column(series, "time"));
  MORULA_TRY_ASSIGN(const SeriesColumn* lower, column(series, "force_z_lower"));
  MORULA_TRY_ASSIGN(const SeriesColumn* upper, column(series, "force_z_upper"));
  std::vector<double> part, force;
  for (std::size_t i = 0; i < series.rows(); ++i) {
    const double after = (times->values[i] - experiment.turn) / experiment.pressing;
    if (after < -1e-9) continue;  // the cells adhere to each other
    part.push_back(after);
    force.push_back(0.5 * (std::abs(lower->values[i]) + std::abs(upper->values[i])));
  }
  if (part.size() < 2) return Error{ErrorKind::kFile, "the plates of '" + run.string() + "' have no way", ""};
  return calibrate::pressed_cluster(std::move(part), force, experiment.way);
}

Result<std::vector<FoundPacking>> packing_of_run(const Experiment& experiment, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const auto series, read_series(RunFiles(run).series()));
  MORULA_TRY_ASSIGN(const SeriesColumn* volume, column(series, "box_volume"));
  MORULA_TRY_ASSIGN(const SeriesColumn* pressure, column(series, "box_pressure"));
  MORULA_TRY_ASSIGN(const SeriesColumn* cells, column(series, "cell_count"));
  MORULA_TRY_ASSIGN(const SeriesColumn* area, column(series, "mean_contact_area"));
  const double free = ball_volume(experiment.radius_a);
  std::vector<FoundPacking> out;
  for (std::size_t i = 0; i < series.rows(); ++i)
    out.push_back(
        {.volume_ratio = volume->values[i] / (cells->values[i] * free), .pressure = pressure->values[i], .contact_area = area->values[i]});
  if (experiment.arrangement != calibrate::Arrangement::kRandom) return out;
  MORULA_TRY_ASSIGN(const auto moments, all_snapshots(run));
  if (moments.size() != out.size())
    return Error{ErrorKind::kFile,
                 "'" + run.string() + "' has " + std::to_string(moments.size()) + " snapshots and " + std::to_string(out.size()) +
                     " rows of its series",
                 ""};
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (const Snapshot::Cell& cell : moments[i].cells) out[i].centers.push_back(cell.centroid);
    out[i].edge = std::cbrt(volume->values[i]);
  }
  return out;
}

}  // namespace morula::scenarios
