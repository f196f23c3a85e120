#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <tuple>

#include "core/random/philox.h"
#include "fields/brick_operator.h"
#include "tests/fields/helpers.h"

namespace morula::fields::test {
namespace {

std::vector<CellSource> scattered_cells(int count, double side, double beyond, double radius, std::uint16_t types = 1) {
  const Random random(7, RandomStream::kInitialPosition);
  std::vector<CellSource> cells;
  for (int i = 1; i <= count; ++i) {
    const CellId id = CellId::founder(static_cast<std::uint64_t>(i));
    const auto a = random.uniform(id, 0), b = random.uniform(id, 1);
    const auto place = [&](double u) { return -beyond + u * (side + 2.0 * beyond); };
    cells.push_back({id, static_cast<std::uint16_t>(i % types), {place(a.first), place(a.second), place(b.first)}, radius});
  }
  return cells;
}

TEST(Uptake, WellMixedFollowsTheLambertFunction) {
  // c = K W0[(c0/K) e^{(c0−Vt)/K}], V = 0.05 mM/s, K = 0.01, c0 = 0.2. One voxel holds one cell: V_max = V times the voxel's volume.
  const Space space = cube(10.0);
  FieldSpec spec = spec_of(2000.0, 10.0, 0.2);
  spec.relative_tolerance = 1e-7;
  spec.reactions = {uptake_of(0.05 * 1000.0, 0.01)};
  const std::vector<CellSource> cells{{CellId::founder(1), 0, {5, 5, 5}, 3.0}};
  Field field = field_of(spec, space);
  std::vector<double> taken(1, 0.0);
  for (const double expected : {0.15269852, 0.10631876, 0.06175192, 0.02205003, 0.00119572}) {
    advance(field, spec, space, 1.0, cells, &taken);
    EXPECT_NEAR(value_at(field, 0, 0, 0), expected, 1e-6);
  }
  EXPECT_NEAR(taken[0], (0.2 - value_at(field, 0, 0, 0)) * 1000.0, 1e-10);
}

TEST(Uptake, CellsGetWhatTheFieldLoses) {
  // 16³ voxels of 10 µm without flux, 20 spheres of R = 6, 40 amol/s, K_m = 0.005, c = 0.2; 100 intervals of 0.5 s.
  const Space space = cube(160.0);
  FieldSpec spec = spec_of(2000.0, 10.0, 0.2);
  spec.reactions = {uptake_of(40.0, 0.005)};
  const auto cells = scattered_cells(20, 160.0, 0.0, 6.0);
  Field field = field_of(spec, space);
  const double start = total_amount(field, alone());
  std::vector<double> taken(cells.size(), 0.0);
  for (int i = 0; i < 100; ++i) EXPECT_LT(advance(field, spec, space, 0.5, cells, &taken).balance_error(), 1e-13);
  const double sum = std::accumulate(taken.begin(), taken.end(), 0.0);
  EXPECT_NEAR(sum, 20 * 40.0 * 50.0, 0.06 * sum);  // nearly saturated
  EXPECT_NEAR((total_amount(field, alone()) + sum) / start, 1.0, 1e-12);
}

TEST(Uptake, BalanceHoldsAcrossFacesTypesDecayAndLongIntervals) {
  // Cells that cross voxels and faces of the domain, two types, boundary inflow, decay, implicit steps at a loose tolerance.
  const Space space = cube(150.0);
  FieldSpec spec = spec_of(2000.0, 12.0, 0.2);
  spec.boundary[0] = {FaceCondition{FaceCondition::Kind::kValue, 0.2}, FaceCondition{FaceCondition::Kind::kValue, 0.1}};
  spec.boundary[2][1] = {FaceCondition::Kind::kValue, 0.15};
  spec.reactions = {decay_of(0.003), uptake_of(40.0, 0.005), uptake_of(0.0, 0.0, 1), uptake_of(400.0, 0.02, 2)};
  spec.relative_tolerance = 1e-3;
  const auto cells = scattered_cells(100, 150.0, 10.0, 7.0, 3);
  Field field = field_of(spec, space);
  const double start = total_amount(field, alone());
  std::vector<double> taken(cells.size(), 0.0);
  double decayed = 0.0, inflow = 0.0;
  for (int i = 0; i < 40; ++i) {
    const auto report = advance(field, spec, space, 30.0, cells, &taken);
    EXPECT_EQ(report.work.method, Method::kImplicit);
    EXPECT_LT(report.balance_error(), 1e-12);
    decayed += report.decayed;
    inflow += report.total_inflow();
  }
  const double sum = std::accumulate(taken.begin(), taken.end(), 0.0);
  EXPECT_GT(sum, start);
  EXPECT_GT(decayed, 0.0);
  EXPECT_NEAR(start + inflow - sum - decayed, total_amount(field, alone()), 1e-10 * sum);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].type == 1)
      EXPECT_EQ(taken[i], 0.0);
    else
      EXPECT_GT(taken[i], 0.0);
  }
}

