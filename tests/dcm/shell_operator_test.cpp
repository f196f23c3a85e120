#include <gtest/gtest.h>

#include <cstring>

#include "dcm/builtin.h"
#include "dcm/laws/dihedral_barrier.h"
#include "dcm/laws/triangle_shape.h"
#include "dcm/stencils/hinge.h"
#include "tests/dcm/operator_fixtures.h"

namespace morula::dcm::testing {
namespace {

std::vector<ShellParameters> everything() {
  ShellParameters p;
  p.spring_stiffness = 0.173205;
  p.hinge_stiffness = 1.0264e-3;
  p.tension = 0.5;
  p.barrier_angle = 0.5;
  p.helfrich_rigidity = 0.02;
  ShellParameters q = p;
  q.tension = 0.8, q.shape_stiffness = 0.1, q.edge_damping = 0.3;
  p.sheets = {{shell_law("neo_hooke").sheet, {0.05, 1.0}}};
  q.helfrich_rigidity = 0.0;
  q.sheets = {{shell_law("st_venant_kirchhoff").sheet, {0.02, 0.6}}, {shell_law("skalak").sheet, {0.03, 0.6}}};
  q.local_area_modulus = 0.1, q.global_area_modulus = 0.2;
  q.bulk_viscosity = 3.0;
  return {p, q};
}

class EveryShellLawInTheOperator : public ::testing::TestWithParam<ShellLaw> {};

TEST_P(EveryShellLawInTheOperator, IsSymmetricAndPositiveSemiDefinite) {
  const ShellLaw& law = GetParam();
  const Shells shells = small_rough_shell();
  ShellParameters p = nothing();
  law.strength().in(p) = 0.7;
  p.barrier_angle = 0.2;
  const Eigen::MatrixXd matrix = dense(assemble(shells, {p}, 10.0), shells);
  const double largest = matrix.cwiseAbs().maxCoeff();
  if (!law.in_operator) {
    EXPECT_EQ(largest, 0.0);
    return;
  }
  ASSERT_GT(largest, 1e-3);
  EXPECT_LE((matrix - matrix.transpose()).cwiseAbs().maxCoeff(), 1e-6 * largest);
  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
  EXPECT_GE(eigenvalues.minCoeff(), -2e-6 * eigenvalues.maxCoeff());
  EXPECT_GT(eigenvalues.maxCoeff(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryShellLawInTheOperator, ::testing::ValuesIn(shell_laws()),
                         [](const auto& test) { return test.param.info.name; });

TEST(ShellOperator, StaysPositiveDefiniteUnderAdhesionStrongerThanTension) {
  const Shells shells = small_rough_shell();
  ShellParameters p = nothing();
  p.tension = 0.5;
  std::vector<double> contact(shells.topology(0).face_count());
  for (std::size_t f = 0; f < contact.size(); ++f) contact[f] = f % 3 == 0 ? -0.9 : f % 3 == 1 ? -0.2 : 0.3;
  const Eigen::VectorXd with =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense(assemble(shells, {p}, 10.0, 8, contact), shells)).eigenvalues();
  EXPECT_GE(with.minCoeff(), -2e-6 * with.maxCoeff());
  EXPECT_GT(with.maxCoeff(), 0.1);
}

TEST(ShellOperator, TensionTakesTheContactEnergyOfItsFace) {
  const Shells shells = small_rough_shell();
  ShellParameters p = nothing(), lower = nothing();
  p.tension = 0.5, lower.tension = 0.3;
  const std::vector<double> contact(shells.topology(0).face_count(), -0.2);
  const auto d = random_vectors(shells.position.size(), 4);
  const auto a = apply(assemble(shells, {p}, 10.0, 8, contact), shells, d), b = apply(assemble(shells, {lower}, 10.0), shells, d);
  for (std::size_t i = 0; i < d.size(); ++i) EXPECT_LE(morula::norm(a[i] - b[i]), 1e-5 * norm(b));
}

TEST(ShellOperator, IsTheHessianOfStretchedSprings) {
  Shells shells = rough_shells();
  for (double& length : shells.rest_length) length *= 0.4;  // every edge of the rough shells is stretched
  std::vector<ShellParameters> types(2, nothing());
  for (ShellParameters& p : types) p.spring_stiffness = 0.173205;
  expect_force_derivative(shells, types, 1e-5);
}

TEST(ShellOperator, IsTheHessianOfThePressureAtTheReferenceVolume) {
  Shells shells = rough_shells();
  std::vector<ShellParameters> types(2, nothing());
  for (ShellParameters& p : types) p.bulk_modulus = 2.5;
  const auto at = mechanics(shells, types, shells.position);
  for (std::size_t s = 0; s < shells.size(); ++s) shells.reference_volume[s] = at.volume[s];
  expect_force_derivative(shells, types, 1e-5);
}

TEST(ShellOperator, TensionIsTheSecondDerivativeOfTheAreaAlongNormals) {
  // Flat hexagon pieces do not exist on a closed mesh: compare vᵀKv of a single face's normal motion with ½cot sums by finite
  // differences of Σ A over faces with frozen normals: A_T(v) ≈ A + ½ vᵀ S v for motion along its own normal.
  const Shells shells = small_rough_shell();
  ShellParameters p = nothing();
  p.tension = 1.0;
  const auto d = random_vectors(shells.position.size(), 8);
  const auto q = apply(with_rotations(assemble(shells, {p}, 1.0)), shells, d);
  double expected = 0.0;
  const double h = 1e-3;
  for (const Triangle& t : shells.topology(0).faces()) {
    const auto& x = shells.position;
    const Vec3d n = normalized(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]));
    const auto area = [&](double step) {
      const auto at = [&](int c) { return x[t[c]] + n * (step * morula::dot(n, d[t[c]])); };
      return 0.5 * morula::norm(cross(at(1) - at(0), at(2) - at(0)));
    };
    expected += (area(h) - 2.0 * area(0.0) + area(-h)) / (h * h);
  }
  EXPECT_NEAR(dot(d, q), expected, 1e-4 * expected);
}

TEST(ShellOperator, ShapeTermIsGaussNewtonPlusItsIsotropicPart) {
  const Shells shells = small_rough_shell();
  ShellParameters p = nothing();
  p.shape_stiffness = 0.3;
  const auto d = random_vectors(shells.position.size(), 9);
  const auto q = apply(with_rotations(assemble(shells, {p}, 1.0)), shells, d);
  const TriangleShape<double> law{0.3};
  const double size = std::pow(shells.rest_volume[0], 2.0 / 3.0), h = 1e-5;
  double expected = 0.0;
  for (std::uint32_t f = 0; f < shells.topology(0).face_count(); ++f) {
    const Triangle& t = shells.topology(0).faces()[f];
    const auto at = [&](int c, double step) { return shells.position[t[c]] + step * d[t[c]]; };
    const auto square_sum = [&](double step) {
      return norm2(at(1, step) - at(0, step)) + norm2(at(2, step) - at(1, step)) + norm2(at(0, step) - at(2, step));
    };
    const auto inverse_area = [&](double step) { return 2.0 / morula::norm(cross(at(1, step) - at(0, step), at(2, step) - at(0, step))); };
    const auto u = [&](double step) { return law.inverse_quality(inverse_area(step), square_sum(step)); };
    const double slope = (u(h) - u(-h)) / (2.0 * h), reference = shells.shape[0]->face_area[f] * size;
    const double relative = norm2(d[t[1]] - d[t[0]]) + norm2(d[t[2]] - d[t[1]]) + norm2(d[t[0]] - d[t[2]]);
    expected +=
        law.gauss_newton_weight(reference) * slope * slope + 2.0 * law.square_sum_slope(u(0.0), inverse_area(0.0), reference) * relative;
  }
  EXPECT_NEAR(dot(d, q), expected, 1e-4 * expected);
}

TEST(ShellOperator, BarrierTermIsGaussNewton) {
  const Shells shells = small_rough_shell();
  ShellParameters p = nothing();
  p.barrier_stiffness = 1.0;
  p.barrier_angle = 0.6;
  const auto d = random_vectors(shells.position.size(), 10);
  const auto a = assemble(shells, {p}, 1.0);
  const auto q = apply(a, shells, d);
  const DihedralBarrier<double> law{1.0, 0.6};
  const double h = 1e-5;
  double expected = 0.0;
  std::size_t active = 0;
  for (const Edge& edge : shells.topology(0).edges()) {
    const auto angle = [&](double step) {
      const auto at = [&](std::uint32_t i) { return shells.position[i] + step * d[i]; };
      const Vec3d e = at(edge.j) - at(edge.i);
      return hinge_angle(cross(e, at(edge.k) - at(edge.i)), cross(at(edge.l) - at(edge.i), e), normalized(e));
    };
    const double slope = (angle(h) - angle(-h)) / (2.0 * h);
    expected += law.curvature_psd(angle(0.0)) * slope * slope;
    active += std::abs(angle(0.0)) > 0.6;
  }
  ASSERT_GT(active, 0u);
  EXPECT_EQ(a.matrix.blocks[0].hinge_edge.size(), active) << "only active edges are stored";
  EXPECT_NEAR(dot(d, q), expected, 1e-4 * expected);
}

TEST(ShellOperator, HoldsHingesThatAreStiffAgainstTheTension) {
  const Shells shells = one_shell(42, 3.0);  // at rest: the Gauss–Newton matrix of hinges is the derivative of their force
  ShellParameters p = nothing();
  p.hinge_stiffness = 2.0;
  expect_force_derivative(shells, {p}, 1e-4);

  const std::size_t edges = shells.topology(0).edge_count();
  const auto terms = [&](double hinge, double tension) {
    p.hinge_stiffness = hinge, p.tension = tension;
    return assemble(shells, {p}, 10.0).matrix.blocks[0].hinge_edge.size();
  };
  EXPECT_EQ(terms(0.0, 0.0), 0u);
  EXPECT_EQ(terms(1.0264e-3, 0.5), 0u) << "the cortex of dcm.md Table 1: not worth its memory";
  EXPECT_EQ(terms(0.5, 0.5), edges);
  EXPECT_EQ(terms(1.0264e-3, 0.0), edges) << "nothing else resists out of the plane";
}

TEST(ShellOperator, WithoutStepIsTheFrictionOfTheResidual) {
  const Shells shells = rough_shells();
  const auto types = everything();
  const auto a = assemble(shells, types, 0.0);
  const auto d = random_vectors(shells.position.size(), 11);
  std::vector<Vec3d> expected(d.size());
  std::vector<double> quadratic(shells.size());
  friction_times_displacement(a.blocks, shells, a.friction, d, expected, quadratic);
  const auto q = apply(a, shells, d);
  for (std::size_t i = 0; i < d.size(); ++i) EXPECT_LE(morula::norm(q[i] - expected[i]), 1e-6 * norm(expected));
  EXPECT_NEAR(sum(quadratic), dot(d, expected), 1e-10 * sum(quadratic));
}

TEST(ShellOperator, GivesTheSameBitsInOneFourAndEightLanes) {
  const Shells shells = rough_shells();
  const auto types = everything();
  const auto p = to_float4(random_vectors(shells.position.size(), 12));
  std::vector<std::vector<Float4>> q;
  std::vector<std::vector<SymMat3<float>>> diagonal;
  for (const int lanes : {1, 4, 8}) {
    const auto a = assemble(shells, types, 30.0, lanes);
    q.emplace_back(p.size());
    diagonal.emplace_back(p.size());
    apply_shell_operator(a.blocks, shells, a.matrix, p, q.back());
    add_block_diagonal(a.blocks, shells, a.matrix, diagonal.back());
  }
  for (const std::size_t other : {1u, 2u}) {
    EXPECT_EQ(std::memcmp(q[0].data(), q[other].data(), p.size() * sizeof(Float4)), 0);
    EXPECT_EQ(std::memcmp(diagonal[0].data(), diagonal[other].data(), p.size() * sizeof(SymMat3<float>)), 0);
  }
}

TEST(ShellOperator, DiagonalBlocksAreThoseOfTheMatrixWithoutVolumeAndRotationTerms) {
  const Shells shells = small_rough_shell();
  auto types = everything();
  types[0].bulk_modulus = 0.0;
  types[0].isotropic_damping = 0.05;
  const auto a = with_rotations(assemble(shells, types, 10.0));
  ASSERT_FALSE(a.matrix.blocks[0].shape_face.empty());
  ASSERT_FALSE(a.matrix.blocks[0].hinge_edge.empty());
  std::vector<SymMat3<float>> diagonal(shells.position.size(), isotropic(1.0f));
  add_block_diagonal(a.blocks, shells, a.matrix, diagonal);
  const Eigen::MatrixXd matrix = dense(a, shells);
  const double scale = matrix.cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < diagonal.size(); ++i) {
    const SymMat3<float>& b = diagonal[i];
    const double expected[3][3] = {{b.xx, b.xy, b.xz}, {b.xy, b.yy, b.yz}, {b.xz, b.yz, b.zz}};
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(matrix(3 * i + r, 3 * i + c) + (r == c), expected[r][c], 1e-5 * scale);
    }
  }
}

