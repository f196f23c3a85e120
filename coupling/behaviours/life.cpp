#include "coupling/behaviours/life.h"

#include <algorithm>
#include <cmath>

#include "core/ball.h"
#include "coupling/behaviours/ask.h"
#include "coupling/behaviours/death.h"
#include "coupling/behaviours/growth.h"
#include "coupling/behaviours/migration.h"

namespace morula {
namespace {

using Kind = LifeDecision::Kind;

/// Whether a shell that waits for a plane of division looks for one in this step.
bool is_time_to_try(const LifeStep& step) {
  return std::floor(step.time / kTimeBetweenTries) > std::floor((step.time - step.dt) / kTimeBetweenTries);
}

/// What follows when a cell is at its division volume.
LifeDecision at_division_volume(CellRow& row, double late, const CellType& type, const LifeStep& step) {
  const bool waits = row.phase == Phase::kWaiting, by_cut = row.body == BodyKind::kShell && type.shells_divide;
  if (row.id.can_divide() && (row.body == BodyKind::kSphere || (by_cut && (!waits || is_time_to_try(step))))) return {Kind::kDivide, late};
  row.phase = Phase::kWaiting;
  if (waits) return {};
  return {row.id.can_divide() ? Kind::kWait : Kind::kCannot, late};
}

Event describe(const CellRow& row, const CellType& type, const LifeStep& step, const LifeDecision& decision) {
  using Cause = EventReason::Cause;
  Event event;
  event.time = step.time - decision.late;
  event.cell = row.id;
  switch (decision.kind) {
    case Kind::kNone:
      break;
    case Kind::kDivide:
      event.kind = EventKind::kDivision;
      event.first_daughter = row.id.daughter(0);
      event.second_daughter = row.id.daughter(1);
      event.reason.cause = type.cycle.phases.empty() ? Cause::kDivisionVolume : Cause::kLastPhase;
      break;
    case Kind::kWait:
      event.kind = EventKind::kDivisionWaits;
      event.reason.cause = Cause::kDivisionVolumeAsShell;
      break;
    case Kind::kCannot:
      event.kind = EventKind::kWarning;
      event.reason.cause = Cause::kLongLineage;
      break;
    case Kind::kBeginDying:
      event.kind = EventKind::kDeath;
      event.reason = {Cause::kBehaviour, false, row.type | static_cast<std::uint32_t>(decision.behaviour) << 16};
      break;
    case Kind::kRemove:
      event.kind = EventKind::kRemoval;
      event.reason.cause = Cause::kShrunk;
      break;
    case Kind::kLeave:
    case Kind::kReturn:
      event.kind = decision.kind == Kind::kLeave ? EventKind::kQuiescence : EventKind::kReturn;
      event.reason = {Cause::kPhaseHeld, false, row.type};
      break;
  }
  return event;
}

/// How a cell moves by itself in the step.
Walk walk_of(const CellRow& row, const LifeValues& values, const CellType& type, const LifeStep& step, const CellWish& wish) {
  if (!type.migration.acts()) return {};
  return migrate({.id = row.id,
                  .velocity = values.migration_velocity,
                  .speed = wish.migration * type.migration.speed,
                  .radius = ball_radius(row.target_volume),
                  .sensed = values.sensed,
                  .random = Random(step.seed, RandomStream::kMigration),
                  .step = step.step,
                  .dt = step.dt},
                 type);
}

/// A step in the phases of the cycle.
LifeDecision pass_cycle(CellRow& row, CyclePlace& place, const CellType& type, const LifeStep& step, const CellWish& wish,
                        const PhaseRate& rate) {
  const PhaseRate own = [&](std::size_t phase) { return wish.cycle * (rate ? rate(phase) : 1.0); };
  const Leaving leaving = leave_or_return(place, type.cycle, step.dt, own);
  const Growth done = pass_phases(row, place, type, step.seed, step.dt, wish.growth, own);
  if (done.reached) return at_division_volume(row, done.late, type, step);
  if (leaving == Leaving::kNo) return {};
  return {leaving == Leaving::kLeaves ? Kind::kLeave : Kind::kReturn, step.dt};
}

}  // namespace

LifeDecision live(CellRow& row, LifeValues& values, const CellType& type, const LifeStep& step, const CellWish& wish,
                  const PhaseRate& rate) {
  if (row.phase == Phase::kDying) {
    shrink(row, type, step.dt);
    return {is_gone(values.death_time, type, step.time) ? Kind::kRemove : Kind::kNone, 0.0};
  }
  if (wish.die) {
    row.phase = Phase::kDying;
    values.death_time = step.time;
    values.migration_velocity = {};
    return {Kind::kBeginDying, 0.0};
  }
  const Walk walk = walk_of(row, values, type, step, wish);
  values.migration_velocity = walk.velocity;
  values.walk = walk.mean;
  if (wish.polarity) values.polarity = normalized(*wish.polarity);
  if (wish.volume != 1.0) row.target_volume *= wish.volume;
  if (row.phase == Phase::kWaiting || wish.divide) return at_division_volume(row, 0.0, type, step);
  if (row.phase == Phase::kResting) return {};
  if (!type.cycle.phases.empty()) return pass_cycle(row, values.place, type, step, wish, rate);
  if (!(wish.growth > 0.0)) return {};
  const Growth growth = grow(row, type, step.dt * wish.growth);
  return growth.reached ? at_division_volume(row, growth.late / wish.growth, type, step) : LifeDecision{};
}

namespace {

CyclePlace place_of(const Cells& cells, std::size_t first, std::int64_t row) {
  const auto value = [&](std::size_t which) { return cells.variables[first + which].values[static_cast<std::size_t>(row)]; };
  return {static_cast<std::size_t>(value(0)), value(1), value(2)};
}

void put_place(const CyclePlace& place, std::size_t first, std::int64_t row, Cells& cells) {
  const auto put = [&](std::size_t which, double value) {
    cells.variables[first + which].values.set(static_cast<std::size_t>(row), value);
  };
  put(0, static_cast<double>(place.phase));
  put(1, place.left);
  put(2, place.held);
}

}  // namespace

LifeReport live(Cells& cells, std::span<const CellType> types, const LifeStep& step) {
  const std::vector<CellRow>& rows = cells.rows;
  std::vector<LifeDecision> decisions(rows.size());
  const auto count = static_cast<std::int64_t>(rows.size());
  OptionalColumns& optional = cells.optional;
  const auto migrates = [](const CellType& type) { return type.migration.acts(); };
  const auto behaves = [](const CellType& type) { return !type.behaviours.empty(); };
  if (std::any_of(types.begin(), types.end(), migrates)) optional.migration_velocity.make_room(rows.size());
  const auto turns = [](const CellType& type) { return type.polarity.set && !type.behaviours.empty(); };
  if (std::any_of(types.begin(), types.end(), behaves)) optional.death_time.make_room(rows.size());
  if (std::any_of(types.begin(), types.end(), turns)) optional.polarity.make_room(rows.size());
  LifeReport report;
  if (std::any_of(types.begin(), types.end(), migrates)) report.walk.resize(rows.size());
  AskBehaviours behaviours(cells, types, step);
  const std::size_t first = first_cycle_variable(cells.variables);
  const bool has_phases = first < cells.variables.size();
  for (std::size_t v = first; has_phases && v < first + 3; ++v) cells.variables[v].values.make_room(rows.size());
#pragma omp parallel for schedule(static) if (count > 1000)
  for (std::int64_t k = 0; k < count; ++k) {
    const CellType& type = types[rows[k].type];
    const bool in_phases = has_phases && !type.cycle.phases.empty();
    LifeValues values{optional.migration_velocity[k], optional.death_time[k], optional.polarity[k]};
    if (in_phases) values.place = place_of(cells, first, k);
    if (!step.sensed.empty()) values.sensed = step.sensed[static_cast<std::size_t>(k)];
    const Asked asked = rows[k].phase == Phase::kDying ? Asked{} : behaviours.ask(k);
    const auto rate = [&behaviours, k](std::size_t phase) { return behaviours.phase_rate(k, phase); };
    const double to_come = rows[k].phase == Phase::kDying ? 0.0 : optional.inflation_left[k];  // growth knows the cell as it will be
    cells.rows[k].target_volume += to_come;
    decisions[k] =
        in_phases ? live(cells.rows[k], values, type, step, asked.wish, rate) : live(cells.rows[k], values, type, step, asked.wish);
    cells.rows[k].target_volume -= to_come;
    if (in_phases) put_place(values.place, first, k, cells);
    if (decisions[k].kind == Kind::kBeginDying) decisions[k].behaviour = asked.deadly;
    optional.migration_velocity.set(k, values.migration_velocity);
    if (!report.walk.empty()) report.walk[static_cast<std::size_t>(k)] = values.walk;
    optional.death_time.set(k, values.death_time);
    if (asked.wish.polarity && type.polarity.set) optional.polarity.set(k, values.polarity);
  }

  for (std::size_t k = 0; k < rows.size(); ++k) {
    const LifeDecision& decision = decisions[k];
    if (decision.kind == Kind::kNone) continue;
    report.events.push_back(describe(rows[k], types[rows[k].type], step, decision));
    if (decision.kind == Kind::kDivide) report.divisions.push_back({k, decision.late});
    if (decision.kind == Kind::kRemove) report.removals.push_back(k);
  }
  return report;
}

}  // namespace morula
