// The part of the matrix between a cell and a nucleus that is a shell: friction, links, and the cytosol between the two volumes.
#include <gtest/gtest.h>

#include <cmath>

#include "dcm/nuclear_shell.h"
#include "tests/dcm/shell_fixtures.h"

namespace morula::dcm {
namespace {

using namespace testing;

constexpr double kVolume = 904.778684233860, kBulkModulus = 2.5, kStep = 3.0;
constexpr std::size_t kNodes = 42;  // of each of the two

using Vectors = std::vector<Vec3d>;

std::vector<double> areas_of(const Topology& topology, std::span<const Vec3d> node) {
  std::vector<double> out(node.size());
  for (const Triangle& t : topology.faces())
    for (const std::uint32_t i : t) out[i] += norm(cross(node[t[1]] - node[t[0]], node[t[2]] - node[t[0]])) / 6.0;
  return out;
}

/// A cell and its nucleus as they are at rest: no link is stretched, and the cytosol has its reference volume.
struct CellWithNucleus {
  InteriorParameters parameters;
  ShapeLibrary shapes;
  std::shared_ptr<const ReferenceShape> shape = shapes.icosphere(kNodes).value();
  Vectors cell, nucleus;
  std::vector<InteriorLink> links;

  CellWithNucleus() {
    parameters.nucleus_fraction = 0.1;
    parameters.nucleus_nodes = kNodes;
    parameters.cytoplasm_viscosity = 0.05;
    parameters.nucleus_links = {20, 0.02, 0.1, false};
    for (const Vec3d& x : shape->position) {
      cell.push_back(x * std::cbrt(kVolume) + Vec3d{2, 1, -1});
      nucleus.push_back(x * std::cbrt(0.1 * kVolume) + Vec3d{2, 1, -1});
    }
    links = choose_nuclear_links(*shape, *shape, parameters);
  }
  [[nodiscard]] NucleusView view() const {
    return {&parameters, links, shape->topology.get(), shape->topology.get(), cell, nucleus, kVolume};
  }
  [[nodiscard]] double cytosol() const {
    const auto faces = shape->topology->faces();
    return enclosed_volume(faces, cell, cell[0]) - enclosed_volume(faces, nucleus, nucleus[0]);
  }
  [[nodiscard]] CellWithNucleus moved(const Vectors& cell_way, const Vectors& nucleus_way, double factor) const {
    CellWithNucleus out = *this;
    for (std::size_t i = 0; i < kNodes; ++i) out.cell[i] += cell_way[i] * factor, out.nucleus[i] += nucleus_way[i] * factor;
    return out;
  }
};

/// Its matrix for a step.
struct NuclearMatrix {
  const CellWithNucleus& body;
  NuclearFriction friction;
  NuclearOperator matrix;

  NuclearMatrix(const CellWithNucleus& of, double bulk_modulus) : body(of) {
    const Topology& topology = *of.shape->topology;
    find_nuclear_friction(of.view(), areas_of(topology, of.cell), areas_of(topology, of.nucleus), friction);
    assemble_nuclear_operator(of.view(), friction, bulk_modulus, kStep, matrix);
  }
  /// Products with a motion of the cell (first) and the nucleus (second).
  [[nodiscard]] std::pair<Vectors, Vectors> times(const Vectors& cell_way, const Vectors& nucleus_way) const {
    const auto in_float = [](const Vectors& v) {
      std::vector<Float4> out;
      for (const Vec3d& x : v) out.push_back({static_cast<float>(x.x), static_cast<float>(x.y), static_cast<float>(x.z), 0.0f});
      return out;
    };
    std::vector<Float4> on_cell(kNodes), on_nucleus(kNodes);
    add_nuclear_product(body.view(), matrix, in_float(cell_way), in_float(nucleus_way), on_cell, on_nucleus);
    const auto in_double = [](const std::vector<Float4>& v) {
      Vectors out;
      for (const Float4& x : v) out.push_back({x.x, x.y, x.z});
      return out;
    };
    return {in_double(on_cell), in_double(on_nucleus)};
  }
};

/// ∂V/∂x by differences of the enclosed volume.
Vectors volume_slope(const Topology& topology, Vectors x) {
  Vectors out(x.size());
  const double h = 1e-4;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double at = x[i][axis];
      x[i][axis] = at + h;
      const double high = enclosed_volume(topology.faces(), x, Vec3d{2, 1, -1});
      x[i][axis] = at - h;
      out[i][axis] = (high - enclosed_volume(topology.faces(), x, Vec3d{2, 1, -1})) / (2.0 * h);
      x[i][axis] = at;
    }
  return out;
}

/// Random, and swelling, so that volumes change.
Vectors swelling(const CellWithNucleus& body, unsigned seed, double by) {
  Vectors out = random_vectors(kNodes, seed);
  for (std::size_t i = 0; i < kNodes; ++i) out[i] += body.shape->position[i] * by;
  return out;
}

/// How far two vectors differ, as part of the second.
double difference(const Vectors& a, const Vectors& b) {
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) error += norm2(a[i] - b[i]), size += norm2(b[i]);
  return std::sqrt(error / size);
}