TEST(ShellOperator, TakesBlocksOfContactsOnItsEdgesInEveryWidth) {
  const Shells shells = rough_shells();
  const std::vector<ShellParameters> types = everything();
  const auto block_of = [](std::uint32_t shell, std::size_t k, std::size_t c) {
    return static_cast<float>(0.1 * static_cast<double>((7 * shell + 3 * k + 5 * c) % 11));
  };
  const EdgeBlockSource source = [&](std::uint32_t shell, std::span<EdgeBlock> edges) {
    if (shell == 2) return false;
    for (std::size_t k = 0; k < edges.size(); ++k)
      for (std::size_t c = 0; c < 6; ++c) edges[k].m[c] = block_of(shell, k, c);
    return true;
  };
  const auto p = random_vectors(shells.position.size(), 9);
  std::vector<Vec3d> first;
  for (const int lanes : {1, 4, 8}) {
    const auto before = apply(assemble(shells, types, 10.0, lanes), shells, p);
    const auto after = apply(assemble(shells, types, 10.0, lanes, {}, source), shells, p);
    if (lanes == 1) first = after;
    EXPECT_EQ(std::memcmp(first.data(), after.data(), first.size() * sizeof(Vec3d)), 0) << lanes;
    std::vector<Vec3d> expected(p.size());
    for (std::uint32_t shell = 0; shell < shells.size(); ++shell) {
      if (shell == 2) continue;
      const std::uint32_t base = shells.first_node[shell];
      const auto edges = shells.topology(shell).edges();
      for (std::size_t k = 0; k < edges.size(); ++k) {
        const auto m = [&](std::size_t c) { return static_cast<double>(block_of(shell, k, c)); };
        const SymMat3<double> matrix{m(0), m(1), m(2), m(3), m(4), m(5)};
        const Vec3d f = matrix * (p[base + edges[k].i] - p[base + edges[k].j]);
        expected[base + edges[k].i] += f;
        expected[base + edges[k].j] -= f;
      }
    }
    double largest = 0.0;
    for (const Vec3d& v : after) largest = std::max(largest, norm(v));
    for (std::size_t i = 0; i < p.size(); ++i) EXPECT_NEAR(norm(after[i] - before[i] - expected[i]), 0.0, 3e-6 * largest) << i;
  }
}

