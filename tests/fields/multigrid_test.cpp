#include "fields/multigrid.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "core/random/philox.h"
#include "fields/brick_operator.h"
#include "fields/halo.h"
#include "fields/layout.h"
#include "tests/fields/helpers.h"

namespace morula::fields::test {
namespace {

Space box(Vec3d size, std::array<BoundaryKind, 3> kinds = {BoundaryKind::kWall, BoundaryKind::kWall, BoundaryKind::kWall}) {
  Space space;
  space.box = {{0, 0, 0}, size};
  for (std::size_t a = 0; a < 3; ++a) space.boundary[a] = {kinds[a], kinds[a]};
  return space;
}

double random_value(std::uint64_t i, std::uint64_t seed) {
  return Random(seed, RandomStream::kInitialPosition).uniform(CellId::founder(i + 1), 0).first - 0.5;
}

std::vector<double> random_vector(std::size_t n, std::uint64_t seed) {
  std::vector<double> out(n);
  for (std::size_t i = 0; i < n; ++i) out[i] = random_value(i, seed);
  return out;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }

/// 1 − γJ of a field all on this rank, with what multiplies by it and by the preconditioner.
struct Problem {
  Comm comm = alone();
  Field field;
  FieldReactions reactions;
  Layout layout;
  Halo<double> halo;
  BrickOperator op;
  Multigrid multigrid;
  double gamma;

