/// Pressure of packing in a tissue: cbm.md §3, tests (1), (2), (4), and where spheres meet surfaces.
#include <gtest/gtest.h>

#include <algorithm>

#include "cbm/laws/sphere_caps.h"
#include "core/random/philox.h"
#include "coupling/mechanics/contact_setup.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

cbm::PackingCurve ideal() { return cbm::PackingCurve::through(cbm::ideal_filled_cell(2.5, 0.45, 0.4).value()).value(); }

Model packing_model(double adhesion) {
  Model model = test::clusters_model(adhesion);
  model.types[0].sphere.packing = ideal();
  return model;
}

Mechanics mechanics_of(const Model& model, ShapeLibrary& shapes, int threads = 1) {
  return {model, contact_obstacles(model).value(), shapes, Comm(), threads};
}

Tissue spheres_at(const std::vector<Vec3d>& centers, const std::vector<double>& radii) {
  std::vector<CellRecord> cells;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    CellRecord& cell = cells.emplace_back();
    cell.row.id = CellId::founder(i + 1);
    cell.row.order = i;
    cell.row.target_volume = cell.row.birth_volume = 4.0 / 3.0 * std::numbers::pi * radii[i] * radii[i] * radii[i];
    cell.sphere = SphereRecord{centers[i], radii[i], {}, {}};
  }
  Tissue tissue;
  put_together(tissue, std::move(cells));
  return tissue;
}

/// Fifty spheres of radius 5 to 6.5 µm in a ball, so tight that forces reach hundreds of nN, nobody's centre within a neighbour's cap limit.
Tissue crowd() {
  const Random random(11, RandomStream::kInitialPosition);
  std::vector<Vec3d> centers;
  std::vector<double> radii;
  for (std::uint64_t k = 0; centers.size() < 50; ++k) {
    const CellId id = CellId::founder(k + 1);
    const Vec3d at = random.direction(id, 0) * (16.0 * std::cbrt(0.5 + 0.5 * random.direction(id, 1).x));
    const bool near = std::any_of(centers.begin(), centers.end(), [&](const Vec3d& c) { return norm(c - at) < 4.5; });
    if (near) continue;
    centers.push_back(at);
    radii.push_back(5.75 + 0.75 * random.direction(id, 2).x);
  }
  return spheres_at(centers, radii);
}

TEST(SpherePacking, ForceIsMinusTheGradientOfTheEnergy) {
  Model model = packing_model(0.0);
  ShapeLibrary shapes;
  Mechanics mechanics = mechanics_of(model, shapes);
  Tissue tissue = crowd();
  std::vector<Vec3d> force, ignored;
  (void)mechanics.energy_and_forces(tissue, force);
  double most = 0.0;
  Vec3d sum, torque;
  for (std::size_t i = 0; i < force.size(); ++i) {
    most = std::max(most, norm(force[i]));
    sum += force[i];
    torque += cross(tissue.spheres.position[i], force[i]);
  }
  EXPECT_GT(most, 50.0);
  EXPECT_LE(norm(sum), 1e-12 * most);
  EXPECT_LE(norm(torque), 1e-11 * most);
  const double h = 1e-5;
  for (std::size_t i = 0; i < force.size(); i += 3)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double& x = tissue.spheres.position[i][axis];
      const double at = x;
      x = at + h;
      mechanics.bodies_changed();  // else it takes positions for its own
      const double high = mechanics.energy_and_forces(tissue, ignored);
      x = at - h;
      mechanics.bodies_changed();
      const double low = mechanics.energy_and_forces(tissue, ignored);
      x = at;
      EXPECT_NEAR(-(high - low) / (2.0 * h), force[i][axis], 1e-6 * most) << i << ' ' << axis;
    }
}