TEST(ShellOperator, LetsRigidTranslationFeelTheMediumOnly) {
  const Shells shells = rough_shells();
  const auto types = everything();
  const auto a = assemble(shells, types, 60.0);
  const std::vector<Vec3d> v(shells.position.size(), Vec3d{0.3, -0.2, 0.5});
  const auto q = apply(a, shells, v);
  const auto geometry = geometry_of(shells, a.blocks, shells.position);
  for (std::size_t i = 0; i < v.size(); ++i) {
    // the volume term is the only one that is not in differences: float rounding of Σ g times Δt K_V A/V
    EXPECT_LE(morula::norm(q[i] - 0.1 * geometry.node_area[i] * v[i]), 2e-3 * 0.1 * geometry.node_area[i]);
  }
}

/// Of each law alone, and of all together. Without the term tension resists rotations as it resists everything else.
TEST(ShellOperator, LetsRigidRotationFeelTheMediumOnly) {
  const Shells shells = rough_shells();
  std::vector<std::vector<ShellParameters>> cases{everything()};
  for (const ShellLaw& law : shell_laws()) {
    if (!law.in_operator || law.info.name == "isotropic_damper") continue;  // which resists rotations as the law says
    cases.emplace_back(2, nothing());
    for (ShellParameters& p : cases.back()) law.strength().in(p) = 0.7, p.barrier_angle = 0.2;
  }
  for (auto& types : cases) {
    for (ShellParameters& p : types) p.medium_friction = 0.0, p.bulk_modulus = 0.0, p.bulk_viscosity = 0.0;
    const auto a = assemble(shells, types, 60.0);
    for (const Vec3d& axis : {Vec3d{1.0, 0.0, 0.0}, Vec3d{0.0, 1.0, 0.0}, Vec3d{0.3, -0.2, 0.5}}) {
      std::vector<Vec3d> v(shells.position.size());
      for (std::size_t i = 0; i < v.size(); ++i) v[i] = cross(axis, shells.position[i]);
      const double of_all = norm(apply(a, shells, random_vectors(v.size(), 13))) / norm(random_vectors(v.size(), 13));
      EXPECT_LE(norm(apply(a, shells, v)), 1e-3 * of_all * norm(v)) << "case " << &types - cases.data();
    }
  }
  ShellParameters tense = nothing();
  tense.tension = 0.5;
  const auto a = assemble(shells, {tense, tense}, 60.0);
  std::vector<Vec3d> v(shells.position.size());
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = cross(Vec3d{0.0, 0.0, 1.0}, shells.position[i]);
  EXPECT_GT(norm(apply(with_rotations(a), shells, v)), 1e3 * norm(apply(a, shells, v)));
}