TEST(Uptake, SteadyStateTakesWhatComesIn) {
  const Space space = cube(200.0);
  FieldSpec spec = spec_of(2000.0, 10.0, 0.2);
  hold_all_faces(spec, 0.2);
  spec.reactions = {uptake_of(40.0, 0.005)};
  const auto cells = scattered_cells(300, 200.0, -20.0, 6.0);
  Field field = field_of(spec, space);
  for (int i = 0; i < 3; ++i) advance(field, spec, space, 60.0, cells);
  const auto steady = advance(field, spec, space, 60.0, cells);
  EXPECT_NEAR(steady.total_inflow() / steady.taken, 1.0, 1e-3);
  EXPECT_LE(steady.work.steps, 5);
}

/// One small cell in the middle of each voxel for which `inside` is true: uptake that is even over the voxels.
std::vector<CellSource> cell_per_voxel(const Grid& grid, const std::function<bool(Vec3d)>& inside) {
  std::vector<CellSource> cells;
  std::uint64_t number = 0;
  for (int k = 0; k < grid.voxels[2]; ++k)
    for (int j = 0; j < grid.voxels[1]; ++j)
      for (int i = 0; i < grid.voxels[0]; ++i) {
        const Vec3d x = grid.voxel_center({i, j, k});
        if (inside(x)) cells.push_back({CellId::founder(++number), 0, x, 0.4 * grid.spacing().x});
      }
  return cells;
}

/// A slab of half-thickness `half`, held at c0 on both sides, with `voxels` (odd) across it.
struct Slab {
  Space space;
  FieldSpec spec;
  Field field;
  std::vector<CellSource> cells;

  Slab(double half, int voxels, double c0, double rate, double half_saturation) {
    const double h = 2.0 * half / voxels;
    space.box = {{-half, 0, 0}, {half, 2 * h, 2 * h}};
    spec = spec_of(2000.0, h, c0);
    spec.boundary[0] = {FaceCondition{FaceCondition::Kind::kValue, c0}, FaceCondition{FaceCondition::Kind::kValue, c0}};
    spec.relative_tolerance = 1e-6;
    spec.reactions = {uptake_of(rate * h * h * h, half_saturation)};
    field = field_of(spec, space);
    cells = cell_per_voxel(field.grid, [](Vec3d) { return true; });
  }
  IntervalReport settle() {
    for (int i = 0; i < 4; ++i) advance(field, spec, space, 50.0, cells);
    return advance(field, spec, space, 1.0, cells);
  }
};

TEST(Uptake, OfFirstOrderGivesTheThieleProfile) {
  // c(0) = 1/cosh φ and effectiveness η = tanh φ/φ, φ = L√(k/D) (Thiele 1939, doi:10.1021/ie50355a027); K_m ≫ c makes it first order.
  // 41 voxels: second-order errors (φ/41)²-ish, below 0.2 % up to φ = 2.
  const double half = 100.0, diffusion = 2000.0, c0 = 1e-4, large = 100.0;
  for (const auto& [phi, centre, effectiveness] :
       {std::tuple{0.5, 0.886819, 0.924234}, {1.0, 0.648054, 0.761594}, {2.0, 0.265802, 0.482014}}) {
    const double k = phi * phi * diffusion / (half * half);
    Slab slab(half, 41, c0, k * large, large);
    const auto report = slab.settle();
    EXPECT_NEAR(value_at(slab.field, 20, 0, 1) / c0, centre, 2e-3 * centre);
    const double volume = slab.field.grid.box.size().x * slab.field.grid.box.size().y * slab.field.grid.box.size().z;
    EXPECT_NEAR(report.taken / (k * c0 * volume), effectiveness, 2e-3 * effectiveness);
  }
}

TEST(Uptake, MichaelisMentenSlabFollowsItsFirstIntegral) {
  // D c″ = q c/(K + c) has the first integral D c′²/2 = q [(c − m) − K ln((K + c)/(K + m))], m = c(0); hence x(c) by quadrature.
  // Here with tissue oxygen numbers: q = 0.044209706 mM/s (40 amol/s per cell of R = 6 µm), K_m = 0.005 mM, D = 2000 µm²/s.
  const double q = 0.044209706, km = 0.005, diffusion = 2000.0, c0 = 0.2;
  Slab slab(120.0, 61, c0, q, km);
  slab.settle();
  const double m = value_at(slab.field, 30, 0, 0);
  const auto distance = [&](double c) {  // ∫_m^c dc′/|c′|, with c = m + s² against the root singularity
    const int n = 4000;
    double sum = 0.0;
    const double end = std::sqrt(c - m);
    for (int i = 0; i < n; ++i) {
      const double s = (i + 0.5) / n * end, at = m + s * s;
      sum += 2.0 * s / std::sqrt(2.0 * q / diffusion * ((at - m) - km * std::log((km + at) / (km + m)))) * end / n;
    }
    return sum;
  };
  EXPECT_NEAR(distance(c0), 120.0, 0.2);
  for (const int i : {40, 50, 60}) EXPECT_NEAR(distance(value_at(slab.field, i, 1, 0)), slab.field.grid.voxel_center({i, 0, 0}).x, 0.2);
}