/// At rest nothing of the second derivative of the energy is left out: Γ d − Δt dF/dx d. The cytosol's pressure is −K_V ln(V/V0); what it does to
/// the cell by the cell's own motion is in the cell's operator. The matrix keeps 0.999 of what couples the two volumes.
TEST(NuclearOperator, IsFrictionPlusTheStiffnessOfLinksAndCytosol) {
  const CellWithNucleus body;
  const NuclearMatrix m(body, kBulkModulus);
  const Topology& topology = *body.shape->topology;
  const Vectors cell_slope = volume_slope(topology, body.cell), nucleus_slope = volume_slope(topology, body.nucleus), still(kNodes);
  Vectors cell_way = swelling(body, 4, 1.0), nucleus_way = swelling(body, 5, -2.0);
  const double h = 1e-5;
  const auto pressure_rate = [&](const Vectors& of_cell, const Vectors& of_nucleus) {
    return -kBulkModulus * std::log(body.moved(of_cell, of_nucleus, h).cytosol() / body.moved(of_cell, of_nucleus, -h).cytosol()) /
           (2.0 * h);
  };
  Vectors on_cell(kNodes), on_nucleus(kNodes);
  (void)add_nuclear_friction(body.view(), m.friction, {cell_way, nucleus_way}, {on_cell, on_nucleus});
  for (const double side : {1.0, -1.0}) {
    const CellWithNucleus moved = body.moved(cell_way, nucleus_way, side * h);
    Vectors pull_cell(kNodes), pull_nucleus(kNodes);
    (void)add_nuclear_link_forces(moved.view(), {pull_cell, pull_nucleus});
    for (std::size_t i = 0; i < kNodes; ++i) {
      on_cell[i] -= pull_cell[i] * (side * kStep / (2.0 * h));
      on_nucleus[i] -= pull_nucleus[i] * (side * kStep / (2.0 * h));
    }
  }
  const double all = pressure_rate(cell_way, nucleus_way), by_nucleus = pressure_rate(still, nucleus_way);
  for (std::size_t i = 0; i < kNodes; ++i) {
    on_cell[i] -= cell_slope[i] * (kStep * by_nucleus);
    on_nucleus[i] += nucleus_slope[i] * (kStep * all);
  }
  ASSERT_GT(std::abs(all - by_nucleus), 0.1 * std::abs(by_nucleus)) << "both volumes change";
  const auto product = m.times(cell_way, nucleus_way);
  EXPECT_LT(difference(product.first, on_cell), 2e-3);
  EXPECT_LT(difference(product.second, on_nucleus), 2e-3);
}

/// With Δt K_V/V g gᵀ of the cell's own operator beside it.
TEST(NuclearOperator, IsSymmetricAndPositiveBesideTheVolumeOfTheCell) {
  const CellWithNucleus body;
  const NuclearMatrix m(body, kBulkModulus);
  const Vectors slope = volume_slope(*body.shape->topology, body.cell);
  const auto form = [&](const Vectors& a_cell, const Vectors& a_nucleus, const Vectors& b_cell, const Vectors& b_nucleus) {
    const auto product = m.times(b_cell, b_nucleus);
    double sum = 0.0, a_rate = 0.0, b_rate = 0.0;
    for (std::size_t i = 0; i < kNodes; ++i) {
      sum += dot(a_cell[i], product.first[i]) + dot(a_nucleus[i], product.second[i]);
      a_rate += dot(a_cell[i], slope[i]), b_rate += dot(b_cell[i], slope[i]);
    }
    return sum + kStep * kBulkModulus / body.cytosol() * a_rate * b_rate;
  };
  for (unsigned k = 0; k < 10; ++k) {
    const Vectors ac = swelling(body, 20 + k, 1.0), an = swelling(body, 40 + k, 2.0), bc = swelling(body, 60 + k, -1.0),
                  bn = swelling(body, 80 + k, 1.0);
    const double aa = form(ac, an, ac, an);
    EXPECT_GT(aa, 0.0);
    EXPECT_NEAR(form(ac, an, bc, bn), form(bc, bn, ac, an), 1e-4 * aa);
  }
}

/// The volume is left out, as in the cells' own operator, and so is the drag on single nodes of the cortex: less than 0.01 of 2.6 nN·s/µm.
TEST(NuclearOperator, HasTheDiagonalItSays) {
  const CellWithNucleus body;
  const NuclearMatrix m(body, 0.0);
  std::vector<SymMat3<float>> cell(kNodes), nucleus(kNodes);
  add_nuclear_diagonal(body.view(), m.matrix, cell, nucleus);
  for (std::size_t i = 0; i < kNodes; ++i) {
    Vectors unit(kNodes);
    unit[i].x = 1.0;
    const Vec3d own = m.times(unit, Vectors(kNodes)).first[i], inner = m.times(Vectors(kNodes), unit).second[i];
    EXPECT_NEAR(own.x, cell[i].xx, 0.01);
    EXPECT_NEAR(own.y, cell[i].xy, 0.01);
    EXPECT_NEAR(inner.x, nucleus[i].xx, 1e-5);
    EXPECT_NEAR(inner.z, nucleus[i].xz, 1e-5);
  }
}

}  // namespace
}  // namespace morula::dcm
