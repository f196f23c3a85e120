// Phases of the cycle, control of size and ages of founders: populations of cells without bodies. Numbers: physics/cbm.md §5.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "coupling/behaviours/balanced_growth.h"
#include "coupling/behaviours/birth.h"
#include "coupling/behaviours/division.h"
#include "coupling/behaviours/division_axis.h"
#include "coupling/behaviours/life.h"
#include "coupling/behaviours/phases.h"

namespace morula {
namespace {

constexpr double kHour = 3600.0;
using Length = CyclePhase::Length;

/// G1, S, G2, M of 7, 6, 3 and 2 h.
CellType four_phases(Length length = Length::kFixed, std::uint32_t stages = 1, double spread = 0.0) {
  CellType type;
  type.cycles = true;
  for (const auto& [name, hours] : {std::pair("G1", 7.0), {"S", 6.0}, {"G2", 3.0}, {"M", 2.0}})
    type.cycle.phases.push_back({.name = name, .length = length, .time = {hours * kHour, spread}, .stages = stages});
  return type;
}

struct Population {
  struct Life {
    double birth_volume, division_volume, time;
  };
  Model model;
  Cells cells;
  std::vector<Life> divisions;
  std::map<EventKind, int> events;
  double time = 0.0;
  std::uint64_t step = 0;

  Population(const CellType& type, std::uint64_t founders, bool random_age) {
    model.types = {type};
    cells.declare(cell_variables(model));
    for (std::uint64_t k = 1; k <= founders; ++k) cells.push_back(make_founder(CellId::founder(k), 0, type, model.seed, 0.0, random_age));
  }

