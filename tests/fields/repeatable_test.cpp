#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random/philox.h"
#include "tests/fields/helpers.h"

namespace morula::fields::test {
namespace {

struct Case {
  Space space = cube(200.0);
  FieldSpec spec = spec_of(2000.0, 3.5, 0.2);  // 58³ voxels in 512 bricks: enough for threads to share
  std::vector<CellSource> cells;

  Case() {
    hold_all_faces(spec, 0.2);
    spec.reactions = {uptake_of(40.0, 0.005)};
    const Random random(5, RandomStream::kInitialPosition);
    for (std::uint64_t i = 1; i <= 60; ++i) {
      const auto a = random.uniform(CellId::founder(i), 0), b = random.uniform(CellId::founder(i), 1);
      cells.push_back({CellId::founder(i), 0, {200 * a.first, 200 * a.second, 200 * b.first}, 6.0});
    }
  }
};

struct History {
  Field field;
  std::vector<double> taken;
};

constexpr double kIntervals[] = {0.01, 1.0, 0.01, 2.0};

History run(const Case& c, bool new_solver_each_time) {
  History out{field_of(c.spec, c.space), std::vector<double>(c.cells.size(), 0.0)};
  FieldSolver solver;
  std::vector<double> taken(c.cells.size()), seen(c.cells.size());
  for (const double interval : kIntervals) {
    if (new_solver_each_time) solver = FieldSolver();
    EXPECT_TRUE(solver.advance(out.field, c.spec, c.space, c.cells, interval, alone(), taken, seen).ok());
    for (std::size_t i = 0; i < taken.size(); ++i) out.taken[i] += taken[i];
  }
  return out;
}

void expect_same_bits(const History& a, const History& b) {
  EXPECT_EQ(a.field.next_step, b.field.next_step);
  EXPECT_EQ(a.field.concentration, b.field.concentration);
  EXPECT_EQ(a.taken, b.taken);
}

TEST(FieldSolver, KeepsNothingFromOneIntervalToTheNext) {
  const Case c;
  expect_same_bits(run(c, false), run(c, true));
}

TEST(FieldSolver, GivesTheSameBitsOnAnyNumberOfThreads) {
  const Case c;
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const History one = run(c, false);
  omp_set_num_threads(3);
  const History three = run(c, false);
  omp_set_num_threads(before);
  expect_same_bits(one, three);
}

TEST(FieldSolver, GivesTheSameBitsInAnyOrderOfCells) {
  Case c;
  const History forward = run(c, false);
  std::reverse(c.cells.begin(), c.cells.end());
  History backward = run(c, false);
  std::reverse(backward.taken.begin(), backward.taken.end());
  expect_same_bits(forward, backward);
}

TEST(FieldSolver, LeavesTheFieldAloneWhenItCannotGoOn) {
  Case c;
  Field field = field_of(c.spec, c.space);
  field.concentration[3][17] = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> taken(c.cells.size()), seen(c.cells.size());
  FieldSolver solver;
  const auto poisoned = solver.advance(field, c.spec, c.space, c.cells, 1.0, alone(), taken, seen);
  ASSERT_FALSE(poisoned.ok());
  EXPECT_EQ(poisoned.error().kind, ErrorKind::kPhysics);
  EXPECT_EQ(field.concentration[3][16], 0.2);

  Field incomplete = field_of(c.spec, c.space);
  incomplete.owned_bricks.pop_back();
  incomplete.concentration.pop_back();
  EXPECT_FALSE(solver.advance(incomplete, c.spec, c.space, c.cells, 1.0, alone(), taken, seen).ok());
}

TEST(FieldSolver, SeesWhatTheCellsStandIn) {
  // A linear field: the trilinear weights of a small cell see it exactly, a large cell its mean.
  const Space space = cube(100.0);
  const FieldSpec spec = spec_of(2000.0, 10.0);
  const Field field = field_of(spec, space, [](Vec3d x) { return 0.1 + 0.002 * x.x - 0.001 * x.z; });
  const std::vector<CellSource> cells{{CellId::founder(1), 0, {33, 47, 61}, 2.0}, {CellId::founder(2), 0, {50, 50, 50}, 20.0}};
  std::vector<double> seen(2);
  ASSERT_TRUE(sample(field, space, cells, alone(), seen).ok());
  EXPECT_NEAR(seen[0], 0.1 + 0.066 - 0.061, 1e-14);
  EXPECT_NEAR(seen[1], 0.15, 1e-14);
}

}  // namespace
}  // namespace morula::fields::test
