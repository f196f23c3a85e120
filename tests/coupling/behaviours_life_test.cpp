#include "coupling/behaviours/life.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "coupling/behaviours/birth.h"
#include "coupling/behaviours/death.h"
#include "coupling/behaviours/division.h"
#include "tests/coupling/same_rows.h"

namespace morula {
namespace {

constexpr double kHour = 3600.0;

/// A population of spheres without mechanics.
struct Population {
  std::vector<CellState> rows;
  std::vector<CellType> types;
  std::vector<Event> events;
  double time = 0.0;
  std::uint64_t step = 0;

  void advance(double dt) {
    time += dt;
    Cells cells;
    Model model;
    model.fields.resize(2);
    cells.declare(cell_variables(model));
    for (const CellState& row : rows) cells.push_back(row);
    const LifeReport report = live(cells, types, {1, step++, time, dt});
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k] = cells.state(k);
    events.insert(events.end(), report.events.begin(), report.events.end());
    std::vector<CellState> next;
    auto division = report.divisions.begin();
    auto removal = report.removals.begin();
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (division != report.divisions.end() && division->row == k) {
        const auto out = divide_row(rows[k], {}, types[rows[k].type], 1, time, division->late, 0.5);
        next.push_back(out.first);
        next.push_back(out.second);
        ++division;
      } else if (removal != report.removals.end() && *removal == k) {
        ++removal;
      } else {
        next.push_back(rows[k]);
      }
    }
    rows = std::move(next);
  }
  void run_to(double end, double dt) {
    while (time < end - 1e-6) advance(std::min(dt, end - time));
  }
  [[nodiscard]] double volume() const {
    double sum = 0.0;
    for (const CellState& row : rows) sum += row.target_volume;
    return sum;
  }
};

CellType cycling(bool exponential = false) {
  CellType type;
  type.cycles = true;
  type.cycle.growth = growth_laws()[exponential ? 1 : 0];
  return type;
}

Population one_cell(const CellType& type) {
  Population population;
  population.types = {type};
  population.rows = {make_founder(CellId::founder(1), 0, type, 1, 0.0, false)};
  return population;
}

TEST(Life, DeterministicCycleDoublesAtEighteenHours) {
  for (const double dt : {60.0, 47.3, 600.0}) {
    Population population = one_cell(cycling());
    population.run_to(18 * kHour - 1.0, dt);
    EXPECT_EQ(population.rows.size(), 1u);
    population.run_to(18 * kHour, dt);
    EXPECT_EQ(population.rows.size(), 2u) << dt;
    population.run_to(36 * kHour - 1.0, dt);
    EXPECT_EQ(population.rows.size(), 2u);
    population.run_to(36 * kHour, dt);
    EXPECT_EQ(population.rows.size(), 4u) << dt;
    ASSERT_EQ(population.events.size(), 3u);
    EXPECT_EQ(population.events[0].kind, EventKind::kDivision);
    EXPECT_NEAR(population.events[0].time, 18 * kHour, 1e-3);
    EXPECT_EQ(population.events[0].second_daughter, CellId::founder(1).daughter(1));
  }
}

TEST(Life, TotalVolumeFollowsTheReferenceWhateverTheStep) {
  // Physics page, deterministic 18 h cycle: total volume/V_b at 12, 24, 48 h.
  const double linear[] = {1.666667, 2.666667, 6.666667};
  const double exponential[] = {1.587401, 2.519842, 6.349604};
  for (const bool law : {false, true}) {
    for (const double dt : {60.0, 1000.0}) {
      Population population = one_cell(cycling(law));
      const double start = population.volume();
      int k = 0;
      for (const double end : {12.0, 24.0, 48.0}) {
        population.run_to(end * kHour, dt);
        EXPECT_NEAR(population.volume() / start, (law ? exponential : linear)[k++], 1e-6) << dt;
      }
    }
  }
}

