#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "core/random/philox.h"
#include "fields/field_solver.h"
#include "tests/fields/helpers.h"

namespace morula::fields {
namespace {

/// A hard case: partial bricks, one periodic axis, faces with values, decay, two types, implicit and explicit intervals.
struct Case {
  Space space;
  FieldSpec spec;
  std::vector<CellSource> cells;  ///< all of them

  explicit Case(std::array<double, 3> size) {
    space.box = {{-20, 0, 10}, {-20 + size[0], size[1], 10 + size[2]}};
    space.boundary[1] = {BoundaryKind::kPeriodic, BoundaryKind::kPeriodic};
    spec.name = "oxygen";
    spec.diffusion = 1500.0;
    spec.initial = 0.2;
    spec.voxel = 10.0;
    spec.boundary[0] = {FaceCondition{FaceCondition::Kind::kValue, 0.2}, FaceCondition{FaceCondition::Kind::kNoFlux, 0.0}};
    spec.boundary[2] = {FaceCondition{FaceCondition::Kind::kNoFlux, 0.0}, FaceCondition{FaceCondition::Kind::kValue, 0.15}};
    spec.reactions = {fields::test::decay_of(0.002), fields::test::uptake_of(40.0, 0.005), fields::test::uptake_of(90.0, 0.02, 1)};
    const Random random(11, RandomStream::kInitialPosition);
    for (std::uint64_t i = 1; i <= 120; ++i) {
      const CellId id = CellId::founder(i);
      const auto a = random.uniform(id, 0), b = random.uniform(id, 1);
      const Vec3d low = space.box.low;
      cells.push_back({id,
                       static_cast<std::uint16_t>(i % 2),
                       {low.x + a.first * size[0], low.y + a.second * size[1], low.z + b.first * size[2]},
                       3.0 + 6.0 * b.second});
    }
  }
};

/// What a run leaves, by name: values by brick, amounts by cell.
struct Outcome {
  std::map<std::int64_t, std::vector<double>> bricks;
  std::map<std::uint64_t, std::array<double, 2>> cells;  ///< taken, seen
  std::vector<IntervalReport> reports;
  double next_step = 0.0;
};

/// Cells that this rank has: by number, so that many touch voxels of other ranks.
std::vector<CellSource> cells_of_rank(const Case& c, const Comm& comm) {
  std::vector<CellSource> out;
  for (std::size_t i = 0; i < c.cells.size(); ++i)
    if (static_cast<int>(i * 7 % static_cast<std::size_t>(comm.size())) == comm.rank()) out.push_back(c.cells[i]);
  return out;
}

Outcome run(const Case& c, const Comm& comm, bool move_bricks) {
  const Grid grid = grid_for(c.spec, c.space).value();
  auto owner = owners_along_curve(grid, comm.size());
  Field field = uniform_field(grid, c.spec.initial, owner, comm.rank());
  const auto cells = cells_of_rank(c, comm);
  std::vector<double> taken(cells.size()), seen(cells.size()), sum(cells.size(), 0.0);
  Outcome out;
  FieldSolver solver;
  for (const double interval : {0.02, 20.0, 0.02, 45.0}) {
    auto report = solver.advance(field, c.spec, c.space, cells, interval, comm, taken, seen);
    EXPECT_TRUE(report.ok()) << report.error().message;
    if (!report.ok()) return out;
    out.reports.push_back(*report);
    for (std::size_t i = 0; i < cells.size(); ++i) sum[i] += taken[i];
    if (move_bricks) {
      std::rotate(owner.begin(), owner.begin() + 1, owner.end());
      redistribute(field, owner, comm);
    }
  }
  for (std::size_t b = 0; b < field.owned_bricks.size(); ++b) out.bricks[field.owned_bricks[b]] = field.concentration[b];
  for (std::size_t i = 0; i < cells.size(); ++i) out.cells[cells[i].id.bits()] = {sum[i], seen[i]};
  out.next_step = field.next_step;
  return out;
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

void expect_part_of(const Outcome& part, const Outcome& whole) {
  EXPECT_TRUE(same_bits(part.next_step, whole.next_step));
  for (const auto& [brick, values] : part.bricks) {
    const auto& expected = whole.bricks.at(brick);
    ASSERT_EQ(values.size(), expected.size());
    for (std::size_t i = 0; i < values.size(); ++i) ASSERT_TRUE(same_bits(values[i], expected[i])) << "brick " << brick << " voxel " << i;
  }
  for (const auto& [id, amounts] : part.cells) {
    ASSERT_TRUE(same_bits(amounts[0], whole.cells.at(id)[0])) << "taken by " << CellId(id).text();
    ASSERT_TRUE(same_bits(amounts[1], whole.cells.at(id)[1])) << "seen by " << CellId(id).text();
  }
  ASSERT_EQ(part.reports.size(), whole.reports.size());
  for (std::size_t i = 0; i < part.reports.size(); ++i) {
    const auto &a = part.reports[i], &b = whole.reports[i];
    EXPECT_EQ(a.work.method, b.work.method);
    EXPECT_EQ(a.work.steps, b.work.steps);
    EXPECT_EQ(a.work.evaluations, b.work.evaluations);
    EXPECT_EQ(a.work.linear_iterations, b.work.linear_iterations);
    for (const auto& [x, y] : {std::pair{a.taken, b.taken},
                               {a.decayed, b.decayed},
                               {a.total_inflow(), b.total_inflow()},
                               {a.amount_after, b.amount_after},
                               {a.minimum, b.minimum},
                               {a.maximum, b.maximum},
                               {a.residual, b.residual}})
      EXPECT_TRUE(same_bits(x, y)) << x << " " << y;
  }
}

TEST(FieldsOnRanks, GiveTheBitsOfOneRank) {
  const Comm world(MPI_COMM_WORLD), self(MPI_COMM_SELF);
  const Case c({210.0, 170.0, 90.0});
  const Outcome whole = run(c, self, false);
  EXPECT_EQ(whole.reports[0].work.method, Method::kExplicit);
  EXPECT_EQ(whole.reports[1].work.method, Method::kImplicit);
  for (const auto& report : whole.reports) EXPECT_LT(report.balance_error(), 1e-12);
  const Outcome part = run(c, world, false);
  EXPECT_EQ(world.sum(static_cast<std::int64_t>(part.bricks.size())), static_cast<std::int64_t>(whole.bricks.size()));
  EXPECT_EQ(world.sum(static_cast<std::int64_t>(part.cells.size())), static_cast<std::int64_t>(whole.cells.size()));
  expect_part_of(part, whole);
}

TEST(FieldsOnRanks, GiveTheSameBitsWhenBricksMove) {
  const Comm world(MPI_COMM_WORLD), self(MPI_COMM_SELF);
  const Case c({130.0, 80.0, 170.0});
  expect_part_of(run(c, world, true), run(c, self, false));
}

TEST(FieldsOnRanks, RunWithMoreRanksThanBricks) {
  const Comm world(MPI_COMM_WORLD), self(MPI_COMM_SELF);
  const Case c({90.0, 40.0, 40.0});  // two bricks
  expect_part_of(run(c, world, false), run(c, self, false));
}

TEST(FieldsOnRanks, SampleWhatOneRankSamples) {
  const Comm world(MPI_COMM_WORLD), self(MPI_COMM_SELF);
  const Case c({210.0, 170.0, 90.0});
  const Grid grid = grid_for(c.spec, c.space).value();
  const auto value = [](std::int64_t brick, std::size_t voxel) {
    return std::sin(0.37 * static_cast<double>(brick) + 0.11 * static_cast<double>(voxel));
  };
  const auto seen_on = [&](const Comm& comm, const std::vector<CellSource>& cells) {
    Field field = uniform_field(grid, 0.0, owners_along_curve(grid, comm.size()), comm.rank());
    for (std::size_t b = 0; b < field.owned_bricks.size(); ++b)
      for (std::size_t i = 0; i < field.concentration[b].size(); ++i) field.concentration[b][i] = value(field.owned_bricks[b], i);
    std::vector<double> seen(cells.size());
    EXPECT_TRUE(sample(field, c.space, cells, comm, seen).ok());
    return seen;
  };
  const auto whole = seen_on(self, c.cells);
  const auto cells = cells_of_rank(c, world);
  const auto mine = seen_on(world, cells);
  for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_TRUE(same_bits(mine[i], whole[cells[i].id.founder_number() - 1]));
}

}  // namespace
}  // namespace morula::fields
