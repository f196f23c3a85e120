// Nucleus and cytoskeleton of one cell: T12.1, T12.2, and what every force must pass.
#include "dcm/interior.h"

#include <gtest/gtest.h>

#include <numbers>

#include "dcm/laws/nucleus_repulsion.h"
#include "tests/dcm/shell_fixtures.h"

namespace morula::dcm {
namespace {

using namespace testing;

constexpr double kVolume = 904.778684233860;

/// A cell of radius 6, its nodes and nucleus, and what is inside it.
struct Cell {
  InteriorParameters parameters;
  std::shared_ptr<const ReferenceShape> shape;
  InteriorLinks links;
  std::vector<Vec3d> node;
  Vec3d nucleus;
  double rest_volume = kVolume;

  explicit Cell(const InteriorParameters& p, std::uint32_t nodes = 162) : parameters(p) {
    ShapeLibrary shapes;
    shape = shapes.icosphere(nodes).value();
    links = choose_links(*shape, parameters);
    for (const Vec3d& x : shape->position) node.push_back(x * std::cbrt(kVolume));
  }
  /// Out of shape, so that links pull and the nucleus overlaps with the cortex.
  void distort() {
    const auto noise = random_vectors(node.size(), 5);
    for (std::size_t i = 0; i < node.size(); ++i)
      node[i] = Vec3d{1.3 * node[i].x, node[i].y, 0.55 * node[i].z} + 0.1 * noise[i] + Vec3d{2, 1, -1};
    nucleus = {2.2, 1.1, -1.15};
  }
  [[nodiscard]] InteriorView view() const {
    InteriorView out;
    out.parameters = &parameters;
    out.links = &links;
    out.topology = shape->topology.get();
    out.node = node;
    out.nucleus = parameters.has_nucleus() ? &nucleus : nullptr;
    out.rest_volume = rest_volume;
    out.repulsion = 100.0;
    return out;
  }
  struct Forces {
    std::vector<Vec3d> node;
    Vec3d nucleus;
    InteriorEnergy energy;
  };
  [[nodiscard]] Forces forces() const {
    Forces out;
    out.node.resize(node.size());
    out.energy = add_interior_forces(view(), out.node, parameters.has_nucleus() ? &out.nucleus : nullptr);
    return out;
  }
  [[nodiscard]] std::vector<double> node_area() const {
    std::vector<double> out(node.size());
    for (const Triangle& t : shape->topology->faces()) {
      const double third = norm(cross(node[t[1]] - node[t[0]], node[t[2]] - node[t[0]])) / 6.0;
      for (const std::uint32_t i : t) out[i] += third;
    }
    return out;
  }
};

InteriorParameters everything() {
  InteriorParameters p;
  p.nucleus_fraction = 0.2;  // radius 3.5: overlaps with the distorted cortex
  p.nucleus_links = {60, 0.02, 0.3, false};
  p.cortex_links = {30, 0.01, 0.2, true};
  return p;
}

TEST(Interior, ForceIsMinusTheGradientOfItsEnergy) {
  Cell cell(everything());
  cell.distort();
  const auto at = cell.forces();
  ASSERT_GT(at.energy.contact_area, 5.0) << "the nucleus touches the cortex";
  ASSERT_GT(at.energy.overlap, 0.1);
  double size = 0.0;
  for (const Vec3d& f : at.node) size += norm2(f);
  size = std::sqrt(size + norm2(at.nucleus));
  for (int k = 0; k < 20; ++k) {
    const auto d = random_vectors(cell.node.size() + 1, 100 + k);
    const double h = 1e-5;
    const auto energy_at = [&](double step) {
      Cell moved = cell;
      for (std::size_t i = 0; i < moved.node.size(); ++i) moved.node[i] += step * d[i];
      moved.nucleus += step * d.back();
      return moved.forces().energy.energy;
    };
    double slope = dot(at.nucleus, d.back()), length = norm2(d.back());
    for (std::size_t i = 0; i < cell.node.size(); ++i) slope += dot(at.node[i], d[i]), length += norm2(d[i]);
    EXPECT_NEAR((energy_at(-h) - energy_at(h)) / (2.0 * h), slope, 1e-6 * size * std::sqrt(length));
  }
}

TEST(Interior, HasNoNetForceAndNoNetTorque) {
  Cell cell(everything());
  cell.distort();
  const auto at = cell.forces();
  Vec3d force = at.nucleus, torque = cross(cell.nucleus, at.nucleus);
  double sum = norm(at.nucleus);
  for (std::size_t i = 0; i < cell.node.size(); ++i) {
    force += at.node[i];
    torque += cross(cell.node[i], at.node[i]);
    sum += norm(at.node[i]);
  }
  ASSERT_GT(sum, 1.0);
  EXPECT_LE(norm(force), 1e-12 * sum);
  EXPECT_LE(norm(torque), 1e-12 * 6.0 * sum);
}

TEST(Interior, DoesNothingInTheUndeformedCellAndGrowsWithIt) {
  Cell cell(everything());
  const auto sum = [](const Cell& c) {
    double out = norm(c.forces().nucleus);
    for (const Vec3d& f : c.forces().node) out += norm(f);
    return out;
  };
  EXPECT_LT(sum(cell), 1e-12);
  cell.rest_volume *= 2.0;
  for (Vec3d& x : cell.node) x *= std::cbrt(2.0);
  EXPECT_LT(sum(cell), 1e-12) << "rest lengths and nucleus grow with the cell";
  EXPECT_NEAR(nucleus_radius(cell.parameters, 2.0 * kVolume) / nucleus_radius(cell.parameters, kVolume), 1.259921, 1e-6);
}

TEST(NucleusLinks, HoldTheNucleusByAThirdOfTheirSum) {
  InteriorParameters p;
  p.nucleus_fraction = 65.450 / kVolume;
  p.nucleus_links = {LinkParameters::kAll, 0.01, 0.0, false};
  Cell cell(p);
  EXPECT_EQ(cell.links.nucleus.size(), 162u);
  for (const Vec3d& way : {Vec3d{1e-5, 0, 0}, Vec3d{0, 6e-6, 8e-6}}) {
    cell.nucleus = way;
    EXPECT_LE(norm(cell.forces().nucleus + 0.540 * way), 1e-5 * 0.540 * norm(way));
  }
}

TEST(Nucleus, HasTheRadiusAndTheDragOfTheReferenceCell) {
  InteriorParameters p;
  p.nucleus_fraction = 65.450 / kVolume;
  EXPECT_NEAR(nucleus_radius(p, kVolume), 2.5, 1e-5);
  EXPECT_NEAR(CytoplasmDrag{1e-3}.coefficient(2.5), 0.04712, 5e-6);
}

TEST(Links, AreChosenEvenlyAndOnce) {
  InteriorParameters p;
  p.nucleus_fraction = 0.07;
  p.nucleus_links = {40, 0.01, 0.0, false};
  p.cortex_links = {LinkParameters::kAll, 0.01, 0.0, false};
  const Cell cell(p);
  ASSERT_EQ(cell.links.nucleus.size(), 40u);
  Vec3d mean;
  std::vector<char> seen(162, 0);
  for (const InteriorLink& link : cell.links.nucleus) {
    EXPECT_EQ(seen[link.i]++, 0);
    mean += normalized(cell.node[link.i]) * (1.0 / 40.0);
  }
  EXPECT_LT(norm(mean), 0.35) << "3 standard deviations of 40 even directions are 0.47";
  ASSERT_EQ(cell.links.cortex.size(), 81u) << "162 nodes in pairs of opposite ones";
  for (const InteriorLink& link : cell.links.cortex) {
    EXPECT_LT(norm(cell.node[link.i] + cell.node[link.j]), 1e-9 * 6.0);
    EXPECT_NEAR(link.rest * std::cbrt(kVolume), norm(cell.node[link.i] - cell.node[link.j]), 1e-12 * 12.0);
  }
}

TEST(Links, GoSlackWhereTheyOnlyPull) {
  const CytoskeletonLink rod{2.0, 0.0, false}, filament{2.0, 0.0, true};
  EXPECT_DOUBLE_EQ(rod.pull(0.9, 1.0), -0.2);
  EXPECT_EQ(filament.pull(0.9, 1.0), 0.0);
  EXPECT_EQ(filament.energy(0.9, 1.0), 0.0);
  EXPECT_DOUBLE_EQ(filament.pull(1.1, 1.0), rod.pull(1.1, 1.0));
  EXPECT_EQ(filament.stiffness_psd({1, 0, 0}, 0.9, 1.0).xx, 0.0);
}

/// The matrix of all points, column by column through add_interior_product().
struct Matrix {
  const Cell& cell;
  InteriorFriction friction;
  InteriorOperator matrix;
  Matrix(const Cell& c, double dt) : cell(c) {
    find_interior_friction(c.view(), c.node_area(), friction);
    assemble_interior(c.view(), friction, dt, matrix);
  }
  [[nodiscard]] std::vector<Vec3d> times(std::span<const Vec3d> p) const {
    std::vector<Float4> in(p.size()), out(p.size());
    for (std::size_t i = 0; i < p.size(); ++i)
      in[i] = {static_cast<float>(p[i].x), static_cast<float>(p[i].y), static_cast<float>(p[i].z), 0.0f};
    const std::size_t n = p.size() - 1;
    add_interior_product(cell.view(), matrix, std::span(in).first(n), std::span(out).first(n), &in[n], &out[n]);
    std::vector<Vec3d> result;
    for (const Float4& v : out) result.push_back({v.x, v.y, v.z});
    return result;
  }
};

TEST(InteriorOperator, IsSymmetricPositiveAndHasTheDiagonalItSays) {
  Cell cell(everything(), 42);
  cell.distort();
  const Matrix m(cell, 5.0);
  ASSERT_FALSE(m.matrix.contact.empty());
  const std::size_t n = cell.node.size() + 1;
  std::vector<SymMat3<float>> diagonal(n - 1);
  SymMat3<float> last{};
  add_interior_diagonal(cell.view(), m.matrix, diagonal, &last);
  diagonal.push_back(last);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<Vec3d> unit(n);
    unit[i].x = 1.0;
    const Vec3d column = m.times(unit)[i];
    EXPECT_NEAR(column.x, diagonal[i].xx, 1e-4 * (1.0 + diagonal[i].xx));
    EXPECT_NEAR(column.y, diagonal[i].xy, 1e-4 * (1.0 + diagonal[i].xx));
  }
  for (int k = 0; k < 10; ++k) {
    const auto a = random_vectors(n, 40 + k), b = random_vectors(n, 60 + k);
    const auto ma = m.times(a), mb = m.times(b);
    double aa = 0.0, ab = 0.0, ba = 0.0;
    for (std::size_t i = 0; i < n; ++i) aa += dot(a[i], ma[i]), ab += dot(a[i], mb[i]), ba += dot(b[i], ma[i]);
    EXPECT_GT(aa, 0.0);
    EXPECT_NEAR(ab, ba, 1e-4 * aa);
  }
}

TEST(InteriorOperator, IsFrictionPlusTheStiffnessOfTheForce) {
  Cell cell(everything());
  cell.parameters.nucleus_fraction = 0.07;  // no contact: then nothing is left out but slack links, and all are at rest
  cell.parameters.cortex_links.tension_only = false;
  const double dt = 3.0, h = 1e-6;
  const Matrix m(cell, dt);
  const auto d = random_vectors(cell.node.size() + 1, 9);
  const auto product = m.times(d);
  Cell plus = cell, minus = cell;
  for (std::size_t i = 0; i < cell.node.size(); ++i) plus.node[i] += h * d[i], minus.node[i] -= h * d[i];
  plus.nucleus += h * d.back(), minus.nucleus -= h * d.back();
  const auto fp = plus.forces(), fm = minus.forces();
  std::vector<Vec3d> rub(cell.node.size());
  Vec3d nucleus_rub;
  const double quadratic =
      add_interior_friction(cell.view(), m.friction, std::span(d).first(cell.node.size()), &d.back(), rub, &nucleus_rub);
  double work = dot(nucleus_rub, d.back()), error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < cell.node.size(); ++i) {
    const Vec3d expected = rub[i] + (fm.node[i] - fp.node[i]) * (dt / (2.0 * h));
    error += norm2(product[i] - expected);
    size += norm2(expected);
    work += dot(rub[i], d[i]);
  }
  error += norm2(product.back() - nucleus_rub - (fm.nucleus - fp.nucleus) * (dt / (2.0 * h)));
  EXPECT_LE(std::sqrt(error / size), 1e-5);
  EXPECT_NEAR(work, quadratic, 1e-12 * quadratic);
  EXPECT_GT(quadratic, 0.0);
}

TEST(InteriorFriction, ResistsNoRigidMotion) {
  const Cell cell(everything());
  const Matrix m(cell, 0.0);
  const Vec3d shift{3, -1, 2}, spin{0.1, 0.3, -0.2};
  std::vector<Vec3d> way;
  for (const Vec3d& x : cell.node) way.push_back(shift + cross(spin, x));
  const Vec3d nucleus_way = shift + cross(spin, cell.nucleus);
  std::vector<Vec3d> rub(cell.node.size());
  Vec3d nucleus_rub;
  EXPECT_LE(add_interior_friction(cell.view(), m.friction, way, &nucleus_way, rub, &nucleus_rub), 1e-20);
  for (const Vec3d& f : rub) EXPECT_LE(norm(f), 1e-12);
  EXPECT_LE(norm(nucleus_rub), 1e-12);
}

}  // namespace
}  // namespace morula::dcm
