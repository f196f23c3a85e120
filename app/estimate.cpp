#include "app/estimate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/words.h"
#include "scenarios/study/csv.h"

namespace morula::app {
namespace {

using scenarios::InitialCells;

// Measured on one core of an x86-64 server (2.5-3 GHz): growing clusters of 13 to 55 shells, dense tissues of 1e5 spheres. Lower and upper ends.
constexpr double kCpuPerNodeHourLow = 0.03e-3, kCpuPerNodeHourHigh = 0.3e-3;  // CPU s per node and simulated hour
constexpr double kCpuPerSphereStepLow = 1e-6, kCpuPerSphereStepHigh = 5e-6;   // CPU s
constexpr double kStepsPerHourLow = 60.0, kStepsPerHourHigh = 240.0;
constexpr double kCpuPerVoxelHourLow = 2e-6, kCpuPerVoxelHourHigh = 5e-5;     // CPU s per voxel and simulated hour
constexpr double kBytesPerNode = 1200.0, kBytesPerSphere = 900.0, kBytesPerVoxel = 120.0, kBytesAtRest = 60e6;

bool inside(const Region& region, const Vec3d& p) {
  const Vec3d d = p - region.center;
  switch (region.shape) {
    case RegionShape::kSphere: return dot(d, d) <= region.radius * region.radius;
    case RegionShape::kBox: return 2.0 * std::fabs(d.x) <= region.size.x && 2.0 * std::fabs(d.y) <= region.size.y && 2.0 * std::fabs(d.z) <= region.size.z;
    case RegionShape::kHalfSpace: return dot(d, region.normal) <= 0.0;
    case RegionShape::kEverything: return true;
  }
  return false;
}

/// Whether a cell here is a shell; the first region that holds it decides, as at the start of a run.
bool shell_at(const Model& model, std::uint16_t type, BodyKind own, Vec3d p) {
  for (const Trigger& trigger : model.swaps.triggers)
    if (trigger.value == Trigger::Value::kType && trigger.type == type) return true;
  for (const Region& region : model.swaps.regions)
    if (inside(region, p)) return region.body == BodyKind::kShell;
  return own == BodyKind::kShell;
}

/// Part of a filled shape in which cells are shells, from 20³ points of a regular grid.
double shell_part(const Model& model, const InitialCells& block, BodyKind own) {
  constexpr int n = 20;
  int all = 0, shells = 0;
  for (int i = 0; i < n * n * n; ++i) {
    const Vec3d u{(i % n + 0.5) / n - 0.5, (i / n % n + 0.5) / n - 0.5, (i / (n * n) + 0.5) / n - 0.5};
    const bool sphere = block.fill == RegionShape::kSphere;
    if (sphere && dot(u, u) > 0.25) continue;
    const Vec3d p = block.center + (sphere ? u * (2.0 * block.radius) : Vec3d{u.x * block.size.x, u.y * block.size.y, u.z * block.size.z});
    ++all;
    if (shell_at(model, block.type, own, p)) ++shells;
  }
  return all ? static_cast<double>(shells) / all : 0.0;
}

struct BlockCount {
  std::vector<double> cells, shells;  ///< by type
};

void count_csv(const scenarios::Study& study, const InitialCells& block, BlockCount& count) {
  std::vector<std::string> names;
  for (const CellType& type : study.model.types) names.push_back(type.name);
  const UnitSystem units;
  scenarios::Diagnostics told;  // the file was checked with the study
  const auto csv = scenarios::read_cells_csv(block.csv_path, block.csv_path, names, {}, units, told);
  if (!csv) return;
  for (const scenarios::CsvCell& cell : csv->cells) {
    const BodyKind own = cell.body ? *cell.body : block.body_given ? block.body : study.model.types[cell.type].initial_body;
    count.cells[cell.type] += 1.0;
    count.shells[cell.type] += shell_at(study.model, cell.type, own, cell.position) ? 1.0 : 0.0;
  }
}

BlockCount count_cells(const scenarios::Study& study) {
  const Model& model = study.model;
  BlockCount count{std::vector<double>(model.types.size()), std::vector<double>(model.types.size())};
  for (const InitialCells& block : study.initial) {
    if (block.source == InitialCells::Source::kCsv) {
      count_csv(study, block, count);
      continue;
    }
    const BodyKind own = block.body_given ? block.body : model.types[block.type].initial_body;
    const auto n = static_cast<double>(block.count);
    count.cells[block.type] += n;
    if (block.source == InitialCells::Source::kFill) {
      count.shells[block.type] += n * shell_part(model, block, own);
    } else {
      for (const Vec3d& p : block.positions) count.shells[block.type] += shell_at(model, block.type, own, p) ? 1.0 : 0.0;
    }
  }
  return count;
}

}  // namespace

Estimate estimate(const scenarios::Study& study) {
  const Model& model = study.model;
  const BlockCount count = count_cells(study);
  const double hours = study.time.end / 3600.0;
  Estimate out;
  double node_hours = 0.0, sphere_hours_most = 0.0, sphere_hours_least = 0.0;
  const auto most_shells = static_cast<double>(model.swaps.max_shells);
  for (std::size_t t = 0; t < model.types.size(); ++t) {
    const CellType& type = model.types[t];
    const double n = count.cells[t], shells = std::min(count.shells[t], most_shells), spheres = n - shells;
    const double doublings = type.cycles ? study.time.end / type.cycle_duration.mean : 0.0;
    const double growth = std::exp2(std::min(doublings, 60.0));
    // ∫ 2^(t/T) dt over the run, against n·t without growth; shells wait at their division volume and do not divide
    const double mean_growth = doublings > 0.0 ? (growth - 1.0) / (std::numbers::ln2 * doublings) : 1.0;
    out.cells_start += n;
    out.cells_end += shells + spheres * growth;
    out.shells_start += shells;
    out.nodes_end += shells * type.shell_nodes;
    node_hours += shells * type.shell_nodes * hours;
    sphere_hours_least += spheres * hours;
    sphere_hours_most += spheres * mean_growth * hours;
  }
  out.shells_end = out.shells_start;
  const Vec3d box = model.space.box.size();
  for (const fields::FieldSpec& field : model.fields)
    if (field.voxel > 0.0) out.voxels += std::ceil(box.x / field.voxel) * std::ceil(box.y / field.voxel) * std::ceil(box.z / field.voxel);
  out.memory = kBytesAtRest + out.nodes_end * kBytesPerNode + (out.cells_end - out.shells_end) * kBytesPerSphere + out.voxels * kBytesPerVoxel;
  const double coarse = std::max(1.0, 60.0 / model.step.max_step);  // a smaller largest step means more steps
  out.cpu_low = node_hours * kCpuPerNodeHourLow + sphere_hours_least * kStepsPerHourLow * coarse * kCpuPerSphereStepLow + out.voxels * hours * kCpuPerVoxelHourLow;
  out.cpu_high = coarse * (node_hours * kCpuPerNodeHourHigh + sphere_hours_most * kStepsPerHourHigh * kCpuPerSphereStepHigh) + out.voxels * hours * kCpuPerVoxelHourHigh;
  return out;
}

std::string estimate_text(const scenarios::Study& study, int ranks) {
  const Estimate e = estimate(study);
  const auto whole = [](double value) { return value < 1e7 ? number_text("%.0f", value) : number_text("%.3g", value); };
  std::string out = "  cells   " + whole(e.cells_start) + " at the start (" + whole(e.shells_start) + " shells)";
  if (e.cells_end > e.cells_start) out += ", at most " + whole(e.cells_end) + " at " + simulated_time_words(study.time.end);
  out += "\n  nodes   " + whole(e.nodes_end) + "\n";
  if (e.voxels > 0.0) out += "  voxels  " + whole(e.voxels) + "\n";
  out += "  memory  about " + bytes_words(e.memory) + "\n";
  out += "  time    " + wall_time_words(e.cpu_low / ranks) + " to " + wall_time_words(e.cpu_high / ranks) + " on " + count_words(static_cast<std::uint64_t>(ranks), "core", "cores") + "\n";
  return out;
}

}  // namespace morula::app
