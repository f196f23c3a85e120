#include "coupling/mechanics/node_terms.h"

#include <gtest/gtest.h>

#include <random>

#include "coupling/face_marks.h"
#include "coupling/simulation.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

SurfaceGeometry geometry_of(const Tissue& tissue) {
  std::vector<const Topology*> topology;
  std::vector<std::uint32_t> first_face{0};
  for (std::size_t s = 0; s < tissue.shells.size(); ++s) {
    topology.push_back(&tissue.shells.topology(s));
    first_face.push_back(first_face.back() + topology.back()->face_count());
  }
  SurfaceGeometry out;
  compute_surface_geometry({topology, tissue.shells.first_node, first_face}, tissue.shells.position, out);
  return out;
}

/// A rigid sphere feels (γ_n + 2γ_t)/3 of its area, and one that breathes γ_n.
TEST(NodeTerms, FrictionAcrossAndAlongAddsUpToTheDragOfASphere) {
  for (const auto& [across, along] : {std::pair{0.3, 0.06}, {0.06, 0.3}}) {
    Model model = test::clusters_model();
    CellType& type = model.types[0];
    type.shell.medium_friction = std::min(across, along);
    type.medium_normal_extra = std::max(0.0, across - along);
    type.medium_tangent_extra = std::max(0.0, along - across);
    ShapeLibrary shapes;
    const Tissue tissue = test::make_tissue(model, shapes, {{4, 5, 6}}, {BodyKind::kShell}, 642);
    const SurfaceGeometry geometry = geometry_of(tissue);
    const auto blocks = NodeTerms(model).friction(tissue, geometry);
    ASSERT_EQ(blocks.size(), 642u);
    const Vec3d v = normalized(Vec3d{1, -2, 0.5});
    double drag = 0.0, breathing = 0.0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const double base = type.shell.medium_friction * geometry.node_area[i];
      drag += base + dot(v, blocks[i] * v);
      breathing += base + dot(geometry.node_normal[i], blocks[i] * geometry.node_normal[i]);
    }
    EXPECT_NEAR(drag / geometry.area[0], (across + 2.0 * along) / 3.0, 1e-10);  // Σ a n nᵀ = A/3 by the symmetry of the icosahedron
    EXPECT_NEAR(breathing / geometry.area[0], across, 1e-12);
  }
}

/// T9.2 with a tensor: V = F/(A (γ_n + 2γ_t)/3).
TEST(NodeTerms, AForceMovesACellByTheMeanOfItsFriction) {
  Model model = test::clusters_model();
  CellType& type = model.types[0];
  type.shell.spring_stiffness = 50.0;  // a stiff cell: it does not flatten before its own drag
  type.shell.bulk_modulus = 200.0;
  type.shell.medium_friction = 0.05;
  type.medium_normal_extra = 0.25;
  model.step.first_tolerance = model.step.later_tolerance = 1e-6;
  model.step.newton_stop = 1e-4;
  model.step.max_newton = 10;
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell}, 162);
  CellLoad load;
  load.force = {0.06, 0, 0.08};
  model.loads = {load};
  auto simulation = Simulation::create(model, std::move(tissue), Comm(), 1).value();
  while (simulation->tissue().clock.time < 40.0) ASSERT_TRUE(simulation->step(40.0).ok());
  const Vec3d from = simulation->centers()[0];
  const double start = simulation->tissue().clock.time;
  while (simulation->tissue().clock.time < 80.0) ASSERT_TRUE(simulation->step(80.0).ok());
  const double speed = norm(simulation->centers()[0] - from) / (simulation->tissue().clock.time - start);
  const double expected = 0.1 / (simulation->values().area[0] * (0.3 + 2.0 * 0.05) / 3.0);
  EXPECT_NEAR(speed / expected, 1.0, 0.02);
}

Model sprung() {
  Model model = test::clusters_model();
  model.mark_names = {"apical"};
  FaceMark rule;
  rule.axis_from = FaceMark::Axis::kTowardPoint;
  rule.angle = 1.0;
  model.marks = {rule};
  model.apical_springs = {{.name = "inner", .mark = 0, .stiffness = 0.3, .friction = 0.2}};
  return model;
}

Tissue ring_of_cells(const Model& model, ShapeLibrary& shapes) {
  std::vector<Vec3d> center;
  for (int k = 0; k < 5; ++k) center.push_back(Vec3d{std::cos(1.2566 * k), std::sin(1.2566 * k), 0.05 * k} * 11.0);
  Tissue tissue = test::make_tissue(model, shapes, center, std::vector(5, BodyKind::kShell));
  mark_new_shells(model, tissue);
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  for (Vec3d& x : tissue.shells.position) x += 0.1 * Vec3d{normal(engine), normal(engine), normal(engine)};
  return tissue;
}

