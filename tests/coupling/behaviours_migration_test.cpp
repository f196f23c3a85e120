#include "coupling/behaviours/migration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "coupling/behaviours/birth.h"

namespace morula {
namespace {

CellType walker() {
  CellType type;
  type.migration.speed = 0.01;
  type.migration.own.set("persistence", 600.0);
  return type;
}

Walk step_of(const Vec3d& velocity, CellId id, const CellType& type, std::uint32_t seed, std::uint64_t step, double dt) {
  return migrate({.id = id,
                  .velocity = velocity,
                  .speed = type.migration.speed,
                  .random = Random(seed, RandomStream::kMigration),
                  .step = step,
                  .dt = dt},
                 type);
}

Vec3d next_velocity(const Vec3d& velocity, CellId id, const CellType& type, std::uint32_t seed, std::uint64_t step, double dt) {
  return step_of(velocity, id, type, seed, step, dt).velocity;
}

/// Mean squared displacement of n walkers after this many steps.
double mean_square_displacement(const CellType& type, int walkers, int steps, double dt, std::uint32_t seed) {
  double sum = 0.0;
  for (int k = 1; k <= walkers; ++k) {
    const CellId id = CellId::founder(k);
    Vec3d velocity = initial_migration_velocity(id, type, seed);
    Vec3d place{};
    for (int n = 0; n < steps; ++n) {
      const Walk walk = step_of(velocity, id, type, seed, n, dt);
      place += dt * walk.mean;
      velocity = walk.velocity;
    }
    sum += norm2(place);
  }
  return sum / walkers;
}

CellType tumbler() {
  CellType type = walker();
  for (const auto& law : migration_laws())
    if (law->info.name == "run_and_tumble") type.migration.law = law;
  type.migration.own = OwnValues();
  type.migration.own.set("run_time", 600.0);
  return type;
}

/// ⟨x²⟩ = 2S²P[t − P(1 − e^(−t/P))], S = 0.01 µm/s, P = 600 s: 26.487320 µm² after 600 s (physics page), 360.178 after an hour, 4248 after ten. Whatever the steps, from a sixtieth of the
/// memory to sixty times of it. The standard error of 10⁴ walkers in three dimensions is 0.82 % where their places are normal, three of them allowed.
TEST(Migration, GoesAsFarAsItsLawSaysInStepsOfAnyLength) {
  constexpr double kError = 3 * 0.0082;
  for (const CellType& type : {walker(), tumbler()}) {
    EXPECT_NEAR(mean_square_displacement(type, 10000, 60, 10.0, 3), 26.487320, 1.2 * kError * 26.487320);
    EXPECT_NEAR(mean_square_displacement(type, 10000, 10, 60.0, 1), 26.487320, 1.2 * kError * 26.487320);
    EXPECT_NEAR(mean_square_displacement(type, 10000, 60, 60.0, 2), 360.178, 1.2 * kError * 360.178);
    EXPECT_NEAR(mean_square_displacement(type, 10000, 1, 3600.0, 4), 360.178, 1.2 * kError * 360.178);
    EXPECT_NEAR(mean_square_displacement(type, 10000, 20, 1800.0, 5), 4248.0, 1.2 * kError * 4248.0);
    EXPECT_NEAR(mean_square_displacement(type, 10000, 1, 36000.0, 6), 4248.0, 1.2 * kError * 4248.0);
  }
  CellType fast = tumbler();
  fast.migration.own.set("run_time", 0.01);  // too many runs in a step to draw each
  const double expected = 2e-4 * 0.01 * 600.0;
  EXPECT_NEAR(mean_square_displacement(fast, 10000, 5, 120.0, 7), expected, kError * expected);
}

/// dcm.md T11.1: a force of σ = 1 nN a component that is forgotten in τ = 60 s, against the drag Γ = 45.239 nN·s/µm of a cell of 6 µm, makes it
/// diffuse with D = σ² τ/Γ² = 0.029318 µm²/s a component; ⟨x²⟩ = 2D (t − τ (1 − e^(−t/τ))), ±5 %.
TEST(Migration, ForceOnACellMakesItDiffuseAsItsDragSays) {
  constexpr double kDrag = 45.239, kForce = 1.0, kTime = 60.0, kDiffusion = 0.029318;
  CellType type;
  type.migration.speed = std::sqrt(3.0) * kForce / kDrag;
  type.migration.own.set("persistence", kTime);
  constexpr int kCells = 4000, kSteps = 600;
  constexpr double kStep = 2.0;  // 20 τ in all
  double square = 0.0, speed = 0.0;
  for (int k = 1; k <= kCells; ++k) {
    const CellId id = CellId::founder(static_cast<std::uint64_t>(k));
    Vec3d velocity = initial_migration_velocity(id, type, 4), place{};
    for (int n = 0; n < kSteps; ++n) {
      const Walk walk = step_of(velocity, id, type, 4, static_cast<std::uint64_t>(n), kStep);
      place += kStep * walk.mean;
      velocity = walk.velocity;
    }
    square += norm2(place) / (3.0 * kCells);
    speed += norm2(velocity) / (3.0 * kCells);
  }
  EXPECT_NEAR(std::sqrt(speed), 0.0221, 0.05 * 0.0221);
  const double t = kSteps * kStep, expected = 2.0 * kDiffusion * (t - kTime * (1.0 - std::exp(-t / kTime)));
  EXPECT_NEAR(square, expected, 0.05 * expected);
}

TEST(Migration, StaysStationaryAndForgetsExactly) {
  const CellType type = walker();
  const int n = 20000;
  double start = 0.0, end = 0.0, correlation = 0.0;
  for (int k = 1; k <= n; ++k) {
    const CellId id = CellId::founder(k);
    const Vec3d u0 = initial_migration_velocity(id, type, 8);
    const Vec3d u1 = next_velocity(u0, id, type, 8, 5, 300.0);
    start += norm2(u0) / n;
    end += norm2(u1) / n;
    correlation += dot(u0, u1) / n;
  }
  // ⟨u²⟩ = S², relative standard error √(2/3n); ⟨u0·u1⟩ = S² e^(−1/2).
  const double error = 4 * std::sqrt(2.0 / 3.0 / n);
  EXPECT_NEAR(start / 1e-4, 1.0, error);
  EXPECT_NEAR(end / 1e-4, 1.0, error);
  EXPECT_NEAR(correlation / 1e-4, std::exp(-0.5), error);
}

TEST(Migration, ComponentsAreIndependent) {
  const CellType type = walker();
  const int n = 20000;
  double xy = 0.0, xz = 0.0, yz = 0.0;
  for (int k = 1; k <= n; ++k) {
    const Vec3d u = next_velocity({}, CellId::founder(k), type, 8, 11, 1e6);
    xy += u.x * u.y;
    xz += u.x * u.z;
    yz += u.y * u.z;
  }
  const double bound = 4 * (1e-4 / 3) * std::sqrt(n);
  EXPECT_LT(std::abs(xy), bound);
  EXPECT_LT(std::abs(xz), bound);
  EXPECT_LT(std::abs(yz), bound);
}

TEST(Migration, SuccessiveStepsAndTheStartAreUncorrelated) {
  const CellType type = walker();
  const int n = 20000;
  double steps = 0.0, start = 0.0;
  for (int k = 1; k <= n; ++k) {
    const CellId id = CellId::founder(k);
    const Vec3d fresh = next_velocity({}, id, type, 8, 0, 1e6);
    steps += dot(fresh, next_velocity({}, id, type, 8, 1, 1e6));
    start += dot(fresh, initial_migration_velocity(id, type, 8));
  }
  const double bound = 4 * (1e-4 / 3) * std::sqrt(3.0 * n);
  EXPECT_LT(std::abs(steps), bound);
  EXPECT_LT(std::abs(start), bound);
}

TEST(Migration, CrawlsAlongWhatTheCellTouches) {
  const Vec3d wanted{0.01, -0.02, 0.03}, up{0, 0, 1};
  const double stretch = std::sqrt(1.5);
  EXPECT_EQ(crawling_velocity(wanted, false, {}, false), wanted);
  EXPECT_EQ(crawling_velocity(wanted, false, {}, true), Vec3d{});
  for (const double sign : {1.0, -1.0}) {
    const Vec3d on = crawling_velocity(wanted, true, up * sign, true), near = crawling_velocity(wanted, true, up * sign, false);
    EXPECT_DOUBLE_EQ(on.x, 0.01 * stretch);
    EXPECT_DOUBLE_EQ(on.y, -0.02 * stretch);
    EXPECT_EQ(on.z, 0.0);
    EXPECT_DOUBLE_EQ(near.x, on.x);
    EXPECT_DOUBLE_EQ(near.z, 0.03);
  }
}

TEST(Migration, IsOffWithoutSpeed) {
  CellType type = walker();
  type.migration.speed = 0.0;
  EXPECT_EQ(next_velocity({1, 1, 1}, CellId::founder(1), type, 1, 0, 60.0), Vec3d{});
  EXPECT_EQ(initial_migration_velocity(CellId::founder(1), type, 1), Vec3d{});
}

}  // namespace
}  // namespace morula