  Problem(const FieldSpec& spec, const Space& space, double step)
      : field(field_of(spec, space)),
        reactions(spec),
        layout(layout_of(field, {})),
        halo(field, layout, space, comm),
        op(field.grid, spec, reactions, layout, halo),
        multigrid(field, spec, layout, space, comm),
        gamma(step) {
    const std::vector<double> nothing(layout.unknowns(), spec.initial);
    op.linearize(nothing.data());
    multigrid.prepare(gamma, op);
  }
  std::size_t size() const { return layout.concentrations(); }
  std::vector<double> product(std::vector<double> v) {
    std::vector<double> out(layout.unknowns());
    v.resize(layout.unknowns());
    op.shifted_product(gamma, v.data(), out.data(), comm);
    out.resize(size());
    return out;
  }
  std::vector<double> preconditioned(const std::vector<double>& r) {
    std::vector<double> out(size());
    multigrid.apply(r.data(), out.data());
    return out;
  }
  /// Conjugate gradients, as a textbook writes them, for a random right-hand side, to a residual of `reduction` times that.
  int iterations(double reduction) {
    std::vector<double> r = random_vector(size(), 11), x(size()), p;
    const double target = reduction * std::sqrt(dot(r, r));
    double rho = 1.0;
    for (int n = 0; n < 200; ++n) {
      if (std::sqrt(dot(r, r)) <= target) return n;
      const auto z = preconditioned(r);
      const double next = dot(r, z);
      if (n == 0)
        p = z;
      else
        for (std::size_t i = 0; i < p.size(); ++i) p[i] = z[i] + next / rho * p[i];
      rho = next;
      const auto q = product(p);
      const double alpha = rho / dot(p, q);
      for (std::size_t i = 0; i < p.size(); ++i) x[i] += alpha * p[i], r[i] -= alpha * q[i];
    }
    return 200;
  }
};

struct Case {
  std::string name;
  FieldSpec spec;
  Space space;
};

/// Grids whose bricks are full or not, thin or single; axes closed, periodic, held on one side or on both.
std::vector<Case> cases() {
  std::vector<Case> out;
  const auto wall = BoundaryKind::kWall, periodic = BoundaryKind::kPeriodic;
  const auto held = FaceCondition{FaceCondition::Kind::kValue, 0.2};
  out.push_back({"closed 16", spec_of(2000.0, 10.0), box({160, 160, 160})});
  out.push_back({"odd 17x9x25", spec_of(2000.0, 10.0), box({170, 90, 250})});
  out.push_back({"periodic", spec_of(2000.0, 10.0), box({240, 130, 170}, {periodic, periodic, periodic})});
  out.push_back({"one axis periodic, one held", spec_of(2000.0, 10.0), box({240, 130, 170}, {periodic, wall, wall})});
  out.back().spec.boundary[1] = {held, held};
  out.back().spec.boundary[2][0] = held;
  out.push_back({"layer of one voxel", spec_of(2000.0, 10.0), box({410, 330, 10})});
  out.push_back({"column", spec_of(2000.0, 10.0), box({10, 10, 600})});
  out.back().spec.boundary[2] = {held, held};
  out.push_back({"one voxel", spec_of(2000.0, 10.0), box({10, 10, 10})});
  out.push_back({"wide voxels along x", spec_of(2000.0, 10.0), box({247, 160, 160})});
  out.push_back({"decay", spec_of(500.0, 10.0), box({170, 160, 90})});
  out.back().spec.reactions = {decay_of(0.3)};
  hold_all_faces(out.back().spec, 0.1);
  return out;
}

TEST(Multigrid, IsSymmetricAndPositive) {
  for (const auto& c : cases())
    for (const double gamma : {0.5, 20.0}) {
      SCOPED_TRACE(c.name + " " + std::to_string(gamma));
      Problem p(c.spec, c.space, gamma);
      const auto a = random_vector(p.size(), 1), b = random_vector(p.size(), 2);
      const auto ma = p.preconditioned(a), mb = p.preconditioned(b);
      EXPECT_NEAR(dot(a, mb), dot(b, ma), 2e-5 * std::sqrt(dot(a, ma) * dot(b, mb)));  // single precision
      EXPECT_GT(dot(a, ma), 0.0);
      EXPECT_GT(dot(b, mb), 0.0);
    }
}

TEST(Multigrid, IsNearlyTheInverseForWhatTheWidestLevelSees) {
  // Without flux through the faces a constant is kept by diffusion: (1 − γJ) 1 = 1 + γ decay. (The smoother's first step is
  // not even where voxels at the faces have fewer neighbours.)
  FieldSpec spec = spec_of(2000.0, 10.0);
  spec.reactions = {decay_of(0.3)};
  Problem p(spec, box({170, 90, 250}), 20.0);
  for (const double z : p.preconditioned(std::vector<double>(p.size(), 1.0))) EXPECT_NEAR(z, 1.0 / 7.0, 0.01);
}

TEST(Multigrid, NeedsFewIterationsOnEveryShape) {
  for (const auto& c : cases())
    for (const double gamma : {0.5, 20.0}) {
      SCOPED_TRACE(c.name + " " + std::to_string(gamma));
      EXPECT_LE(Problem(c.spec, c.space, gamma).iterations(1e-6), 14);
    }
}

TEST(Multigrid, NeedsNoMoreIterationsOnALargeGridThanOnASmallOne) {
  const auto iterations = [](double voxels) {
    FieldSpec spec = spec_of(2000.0, 10.0);
    hold_all_faces(spec, 0.2);
    return Problem(spec, box({10 * voxels, 10 * voxels, 10 * voxels}), 13.0).iterations(1e-6);
  };
  const int small = iterations(16);
  EXPECT_GT(small, 2);
  EXPECT_LE(iterations(72), 1.5 * small);
}

TEST(Multigrid, NeedsNoMoreIterationsWhereCellsConsume) {
  // A ball full of cells that take nearly all: the shift jumps by a factor of thousands between voxels.
  const Space space = box({400, 400, 400});
  FieldSpec spec = spec_of(2000.0, 10.0, 0.2);
  hold_all_faces(spec, 0.2);
  spec.reactions = {uptake_of(4000.0, 0.005)};
  std::vector<CellSource> cells;
  std::uint64_t number = 0;
  for (int k = 0; k < 10; ++k)
    for (int j = 0; j < 10; ++j)
      for (int i = 0; i < 10; ++i) cells.push_back({CellId::founder(++number), 0, {110.0 + 18 * i, 110.0 + 18 * j, 110.0 + 18 * k}, 8.0});
  Field field = field_of(spec, space);
  for (int n = 0; n < 3; ++n) advance(field, spec, space, 60.0, cells);
  const auto report = advance(field, spec, space, 60.0, cells);
  EXPECT_EQ(report.work.method, Method::kImplicit);
  EXPECT_GT(report.work.linear_iterations, 0);
  EXPECT_LE(static_cast<double>(report.work.linear_iterations), 6.0 * static_cast<double>(report.work.steps) * 4.0);
  EXPECT_LT(report.balance_error(), 1e-12);
}

TEST(Multigrid, KeepsItsBitsOnAnyNumberOfThreads) {
  const int before = omp_get_max_threads();
  std::array<std::vector<double>, 2> z;
  for (std::size_t n = 0; n < 2; ++n) {
    omp_set_num_threads(n == 0 ? 1 : 3);
    FieldSpec spec = spec_of(2000.0, 10.0);
    Problem p(spec, box({560, 530, 570}), 5.0);  // 7 × 7 × 8 bricks
    static_assert(7 * 7 * 8 >= kBricksWorthThreads, "threads share them");
    z[n] = p.preconditioned(random_vector(p.size(), 3));
  }
  omp_set_num_threads(before);
  EXPECT_EQ(z[0], z[1]);
}

TEST(Multigrid, SolvesWhatTheClosedFormSays) {
  // Between two faces held at 0 each mode sin(mπx/L) decays at its own rate; here by steps far longer than a voxel's. L = 640 µm,
  // D = 2000 µm²/s: π²D/L² = 0.04819/s.
  const Space space = box({640, 80, 80});
  FieldSpec spec = spec_of(2000.0, 10.0);
  spec.relative_tolerance = 1e-6;
  spec.boundary[0] = {FaceCondition{FaceCondition::Kind::kValue, 0.0}, FaceCondition{FaceCondition::Kind::kValue, 0.0}};
  Field field = field_of(spec, space, [](Vec3d x) { return std::sin(std::numbers::pi * x.x / 640.0); });
  const auto report = advance(field, spec, space, 30.0);
  EXPECT_EQ(report.work.method, Method::kImplicit);
  for (const int i : {3, 20, 31, 60})
    EXPECT_NEAR(value_at(field, i, 4, 4) / (std::sin(std::numbers::pi * (i + 0.5) / 64.0) * std::exp(-0.048191 * 30.0)), 1.0, 1e-3);
}

}  // namespace
}  // namespace morula::fields::test