/// c at the centre of a ball with Michaelis–Menten uptake, the voxels with their centre outside it held at c0 and full uptake inside.
double staircase_ball_centre(double h, double radius) {
  const double q = 0.044209706, c0 = 0.2;
  const int voxels = 2 * static_cast<int>(std::ceil(radius / h)) + 1;
  Space space;
  const double half = 0.5 * voxels * h;
  space.box = {{-half, -half, -half}, {half, half, half}};
  FieldSpec spec = spec_of(2000.0, h, c0);
  spec.reactions = {uptake_of(q * h * h * h, 0.005)};
  Field field = field_of(spec, space);
  const auto inside = [&](Vec3d x) { return norm(x) <= radius; };
  const auto cells = cell_per_voxel(field.grid, inside);
  const Comm comm = alone();
  const CellExchange exchange(field, space, cells, comm);
  const Layout layout = layout_of(field, exchange.sinks({true}));
  Halo<double> halo(field, layout, space, comm);
  const FieldReactions reactions(spec);
  BrickOperator op(field.grid, spec, reactions, layout, halo);
  std::vector<double> c(layout.unknowns(), 0.0), rate(layout.unknowns());
  std::vector<double> free_voxel;
  const Field mask = field_of(spec, space, [&](Vec3d x) { return inside(x) ? 1.0 : 0.0; });
  for (std::size_t b = 0; b < layout.bricks(); ++b)
    free_voxel.insert(free_voxel.end(), mask.concentration[b].begin(), mask.concentration[b].end());
  std::fill_n(c.begin(), layout.concentrations(), c0);
  // Relaxation by Richardson iteration with the Chebyshev-like momentum of heavy ball, rates at the two ends of the spectrum.
  const double fast = op.largest_rate(c0), slow = 0.45;
  const double root = std::sqrt(slow / fast), step = 4.0 / (fast * (1 + root) * (1 + root)),
               momentum = std::pow((1 - root) / (1 + root), 2);
  std::vector<double> before = c;
  for (int i = 0; i < 400; ++i) {
    op.evaluate(0.0, c.data(), rate.data(), false);
    for (std::size_t v = 0; v < layout.concentrations(); ++v) {
      const double now = c[v];
      c[v] += free_voxel[v] * (step * rate[v] + momentum * (now - before[v]));
      before[v] = now;
    }
  }
  double left = 0.0;
  for (std::size_t v = 0; v < layout.concentrations(); ++v) left = std::max(left, free_voxel[v] * std::fabs(rate[v]));
  EXPECT_LT(left, 1e-8) << "the relaxation has not settled";
  for (std::size_t b = 0; b < layout.bricks(); ++b)
    field.concentration[b].assign(c.begin() + static_cast<std::ptrdiff_t>(layout.offset[b]),
                                  c.begin() + static_cast<std::ptrdiff_t>(layout.offset[b + 1]));
  return value_at(field, voxels / 2, voxels / 2, voxels / 2);
}

TEST(Uptake, OxygenInAStaircaseBallConvergesInFirstOrder) {
  // Radial solution for R = 200 µm: c(0) = 0.0601422 mM; as a staircase of voxels 0.0522 at h = 20 and 0.0557 at h = 10 µm. Where
  // the centre lies among the voxels moves the staircase, hence 1.5 %.
  EXPECT_NEAR(staircase_ball_centre(20.0, 200.0), 0.0522, 0.015 * 0.0522);
  EXPECT_NEAR(staircase_ball_centre(10.0, 200.0), 0.0557, 0.015 * 0.0557);
}

TEST(Uptake, RejectsASpecWithoutHalfSaturation) {
  FieldSpec spec = spec_of(2000.0, 10.0, 0.2);
  spec.reactions = {uptake_of(40.0, 0.0)};
  EXPECT_FALSE(check(spec).ok());
  spec.reactions = {decay_of(-1.0)};
  EXPECT_FALSE(check(spec).ok());
  spec.reactions = {uptake_of(0.0, 0.0)};
  EXPECT_TRUE(check(spec).ok());
  spec.diffusion = -1.0;
  EXPECT_FALSE(check(spec).ok());
}

}  // namespace
}  // namespace morula::fields::test
