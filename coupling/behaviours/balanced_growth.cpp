#include "coupling/behaviours/balanced_growth.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/ball.h"
#include "core/random/philox.h"
#include "coupling/behaviours/draw.h"

namespace morula {
namespace {

using Length = CyclePhase::Length;

/// Times of all phases of a cell. What ends by size gets the rest of the time that the cell needs to grow.
void add_time_to_size(const CellCycle& cycle, double time_to_grow, std::vector<double>& times) {
  const auto at = std::ranges::find(cycle.phases, Length::kSize, &CyclePhase::length);
  if (at == cycle.phases.end()) return;
  double others = 0.0;
  for (std::size_t p = 0; p < times.size(); ++p)
    if (cycle.phases[p].grows && cycle.phases[p].length != Length::kSize) others += times[p];
  times[static_cast<std::size_t>(at - cycle.phases.begin())] = std::max(0.0, time_to_grow - others);
}

/// A cell with the mean values of its type, of the birth volume at which a population of it settles.
CellState typical_cell(const CellType& type) {
  const double radius = type.radius.mean, birth = ball_volume(radius);
  CellState row;
  row.cycle_duration = type.cycle_duration.mean;
  switch (type.cycle.control) {
    case SizeControl::kTimer:
      row.birth_volume = birth, row.division_volume = type.cycle.ratio * birth;
      break;
    case SizeControl::kSizer:
      row.birth_volume = 0.5 * type.cycle.size, row.division_volume = type.cycle.size;
      break;
    case SizeControl::kAdder:
      row.birth_volume = type.cycle.size, row.division_volume = 2.0 * type.cycle.size;
      break;
  }
  row.target_volume = row.birth_volume;
  return row;
}

/// E[e^(−αT)] of a Gaussian that is truncated as draw_truncated() does: e^(−αm + c²/2) times what is left of a Gaussian shifted by c = αms, over what
/// is left of the unshifted one.
double gaussian_discount(const Distribution& time, double rate) {
  if (!(time.relative_spread > 0.0)) return std::exp(-rate * time.mean);
  const auto below = [](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); };
  const double low = std::max(-3.0, -1.0 / time.relative_spread), shift = rate * time.mean * time.relative_spread;
  return std::exp(-rate * time.mean + 0.5 * shift * shift) * (below(3.0 + shift) - below(low + shift)) / (below(3.0) - below(low));
}

/// M = E[e^(−αT)] of every phase.
std::vector<double> discounts(const CellType& type, double rate) {
  const CellCycle& cycle = type.cycle;
  const CellState typical = typical_cell(type);
  std::vector<double> times, out;
  for (const CyclePhase& phase : cycle.phases)
    times.push_back(phase.length == Length::kPart ? phase.time.mean * typical.cycle_duration : phase.time.mean);
  add_time_to_size(cycle, time_to_grow(typical, type), times);
  for (std::size_t p = 0; p < times.size(); ++p) {
    const CyclePhase& phase = cycle.phases[p];
    out.push_back(phase.length == Length::kGaussian ? gaussian_discount(phase.time, rate)
                  : phase.length == Length::kErlang ? std::pow(1.0 + rate * times[p] / phase.stages, -static_cast<double>(phase.stages))
                                                    : std::exp(-rate * times[p]));
  }
  return out;
}

/// Whether phases have times of their own, and are not parts of one that is drawn for the whole cycle.
bool has_own_times(const CellCycle& cycle) {
  return !cycle.phases.empty() && std::ranges::none_of(cycle.phases, [](const CyclePhase& p) { return p.length == Length::kPart; });
}

/// A point of a cell's life: its phase, and how long that has lasted, with the times of all its phases.
struct Lived {
  std::vector<double> times;
  std::size_t phase = 0;
  double in_phase = 0.0;
};

/// What follows from it for the row.
CyclePlace settle(CellState& row, const CellType& type, double time, const Lived& lived) {
  const CellCycle& cycle = type.cycle;
  double age = lived.in_phase, growing = cycle.phases[lived.phase].grows ? lived.in_phase : 0.0, all_growing = growing;
  for (std::size_t p = 0; p < lived.times.size(); ++p) {
    const double length = lived.times[p];
    if (p < lived.phase) age += length;
    if (!cycle.phases[p].grows) continue;
    if (p < lived.phase) growing += length;
    all_growing += p == lived.phase ? length - lived.in_phase : length;
  }
  if (paced_by_phases(cycle) && all_growing > 0.0) row.cycle_duration = all_growing;
  row.birth_time = time - age;
  row.target_volume = cycle.growth->after(growth_pace(row, type), cycle.growth_values, row.birth_volume, growing);
  if (cycle.growth->grows && lived.phase > last_growing_phase(cycle)) row.target_volume = row.division_volume;
  row.target_volume = std::min(row.target_volume, std::max(row.division_volume, row.birth_volume));
  CyclePlace place;
  place.phase = lived.phase;
  place.left = cycle.phases[lived.phase].length == Length::kSize ? 0.0 : lived.times[lived.phase] - lived.in_phase;
  return place;
}

std::vector<double> own_times(const CellRow& row, const CellType& type, std::uint32_t seed) {
  std::vector<double> out;
  for (std::size_t p = 0; p < type.cycle.phases.size(); ++p) out.push_back(phase_duration(row, type, p, seed));
  add_time_to_size(type.cycle, time_to_grow(row, type), out);
  return out;
}

/// Of a cycle without phases, or whose phases are parts of it.
CyclePlace settle_at_point(CellState& row, const CellType& type, double time, double point) {
  row.birth_time = time - point * time_to_grow(row, type);
  row.target_volume = volume_in_cycle(row, type, point);
  CyclePlace place;
  double begin = 0.0;
  for (std::size_t p = 0; p < type.cycle.phases.size(); ++p) {
    const double part = type.cycle.phases[p].time.mean;
    place = {p, std::max(0.0, begin + part - point) * row.cycle_duration, 0.0};
    begin += part;
    if (begin > point) break;
  }
  return place;
}

/// Numbers of the draws of one founder, which are rejected until one fits.
struct FounderDraws {
  Random random;
  CellId id;
  std::uint64_t index = 1;  // 0 is that of cycles without phases

