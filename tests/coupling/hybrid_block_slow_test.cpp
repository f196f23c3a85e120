/// Half spheres, half shells in one block under pressure: one p for both (fields_and_coupling.md, D, test (a); decision 0023).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/simulation.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

constexpr double kRadius = 6.0, kBulk = 2.5;
constexpr int kCells[3] = {4, 3, 3};  // of the cubic lattice; the left half are spheres, the right half shells

/// A cubic close packing whose cells have this part of their free volume, with a fluid cortex and without adhesion.
Model block_model(double lattice) {
  Model model = test::clusters_model(0.0);
  CellType& type = model.types[0];
  type.cycles = false;
  type.radius.mean = kRadius;
  type.shell.tension = 0.2;
  type.shell.bulk_modulus = kBulk;
  type.shell.spring_stiffness = type.shell.hinge_stiffness = 0.0;
  type.shell.shape_stiffness = 0.06;
  type.shell.barrier_stiffness = 1.0;
  type.sphere.packing = cbm::PackingCurve::through(cbm::ideal_filled_cell(kBulk, 0.45, 0.4).value()).value();
  model.contact.range = 0.5;
  model.contact.repulsion = 100.0;
  model.contact.points_per_face = 3;
  model.space.box = {{0, 0, 0}, {kCells[0] * lattice, kCells[1] * lattice, kCells[2] * lattice}};
  for (auto& axis : model.space.boundary) axis[0] = axis[1] = BoundaryKind::kPeriodic;
  return model;
}

/// The cells begin with 65 % of their volume and inflate within 20 minutes.
Tissue block_of(const Model& model, ShapeLibrary& shapes, double lattice) {
  std::vector<Vec3d> centers;
  std::vector<BodyKind> bodies;
  for (int x = 0; x < kCells[0]; ++x)
    for (int y = 0; y < kCells[1]; ++y)
      for (int z = 0; z < kCells[2]; ++z)
        for (const Vec3d& base : {Vec3d{0, 0, 0}, Vec3d{0.5, 0.5, 0}, Vec3d{0.5, 0, 0.5}, Vec3d{0, 0.5, 0.5}}) {
          centers.push_back((base + Vec3d{x + 0.25, y + 0.25, z + 0.25}) * lattice);
          bodies.push_back(2 * x < kCells[0] ? BodyKind::kSphere : BodyKind::kShell);
        }
  Tissue tissue = test::make_tissue(model, shapes, centers, bodies, 162, kRadius * std::cbrt(0.65));
  const double whole = 4.0 / 3.0 * std::numbers::pi * std::pow(kRadius, 3);
  for (std::size_t i = 0; i < tissue.cells.size(); ++i) {
    tissue.cells.side.inflation_left.set(i, 0.35 * whole, tissue.cells.size());
    tissue.cells.side.inflation_rate.set(i, 0.35 * whole / 1200.0, tissue.cells.size());
  }
  return tissue;
}

struct Compression {
  double ratio;  ///< V/V0
  /// Of the level K_V ln(V0/V), relative: 5 %. At 0.95 cells at 0.2 kPa are round along their edges by γ/p_in = 0.9 µm: with 52 µm of edges a cell
  /// 0.161 r² 52 µm = 7 µm³ of the 860 µm³ are between them, and K_V times 0.8 % is 16 % of the 128 Pa.
  double level;
  friend void PrintTo(const Compression& c, std::ostream* out) { *out << c.ratio; }
};

class HybridBlock : public testing::TestWithParam<Compression> {};

TEST_P(HybridBlock, HasOnePressure) {
  const double ratio = GetParam().ratio, lattice = std::numbers::sqrt2 * 10.8564 * std::cbrt(ratio);  // 10.8564 µm apart at V = V0
  const Model model = block_model(lattice);
  ShapeLibrary shapes;
  auto simulation = std::move(Simulation::create(model, block_of(model, shapes, lattice), Comm(), 1)).value();
  ASSERT_TRUE(simulation->first_swaps().ok());
  while (simulation->tissue().clock.time < 3600.0) {
    const auto done = simulation->step(3600.0);
    ASSERT_TRUE(done.ok()) << done.error().message;
  }
  const BodyValues values = simulation->values();
  const std::vector<Vec3d> center = simulation->centers();
  std::vector<double> layer(static_cast<std::size_t>(2 * kCells[0]), 0.0), cells(layer);
  double mean = 0.0;
  std::size_t shell = 0, sphere = simulation->tissue().shells.size();
  for (std::size_t i = 0; i < center.size(); ++i) {
    const std::size_t body = simulation->tissue().cells.rows[i].body == BodyKind::kShell ? shell++ : sphere++;
    const auto l = static_cast<std::size_t>(std::floor(2.0 * center[i].x / lattice)) % layer.size();
    layer[l] += values.pressure[body];
    cells[l] += 1.0;
    mean += values.pressure[body] / static_cast<double>(center.size());
  }
  const double ideal = kBulk * std::log(1.0 / ratio);  // K_V ln(V0/V)
  for (std::size_t l = 0; l < layer.size(); ++l) {
    EXPECT_NEAR(layer[l] / cells[l] / mean, 1.0, 0.03) << "layer " << l;
    EXPECT_NEAR(layer[l] / cells[l] / ideal, 1.0, GetParam().level) << "layer " << l;
  }
}

INSTANTIATE_TEST_SUITE_P(Compressed, HybridBlock,
                         testing::Values(Compression{0.95, 0.16}, Compression{0.90, 0.05}, Compression{0.85, 0.05}));

}  // namespace
}  // namespace morula
