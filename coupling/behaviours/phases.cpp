#include "coupling/behaviours/phases.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random/philox.h"
#include "coupling/behaviours/draw.h"

namespace morula {
namespace {

constexpr double kForEver = std::numeric_limits<double>::infinity();
// A sum of many steps ends a rounding away from the end of a phase: that much early counts as its end.
constexpr double kRounding = 1e-9;

/// Grow for dt [s] of free growth, at most to the division volume.
void grow_for(CellRow& row, const CellType& type, double dt) {
  if (dt > 0.0 && type.cycle.growth->grows && row.target_volume < row.division_volume) grow(row, type, dt);
}

/// Time that growth at this rate takes to the division volume [s].
double time_to_size(const CellRow& row, const CellType& type, double rate) {
  if (row.target_volume >= row.division_volume) return 0.0;
  const double needed =
      type.cycle.growth->time_to(growth_pace(row, type), type.cycle.growth_values, row.target_volume, row.division_volume);
  if (needed <= kRounding * row.cycle_duration) return 0.0;
  return rate > 0.0 ? needed / rate : kForEver;
}

/// Time to the end of the present phase [s].
double time_to_end(const CellRow& row, const CyclePlace& place, const CellType& type, double clock, double growth) {
  const CellCycle& cycle = type.cycle;
  const bool by_size = cycle.phases[place.phase].length == CyclePhase::Length::kSize;
  double out = clock > 0.0 ? place.left / clock : by_size || place.left > 0.0 ? kForEver : 0.0;
  if (cycle.growth->grows && place.phase == last_growing_phase(cycle)) out = std::max(out, time_to_size(row, type, growth));
  return out;
}

}  // namespace

bool paced_by_phases(const CellCycle& cycle) {
  using Length = CyclePhase::Length;
  return !cycle.phases.empty() && cycle.control == SizeControl::kTimer &&
         std::ranges::none_of(cycle.phases, [](const CyclePhase& p) { return p.length == Length::kSize || p.length == Length::kPart; });
}

std::size_t last_growing_phase(const CellCycle& cycle) {
  for (std::size_t p = cycle.phases.size(); p-- > 0;)
    if (cycle.phases[p].grows) return p;
  return cycle.phases.size();
}

double draw_phase(const CyclePhase& phase, const Random& random, CellId cell, std::uint64_t& index) {
  switch (phase.length) {
    case CyclePhase::Length::kPart:
    case CyclePhase::Length::kSize:
      return 0.0;
    case CyclePhase::Length::kFixed:
      return phase.time.mean;
    case CyclePhase::Length::kGaussian:
      return draw_truncated(phase.time, random, cell, index);
    case CyclePhase::Length::kErlang:
      break;
  }
  double sum = 0.0;
  for (std::uint32_t k = 0; k < phase.stages; k += 2) {
    const RandomPair u = random.uniform(cell, index++);
    sum -= std::log(u.first);
    if (k + 1 < phase.stages) sum -= std::log(u.second);
  }
  return phase.time.mean / phase.stages * sum;
}

double phase_duration(const CellRow& row, const CellType& type, std::size_t number, std::uint32_t seed) {
  const CyclePhase& phase = type.cycle.phases[number];
  if (phase.length == CyclePhase::Length::kPart) return phase.time.mean * row.cycle_duration;
  std::uint64_t index = static_cast<std::uint64_t>(number) << 32;
  return draw_phase(phase, Random(seed, RandomStream::kPhaseDuration), row.id, index);
}

CyclePlace begin_cycle(CellState& row, const CellType& type, std::uint32_t seed, std::optional<double> mothers_duration) {
  const CellCycle& cycle = type.cycle;
  if (paced_by_phases(cycle)) {
    double growing = 0.0, all = 0.0;
    for (std::size_t p = 0; p < cycle.phases.size(); ++p) {
      const double time = phase_duration(row, type, p, seed);
      all += time;
      if (cycle.phases[p].grows) growing += time;
    }
    row.cycle_duration = growing > 0.0 ? growing : all;
  } else {
    const Random random(seed, RandomStream::kDivisionDuration);
    row.cycle_duration = mothers_duration ? draw_inherited(type.cycle_duration, *mothers_duration, random, row.id, row.draws)
                                          : draw_truncated(type.cycle_duration, random, row.id, row.draws);
  }
  row.division_volume = division_volume(row, type, seed);
  CyclePlace place;
  if (!cycle.phases.empty()) place.left = phase_duration(row, type, 0, seed);
  return place;
}

Growth pass_phases(CellRow& row, CyclePlace& place, const CellType& type, std::uint32_t seed, double dt, double growth,
                   const PhaseRate& rate) {
  const CellCycle& cycle = type.cycle;
  if (place.phase >= cycle.phases.size()) return {};  // quiescent
  for (double left = dt;;) {
    const bool grows = cycle.phases[place.phase].grows && may_grow(row, type);
    const double clock = rate(place.phase), own_growth = grows ? growth : 0.0;
    const double to_end = time_to_end(row, place, type, clock, own_growth);
    const bool ends = to_end <= left * (1.0 + kRounding) + kRounding * row.cycle_duration;
    const double time = ends ? std::min(to_end, left) : left;
    grow_for(row, type, time * own_growth);
    place.left = ends ? 0.0 : std::max(0.0, place.left - time * clock);
    left -= time;
    if (!ends) return {};
    if (place.phase + 1 == cycle.phases.size()) return {true, std::clamp(left, 0.0, dt)};
    ++place.phase;
    place.held = 0.0;
    place.left = phase_duration(row, type, place.phase, seed);
  }
}

Leaving leave_or_return(CyclePlace& place, const CellCycle& cycle, double dt, const PhaseRate& rate) {
  const Quiescence& rest = cycle.quiescence;
  const auto phase = static_cast<std::size_t>(rest.phase);
  const bool rests = place.phase == cycle.phases.size();
  if (rest.phase < 0 || (!rests && place.phase != phase)) return Leaving::kNo;
  const double factor = rate(phase);
  if (!(rests ? factor > rest.leave_above : factor < rest.enter_below)) {
    place.held = 0.0;
    return Leaving::kNo;
  }
  if (place.held < rest.hold * (1.0 - kRounding)) {  // it has held so long until now, and will during the coming step
    place.held += dt;
    return Leaving::kNo;
  }
  place.held = 0.0;
  place.phase = rests ? phase : cycle.phases.size();
  return rests ? Leaving::kReturns : Leaving::kLeaves;
}

}  // namespace morula