  void advance(double dt) {
    time += dt;
    const LifeReport report = live(cells, model.types, {.seed = model.seed, .step = step++, .time = time, .dt = dt});
    for (const Event& event : report.events) ++events[event.kind];
    if (report.divisions.empty()) return;
    Cells next;
    next.declare(cell_variables(model));
    next.rows.reserve(cells.size() + report.divisions.size());
    auto order = report.divisions.begin();
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const CellState row = cells.state(k);
      if (order == report.divisions.end() || order->row != k) {
        next.push_back(row);
        continue;
      }
      const CellType& type = model.types[row.type];
      const double share = division_share({row, type}, model.seed);
      const DaughterRows daughters = divide_row(row, cells.variables, type, model.seed, time, order->late, share);
      divisions.push_back({row.birth_volume, row.target_volume, time - order->late});
      next.push_back(daughters.first);
      next.push_back(daughters.second);
      ++order;
    }
    cells = std::move(next);
  }
  void run_to(double end, double dt) {
    while (time < end - 1e-6) advance(std::min(dt, end - time));
  }
  [[nodiscard]] double count() const { return static_cast<double>(cells.size()); }
  [[nodiscard]] double volume() const {
    double sum = 0.0;
    for (const CellRow& row : cells.rows) sum += row.target_volume;
    return sum;
  }
  /// Parts of the cells in each phase; the last: quiescent.
  [[nodiscard]] std::vector<double> fractions() const {
    std::vector<double> out(model.types[0].cycle.phases.size() + 1, 0.0);
    for (std::size_t k = 0; k < cells.size(); ++k) out[static_cast<std::size_t>(cells.state(k).variable(0))] += 1.0 / count();
    return out;
  }
  /// Slope of the division volume against the birth volume, of cells that were born in the run.
  [[nodiscard]] double slope() const {
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (std::size_t k = divisions.size() / 4; k < divisions.size(); ++k) {
      const double a = divisions[k].birth_volume, b = divisions[k].division_volume;
      n += 1.0, x += a, y += b, xx += a * a, xy += a * b;
    }
    return (n * xy - x * y) / (n * xx - x * x);
  }
};

TEST(Phases, GrowAndDivideOnTheClockWhateverTheSteps) {
  // physics/cbm.md §5: N = 1, 2, 4 at 0, 18, 36 h; total volume over V_b at 12, 24, 48 h.
  const double linear[] = {1.666667, 2.666667, 6.666667}, exponential[] = {1.587401, 2.519842, 6.349604};
  for (const bool law : {false, true})
    for (const double dt : {60.0, 1800.0, 7000.0, 12 * kHour}) {
      CellType type = four_phases();
      type.cycle.growth = growth_laws()[law ? 1 : 0];
      Population population(type, 1, false);
      const double birth = population.volume();
      int k = 0;
      for (const double hours : {12.0, 24.0, 48.0}) {
        population.run_to(hours * kHour, dt);
        EXPECT_NEAR(population.volume() / birth, (law ? exponential : linear)[k++], 1e-6) << dt;
      }
      EXPECT_EQ(population.count(), 4.0);
      ASSERT_EQ(population.divisions.size(), 3u);
      EXPECT_NEAR(population.divisions[0].time, 18 * kHour, 1e-3) << dt;
      EXPECT_NEAR(population.divisions[1].time, 36 * kHour, 1e-3) << dt;
    }
}

TEST(Phases, WithoutTimesOfTheirOwnAreTheCycleWithoutPhases) {
  CellType plain, parts;
  plain.cycles = parts.cycles = true;
  plain.cycle_duration = parts.cycle_duration = {18 * kHour, 0.1};
  for (const auto& [name, part] : {std::pair("G1", 7.0), {"S", 6.0}, {"G2", 3.0}, {"M", 2.0}})
    parts.cycle.phases.push_back({.name = name, .length = Length::kPart, .time = {part / 18.0, 0.0}});
  Population one(plain, 50, true), other(parts, 50, true);
  for (std::size_t k = 0; k < 50; ++k) {
    EXPECT_EQ(one.cells.rows[k].target_volume, other.cells.rows[k].target_volume);
    EXPECT_EQ(one.cells.rows[k].birth_time, other.cells.rows[k].birth_time);
  }
  one.run_to(40 * kHour, 600.0);
  other.run_to(40 * kHour, 600.0);
  ASSERT_EQ(one.divisions.size(), other.divisions.size());
  for (std::size_t k = 0; k < one.divisions.size(); ++k) EXPECT_NEAR(one.divisions[k].time, other.divisions[k].time, 1e-3);
}

TEST(Phases, LetCellsGrowOnlyWhereTheyGrow) {
  CellType type = four_phases();
  type.cycle.phases[3].grows = false;
  Population population(type, 1, false);
  const double birth = population.volume();
  population.run_to(12 * kHour, 600.0);
  EXPECT_NEAR(population.volume() / birth, 1.75, 1e-9);  // 12 of 16 h
  population.run_to(17 * kHour, 600.0);
  EXPECT_NEAR(population.volume() / birth, 2.0, 1e-9);
  EXPECT_EQ(population.count(), 1.0);
  population.run_to(18.5 * kHour, 600.0);
  EXPECT_EQ(population.count(), 2.0);
  EXPECT_NEAR(population.divisions[0].time, 18 * kHour, 1e-3);
}

TEST(Phases, WithoutGrowthHalveTheCells) {
  CellType type = four_phases();
  type.cycle.growth = growth_laws().back();
  ASSERT_FALSE(type.cycle.growth->grows);
  Population population(type, 1, false);
  const double birth = population.volume();
  population.run_to(54.5 * kHour, 600.0);
  EXPECT_EQ(population.count(), 8.0);
  EXPECT_NEAR(population.volume(), birth, 1e-12 * birth);
}

TEST(Phases, HaveTheMeanAndTheSpreadOfTheirLaw) {
  struct Case {
    Length length;
    std::uint32_t stages;
    double spread, deviation;
  };
  // Of a Gaussian cut at three deviations 0.9866 is left; of Erlang 1/√k.
  for (const Case& one : {Case{Length::kFixed, 1, 0.0, 0.0},
                          {Length::kGaussian, 1, 0.2, 0.2 * 0.98658},
                          {Length::kErlang, 1, 0.0, 1.0},
                          {Length::kErlang, 10, 0.0, std::sqrt(0.1)},
                          {Length::kErlang, 7, 0.0, std::sqrt(1.0 / 7.0)}}) {
    const CellType type = four_phases(one.length, one.stages, one.spread);
    double sum = 0.0, squares = 0.0;
    const int n = 20000;
    for (int k = 1; k <= n; ++k) {
      CellRow row;
      row.id = CellId::founder(k);
      const double hours = phase_duration(row, type, 1, 3) / kHour;
      ASSERT_GT(hours, 0.0);
      EXPECT_EQ(hours, phase_duration(row, type, 1, 3) / kHour);
      sum += hours / n, squares += hours * hours / n;
    }
    const double deviation = std::sqrt(std::max(0.0, squares - sum * sum)) / 6.0;
    EXPECT_NEAR(sum, 6.0, 4.0 * 6.0 * one.deviation / std::sqrt(n) + 1e-9);
    EXPECT_NEAR(deviation, one.deviation, 0.04 * one.deviation + 1e-6);
  }
}

/// α [1/h] and phase fractions: tests/reference/cycle.py.
struct Balanced {
  CellType type;
  double rate;
  std::vector<double> fractions;
};

std::vector<Balanced> balanced() {
  return {{four_phases(), 0.0385082, {0.472565, 0.315109, 0.132266, 0.080060}},
          {four_phases(Length::kErlang, 1), 0.0427719, {0.460832, 0.314332, 0.139292, 0.085544}},
          {four_phases(Length::kErlang, 10), 0.0389140, {0.471338, 0.315060, 0.132991, 0.080611}},
          {four_phases(Length::kGaussian, 1, 0.1), 0.0385475, {0.472445, 0.315105, 0.132337, 0.080114}}};
}

TEST(BalancedGrowth, HasTheKnownRates) {
  for (const Balanced& one : balanced()) EXPECT_NEAR(population_growth_rate(one.type) * kHour, one.rate, 1e-6);
}

TEST(BalancedGrowth, IsWhatFoundersBeginWith) {
  for (const Balanced& one : balanced()) {
    Population population(one.type, 16000, true);
    const auto start = population.fractions();
    for (std::size_t p = 0; p < 4; ++p) EXPECT_NEAR(start[p], one.fractions[p], 0.01) << one.rate << ' ' << p;
    // No wave goes through it: it grows by the same rate from the beginning, and every fraction stays.
    for (const double hours : {1.0, 3.0, 6.0, 9.0, 13.0, 19.0}) {
      population.run_to(hours * kHour, 1800.0);
      EXPECT_NEAR(population.count() / 16000.0, std::exp(one.rate * hours), 0.012 * std::exp(one.rate * hours)) << one.rate << ' ' << hours;
    }
    const auto end = population.fractions();
    for (std::size_t p = 0; p < 4; ++p) EXPECT_NEAR(end[p], one.fractions[p], 0.01) << one.rate << ' ' << p;
  }
}

TEST(BalancedGrowth, ComesOutOfAnyStart) {
  // 400 founders at birth; the waves of the first cycles die out where phases vary. Rate over the last 36 h.
  for (const Balanced& one : balanced()) {
    const bool varies = one.type.cycle.phases[0].length == Length::kErlang;
    Population population(one.type, 400, !varies);
    const double first = varies ? 84.0 : 36.0;
    population.run_to(first * kHour, 1800.0);
    const double before = population.count();
    population.run_to((first + 36.0) * kHour, 1800.0);
    EXPECT_NEAR(std::log(population.count() / before) / 36.0, one.rate, 0.01 * one.rate);
  }
}

TEST(BalancedGrowth, GivesFoundersTheVolumeOfTheirAge) {
  // Linear growth: mean V_b/ln 2, and each daughter is half of her mother at the end.
  Population population(four_phases(), 20000, true);
  const double birth = population.cells.rows[0].birth_volume;
  EXPECT_NEAR(population.volume() / 20000.0 / birth, 1.442695, 0.01);
  for (std::size_t k = 0; k < 200; ++k) {
    const CellState row = population.cells.state(k);
    const double point = -row.birth_time / (18 * kHour);
    EXPECT_NEAR(row.target_volume / birth, 1.0 + point, 1e-9);
    const double begin[] = {0.0, 7.0, 13.0, 16.0, 18.0};
    const auto phase = static_cast<std::size_t>(row.variable(0));
    EXPECT_NEAR(row.variable(1), begin[phase + 1] * kHour + row.birth_time, 1e-6);
  }
}

/// Adder, sizer and timer with unequal daughters.
CellType controlled(SizeControl control, bool phases) {
  CellType type;
  type.cycles = true;
  type.division_share = {0.5, 0.15};
  type.cycle_duration = {18 * kHour, 0.05};
  type.cycle.growth = growth_laws()[1];
  type.cycle.control = control;
  type.cycle.size = (control == SizeControl::kSizer ? 2.0 : 1.0) * 4.0 / 3.0 * 3.14159265358979 * 216.0;
  type.cycle.size_spread = 0.05;
  if (phases) {
    type.cycle.phases = {{.name = "G1", .length = Length::kSize},
                         {.name = "M", .length = Length::kGaussian, .time = {2 * kHour, 0.1}, .grows = false}};
  }
  return type;
}

TEST(SizeControl, HasTheSlopeOfItsKind) {
  for (const bool phases : {false, true})
    for (const auto& [control, slope] : {std::pair(SizeControl::kSizer, 0.0), {SizeControl::kAdder, 1.0}, {SizeControl::kTimer, 2.0}}) {
      Population population(controlled(control, phases), 400, true);
      population.run_to(80 * kHour, 1800.0);
      EXPECT_GT(population.divisions.size(), 3000u);
      EXPECT_NEAR(population.slope(), slope, 0.05) << phases << ' ' << slope;
    }
}

TEST(SizeControl, KeepsTheMeanSizeAndTheRateOfGrowth) {
  for (const SizeControl control : {SizeControl::kSizer, SizeControl::kAdder}) {
    Population population(controlled(control, false), 1000, true);
    const double start = population.volume() / population.count();
    population.run_to(54 * kHour, 1800.0);
    EXPECT_NEAR(std::log(population.count() / 1000.0) / 54.0, 0.0385082, 0.01 * 0.0385082);
    EXPECT_NEAR(population.volume() / population.count() / start, 1.0, 0.02);
  }
}

TEST(SizeControl, DividesByTheRatio) {
  CellType type;
  type.cycles = true;
  type.cycle.ratio = 1.5;
  Population population(type, 1, false);
  population.run_to(18.5 * kHour, 600.0);
  ASSERT_EQ(population.divisions.size(), 1u);
  EXPECT_NEAR(population.divisions[0].division_volume / population.divisions[0].birth_volume, 1.5, 1e-12);
  EXPECT_NEAR(population.divisions[0].time, 18 * kHour, 1e-3);
}

/// A factor of the pressure of a cell.
CellArrest by_pressure(double from, double to) {
  OwnValues values;
  values.set("from", from), values.set("to", to);
  return {builtin_arrest_factors()[0], values};
}

TEST(Arrest, HoldsGrowthBackAndCellsDoNotBecomeSmaller) {
  CellType type = four_phases();
  type.cycle.arrest = {by_pressure(0.2, 0.8)};
  for (const auto& [pressure, rate] : {std::pair(0.1, 1.0), {0.5, 0.5}, {0.65, 0.25}, {0.8, 0.0}, {2.0, 0.0}}) {
    Population population(type, 1, false);
    population.cells.rows[0].pressure = pressure;
    const double birth = population.volume();
    population.run_to(6 * kHour, 600.0);
    EXPECT_NEAR(population.volume() / birth, 1.0 + rate / 3.0, 1e-9) << pressure;
    population.run_to(17.9 * kHour, 600.0);
    EXPECT_EQ(population.count(), 1.0);
    if (rate ==
        0.5) {  // the pressure stays, in the daughters, too: they have half of their growth in the cycle of 18 h before M waits for it
      population.run_to(36.1 * kHour, 600.0);
      EXPECT_EQ(population.count(), 2.0);
      EXPECT_NEAR(population.divisions[0].time, 36 * kHour, 1e-3);
      EXPECT_NEAR(population.divisions[0].division_volume / birth, 2.0, 1e-12);
    }
  }
}

TEST(Arrest, HoldsAPhaseBack) {
  CellType type = four_phases();
  type.cycle.phases[0].arrest = {by_pressure(0.2, 0.8)};
  Population population(type, 1, false);
  population.cells.rows[0].pressure = 0.8;
  population.run_to(40 * kHour, 600.0);
  EXPECT_EQ(population.fractions()[0], 1.0) << "the clock of G1 stands";
  EXPECT_EQ(population.cells.rows[0].target_volume, population.cells.rows[0].division_volume) << "growth does not, and ends";
  population.cells.rows[0].pressure = 0.5;
  population.run_to(53.9 * kHour, 600.0);
  EXPECT_EQ(population.fractions()[0], 1.0);
  population.run_to(54.1 * kHour, 600.0);
  EXPECT_EQ(population.fractions()[1], 1.0) << "7 h of G1 at half the rate";
}

TEST(Quiescence, IsEnteredAndLeftAfterTheHold) {
  CellType type = four_phases();
  type.cycle.phases[0].arrest = {by_pressure(0.2, 0.8)};
  type.cycle.quiescence = {0, 0.1, 0.5, kHour};
  Population population(type, 1, false);
  const auto at = [&] { return population.cells.state(0); };
  population.run_to(2 * kHour, 600.0);
  population.cells.rows[0].pressure = 0.79;
  population.run_to(2.8 * kHour, 600.0);
  EXPECT_EQ(at().variable(0), 0.0);
  population.run_to(3.2 * kHour, 600.0);  // a step begins after the hour
  EXPECT_EQ(at().variable(0), 4.0) << "G0";
  EXPECT_EQ(population.events[EventKind::kQuiescence], 1);
  const double volume = population.volume(), left = at().variable(1);
  population.run_to(30 * kHour, 600.0);
  EXPECT_EQ(population.volume(), volume);
  population.cells.rows[0].pressure = 0.6;  // a factor of a third: not enough
  population.run_to(33 * kHour, 600.0);
  EXPECT_EQ(at().variable(0), 4.0);
  population.cells.rows[0].pressure = 0.0;
  population.run_to(33.9 * kHour, 600.0);
  EXPECT_EQ(at().variable(0), 4.0);
  EXPECT_EQ(at().variable(1), left);
  population.run_to(34.2 * kHour, 600.0);
  EXPECT_EQ(at().variable(0), 0.0);
  EXPECT_EQ(population.events[EventKind::kReturn], 1);
  population.run_to(60 * kHour, 600.0);
  EXPECT_EQ(population.count(), 2.0);
}

TEST(CycleVariables, ThereAreNoneWherePhasesAreNot) {
  Model model;
  model.types.resize(1);
  EXPECT_TRUE(cell_variables(model).empty());
  model.types[0] = four_phases();
  EXPECT_EQ(cell_variables(model).size(), 3u);
}

/// What holds a cell back is looked at when a step begins: after ten minutes of it a cell leaves, however long the steps are.
TEST(Quiescence, BeginsWhenItsConditionHasHeldAsLongAsIsSaid) {
  CellType type = four_phases();
  type.cycle.quiescence = {.phase = 0, .enter_below = 0.5, .leave_above = 0.7, .hold = 600.0};
  for (const double dt : {5.0, 60.0, 600.0}) {
    CyclePlace place{.phase = 0, .left = 3600.0};
    double time = 0.0;
    while (leave_or_return(place, type.cycle, dt, [](std::size_t) { return 0.1; }) == Leaving::kNo && time < 1e4) time += dt;
    EXPECT_NEAR(time, 600.0, 1e-6) << dt;
    EXPECT_EQ(place.phase, type.cycle.phases.size());
    for (time = 0.0; leave_or_return(place, type.cycle, dt, [](std::size_t) { return 0.9; }) == Leaving::kNo && time < 1e4;) time += dt;
    EXPECT_NEAR(time, 600.0, 1e-6) << dt;
    EXPECT_EQ(place.phase, 0u);
    EXPECT_EQ(place.left, 3600.0) << "what was left of it";
  }
}

}  // namespace
}  // namespace morula