TEST(SpherePacking, PeriodicCubicPackingHasTheReferencePressures) {
  struct Point {
    double s, pressure;
  };
  for (const Point& p : {Point{0.05, 6.257e-3}, Point{0.115, 165.12e-3}, Point{0.12, 207.61e-3}, Point{0.20, 922.44e-3}}) {
    Model model = packing_model(0.0);
    const double d = 2.0 * 6.0 * (1.0 - p.s), a = d * std::numbers::sqrt2, size = 4.0 * a;
    model.space.box = {{0, 0, 0}, {size, size, size}};
    for (auto& axis : model.space.boundary) axis[0] = axis[1] = BoundaryKind::kPeriodic;
    std::vector<Vec3d> centers;
    for (int x = 0; x < 4; ++x)
      for (int y = 0; y < 4; ++y)
        for (int z = 0; z < 4; ++z)
          for (const Vec3d& base : {Vec3d{0, 0, 0}, Vec3d{0.5, 0.5, 0}, Vec3d{0.5, 0, 0.5}, Vec3d{0, 0.5, 0.5}})
            centers.push_back((base + Vec3d{x + 0.1, y + 0.1, z + 0.1}) * a);
    Tissue tissue = spheres_at(centers, std::vector<double>(centers.size(), 6.0));
    ShapeLibrary shapes;
    Mechanics mechanics = mechanics_of(model, shapes);
    const std::vector<double> pressure = mechanics.pressures(tissue);
    // A cell has the volume d³/√2 of the lattice or, in the loose packing, that of its sphere: the rest is between cells.
    const double taken = std::min(1.0, 4.0 / 3.0 * std::numbers::pi * 216.0 / (d * d * d / std::numbers::sqrt2));
    for (const double here : pressure) ASSERT_NEAR(here * taken, p.pressure, 0.005 * p.pressure) << p.s;
    EXPECT_NEAR(mechanics.packing()[7], 3.0 * p.s * p.s * (3.0 - p.s), 1e-9);
  }
}

TEST(SpherePacking, GivesTheSameBitsOnAnyNumberOfThreadsAndMovesSpheresApart) {
  const Model model = packing_model(0.02);
  std::vector<Tissue> tissues(2, crowd());
  double energy = 1e300;
  for (std::size_t t = 0; t < tissues.size(); ++t) {
    ShapeLibrary shapes;
    Mechanics mechanics = mechanics_of(model, shapes, static_cast<int>(t) + 1);
    const std::vector<Vec3d> none(Mechanics::external_size(tissues[t]));
    double dt = 0.01, last = 1e300;
    for (int k = 0; k < 8; ++k) {
      const auto done = mechanics.step(tissues[t], dt, none);
      if (!done.ok()) {
        dt *= 0.25;
        continue;
      }
      EXPECT_LE(done->energy, last + 1e-9);
      last = done->energy;
      dt *= 1.5;
    }
    EXPECT_TRUE(t == 0 || last == energy);
    energy = last;
  }
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_EQ(tissues[0].spheres.position[i], tissues[1].spheres.position[i]);
  }
}