TEST(Life, VariableCyclesHaveTheKnownFirstDivision) {
  // Cycle 18 h with 5.5 % spread (four phases of 10 % each): 1000 cells divide at 18 h on average, ±0.1 h.
  CellType type = cycling();
  type.cycle_duration = {18 * kHour, 0.055};
  Population population;
  population.types = {type};
  for (int k = 1; k <= 1000; ++k) population.rows.push_back(make_founder(CellId::founder(k), 0, type, 1, 0.0, false));
  population.run_to(23 * kHour, 300.0);
  ASSERT_EQ(population.events.size(), 1000u);
  double mean = 0.0, squares = 0.0;
  for (const Event& event : population.events) mean += event.time / kHour / 1000;
  for (const Event& event : population.events) squares += std::pow(event.time / kHour - mean, 2) / 1000;
  EXPECT_NEAR(mean, 18.0, 0.1);
  EXPECT_NEAR(std::sqrt(squares), 0.99 * 0.9866, 0.09);  // deviation cut at ±3; four standard errors
}

TEST(Life, AShellThatIsToWaitDoesSoOnceAndDividesWhenItBecomesASphere) {
  CellType waits = cycling();
  waits.shells_divide = false;
  Population population = one_cell(waits);
  population.rows[0].body = BodyKind::kShell;
  population.run_to(20 * kHour, 600.0);
  ASSERT_EQ(population.events.size(), 1u);
  EXPECT_EQ(population.events[0].kind, EventKind::kDivisionWaits);
  EXPECT_EQ(population.rows[0].phase, Phase::kWaiting);
  EXPECT_EQ(population.rows[0].target_volume, population.rows[0].division_volume);
  population.rows[0].body = BodyKind::kSphere;
  population.advance(60.0);
  EXPECT_EQ(population.rows.size(), 2u);
  EXPECT_EQ(population.rows[0].birth_time, population.time);
}

TEST(Life, AShellDividesAsASphereDoes) {
  Population population = one_cell(cycling());
  population.rows[0].body = BodyKind::kShell;
  population.run_to(25 * kHour, 600.0);
  ASSERT_EQ(population.events.size(), 1u);
  EXPECT_EQ(population.events[0].kind, EventKind::kDivision);
  ASSERT_EQ(population.rows.size(), 2u);
  for (const CellState& row : population.rows) EXPECT_EQ(row.body, BodyKind::kShell);
}

TEST(Life, AShellThatFoundNoPlaneTriesAgainEveryTenMinutes) {
  CellType type = cycling();
  CellRow row = make_founder(CellId::founder(1), 0, type, 1, 0.0, false);
  row.body = BodyKind::kShell;
  row.phase = Phase::kWaiting;  // as the pipeline leaves it
  row.target_volume = row.division_volume;
  int tries = 0;
  double time = 90000.0;
  for (const double dt : {60.0, 240.0, 240.0, 60.0, 30.0, 570.0, 7.0, 1300.0}) {
    time += dt;
    LifeValues sides;
    const LifeDecision decision = live(row, sides, type, {.time = time, .dt = dt});
    EXPECT_TRUE(decision.kind == LifeDecision::Kind::kNone || decision.kind == LifeDecision::Kind::kDivide);
    const bool passes = std::floor(time / 600.0) > std::floor((time - dt) / 600.0);
    EXPECT_EQ(decision.kind == LifeDecision::Kind::kDivide, passes) << time;
    tries += decision.kind == LifeDecision::Kind::kDivide;
    EXPECT_EQ(row.phase, Phase::kWaiting);
  }
  EXPECT_EQ(tries, 3);
}

TEST(Life, TheLastGenerationWarnsOnceAndStays) {
  CellId id = CellId::founder(1);
  while (id.can_divide()) id = id.daughter(0);
  Population population = one_cell(cycling());
  population.rows[0].id = id;
  population.run_to(20 * kHour, 600.0);
  ASSERT_EQ(population.events.size(), 1u);
  EXPECT_EQ(population.events[0].kind, EventKind::kWarning);
  EXPECT_EQ(population.rows.size(), 1u);
}

TEST(Life, RestingCellsKeepTheirVolume) {
  CellType type;
  Population population = one_cell(type);
  const double before = population.volume();
  population.run_to(100 * kHour, 3600.0);
  EXPECT_EQ(population.volume(), before);
  EXPECT_TRUE(population.events.empty());
}

/// The type's cells die at this rate [1/s] where the concentration of the field is below a threshold [mM].
void starve(CellType& type, int field, double below, double rate) {
  OwnValues values;
  values.set("field", field), values.set_name("field", "oxygen"), values.set("below", below), values.set("rate", rate);
  type.behaviours = {CellBehaviour(starvation(), values, type.name)};
}