TEST(ApicalSprings, ForceIsMinusTheGradientAndTheNetForceIsZero) {
  const Model model = sprung();
  ShapeLibrary shapes;
  const Tissue tissue = ring_of_cells(model, shapes);
  NodeTerms terms(model);
  terms.set_springs(tissue, Comm());
  const auto energy = [&](const std::vector<Vec3d>& x, std::vector<Vec3d>& force) {
    OrderFreeSum sum;
    force.assign(x.size(), {});
    terms.add_forces(tissue.shells, x, force, sum);
    return sum.value();
  };
  std::vector<Vec3d> force, other;
  EXPECT_GT(energy(tissue.shells.position, force), -1e9);
  Vec3d sum{};
  double size = 0.0;
  for (const Vec3d& f : force) sum += f, size += norm(f);
  EXPECT_GT(size, 1.0);
  EXPECT_LT(norm(sum), 1e-12 * size);

  std::mt19937_64 engine(8);
  std::normal_distribution<double> normal;
  const auto stiffness = terms.stiffness(tissue.shells.position, force.size());
  for (int k = 0; k < 20; ++k) {
    std::vector<Vec3d> low = tissue.shells.position, high = low;
    double slope = 0.0, size_of = 0.0, quadratic = 0.0;
    for (std::size_t i = 0; i < force.size(); ++i) {
      const Vec3d d{normal(engine), normal(engine), normal(engine)};
      low[i] -= d * 1e-5, high[i] += d * 1e-5;
      slope -= dot(force[i], d), size_of += std::abs(dot(force[i], d));
      quadratic += dot(d, stiffness[i] * d);
    }
    EXPECT_NEAR((energy(high, other) - energy(low, other)) / 2e-5, slope, 1e-6 * size_of);
    EXPECT_GT(quadratic, 0.0);
  }
}

/// From a node's direction towards the sphere's centre the energy is ½ k w (r − R)² less a linear part: its second derivative is the matrix's, and across
/// the matrix holds nothing.
TEST(ApicalSprings, StiffnessIsTheSecondDerivativeTowardsTheCentre) {
  const Model model = sprung();
  ShapeLibrary shapes;
  const Tissue tissue = ring_of_cells(model, shapes);
  NodeTerms terms(model);
  terms.set_springs(tissue, Comm());
  const std::vector<Vec3d>& x = tissue.shells.position;
  const auto blocks = terms.stiffness(x, x.size());
  const auto force_at = [&](std::size_t node, const Vec3d& at) {
    std::vector<Vec3d> moved = x, force(x.size());
    moved[node] = at;
    OrderFreeSum unused;
    terms.add_forces(tissue.shells, moved, force, unused);
    return force[node];
  };
  int marked = 0;
  for (std::size_t i = 0; i < x.size(); i += 7) {
    const double held = blocks[i].xx + blocks[i].yy + blocks[i].zz;
    if (held == 0.0) continue;
    ++marked;
    // The one direction in which the block holds: its largest column.
    Vec3d radial{blocks[i].xx, blocks[i].xy, blocks[i].xz};
    for (const Vec3d& column : {Vec3d{blocks[i].xy, blocks[i].yy, blocks[i].yz}, Vec3d{blocks[i].xz, blocks[i].yz, blocks[i].zz}})
      if (norm2(column) > norm2(radial)) radial = column;
    radial = normalized(radial);
    const double h = 1e-4;
    const double second = -dot(force_at(i, x[i] + radial * h) - force_at(i, x[i] - radial * h), radial) / (2.0 * h);
    EXPECT_NEAR(second / held, 1.0, 1e-6) << i;
    EXPECT_NEAR(dot(radial, blocks[i] * radial) / held, 1.0, 1e-12) << i;
  }
  EXPECT_GT(marked, 5);
}

TEST(ApicalSprings, MakeTheMarkedFacesASphereAndRubByArea) {
  Model model = sprung();
  model.apical_springs[0].stiffness = 2.0;
  model.step.max_step = 20.0;
  ShapeLibrary shapes;
  const auto spread = [](const Tissue& tissue) {  // deviation of the distances of the marked nodes from their mean
    double sum = 0.0, square = 0.0, count = 0.0;
    Vec3d center{};
    for (int pass = 0; pass < 2; ++pass) {
      sum = square = count = 0.0;
      Vec3d mean{};
      for (std::size_t s = 0; s < tissue.shells.size(); ++s)
        for (std::size_t f = 0; f < tissue.shells.faces_of(s).mark.size(); ++f)
          if (tissue.shells.faces_of(s).mark[f])
            for (const std::uint32_t node : tissue.shells.topology(s).faces()[f]) {
              const Vec3d& x = tissue.shells.nodes(s)[node];
              const double r = norm(x - center);
              mean += x, sum += r, square += r * r, count += 1.0;
            }
      center = mean * (1.0 / count);
    }
    return std::sqrt(std::max(0.0, square / count - sum * sum / (count * count)));
  };
  double after[2];
  for (const bool held : {false, true}) {
    Model with = model;
    if (!held) with.apical_springs.clear();
    auto simulation = Simulation::create(with, ring_of_cells(model, shapes), Comm(), 1).value();
    while (simulation->tissue().clock.time < 100.0) ASSERT_TRUE(simulation->step(100.0).ok());
    after[held] = spread(simulation->tissue());
  }
  EXPECT_LT(after[1], 0.6 * after[0]);

  const Tissue tissue = ring_of_cells(model, shapes);
  NodeTerms terms(model);
  terms.set_springs(tissue, Comm());
  const auto blocks = terms.friction(tissue, geometry_of(tissue));
  double trace = 0.0, area = 0.0;
  for (const auto& b : blocks) trace += b.xx + b.yy + b.zz;
  for (std::size_t s = 0; s < 5; ++s) area += marked_area(tissue.shells.topology(s), tissue.shells.nodes(s), tissue.shells.marks_of(s), 0);
  EXPECT_NEAR(trace / 3.0, 0.2 * area, 1e-10);
}

}  // namespace
}  // namespace morula
