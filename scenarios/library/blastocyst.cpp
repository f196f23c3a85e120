#include "scenarios/library/blastocyst.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "core/mesh/convex_hull.h"
#include "results/snapshot_file.h"
#include "scenarios/library/embryo_measures.h"
#include "scenarios/measures/verdicts.h"
#include "study/csv.h"

namespace morula::scenarios {
namespace {

constexpr double kVolumeError = 0.01;     // S18.2
constexpr double kInnerFree = 0.10;       // S18.2
constexpr double kRmsDisplacement = 5.0;  // S18.3 [µm]
constexpr double kOrder = 1e-6;           // S18.3, p
constexpr double kSwapVolume = 1e-10;     // S18.6
constexpr double kSwapMotion = 0.2;       // S18.6 [µm]
constexpr double kSwapWindow = 1200.0;    // in which an exchange of all inner cells is over [s]

/// What was measured and what became of it.
struct Embryo {
  std::vector<CsvCell> rows;
  std::vector<Snapshot> moments;
  std::uint16_t outer = 0;  ///< number of the type TE

  [[nodiscard]] bool is_outer(const Snapshot::Cell& cell) const { return cell.type == outer; }
  [[nodiscard]] const Snapshot& first() const { return moments.front(); }
  [[nodiscard]] const Snapshot& last() const { return moments.back(); }
};

Result<Embryo> read_embryo(const Study& study, const std::filesystem::path& run) {
  Embryo out;
  std::vector<std::string> names;
  for (const CellType& type : study.model.types) names.push_back(type.name);
  out.outer = static_cast<std::uint16_t>(std::find(names.begin(), names.end(), "TE") - names.begin());
  const UnitSystem units;
  Diagnostics diagnostics;
  const std::string& path = study.initial.front().csv_path;
  auto csv = read_cells_csv(path, path, names, {}, units, diagnostics);
  if (!csv) return diagnostics.as_error();
  out.rows = std::move(csv->cells);
  MORULA_TRY_ASSIGN(const auto entries, list_snapshots(run / "results.h5"));
  for (const SnapshotEntry& entry : entries) {
    MORULA_TRY_ASSIGN(Snapshot moment, read_snapshot(run / "results.h5", entry.index));
    out.moments.push_back(std::move(moment));
  }
  if (out.moments.empty()) return Error{ErrorKind::kFile, "no snapshot in '" + (run / "results.h5").string() + "'", {}};
  return out;
}

/// The last moment not after a time.
std::size_t moment_at(const Embryo& embryo, double time) {
  std::size_t k = 0;
  while (k + 1 < embryo.moments.size() && embryo.moments[k + 1].time <= time + 1e-6) ++k;
  return k;
}

/// S18.1. Rows at one place are counted here by comparing all, not by the reader's search.
void judge_import(const Study& study, const Embryo& embryo, std::vector<Verdict>& out) {
  out.push_back(equal("S18.1", "cells at time 0, against rows of the CSV file", embryo.first().cells.size(), embryo.rows.size()));
  std::size_t groups = 0, named = 0;
  for (std::size_t i = 0; i < embryo.rows.size(); ++i) {
    const auto same = [&](std::size_t j) { return embryo.rows[j].position == embryo.rows[i].position; };
    bool first = true, more = false;
    for (std::size_t j = 0; j < i; ++j) first = first && !same(j);
    for (std::size_t j = i + 1; j < embryo.rows.size(); ++j) more = more || same(j);
    groups += first && more;
  }
  for (const std::string& note : study.notes) named += note.find("lie at the same place") != std::string::npos;
  out.push_back(equal("S18.1", "groups of coincident cells named, against groups in the CSV file", named, groups));
}

/// S18.2, which speaks of the embryo after inflation; what relaxing does to it is S18.3.
void judge_shape(const Study& study, const Embryo& embryo, std::vector<Verdict>& out) {
  const InitialCells& start = study.initial.front();
  const Snapshot& inflated = start.inflate_time > 0.0 ? embryo.moments[moment_at(embryo, start.inflate_time)] : embryo.last();
  double volume = 0.0;
  for (const auto& cell : inflated.cells) volume += cell.volume;
  const double target = start.shared_volume * static_cast<double>(inflated.cells.size());
  out.push_back(
      at_most("S18.2", "total volume after inflation against the target, relative", std::abs(volume / target - 1.0), kVolumeError));
  const double cell_radius = std::cbrt(0.75 / std::numbers::pi * volume / static_cast<double>(inflated.cells.size()));
  const std::vector<double> free = outer_surface_fractions(inflated, cell_radius, {start.cavity_center, start.cavity_radius});
  std::size_t covered = 0, outside = 0;
  Largest most;
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (embryo.is_outer(inflated.cells[i])) {
      covered += free[i] == 0.0;
    } else {
      outside += free[i] > kInnerFree;
      most.add(free[i]);
    }
  }
  out.push_back(equal("S18.2", "trophectoderm cells that a ball of a cell's size, rolling outside, does not touch", covered, 0));
  out.push_back(equal("S18.2", "inner cells that such a ball touches on more than 10 % of their surface", outside, 0));
  out.push_back(at_most("S18.2", "largest part of an inner cell's surface that such a ball touches", most.value(), kInnerFree));
}

/// S18.3
void judge_places(const Embryo& embryo, std::vector<Verdict>& out) {
  std::vector<Vec3d> measured, now;
  std::vector<double> outer, inner;
  for (const auto& cell : embryo.last().cells) {
    const std::uint64_t number = cell.id.founder_number();
    if (number == 0 || number > embryo.rows.size()) continue;
    measured.push_back(embryo.rows[number - 1].position);
    now.push_back(cell.centroid);
  }
  out.push_back(at_most("S18.3", "root mean square way of the cells from the measured nuclei",
                        now.empty() ? kNothing : rms_after_rigid_motion(measured, now), kRmsDisplacement, "um"));
  if (const auto hull = convex_hull(now))
    for (const auto& cell : embryo.last().cells) (embryo.is_outer(cell) ? outer : inner).push_back(hull->depth(cell.centroid));
  out.push_back(at_most("S18.3", "trophectoderm lies outside the inner cells (depth below the hull, Mann-Whitney p)",
                        outer.empty() || inner.empty() ? kNothing : mann_whitney_p(outer, inner), kOrder));
}

/// The last moment before a time.
std::size_t moment_before(const Embryo& embryo, double time) { return moment_at(embryo, time - 2e-6); }

/// Largest way of a TE centre in the window of an exchange that begins at `time`, beyond what it went on as in the window before; kNothing without
/// snapshots before and after.
double motion_by_exchange(const Embryo& embryo, double time) {
  // At the moment of an exchange the first cell has its new body, and nobody has moved yet.
  const std::size_t at = moment_at(embryo, time);
  const std::size_t before = moment_at(embryo, embryo.moments[at].time - kSwapWindow);
  const std::size_t after = moment_at(embryo, embryo.moments[at].time + kSwapWindow);
  std::map<CellId, Vec3d> start, past;
  for (const auto& cell : embryo.moments[at].cells) start[cell.id] = cell.centroid;
  for (const auto& cell : embryo.moments[before].cells) past[cell.id] = cell.centroid;
  if (before == at || after == at) return kNothing;
  const double ratio = (embryo.moments[after].time - embryo.moments[at].time) / (embryo.moments[at].time - embryo.moments[before].time);
  Largest most;
  for (const auto& cell : embryo.moments[after].cells) {
    if (!embryo.is_outer(cell) || !start.contains(cell.id) || !past.contains(cell.id)) continue;
    const Vec3d drift = (start[cell.id] - past[cell.id]) * ratio;
    most.add(norm(cell.centroid - start[cell.id] - drift));
  }
  return most.value();
}

/// S18.6
void judge_exchange(const Region& region, const Embryo& embryo, std::vector<Verdict>& out) {
  std::size_t lost = 0, inner = 0, shells = 0, shells_at_end = 0;
  Largest volume;
  const auto has = [](const Snapshot& moment, CellId id) {
    return std::any_of(moment.cells.begin(), moment.cells.end(), [&](const auto& cell) { return cell.id == id; });
  };
  for (const auto& cell : embryo.first().cells) lost += !has(embryo.last(), cell.id);
  for (const auto& cell : embryo.last().cells) lost += !has(embryo.first(), cell.id);
  for (const auto& cell : embryo.moments[moment_before(embryo, region.until)].cells) {
    if (embryo.is_outer(cell)) continue;
    ++inner;
    shells += cell.body == BodyKind::kShell;
  }
  for (const auto& cell : embryo.last().cells) shells_at_end += !embryo.is_outer(cell) && cell.body == BodyKind::kShell;
  // The first exchange comes at the end of the step that lands on `from`, which is an output time: its snapshot shows the cell just exchanged.
  const std::size_t at = moment_before(embryo, region.from);
  if (at + 1 < embryo.moments.size() && embryo.moments[at + 1].time == region.from)
    for (const auto& now : embryo.moments[at + 1].cells)
      for (const auto& then : embryo.moments[at].cells)
        if (now.id == then.id && now.body != then.body) volume.add(std::abs(now.volume / then.volume - 1.0));
  out.push_back(equal("S18.6", "ids that came or went", lost, 0));
  out.push_back(at_least("S18.6", "part of the inner cells that are shells before the region ends",
                         static_cast<double>(shells) / static_cast<double>(inner), 1.0));
  out.push_back(equal("S18.6", "inner cells that are shells at the end", shells_at_end, 0));
  out.push_back(at_most("S18.6", "volume of the cells just promoted, relative change", volume.value(), kSwapVolume));
  out.push_back(at_most("S18.6", "way of a trophectoderm cell in the 20 min of promotion, beyond its drift",
                        motion_by_exchange(embryo, region.from), kSwapMotion, "um"));
  out.push_back(at_most("S18.6", "way of a trophectoderm cell in the 20 min of demotion, beyond its drift",
                        motion_by_exchange(embryo, region.until), kSwapMotion, "um"));
}

}  // namespace

Status blastocyst_needs(const Study& study) {
  if (study.initial.size() != 1 || study.initial.front().source != InitialCells::Source::kCsv ||
      !(study.initial.front().shared_volume > 0.0))
    return Error{ErrorKind::kInput, "its cells from one CSV file, with `volume_from_hull`", ""};
  for (const CellType& type : study.model.types)
    if (type.name == "TE") return {};
  return Error{ErrorKind::kInput, "a cell type `TE`", ""};
}

Result<std::vector<Verdict>> judge_blastocyst(const Study& study, const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const Embryo embryo, read_embryo(study, run));
  std::vector<Verdict> out;
  judge_import(study, embryo, out);
  judge_shape(study, embryo, out);
  judge_places(embryo, out);
  for (const Region& region : study.model.swaps.regions)
    if (region.until < kNever && region.until <= embryo.last().time) judge_exchange(region, embryo, out);
  return out;
}

}  // namespace morula::scenarios