CellType starving(double rate = 5.31667e-5 / 60.0) {
  CellType type;
  starve(type, 1, 0.02, rate);
  return type;
}

TEST(Death, PoissonSurvivorsAfterNinetySixHours) {
  // μ = 5.31667e-5/min, 96 h: fraction 0.736210 (physics page), whatever the step. Four standard errors of a binomial.
  for (const double dt : {3600.0, 14400.0}) {
    CellType type = starving();
    type.removal_fraction = 1e-30;
    Population population;
    population.types = {type};
    const int n = 20000;
    for (int k = 1; k <= n; ++k) population.rows.push_back(make_founder(CellId::founder(k), 0, type, 1, 0.0, false));
    population.run_to(96 * kHour, dt);
    const auto alive =
        std::count_if(population.rows.begin(), population.rows.end(), [](const CellState& r) { return r.phase != Phase::kDying; });
    EXPECT_NEAR(static_cast<double>(alive) / n, 0.736210, 4 * std::sqrt(0.7362 * 0.2638 / n));
    EXPECT_EQ(population.events.size(), n - static_cast<std::size_t>(alive));
  }
}

TEST(Death, NeedsALackOfTheNamedField) {
  CellType type = starving(1e6);  // certain
  Cells cells;
  Model two_fields;
  two_fields.fields.resize(2);
  cells.declare(cell_variables(two_fields));
  cells.push_back(make_founder(CellId::founder(1), 0, type, 1, 0.0, false));
  const auto dies = [&] { return !live(cells, std::span(&type, 1), {1, 0, 60.0, 60.0}).events.empty(); };
  cells.variables[concentration_of(1)].values.set(0, 0.02);
  EXPECT_FALSE(dies()) << "the other fields are at 0";
  cells.variables[concentration_of(1)].values.set(0, 0.0199);
  EXPECT_TRUE(dies());
}

TEST(Death, ADyingCellShrinksAndIsRemovedAtItsFraction) {
  CellType type = starving(1e6);
  type.migration.speed = 0.01;
  Population population = one_cell(type);
  const double before = population.volume();
  population.advance(60.0);
  ASSERT_EQ(population.rows[0].phase, Phase::kDying);
  EXPECT_EQ(population.rows[0].migration_velocity, Vec3d{});
  const double death = population.time;
  EXPECT_EQ(population.rows[0].death_time, death);
  population.run_to(death + 8 * kHour, 60.0);
  EXPECT_NEAR(population.volume() / before, std::exp(-1.0), 1e-12);
  // 0.1 = e^(−t/τ): t = τ ln 10.
  const double end = death + 8 * kHour * std::log(10.0);
  population.run_to(end - 1.0, 60.0);
  EXPECT_EQ(population.rows.size(), 1u);
  population.run_to(end, 60.0);
  EXPECT_TRUE(population.rows.empty());
  ASSERT_EQ(population.events.size(), 2u);
  EXPECT_EQ(population.events[0].kind, EventKind::kDeath);
  EXPECT_EQ(population.events[1].kind, EventKind::kRemoval);
}

TEST(Life, DoesNotDependOnTheOrderOfCells) {
  CellType type = cycling();
  type.cycle_duration = {18 * kHour, 0.2};
  starve(type, 0, 1.0, 1e-6);
  type.migration.speed = 0.01;
  Population one;
  one.types = {type};
  for (int k = 1; k <= 200; ++k) one.rows.push_back(make_founder(CellId::founder(k), 0, type, 1, 0.0, true));
  Population other = one;
  std::shuffle(other.rows.begin(), other.rows.end(), std::mt19937(3));
  one.run_to(30 * kHour, 300.0);
  other.run_to(30 * kHour, 300.0);
  ASSERT_GT(one.rows.size(), 300u);
  ASSERT_EQ(one.rows.size(), other.rows.size());
  const auto by_id = [](const CellState& a, const CellState& b) { return a.id < b.id; };
  std::sort(one.rows.begin(), one.rows.end(), by_id);
  std::sort(other.rows.begin(), other.rows.end(), by_id);
  for (std::size_t k = 0; k < one.rows.size(); ++k) {
    EXPECT_TRUE(same_rows(one.rows[k], other.rows[k])) << one.rows[k].id.text();
  }
}

}  // namespace
}  // namespace morula
