#include "scenarios/measures/pulled_contact.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/ball.h"
#include "scenarios/measures/elastic_cap.h"

namespace morula::scenarios {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kFewest = 4;  // outputs

/// What a cell is pulled off.
struct Partner {
  std::size_t material = 0;
  const CellLoad* holder = nullptr;  ///< grip of the other cell; null: an obstacle
};

std::optional<Partner> partner_of(const Model& model, const CellLoad& load) {
  Partner out;
  double nearest = 4.0 * model.types[load.type].radius.mean;
  for (const CellLoad& other : model.loads) {
    const double distance = norm(other.center - load.center);
    if (other.what != grip_load() || !other.way.empty() || other.type == load.type || distance > nearest) continue;
    nearest = distance;
    out = {other.type, &other};
  }
  if (out.holder != nullptr) return out;
  double most = 0.0;
  for (std::size_t obstacle = model.types.size(); obstacle < model.material_count(); ++obstacle) {
    if (!(model.pair(load.type, obstacle).adhesion > most)) continue;
    most = model.pair(load.type, obstacle).adhesion;
    out.material = obstacle;
  }
  return most > 0.0 ? std::optional(out) : std::nullopt;
}

/// When a grip begins its last way in its direction, and when that ends.
std::pair<double, double> retraction(const TimeCourse& way) {
  for (std::size_t i = way.time.size(); i-- > 1;)
    if (way.value[i] > way.value[i - 1]) return {way.time[i - 1], way.time[i]};
  return {0.0, 0.0};
}

Status read_curve(FinishedRun& run, const CellLoad& load, const CellLoad* holder, PulledContact& out) {
  const auto [from, until] = retraction(load.way);
  if (!(until > from)) return {};
  const CellType& type = run.study().model.types[load.type];
  const double size = type.radius.mean;
  out.speed = (load.way.at(until) - load.way.at(from)) / (until - from);
  const double drag = type.medium_friction * 4.0 * kPi * size * size * out.speed;
  MORULA_TRY_ASSIGN(const std::vector<Sample> along,
                    by_row(run, pulled_contact_columns(run.study(), load), {Moments::Kind::kBetween, from, until},
                           [&](double, const std::vector<double>& row) {
                             return dot(Vec3d{row[0], row[1], row[2]}, load.direction);
                           }));
  for (const Sample& one : along) {
    out.time.push_back(one.time);
    out.way.push_back(load.way.at(one.time) - load.way.at(from));
    out.pull.push_back(holder == nullptr ? one.value - drag : -one.value);
  }
  return {};
}

/// The first cell of the load in the snapshot of an output; null where there is none.
Result<std::shared_ptr<const Snapshot>> shown_at(FinishedRun& run, std::size_t index, std::size_t type, const Snapshot::Cell*& cell) {
  MORULA_TRY_ASSIGN(auto snapshot, run.snapshot(index));
  const auto cells = shells_of(*snapshot, type);
  cell = cells.empty() ? nullptr : cells[0].cell;
  return snapshot;
}

}  // namespace

Result<double> pressure_at_peak(FinishedRun& run, const CellLoad& load, const PulledContact& pulled) {
  MORULA_TRY_ASSIGN(const auto snapshot, run.snapshot_at(pulled.peak_time));
  if (snapshot == nullptr) return std::nan("");
  const auto cells = shells_of(*snapshot, load.type);
  return cells.empty() ? std::nan("") : cells[0].cell->inner_pressure;
}

Result<double> radius_at_end(FinishedRun& run, const CellLoad& load) {
  MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
  if (times->empty()) return std::nan("");
  const Snapshot::Cell* cell = nullptr;
  MORULA_TRY_ASSIGN(const auto snapshot, shown_at(run, times->size() - 1, load.type, cell));
  return cell == nullptr ? std::nan("") : ball_radius(cell->volume);
}

Result<double> last_contact_radius(FinishedRun& run, const CellLoad& load, const PulledContact& pulled) {
  MORULA_TRY_ASSIGN(const std::vector<double>* const times, run.snapshot_times());
  for (std::size_t i = times->size(); i-- > 0 && (*times)[i] >= pulled.time.front();) {
    const Snapshot::Cell* cell = nullptr;
    MORULA_TRY_ASSIGN(const auto snapshot, shown_at(run, i, load.type, cell));
    if (cell != nullptr && cell->contact_area > 0.0) return std::sqrt(cell->contact_area / kPi);
  }
  return 0.0;
}

std::vector<std::string> pulled_contact_columns(const Study& study, const CellLoad& load) {
  const auto partner = partner_of(study.model, load);
  const std::string grip = partner && partner->holder != nullptr ? partner->holder->name : load.name;
  return {"grip_x_" + grip, "grip_y_" + grip, "grip_z_" + grip};
}

Result<std::optional<PulledContact>> pulled_contact(FinishedRun& run, const CellLoad& load) {
  const Model& model = run.study().model;
  const auto partner = partner_of(model, load);
  if (load.way.empty() || !partner) return std::optional<PulledContact>();
  PulledContact out;
  out.on_obstacle = partner->holder == nullptr;
  out.adhesion = model.pair(load.type, partner->material).adhesion;
  out.range = range_of(model, load.type, partner->material);
  MORULA_TRY(read_curve(run, load, partner->holder, out));
  if (out.pull.size() < kFewest) return std::optional<PulledContact>();
  const auto peak = std::max_element(out.pull.begin(), out.pull.end());
  out.peak = *peak;
  out.peak_time = out.time[static_cast<std::size_t>(peak - out.pull.begin())];
  for (std::size_t i = out.pull.size() - 3; i < out.pull.size(); ++i) out.left = std::max(out.left, std::abs(out.pull[i]) / out.peak);
  return std::optional(std::move(out));
}

}  // namespace morula::scenarios
