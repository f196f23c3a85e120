#include "scenarios/run/cost_model.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "coupling/swaps.h"
#include "scenarios/initial/make_tissue.h"

namespace morula::scenarios {
namespace {

constexpr double kFade = 0.97;  // memory of about 30 steps
constexpr double kCostPerLoadHour =
    4.0e-5;  // CPU s per simulated hour and unit of load: 0.12 s per 1,000 nodes (measured on clusters at W = 0.1 mN/m)
constexpr double kBytesPerNode = 800.0, kBytesPerSphere = 600.0, kBytesPerVoxel = 120.0;
constexpr double kBytesAlways = 6e7;

/// ∫_0^τ (3 nodes + spheres e^{g t}) dt
double load_integral(const Load& load, double growth, double duration) {
  const double exponent = std::min(growth * duration, 60.0);
  const double spheres = growth > 0.0 && exponent > 1e-6 ? std::expm1(exponent) / growth : duration;
  return (load.total() - load.spheres) * duration + load.spheres * spheres;
}

}  // namespace

double free_growth_rate(const Model& model, const std::vector<std::int64_t>& cells_of_type) {
  double sum = 0.0, cells = 0.0;
  for (std::size_t t = 0; t < model.types.size(); ++t) {
    const auto count = static_cast<double>(cells_of_type[t]);
    cells += count;
    if (model.types[t].cycles) sum += count * std::numbers::ln2 / model.types[t].cycle_duration.mean;
  }
  return cells > 0.0 ? sum / cells : 0.0;
}

void CostModel::observe(double simulated, double wall, const Load& load) {
  wall_ = kFade * wall_ + wall;
  weight_ = kFade * weight_ + simulated * load.total();
}

WallRange CostModel::left(double simulated, const Load& load, double growth_rate) const {
  if (weight_ <= 0.0) return {};
  return {0.85 * cost() * load_integral(load, 0.5 * growth_rate, simulated), 1.25 * cost() * load_integral(load, growth_rate, simulated)};
}

Result<Estimate> estimate(const Study& study) {
  ShapeLibrary shapes;
  const Comm alone;
  MORULA_TRY_ASSIGN(InitialTissue initial, make_tissue(study, shapes, alone));
  Tissue& tissue = initial.tissue;
  Estimate out;
  out.cells = static_cast<std::int64_t>(tissue.cells.size());
  out.nodes = tissue.shells.node_count() + tissue.nuclei.shells.node_count();
  out.shells = static_cast<std::int64_t>(tissue.shells.size());
  for (std::size_t f = 0; f < study.model.fields.size(); ++f)
    for (std::size_t i = 0; i < tissue.cells.size(); ++i)
      tissue.cells.side.concentration[f].set(i, study.model.fields[f].initial, tissue.cells.size());
  std::vector<Vec3d> center;
  std::vector<std::int64_t> of_type(study.model.types.size(), 0);
  std::size_t shell = 0, sphere = 0;
  for (const CellRow& row : tissue.cells.rows) {
    ++of_type[row.type];
    if (row.body == BodyKind::kSphere)
      center.push_back(tissue.spheres.position[sphere++]);
    else {
      center.push_back(volume_centroid(tissue.shells.topology(shell).faces(), std::as_const(tissue.shells).nodes(shell)));
      ++shell;
    }
  }
  for (const SwapOrder& order : choose_swaps(study.model, tissue, center, alone)) {
    const std::int64_t change = order.to == BodyKind::kShell ? 1 : -1;
    out.shells += change;
    const CellType& type = study.model.types[tissue.cells.rows[order.row].type];
    out.nodes += change * (type.shell_nodes + (type.interior.has_nuclear_shell() ? type.interior.nucleus_nodes : 0));
  }
  for (const auto& spec : study.model.fields) {
    MORULA_TRY_ASSIGN(const fields::Grid grid, fields::grid_for(spec, study.model.space));
    out.voxels += grid.voxel_count();
  }
  const double growth = free_growth_rate(study.model, of_type);
  const Load load{static_cast<double>(out.cells - out.shells), static_cast<double>(out.nodes)};
  const double grown = load.spheres * std::exp(std::min(growth * study.time.end, 60.0));
  out.cells_at_end = static_cast<double>(out.shells) + grown;
  out.memory = kBytesAlways + kBytesPerNode * load.nodes + kBytesPerSphere * grown + kBytesPerVoxel * static_cast<double>(out.voxels);
  const double middle = kCostPerLoadHour / 3600.0 * load_integral(load, growth, study.time.end);
  out.wall = {middle / 3.0, middle * 3.0};
  return out;
}

std::string duration_text(double seconds) {
  char text[64];
  if (seconds < 90.0)
    std::snprintf(text, sizeof text, "%.0f s", seconds);
  else if (seconds < 90.0 * 60.0)
    std::snprintf(text, sizeof text, "%.0f min", seconds / 60.0);
  else if (seconds < 48.0 * 3600.0) {
    const long minutes = std::lround(seconds / 60.0);
    std::snprintf(text, sizeof text, "%ld h %02ld min", minutes / 60, minutes % 60);
  } else
    std::snprintf(text, sizeof text, "%.1f d", seconds / 86400.0);
  return text;
}

std::string duration_text(const WallRange& range) {
  if (range.low < 0.0) return "unknown";
  std::string low = duration_text(range.low);
  const std::string high = duration_text(range.high);
  if (low == high) return low;
  const auto unit = [](const std::string& text) { return text.substr(text.rfind(' ') + 1); };
  const bool simple = low.find(' ') == low.rfind(' ') && high.find(' ') == high.rfind(' ') && unit(low) == unit(high);
  return simple ? low.substr(0, low.find(' ')) + "–" + high : low + " to " + high;
}

}  // namespace morula::scenarios