/// The operator holds the whole of a uniform compression and is positive semi-definite: few Newton iterations suffice.
TEST(SpherePacking, OperatorIsPositiveSemiDefiniteAndHoldsABreath) {
  SpherePairs pairs;
  const auto n = [](Vec3d v) { return normalized(v); };
  const std::vector<Vec3d> at{{0, 0, 0}, {9, 1, 0}, {-1, 9, 2}, {-8, -5, 1}, {2, -3, -9}};
  for (std::uint32_t i = 1; i < 5; ++i) pairs.pairs.push_back({0, i, 0});
  pairs.pairs.push_back({1, 2, 0});
  for (const SpherePair& pair : pairs.pairs) {
    const Vec3d normal = n(at[pair.b] - at[pair.a]);
    SpherePairElement& e = pairs.elements.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) e.n[axis] = static_cast<float>(normal[axis]);
    pairs.packing.slopes.push_back({2.0f + static_cast<float>(pair.b), 1.0f});
  }
  pairs.packing.on = true;
  pairs.packing.resistance = {0.5f, 0.25f, 0.0f, 1.0f, 0.125f};
  pairs.set_layout(0, 5, 1);
  const auto product = [&](const std::vector<Float4>& p) {
    std::vector<Float4> q(5);
    pairs.add_product(p, q, 2.0f);
    return q;
  };
  std::vector<std::vector<Float4>> column;  // the matrix itself
  for (std::size_t k = 0; k < 15; ++k) {
    std::vector<Float4> unit(5);
    (&unit[k / 3].x)[k % 3] = 1.0f;
    column.push_back(product(unit));
  }
  const auto entry = [&](std::size_t row, std::size_t col) { return static_cast<double>((&column[col][row / 3].x)[row % 3]); };
  for (std::size_t i = 0; i < 15; ++i)
    for (std::size_t j = 0; j < 15; ++j) EXPECT_NEAR(entry(i, j), entry(j, i), 1e-4);
  std::vector<SymMat3<float>> diagonal(5);
  pairs.add_diagonal(diagonal, 2.0f);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(diagonal[i].xx, entry(3 * i, 3 * i), 1e-4);
    EXPECT_NEAR(diagonal[i].xy, entry(3 * i, 3 * i + 1), 1e-4);
    EXPECT_NEAR(diagonal[i].yz, entry(3 * i + 1, 3 * i + 2), 1e-4);
    EXPECT_NEAR(diagonal[i].zz, entry(3 * i + 2, 3 * i + 2), 1e-4);
  }
  // Σ_i Δt c_i (g_i·p)², from the definition of g_i.
  const Random random(5, RandomStream::kInitialPosition);
  for (std::uint64_t k = 0; k < 20; ++k) {
    std::vector<Float4> p(5);
    double growth[5] = {};
    for (std::size_t i = 0; i < 5; ++i) {
      const Vec3d v = random.direction(CellId::founder(i + 1), k);
      p[i] = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0.0f};
    }
    for (std::size_t e = 0; e < pairs.pairs.size(); ++e) {
      const SpherePair& pair = pairs.pairs[e];
      double approach = 0.0;
      for (int axis = 0; axis < 3; ++axis) approach += pairs.elements[e].n[axis] * ((&p[pair.a].x)[axis] - (&p[pair.b].x)[axis]);
      growth[pair.a] += pairs.packing.slopes[e].a * approach;
      growth[pair.b] += pairs.packing.slopes[e].b * approach;
    }
    double wanted = 0.0, found = 0.0;
    for (std::size_t i = 0; i < 5; ++i) wanted += 2.0 * pairs.packing.resistance[i] * growth[i] * growth[i];
    const auto q = product(p);
    for (std::size_t i = 0; i < 5; ++i) found += p[i].x * q[i].x + p[i].y * q[i].y + p[i].z * q[i].z;
    EXPECT_NEAR(found, wanted, 1e-5 * (1.0 + wanted));
    EXPECT_GE(found, -1e-5);
  }
}

/// A sphere between shells, spheres and a wall, all pressed together.
struct Mixed {
  Model model = packing_model(0.05);
  ShapeLibrary shapes;
  Tissue tissue;
  Mixed() {
    model.space.box = {{-200, -200, -5.0}, {200, 200, 200}};
    model.space.boundary[2][0] = BoundaryKind::kWall;
    using B = BodyKind;
    tissue = test::make_tissue(model, shapes, {{0, 0, 0}, {9.9, 0.3, 0.2}, {-4.9, 8.4, 0.5}, {-4.8, -8.5, 1.0}, {0.4, 0.2, 9.8}},
                               {B::kSphere, B::kShell, B::kSphere, B::kShell, B::kSphere});
    tissue.obstacle_offset.resize(1);
  }
};