TEST(ShellFriction, LetsRigidRotationFeelTheMediumOnly) {  // T1.2: |Γ_int v| ≤ 1e-12 |Γ| |v|
  const Shells shells = rough_shells();
  auto types = everything();
  for (ShellParameters& p : types) p.medium_friction = 0.0;
  const auto blocks = make_shell_blocks(shells);
  const auto friction = friction_of(shells, blocks, types, shells.position);
  std::vector<Vec3d> v(shells.position.size()), result(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = cross(Vec3d{0.3, 0.7, -0.2}, shells.position[i]);
  std::vector<double> quadratic(shells.size());
  friction_times_displacement(blocks, shells, friction, v, result, quadratic);
  EXPECT_LE(norm(result), 1e-12 * 0.3 * norm(v));
}

TEST(ShellFriction, IsSymmetricAndDissipates) {  // T1.3
  const Shells shells = rough_shells();
  const auto types = everything();
  const auto blocks = make_shell_blocks(shells);
  const auto friction = friction_of(shells, blocks, types, shells.position);
  const auto a = random_vectors(shells.position.size(), 1), b = random_vectors(shells.position.size(), 2);
  std::vector<Vec3d> fa(a.size()), fb(a.size());
  std::vector<double> qa(shells.size()), qb(shells.size());
  friction_times_displacement(blocks, shells, friction, a, fa, qa);
  friction_times_displacement(blocks, shells, friction, b, fb, qb);
  EXPECT_NEAR(dot(b, fa), dot(a, fb), 1e-12 * norm(a) * norm(fb));
  for (const double q : qa) EXPECT_GT(q, 0.0);
}

}  // namespace
}  // namespace morula::dcm::testing
