// What a behaviour may ask of a cell, and what it may look at.
#include <gtest/gtest.h>

#include <cmath>

#include "coupling/behaviours/ask.h"
#include "coupling/behaviours/birth.h"

namespace morula {
namespace {

/// A type whose cells do this in every step.
template <class Act>
CellType that(Act, std::vector<BehaviourVariable> variables = {}) {
  const auto behaviour = std::make_shared<const Behaviour>(
      Behaviour{.info = {.name = "that", .title = "That", .equation = "", .source = "a test", .parameters = {}},
                .section = {},
                .variables = std::move(variables),
                .build = [](const OwnValues&) -> Behave { return Act{}; }});
  CellType type;
  type.cycles = true;
  type.behaviours.emplace_back(behaviour, OwnValues{}, "cell");
  return type;
}

/// Cells of a type of their own, at birth at time 0.
struct Living {
  Model model;
  Cells cells;
  std::uint64_t steps = 0;

  explicit Living(const CellType& type, std::uint64_t count = 1) {
    model.types = {type};
    cells.declare(cell_variables(model));
    for (std::uint64_t k = 1; k <= count; ++k) cells.push_back(make_founder(CellId::founder(k), 0, type, 1, 0.0, false));
  }
  LifeReport advance(double dt) {
    const LifeStep step{1, steps, dt * static_cast<double>(steps + 1), dt};
    ++steps;
    return live(cells, model.types, step);
  }
};

TEST(Behaviours, SetTheRateOfGrowth) {
  Living half(that([](const CellStep&, CellWish&wish) { wish.growth = 0.5; })),
      none(that([](const CellStep&, CellWish&w) { w.growth = 0.0; }));
  const double birth = half.cells.rows[0].birth_volume, cycle = half.cells.rows[0].cycle_duration;
  for (int k = 0; k < 10; ++k) half.advance(600.0), none.advance(600.0);
  EXPECT_NEAR(half.cells.rows[0].target_volume, birth * (1.0 + 0.5 * 6000.0 / cycle), 1e-9 * birth);
  EXPECT_EQ(none.cells.rows[0].target_volume, birth);
  LifeReport report;
  while (report.divisions.empty()) report = half.advance(700.0);
  const double time = 6000.0 + 700.0 * static_cast<double>(half.steps - 10);
  EXPECT_NEAR(time - report.divisions[0].late, 2.0 * cycle, 1e-6 * cycle) << "the moment within the step is that of the slower growth";
}

TEST(Behaviours, LetACellDivideOrDieOrChangeItsVolume) {
  Living divides(that([](const CellStep&, CellWish& wish) { wish.divide = true; }));
  const LifeReport report = divides.advance(60.0);
  ASSERT_EQ(report.divisions.size(), 1u);
  EXPECT_EQ(report.divisions[0].late, 0.0);
  Living dies(that([](const CellStep& step, CellWish& wish) { wish.die = step.number == 1; }));
  EXPECT_TRUE(dies.advance(60.0).events.empty());
  const LifeReport death = dies.advance(60.0);
  ASSERT_EQ(death.events.size(), 1u);
  EXPECT_EQ(death.events[0].reason.cause, EventReason::Cause::kBehaviour);
  EXPECT_EQ(dies.cells.rows[0].phase, Phase::kDying);
  Living swells(that([](const CellStep&, CellWish& wish) { wish.volume = 1.5, wish.growth = 0.0; }));
  swells.advance(60.0);
  EXPECT_DOUBLE_EQ(swells.cells.rows[0].target_volume, 1.5 * swells.cells.rows[0].birth_volume);
}

TEST(Behaviours, TurnTheCellAndSetItsSpeed) {
  CellType type = that([](const CellStep&, CellWish& wish) { wish.polarity = Vec3d{0, 3, 0}, wish.migration = 0.0; });
  type.polarity.set = true;
  type.migration.speed = 0.01;
  type.migration.own.set("persistence", 60.0);
  Living turns(type);
  const double before = norm(turns.cells.optional.migration_velocity[0]);
  turns.advance(60.0);
  EXPECT_EQ(turns.cells.optional.polarity[0], (Vec3d{0, 1, 0}));
  EXPECT_NEAR(norm(turns.cells.optional.migration_velocity[0]), before * std::exp(-1.0), 1e-12) << "what is left of the speed before";
}

TEST(Behaviours, RememberAndSeeOnlyTheirOwnCell) {
  Living counts(that([](const CellStep& step, CellWish&) { step.state[1] += static_cast<double>(step.cell.row().id.bits()) * step.dt; },
                     {{.name = "never"}, {.name = "sum", .unit = "s", .shared = true}}),
                3000);  // many: several threads
  ASSERT_EQ(counts.cells.variables.size(), 2u);
  EXPECT_EQ(counts.cells.variables[1].what, (CellVariable{"that/sum", "s", AtDivision::kShared, true}));
  for (int k = 0; k < 3; ++k) counts.advance(2.0);
  for (std::size_t k = 0; k < counts.cells.size(); ++k) {
    ASSERT_EQ(counts.cells.variables[0].values[k], 0.0);
    ASSERT_EQ(counts.cells.variables[1].values[k], 6.0 * static_cast<double>(counts.cells.rows[k].id.bits()));
  }
}

TEST(Behaviours, DrawFromAStreamOfTheirOwn) {
  // A Poisson process: 1 − e^(−rate·dt) of the cells in one step, whatever the number of cells before; four standard errors.
  Living some(that([](const CellStep& step, CellWish& wish) { wish.die = step.happens(0.01); }), 20000);
  const double part = static_cast<double>(some.advance(50.0).events.size()) / 20000.0, expected = 1.0 - std::exp(-0.5);
  EXPECT_NEAR(part, expected, 4.0 * std::sqrt(expected * (1.0 - expected) / 20000.0));
  Living other(that([](const CellStep& step, CellWish& wish) { wish.die = step.uniform(1).first < 0.5 && step.uniform(0).first >= 0.5; }),
               20000);
  EXPECT_NEAR(static_cast<double>(other.advance(50.0).events.size()) / 20000.0, 0.25, 4.0 * std::sqrt(0.25 * 0.75 / 20000.0))
      << "draws of one step are independent";
}

}  // namespace
}  // namespace morula
