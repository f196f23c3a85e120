#include "scenarios/run/cost_model.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <numeric>
#include <optional>

#include "core/ball.h"
#include "coupling/neighbourhoods.h"
#include "coupling/simulation.h"
#include "coupling/swaps.h"
#include "scenarios/run/tried_steps.h"
#include "study/initial/make_tissue.h"

namespace morula::scenarios {
namespace {

constexpr double kFade = 0.97;         // memory of about 30 steps
constexpr double kMostOfAStep = 10.0;  // times the mean of those before it
// CPU of a step, measured on clusters of shells at W = 0.1 mN/m and on 25,000 and 100,000 packed spheres [s]
constexpr double kCostPerNode = 4e-6, kCostPerSphere = 1.2e-5;
constexpr double kPlacing = 3e-4;  // CPU of finding the place of a cell, on these [s]
constexpr double kBytesPerNode = 2200.0, kBytesPerSphere = 2500.0;
// Of all fields; and of the largest, for they are solved one by one: stages and multigrid, measured on 10⁶ voxels
constexpr double kBytesPerVoxel = 20.0, kBytesToSolve = 290.0;
constexpr double kBytesAlways = 3.0e7, kBytesReport = 1.2e8;     // measured: program and libraries; the pictures of the report
constexpr std::int64_t kSampled = 20'000;                        // cells up to which places are made and steps are tried
constexpr double kSampledVoxels = 1e6;                           // of all fields, with which they are tried
constexpr double kSampleTime = 3.0, kMostSampleTime = 10.0;      // CPU time of the steps that are tried, more where they are few [s]
constexpr std::size_t kSampleSteps = 16;                         // the first are taken back and cut: four say nothing of those that follow
constexpr double kReportTime = 2.2, kStartTime = 0.3;            // CPU, measured on single-cell studies [s]
constexpr double kOutputTime = 4e-3, kOutputTimePerNode = 1e-6;  // CPU of one output [s]
constexpr double kPacked = 0.74;                                 // part of a volume that its cells fill

constexpr std::size_t kFirstSteps = 32;  // that tell by how they grow what is to come, from the eighth on
constexpr std::size_t kLeastSteps = 8;
constexpr int kMoments = 16;  // at which the places of moving regions are looked up

}  // namespace

double longest_step(const Study& study) { return std::min(study.model.step.max_step, study.time.output); }

void CostModel::observe(double simulated, double wall, const Load& load) {
  if (step_ > 0.0) wall = std::min(wall, kMostOfAStep * step_);
  step_ = step_ > 0.0 ? kFade * step_ + (1.0 - kFade) * wall : wall;
  wall_ = kFade * wall_ + wall;
  weight_ = kFade * weight_ + simulated * load.total();
  if (first_.size() >= kFirstSteps) return;
  const TriedStep before = first_.empty() ? TriedStep{} : first_.back();
  first_.push_back({before.end + simulated, before.cost + wall});
}

WallRange CostModel::left(double simulated, const Load& load, double growth_rate) const {
  if (first_.size() < kLeastSteps || weight_ <= 0.0 || simulated <= 0.0 || load.total() <= 0.0) return {};
  double each = cost() * load.total();  // wall time per simulated second, for what is there now
  if (first_.size() < kFirstSteps) each = cost_ahead(first_, first_.back().end + simulated, most_) / simulated;
  const auto times = [&](double growth) { return load_integral(load, growth, simulated).total() / load.total(); };
  return {0.85 * each * times(0.5 * growth_rate), 1.25 * each * times(growth_rate)};
}

namespace {

/// What the tissue of time 0 consists of.
struct Counts {
  std::int64_t cells = 0, shells = 0, nodes = 0;
  std::vector<std::int64_t> of_type;
  [[nodiscard]] Load load() const {
    return {.spheres = static_cast<double>(cells - shells), .nodes = static_cast<double>(nodes), .shells = static_cast<double>(shells)};
  }
};

std::int64_t nodes_of(const CellType& type) {
  return type.shell_nodes + (type.interior.has_nuclear_shell() ? type.interior.nucleus_nodes : 0);
}

/// The cells that a region can hold of so many, of this volume each; layers at the tissue's surface as many as those of a ball.
double room_of(const Region& region, double cell_volume, double cells) {
  const auto& shape = *region.shape;
  if (shape.counts == CountsContacts::kFromSurface) {
    const double within = 1.0 - 2.0 * (region.contacts + 1.0) * std::cbrt(kPacked / std::max(1.0, cells));
    return cells * (1.0 - std::pow(std::max(0.0, within), 3.0));
  }
  const double volume = shape.volume != nullptr ? shape.volume(region) : std::numeric_limits<double>::infinity();
  return kPacked * volume / cell_volume;
}

}  // namespace

double most_shells(const Model& model, double cells) {
  constexpr double kUnbound = std::numeric_limits<double>::infinity();
  double radius = kUnbound;
  for (const CellType& type : model.types) {
    if (type.initial_body == BodyKind::kShell) return kUnbound;
    radius = std::min(radius, type.radius.mean);
  }
  std::optional<double> room;
  for (const Region& region : model.swaps.regions)
    if (region.body == BodyKind::kShell) room = room.value_or(0.0) + room_of(region, ball_volume(radius), cells);
  return room.value_or(kUnbound);
}

namespace {

/// Regions that count contacts hold as many shells as they have room for: who touches whom is not known before the tissue is at work.
void add_neighbours(const Study& study, double time, Counts& counts) {
  const auto& types = study.model.types;
  const auto most = static_cast<std::size_t>(std::ranges::max_element(counts.of_type) - counts.of_type.begin());
  for (const Region& region : study.model.swaps.regions) {
    if (region.shape->counts == CountsContacts::kNo || region.body != BodyKind::kShell || !region.exists_at(time)) continue;
    const double room = room_of(region, ball_volume(types[most].radius.mean), static_cast<double>(counts.cells));
    const double places = std::min(static_cast<double>(counts.cells), static_cast<double>(study.model.swaps.max_shells));
    const auto more = std::max<std::int64_t>(0, static_cast<std::int64_t>(std::min(room, places)) - counts.shells);
    counts.shells += more;
    counts.nodes += more * nodes_of(types[most]);
  }
}

/// From the places of the cells, and the bodies that the regions of a time give them. `swollen`: how many times as far from each other the cells are then, as
/// those of a tissue that has grown.
Counts count_cells(const Study& study, Tissue& tissue, double time, double swollen = 1.0) {
  Counts out;
  tissue.clock.time = time;
  out.cells = static_cast<std::int64_t>(tissue.cells.size());
  out.shells = static_cast<std::int64_t>(tissue.shells.size());
  out.nodes = static_cast<std::int64_t>(tissue.shells.node_count() + tissue.nuclei.shells.node_count());
  out.of_type.assign(study.model.types.size(), 0);
  tissue.cells.declare(cell_variables(study.model));
  for (std::size_t f = 0; f < study.model.fields.size(); ++f)
    for (std::size_t i = 0; i < tissue.cells.size(); ++i)
      tissue.cells.variables[concentration_of(f)].values.set(i, study.model.fields[f].initial, tissue.cells.size());
  std::vector<Vec3d> center;
  for (const BodyOfRow& body : bodies_of(tissue.cells)) {
    ++out.of_type[tissue.cells.rows[body.row].type];
    center.push_back(center_of(tissue, body));
  }
  if (swollen != 1.0) {
    const Vec3d middle = std::accumulate(center.begin(), center.end(), Vec3d{}) * (1.0 / std::max(1.0, static_cast<double>(center.size())));
    for (Vec3d& c : center) c = middle + (c - middle) * swollen;
  }
  Model model = study.model;
  model.box_volume = {};  // the cells are where they are at first, and so is the box
  for (const SwapOrder& order : choose_swaps(model, tissue, {center}, Comm())) {
    const std::int64_t change = order.to == BodyKind::kShell ? 1 : -1;
    out.shells += change;
    out.nodes += change * nodes_of(study.model.types[tissue.cells.rows[order.row].type]);
  }
  add_neighbours(study, time, out);
  return out;
}

/// From the numbers of the study alone, at no cost: regions hold as many cells as they have room for.
Counts count_entries(const Study& study) {
  const Model& model = study.model;
  Counts out;
  out.of_type.assign(model.types.size(), 0);
  std::vector<std::int64_t> spheres(model.types.size(), 0);
  for (const InitialCells& block : study.initial) {
    const auto count = static_cast<std::int64_t>(block.count);
    const CellType& type = model.types[block.type];
    out.cells += count;
    out.of_type[block.type] += count;
    if ((block.body_given ? block.body : type.initial_body) == BodyKind::kShell)
      out.shells += count, out.nodes += count * nodes_of(type);
    else
      spheres[block.type] += count;
  }
  for (const Region& region : model.swaps.regions) {
    if (region.body != BodyKind::kShell || !region.exists_at(0.0)) continue;
    for (std::size_t t = 0; t < spheres.size(); ++t) {
      const double room = room_of(region, ball_volume(model.types[t].radius.mean), static_cast<double>(out.cells));
      const double left = static_cast<double>(model.swaps.max_shells) - static_cast<double>(out.shells);
      const auto promoted = static_cast<std::int64_t>(std::max(0.0, std::min({room, left, static_cast<double>(spheres[t])})));
      spheres[t] -= promoted;
      out.shells += promoted;
      out.nodes += promoted * nodes_of(model.types[t]);
    }
  }
  return out;
}

double cpu_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The first exchanges and steps of a run.
struct Tried {
  double start = 0.0;  ///< CPU time until the first step: spheres of regions find their shapes as shells [s]
  std::vector<TriedStep> steps;
};

/// Voxels of all fields, and of the largest.
struct Voxels {
  std::int64_t all = 0, largest = 0;
};

Result<Voxels> count_voxels(const Model& model) {
  Voxels out;
  for (const fields::FieldSpec& spec : model.fields) {
    MORULA_TRY_ASSIGN(const fields::Grid grid, fields::grid_for(spec, model.space));
    out.all += grid.voxel_count();
    out.largest = std::max(out.largest, grid.voxel_count());
  }
  return out;
}

double bytes_of(const Voxels& voxels) {
  return kBytesPerVoxel * static_cast<double>(voxels.all) + kBytesToSolve * static_cast<double>(voxels.largest);
}

/// What is told is for one core: fields take as many threads as there are, whose waiting for each other would count as work.
class OneThread {
 public:
  OneThread() { omp_set_num_threads(1); }
  ~OneThread() { omp_set_num_threads(before_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int before_ = omp_get_max_threads();
};

/// Steps for kSampleTime, and until there are some. Fields of many voxels are tried with larger ones, and cost as many times more as these are fewer.
Result<Tried> try_steps(const Study& study, Tissue tissue) {
  const OneThread one;
  Model model = study.model;
  MORULA_TRY_ASSIGN(const Voxels voxels, count_voxels(model));
  const double fewer = std::max(1.0, static_cast<double>(voxels.all) / kSampledVoxels);
  for (fields::FieldSpec& spec : model.fields) spec.voxel *= std::cbrt(fewer);
  const double start = cpu_time();
  MORULA_TRY_ASSIGN(auto simulation, Simulation::create(std::move(model), std::move(tissue), Comm(), 1));
  MORULA_TRY(simulation->first_swaps());
  const double begin = cpu_time();
  std::vector<TriedStep> out;
  const auto time = [&] { return simulation->tissue().clock.time; };
  const auto enough = [&] {
    const double taken = cpu_time() - begin;
    return taken >= kMostSampleTime || (taken >= kSampleTime && out.size() >= kSampleSteps);
  };
  while (time() < study.time.end && !enough()) {
    const double landing = std::min(study.time.end, study.time.output * (std::floor(time() / study.time.output * (1.0 + 1e-12)) + 1.0));
    if (!simulation->step(landing).ok()) break;  // the run will tell; what was tried is what there is
    out.push_back({time(), cpu_time() - begin + (fewer - 1.0) * simulation->timer().seconds(Stage::kFields)});
  }
  return Tried{begin - start, std::move(out)};
}

/// Bodies that regions exchange later on, cells being where they are at first: regions come and go, and move with what they surround. A tissue that grows
/// swells about its middle, and reaches others.
struct LaterBodies {
  std::vector<std::pair<double, Load>> from;  ///< the load from a time on [s], in order, the first from 0
  double most_nodes = 0.0;                    ///< at the end, of any of them
  [[nodiscard]] const Load& at(double time) const {
    const auto later = std::ranges::find_if(from, [&](const auto& piece) { return piece.first > time; });
    return std::prev(later)->second;  // the first piece begins at 0
  }
};
LaterBodies later_bodies(const Study& study, const Counts& first, double growth, Tissue* tissue) {
  const double end = study.time.end;
  const double room = most_shells(study.model, static_cast<double>(first.cells) * multiplied(growth, end));
  std::vector<double> times;
  for (const Region& region : study.model.swaps.regions)
    for (const double time : {region.from, region.until})
      if (time > 0.0 && time < end) times.push_back(time);
  if (!study.model.swaps.regions.empty())
    for (int i = 1; i < kMoments; ++i) times.push_back(end * i / kMoments);
  std::sort(times.begin(), times.end());
  LaterBodies out{{{0.0, first.load()}}, 0.0};
  for (std::size_t i = 0; tissue != nullptr && i < times.size(); ++i) {
    const double time = 0.5 * (times[i] + (i + 1 < times.size() ? times[i + 1] : end));
    Load load = count_cells(study, *tissue, time).load();
    if (growth > 0.0 && !study.model.space.any_periodic()) {  // into what regions it grows
      const Load grown = count_cells(study, *tissue, time, std::cbrt(multiplied(growth, time))).load();
      if (grown.shells > load.shells) load = grown;
    }
    out.from.emplace_back(times[i], load);
  }
  for (auto& [time, load] : out.from) {
    load.most_shells = room;
    out.most_nodes = std::max(out.most_nodes, load_after(load, growth, end).nodes);
  }
  if (tissue != nullptr) tissue->clock.time = 0.0;
  return out;
}

/// What a step costs with a load, over what one costs with another, of which it is known [s]. Where that had no shells, what a node costs is not known from it.
double relative_cost(const Load& load, const Load& known, double step) {
  if (known.nodes > 0.0 || known.spheres <= 0.0) return load.total() / known.total();
  return load.spheres / known.spheres + kCostPerNode * load.nodes / step;
}

/// CPU time of a whole run [s].
Result<double> cost_of_run(const Study& study, double cells, const LaterBodies& bodies, double growth, Tissue* tissue) {
  const Load load = bodies.from.front().second;
  const double outputs = study.time.end / study.time.output;
  double cost =
      kStartTime + (study.output.report ? kReportTime : 0.0) + outputs * (kOutputTime + kOutputTimePerNode * (load.nodes + load.spheres));
  const double most = longest_step(study);
  if (tissue == nullptr) {
    const Load all = load_integral(load, growth, study.time.end);
    return cost + kPlacing * cells + (kCostPerSphere * all.spheres + kCostPerNode * all.nodes) / most;
  }
  MORULA_TRY_ASSIGN(const Tried tried, try_steps(study, std::move(*tissue)));
  cost += tried.start;
  if (tried.steps.empty()) return cost;
  cost += tried.steps.back().cost;
  // What each piece of the time ahead costs, by its load over that of the later half of what was tried, as if no cell divided; then how they multiply.
  const double here = tried.steps.back().end, left = study.time.end - here;
  if (left <= 0.0) return cost;
  const Load known = bodies.at(0.75 * here), now = load_after(bodies.at(here), growth, here);
  const double step = cost_of_late_step(tried.steps);
  double ahead = 0.0;
  for (std::size_t i = 0; i < bodies.from.size(); ++i) {
    const double from = std::max(here, bodies.from[i].first),
                 until = i + 1 < bodies.from.size() ? bodies.from[i + 1].first : study.time.end;
    if (until > from)
      ahead +=
          (cost_ahead(tried.steps, until, most) - cost_ahead(tried.steps, from, most)) * relative_cost(bodies.from[i].second, known, step);
  }
  return cost + ahead * load_integral(now, growth, left).total() / (now.total() * left);
}

}  // namespace

double memory_at_start(const Study& study) {
  const Counts counts = count_entries(study);
  const auto voxels = count_voxels(study.model);
  return kBytesAlways + kBytesPerNode * static_cast<double>(counts.nodes) +
         kBytesPerSphere * static_cast<double>(counts.cells - counts.shells) + (voxels.ok() ? bytes_of(*voxels) : 0.0);
}

Result<Estimate> estimate(const Study& study) {
  std::int64_t cells = 0;
  for (const InitialCells& block : study.initial) cells += static_cast<std::int64_t>(block.count);
  std::optional<Tissue> tissue;
  const double before = cpu_time();
  if (cells <= kSampled) {
    ShapeLibrary shapes;
    MORULA_TRY_ASSIGN(InitialTissue initial, make_tissue(study, shapes, Comm()));
    tissue = std::move(initial.tissue);
  }
  const double placing = 2.0 * (cpu_time() - before);  // to judge the places, and to run; surfaces of files are remeshed
  const Counts counts = tissue ? count_cells(study, *tissue, 0.0) : count_entries(study);
  const double growth = free_growth_rate(study.model, counts.of_type, study.time.end);
  const LaterBodies later = later_bodies(study, counts, growth, tissue ? &*tissue : nullptr);
  Estimate out;
  out.cells = counts.cells;
  out.shells = counts.shells;
  out.nodes = counts.nodes;
  MORULA_TRY_ASSIGN(const Voxels voxels, count_voxels(study.model));
  out.voxels = voxels.all;
  const Load at_end = load_after(later.from.front().second, growth, study.time.end);
  out.cells_at_end = at_end.spheres + at_end.shells;
  out.memory = kBytesAlways + (study.output.report ? kBytesReport : 0.0) + kBytesPerNode * later.most_nodes +
               kBytesPerSphere * at_end.spheres + bytes_of(voxels);
  MORULA_TRY_ASSIGN(const double from_there,
                    cost_of_run(study, static_cast<double>(counts.cells), later, growth, tissue ? &*tissue : nullptr));
  const double middle = placing + from_there, range = tissue ? 1.6 : 3.0;
  out.wall = {middle / range, middle * range};
  return out;
}

std::string duration_text(double seconds) {
  char text[64];
  if (seconds < 9.95)
    std::snprintf(text, sizeof text, "%.2g s", seconds);
  else if (seconds < 90.0)
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