  double uniform() { return random.uniform(id, index++).first; }
  /// The time of a phase with its law times e^(−αT), or times 1 − e^(−αT).
  double weighted(const CyclePhase& phase, double rate, bool is_present) {
    for (;;) {
      const double time = draw_phase(phase, random, id, index), kept = std::exp(-rate * time);
      if (phase.length == Length::kFixed || uniform() < (is_present ? 1.0 - kept : kept)) return time;
    }
  }
};

}  // namespace

double population_growth_rate(const CellType& type) {
  const double usual = std::numbers::ln2 / std::max(time_to_grow(typical_cell(type), type), 1e-9);
  if (!has_own_times(type.cycle)) return usual;
  // Σ ln M(α) falls from 0, nearly straight: the secant's steps.
  const auto excess = [&](double rate) {
    double sum = std::numbers::ln2;
    for (const double one : discounts(type, rate)) sum += std::log(one);
    return sum;
  };
  double before = 0.0, at_before = std::numbers::ln2, rate = usual;
  for (int k = 0; k < 50; ++k) {
    const double here = excess(rate), step = here * (rate - before) / (at_before - here);
    if (!(std::abs(step) > 1e-14 * rate)) break;
    before = rate, at_before = here, rate += step;
  }
  return rate;
}

CyclePlace settle_in_balanced_growth(CellState& row, const CellType& type, std::uint32_t seed, double time) {
  const Random random(seed, RandomStream::kInitialPhase);
  const double u = random.uniform(row.id, 0).first;
  if (!has_own_times(type.cycle)) return settle_at_point(row, type, time, balanced_growth_age(u));
  const std::vector<CyclePhase>& phases = type.cycle.phases;
  const double rate = population_growth_rate(type);
  const std::vector<double> discount = discounts(type, rate);
  Lived lived{own_times(row, type, seed)};
  double behind = 1.0, left = 0.5 * u;  // Σ (1 − M_p) Π M_q = ½
  for (; lived.phase + 1 < phases.size() && left >= behind * (1.0 - discount[lived.phase]); ++lived.phase) {
    left -= behind * (1.0 - discount[lived.phase]);
    behind *= discount[lived.phase];
  }
  FounderDraws draws{random, row.id};
  for (std::size_t p = 0; p <= lived.phase; ++p)
    if (phases[p].length != Length::kSize) lived.times[p] = draws.weighted(phases[p], rate, p == lived.phase);
  const double present = lived.times[lived.phase];
  lived.in_phase = std::min(present, -std::log1p(draws.uniform() * std::expm1(-rate * present)) / rate);
  return settle(row, type, time, lived);
}

CyclePlace settle_at(CellState& row, const CellType& type, std::uint32_t seed, double time, double point) {
  if (!has_own_times(type.cycle)) return settle_at_point(row, type, time, point);
  Lived lived{own_times(row, type, seed)};
  double left = 0.0;
  for (const double one : lived.times) left += point * one;
  for (; lived.phase + 1 < lived.times.size() && left >= lived.times[lived.phase]; ++lived.phase) left -= lived.times[lived.phase];
  lived.in_phase = std::min(left, lived.times[lived.phase]);
  return settle(row, type, time, lived);
}

}  // namespace morula
