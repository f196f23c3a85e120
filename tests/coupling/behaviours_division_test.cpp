#include "coupling/behaviours/division.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "coupling/behaviours/birth.h"
#include "coupling/behaviours/division_axis.h"

namespace morula {
namespace {

CellType cycling() {
  CellType type;
  type.cycles = true;
  type.cycle_duration = {64800.0, 0.1};
  return type;
}

CellState mother_row(std::uint64_t number = 17) {
  CellState row = make_founder(CellId::founder(number), 2, cycling(), 9, 0.0, false);
  row.target_volume = row.division_volume;
  row.pressure = 0.04;
  row.polarity = {0, 0.6, 0.8};
  row.migration_velocity = {1e-3, 2e-3, -1e-3};
  row.last_swap_time = 123.0;
  row.order = 77;
  return row;
}

const SphereBody kBody{{10, -20, 5}, 7.5595263};

/// A cell that is a sphere divides along its random axis.
struct Divided : DaughterRows {
  SphereBody first_body, second_body;
};
Divided divide(const CellState& mother, const CellType& type, std::uint32_t seed, double time, double late, double fraction = 0.5,
               std::span<const VariableColumn> variables = {}) {
  Divided out{divide_row(mother, variables, type, seed, time, late, fraction), {}, {}};
  const SphereDivision bodies = divide_sphere(kBody, division_axis({mother, type}, seed, 0), out.share);
  out.first_body = bodies.first;
  out.second_body = bodies.second;
  return out;
}

TEST(Division, KeepsVolumeToTheLastBit) {
  for (const double fraction : {0.5, 0.3, 0.61803}) {
    const CellState mother = mother_row();
    const auto out = divide(mother, cycling(), 9, 1000.0, 0.0, fraction);
    EXPECT_NEAR((out.first.target_volume + out.second.target_volume) / mother.target_volume, 1.0, 1e-15);
    EXPECT_NEAR(out.first.target_volume / mother.target_volume, fraction, 1e-15);
    const double cubes = std::pow(out.first_body.radius, 3) + std::pow(out.second_body.radius, 3);
    EXPECT_NEAR(cubes / std::pow(kBody.radius, 3), 1.0, 1e-12);
  }
}

TEST(Division, DividesEveryVariableAsItIsDeclared) {
  Model model;
  model.fields.resize(6);  // as many as one likes
  Cells cells;
  cells.declare(cell_variables(model));
  cells.variables.push_back({{"anger", "1", AtDivision::kUsual}, {}});
  CellState mother = mother_row();
  mother.variables = {3.7, 0.2, 1e5 / 3, 0.01, 0.0, 0.0, 1e-9, 0.0, 5.0, 6.0, 7.0, 8.0, 9.0};
  for (const double fraction : {0.5, 0.3, 0.61803}) {
    const auto out = divide(mother, cycling(), 9, 1000.0, 20.0, fraction, cells.variables);
    for (std::size_t field = 0; field < 6; ++field) {
      const double whole = mother.variables[amount_of(field)], first = out.first.variables[amount_of(field)];
      EXPECT_NEAR(first, fraction * whole, 1e-15 * whole);
      EXPECT_EQ(out.second.variables[amount_of(field)], whole - first) << "nothing is lost to rounding";
      EXPECT_EQ(out.first.variables[concentration_of(field)], mother.variables[concentration_of(field)]);
      EXPECT_EQ(out.second.variables[concentration_of(field)], mother.variables[concentration_of(field)]);
    }
    EXPECT_EQ(out.first.variables[12], 0.0);
    EXPECT_EQ(out.second.variables[12], 0.0);
  }
}

TEST(Division, KeepsTheCentroidAndStaysInTheMothersEnvelope) {
  for (const double fraction : {0.5, 0.3}) {
    const auto out = divide(mother_row(), cycling(), 9, 1000.0, 0.0, fraction);
    const Vec3d centroid = fraction * out.first_body.position + (1 - fraction) * out.second_body.position;
    EXPECT_LT(norm(centroid - kBody.position), 1e-12 * kBody.radius * 10);
    for (const SphereBody& body : {out.first_body, out.second_body}) {
      EXPECT_LE(norm(body.position - kBody.position) + body.radius, kBody.radius * (1 + 1e-12));
    }
  }
}

TEST(Division, EqualDaughtersStartAtTheReferenceDistance) {
  const auto out = divide(mother_row(), cycling(), 9, 1000.0, 0.0);
  EXPECT_NEAR(out.first_body.radius / kBody.radius, 0.7937005, 5e-8);
  EXPECT_NEAR(norm(out.first_body.position - out.second_body.position) / kBody.radius, 0.4125989, 5e-8);
}

TEST(Division, DaughtersInheritAndBeginACycle) {
  const CellState mother = mother_row();
  const auto out = divide(mother, cycling(), 9, 1000.0, 0.0);
  EXPECT_EQ(out.first.id, mother.id.daughter(0));
  EXPECT_EQ(out.second.id, mother.id.daughter(1));
  for (const CellState& row : {out.first, out.second}) {
    EXPECT_EQ(row.parent, mother.id);
    EXPECT_EQ(row.type, mother.type);
    EXPECT_EQ(row.polarity, mother.polarity);
    EXPECT_EQ(row.migration_velocity, mother.migration_velocity);
    EXPECT_EQ(row.pressure, mother.pressure);
    EXPECT_EQ(row.last_swap_time, mother.last_swap_time);
    EXPECT_EQ(row.order, mother.order);
    EXPECT_EQ(row.birth_time, 1000.0);
    EXPECT_EQ(row.phase, Phase::kGrowing);
    EXPECT_EQ(row.body, BodyKind::kSphere);
    EXPECT_LT(row.death_time, 0.0);
    EXPECT_DOUBLE_EQ(row.birth_volume, 0.5 * mother.target_volume);
    EXPECT_DOUBLE_EQ(row.division_volume, mother.target_volume);
  }
  EXPECT_NE(out.first.cycle_duration, out.second.cycle_duration);
  EXPECT_NEAR(out.first.cycle_duration, 64800.0, 3 * 6480.0);
}

TEST(Division, DaughtersOfALateStepHaveGrownForTheRest) {
  CellType type = cycling();
  type.cycle_duration.relative_spread = 0.0;
  const CellState mother = mother_row();
  const auto out = divide(mother, type, 9, 1000.0, 648.0);
  EXPECT_EQ(out.first.birth_time, 352.0);
  EXPECT_NEAR(out.first.target_volume / out.first.birth_volume, 1.01, 1e-12);  // 648 s of 64800 s
}

TEST(Division, AxesAreUniformOnTheSphere) {
  Vec3d mean{};
  double zz = 0.0;
  const int n = 20000;
  for (int k = 1; k <= n; ++k) {
    const auto out = divide(mother_row(k), cycling(), 9, 0.0, 0.0);
    const Vec3d axis = normalized(out.first_body.position - out.second_body.position);
    mean += axis;
    zz += axis.z * axis.z;
  }
  // Each component has variance 1/3 and its square variance 4/45: four standard errors.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c] / n, 0.0, 4 * std::sqrt(1.0 / 3.0 / n));
  EXPECT_NEAR(zz / n, 1.0 / 3.0, 4 * std::sqrt(4.0 / 45.0 / n));
}

TEST(Division, IsTheSameWheneverItIsAsked) {
  const auto one = divide(mother_row(), cycling(), 9, 1000.0, 12.5);
  const auto other = divide(mother_row(), cycling(), 9, 1000.0, 12.5);
  EXPECT_EQ(one.first_body.position, other.first_body.position);
  EXPECT_EQ(one.second.cycle_duration, other.second.cycle_duration);
  const auto seeded = divide(mother_row(), cycling(), 10, 1000.0, 12.5);
  EXPECT_FALSE(one.first_body.position == seeded.first_body.position);
}

TEST(Founder, HasTheVolumeOfItsAge) {
  CellType type = cycling();
  type.cycle_duration.relative_spread = 0.0;
  double age_sum = 0.0, volume_sum = 0.0;
  const double birth_volume = 4.0 / 3.0 * std::numbers::pi * 216.0;
  const int n = 20000;
  for (int k = 1; k <= n; ++k) {
    const CellState row = make_founder(CellId::founder(k), 0, type, 4, 500.0, true);
    const double point = (500.0 - row.birth_time) / row.cycle_duration;
    ASSERT_GT(point, 0.0);
    ASSERT_LT(point, 1.0);
    EXPECT_NEAR(row.target_volume, birth_volume * (1.0 + point), 1e-9);
    EXPECT_DOUBLE_EQ(row.division_volume, 2.0 * birth_volume);
    age_sum += point;
    volume_sum += row.target_volume / birth_volume;
  }
  // Mean volume 1/ln 2, mean age 1/ln 2 − 1, variance of the age about 0.081.
  EXPECT_NEAR(volume_sum / n, 1.442695, 4 * std::sqrt(0.081 / n));
  EXPECT_NEAR(age_sum / n, 0.442695, 4 * std::sqrt(0.081 / n));
}

TEST(Founder, RestsWhereItsTypeDoesNotCycle) {
  CellType type;
  type.radius = {6.0, 0.05};
  type.initial_body = BodyKind::kShell;
  std::set<double> volumes;
  for (int k = 1; k <= 100; ++k) {
    const CellState row = make_founder(CellId::founder(k), 3, type, 4, 0.0, true);
    EXPECT_EQ(row.phase, Phase::kResting);
    EXPECT_EQ(row.body, BodyKind::kShell);
    EXPECT_EQ(row.birth_time, 0.0);
    EXPECT_EQ(row.target_volume, row.birth_volume);
    EXPECT_NEAR(std::cbrt(0.75 * row.birth_volume / std::numbers::pi), 6.0, 3 * 0.3 + 1e-12);
    volumes.insert(row.birth_volume);
  }
  EXPECT_EQ(volumes.size(), 100u);
}

}  // namespace
}  // namespace morula
