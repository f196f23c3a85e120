// The factors of the friction inside a cell are those of the friction: Σ_k (G_kᵀ d)² = dᵀ Γ d for any motion d, exactly.
#include "dcm/interior_noise.h"

#include <gtest/gtest.h>

#include "tests/dcm/shell_fixtures.h"

namespace morula::dcm {
namespace {

using namespace testing;

constexpr double kVolume = 904.778684233860;

/// Nodes of a shape at a volume, a little out of shape and away from the origin.
std::vector<Vec3d> nodes_of(const ReferenceShape& shape, double volume, unsigned seed) {
  std::vector<Vec3d> out;
  const auto noise = random_vectors(shape.position.size(), seed);
  for (std::size_t i = 0; i < noise.size(); ++i) out.push_back(shape.position[i] * std::cbrt(volume) + 0.1 * noise[i] + Vec3d{2, 1, -1});
  return out;
}

std::vector<double> areas_of(const Topology& topology, std::span<const Vec3d> node) {
  std::vector<double> out(node.size());
  for (const Triangle& t : topology.faces())
    for (const std::uint32_t i : t) out[i] += norm(cross(node[t[1]] - node[t[0]], node[t[2]] - node[t[0]])) / 6.0;
  return out;
}

double work(std::span<const Vec3d> force, std::span<const Vec3d> way) {
  double out = 0.0;
  for (std::size_t i = 0; i < force.size(); ++i) out += dot(force[i], way[i]);
  return out;
}

InteriorParameters parameters() {
  InteriorParameters p;
  p.nucleus_fraction = 0.1;
  p.cytoplasm_viscosity = 0.05;
  p.nucleus_links = {20, 0.02, 0.3, false};
  p.cortex_links = {10, 0.02, 0.2, false};
  return p;
}

TEST(InteriorNoise, HasTheFactorsOfTheFrictionOfARigidNucleusAndLinks) {
  const InteriorParameters p = parameters();
  ShapeLibrary shapes;
  const auto shape = shapes.icosphere(42).value();
  const InteriorLinks links = choose_links(*shape, p);
  const std::vector<Vec3d> node = nodes_of(*shape, kVolume, 5), way = random_vectors(42, 6);
  const Vec3d nucleus{2.2, 1.1, -1.15}, nucleus_way{0.3, -0.2, 0.5};
  InteriorView cell;
  cell.parameters = &p, cell.links = &links, cell.topology = shape->topology.get();
  cell.node = node, cell.nucleus = &nucleus, cell.rest_volume = kVolume;
  InteriorFriction friction;
  find_interior_friction(cell, areas_of(*cell.topology, node), friction);
  std::vector<Vec3d> ignored(42);
  Vec3d ignored_nucleus;
  const double expected = add_interior_friction(cell, friction, way, &nucleus_way, ignored, &ignored_nucleus);

  ASSERT_EQ(interior_factor_count(cell), 33u);
  double sum = 0.0;
  for (std::size_t k = 0; k < 33; ++k) {
    std::vector<double> normal(33, 0.0);
    normal[k] = 1.0;
    std::vector<Vec3d> force(42);
    Vec3d on_nucleus, net;
    add_interior_noise(cell, friction, normal, force, &on_nucleus);
    for (const Vec3d& f : force) net += f;
    EXPECT_LT(norm(net + on_nucleus), 1e-12) << k;
    const double factor = work(force, way) + dot(on_nucleus, nucleus_way);
    sum += factor * factor;
  }
  EXPECT_NEAR(sum / expected, 1.0, 1e-12);
}

TEST(InteriorNoise, HasTheFactorsOfTheFrictionOfANuclearShell) {
  InteriorParameters p = parameters();
  p.cortex_links = {};
  p.nucleus_nodes = 42;
  ShapeLibrary shapes;
  const auto outer = shapes.icosphere(42).value(), inner = shapes.icosphere(42).value();
  const std::vector<InteriorLink> links = choose_nuclear_links(*outer, *inner, p);
  const std::vector<Vec3d> cell = nodes_of(*outer, kVolume, 5), nucleus = nodes_of(*inner, 0.1 * kVolume, 7);
  std::vector<Vec3d> cell_way = random_vectors(42, 8), nucleus_way = random_vectors(42, 9);
  const NucleusView view{&p, links, outer->topology.get(), inner->topology.get(), cell, nucleus, kVolume};
  NuclearFriction friction;
  find_nuclear_friction(view, areas_of(*view.cell_topology, cell), areas_of(*view.nucleus_topology, nucleus), friction);
  std::vector<Vec3d> ignored_cell(42), ignored_nucleus(42);
  const double expected = add_nuclear_friction(view, friction, {cell_way, nucleus_way}, {ignored_cell, ignored_nucleus});

  const std::size_t count = nuclear_factor_count(view);
  ASSERT_EQ(count, 126u + links.size());
  ASSERT_GT(links.size(), 0u);
  double sum = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<double> normal(count, 0.0);
    normal[k] = 1.0;
    std::vector<Vec3d> on_cell(42), on_nucleus(42);
    add_nuclear_noise(view, friction, normal, {on_cell, on_nucleus});
    Vec3d net, torque;
    for (std::size_t i = 0; i < 42; ++i) net += on_cell[i], torque += cross(cell[i], on_cell[i]);
    for (std::size_t i = 0; i < 42; ++i) net += on_nucleus[i], torque += cross(nucleus[i], on_nucleus[i]);
    EXPECT_LT(norm(net), 1e-12) << k;
    EXPECT_LT(norm(torque), 1e-11) << k;
    const double factor = work(on_cell, cell_way) + work(on_nucleus, nucleus_way);
    sum += factor * factor;
  }
  EXPECT_NEAR(sum / expected, 1.0, 1e-12);
}

}  // namespace
}  // namespace morula::dcm