TEST(SpherePacking, BetweenShellsSpheresAndAWallForcesAreTheGradientAndBalance) {
  Mixed mixed;
  mixed.model.types[0].sphere.packing =
      cbm::PackingCurve::through(std::vector<cbm::PackingKnot>{{0.01, 0.0}, {0.03, 0.1}, {0.1, 0.6}, {0.2, 1.0}}).value();
  Mechanics mechanics = mechanics_of(mixed.model, mixed.shapes);
  std::vector<Vec3d> force, ignored;
  (void)mechanics.energy_and_forces(mixed.tissue, force);
  const auto packing = mechanics.packing();
  EXPECT_GT(*std::max_element(packing.begin(), packing.end()), 0.08);
  double most = 0.0;
  for (const Vec3d& f : force) most = std::max(most, norm(f));
  const double h = 1e-6;
  const std::size_t nodes = mixed.tissue.shells.position.size();
  for (std::size_t i = 0; i < force.size(); i = i < nodes ? std::min(i + 7, nodes) : i + 1)  // some nodes, and all spheres
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double& x = (i < nodes ? mixed.tissue.shells.position[i] : mixed.tissue.spheres.position[i - nodes])[axis];
      const double at = x;
      x = at + h;
      mechanics.bodies_changed();  // else it takes positions for its own
      const double high = mechanics.energy_and_forces(mixed.tissue, ignored);
      x = at - h;
      mechanics.bodies_changed();
      const double low = mechanics.energy_and_forces(mixed.tissue, ignored);
      x = at;
      EXPECT_NEAR(-(high - low) / (2.0 * h), force[i][axis], 2e-6 * most) << i << ' ' << axis;
    }
}

/// The onset has no kink, leaves what is deeper as it is, and takes 2πR w²/24 more of a cap: ∫(h − d) over the onset is w²/24 of a length.
TEST(SpherePacking, SetsInSmoothly) {
  const double w = 0.2;
  for (const double end : {6.0 - 0.5 * w, 6.0 + 0.5 * w}) {
    const auto before = PackingDepth::of(end - 1e-9, 6.0, w), after = PackingDepth::of(end + 1e-9, 6.0, w);
    EXPECT_NEAR(before.depth, after.depth, 1e-8);
    EXPECT_NEAR(before.slope, after.slope, 1e-7);
  }
  EXPECT_EQ(PackingDepth::of(6.1001, 6.0, w).slope, 0.0);
  EXPECT_DOUBLE_EQ(PackingDepth::of(5.8, 6.0, w).depth, PackingDepth::of(5.8, 6.0, 0.0).depth);
  double more = 0.0;
  const int rings = 20000;
  for (int k = 0; k < rings; ++k) {
    const double r = 5.8 + 0.4 * (k + 0.5) / rings;
    more += (PackingDepth::of(r, 6.0, w).depth - PackingDepth::of(r, 6.0, 0.0).depth) * 2.0 * std::numbers::pi * r * 0.4 / rings;
  }
  const double expected = 2.0 * std::numbers::pi * 6.0 * w * w / 24.0;
  EXPECT_NEAR(more, expected, 0.02 * expected);  // w/R of it: the disc is curved
}

/// A flat shell face counts as the radical plane of two equal spheres does.
TEST(SpherePacking, AFlatSurfaceTakesTheCapOfItsPlane) {
  for (const double l : {5.9, 5.5, 5.0, 4.0}) {
    double sum = 0.0;  // over the disc within the sphere, ring by ring: s ds = r dr
    const int rings = 20000;
    for (int k = 0; k < rings; ++k) {
      const double r = l + (6.0 - l) * (k + 0.5) / rings;
      sum += PackingDepth::of(r, 6.0, 0.0).depth * 2.0 * std::numbers::pi * r * (6.0 - l) / rings;
    }
    EXPECT_NEAR(sum, cbm::plane_cap(6.0, 6.0 - l).volume, 1e-7 * (1.0 + sum));
  }
  const double h = 1e-6;
  for (const double onset : {0.0, 0.2, 0.5})
    for (const double r : {2.0, 4.0, 5.85, 5.95, 6.02, 6.09, 6.2}) {
      const auto low = PackingDepth::of(r - h, 6.0, onset), here = PackingDepth::of(r, 6.0, onset),
                 high = PackingDepth::of(r + h, 6.0, onset);
      EXPECT_NEAR(-(high.depth - low.depth) / (2.0 * h), here.slope, 1e-8);
      EXPECT_NEAR(-(high.slope - low.slope) / (2.0 * h), here.curvature, 1e-8);
    }
}

}  // namespace
}  // namespace morula
