#include <gtest/gtest.h>

#include "tests/dcm/operator_fixtures.h"

namespace morula::dcm::testing {
namespace {

/// Laws that resist strain in the plane; sheets alone, or springs and area as well.
std::vector<ShellLaw> laws_in_the_plane(bool sheets_only) {
  std::vector<ShellLaw> out;
  for (const ShellLaw& law : shell_laws())
    if (law.sheet || (!sheets_only && (law.info.name == "edge_spring" || law.info.name == "local_area" || law.info.name == "global_area")))
      out.push_back(law);
  return out;
}

class MembraneOperator : public ::testing::TestWithParam<ShellLaw> {};

TEST_P(MembraneOperator, IsTheHessianWhereNothingIsStretched) {
  Shells shells = rough_shells();
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const auto edges = shells.topology(s).edges();
    const auto x = std::as_const(shells).nodes(s);
    for (std::size_t k = 0; k < edges.size(); ++k)
      shells.rest_length[shells.first_edge[s] + k] = morula::norm(x[edges[k].j] - x[edges[k].i]);
  }
  std::vector<ShellParameters> types(2, nothing());
  GetParam().strength().in(types[0]) = 0.07;
  GetParam().strength().in(types[1]) = 0.11, set_area_ratio(types[1], 0.6);
  expect_force_derivative(shells, types, 2e-5);
}

INSTANTIATE_TEST_SUITE_P(Registry, MembraneOperator, ::testing::ValuesIn(laws_in_the_plane(false)),
                         [](const auto& test) { return test.param.info.name; });

class StretchedMembraneOperator : public MembraneOperator {};

TEST_P(StretchedMembraneOperator, IsTheHessianWhereBothPrincipalStressesPull) {
  Shells shells = one_shell(162);
  const auto noise = random_vectors(shells.position.size(), 5);
  for (std::size_t i = 0; i < noise.size(); ++i) shells.position[i] += 0.02 * noise[i];
  for (double& length : shells.rest_length) length *= 0.85;
  ShellParameters p = nothing();
  GetParam().strength().in(p) = 0.07;
  set_area_ratio(p, 0.5);  // Skalak's C (D − 1) stays below 1
  expect_force_derivative(shells, {p}, 2e-5);
}

INSTANTIATE_TEST_SUITE_P(Registry, StretchedMembraneOperator, ::testing::ValuesIn(laws_in_the_plane(true)),
                         [](const auto& test) { return test.param.info.name; });

/// Shells pushed together, pulled in one direction, and pulled in both: the cut of compressive stress is at work in the first two.
class EveryStretch : public ::testing::TestWithParam<std::array<double, 3>> {};

TEST_P(EveryStretch, KeepsTheOperatorPositiveSemiDefinite) {
  Shells shells = small_rough_shell();
  for (Vec3d& x : shells.position) x = {GetParam()[0] * x.x, GetParam()[1] * x.y, GetParam()[2] * x.z};
  for (const char* law : {"neo_hooke", "st_venant_kirchhoff", "skalak", "local_area", "global_area"}) {
    for (const double ratio : {0.0, 1.0, 50.0}) {
      if (ratio > 1.0 && std::string(law) != "skalak") continue;  // only Skalak's C may be above that of ν = ½
      ShellParameters p = nothing();
      shell_law(law).strength().in(p) = 0.7;
      set_area_ratio(p, ratio);
      const Eigen::VectorXd values =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense(assemble(shells, {p}, 10.0), shells)).eigenvalues();
      EXPECT_GT(values.maxCoeff(), 1e-3);
      EXPECT_GE(values.minCoeff(), -5e-6 * values.maxCoeff());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, EveryStretch,
                         ::testing::Values(std::array{0.6, 0.6, 0.6}, std::array{0.6, 1.5, 0.8}, std::array{1.6, 1.6, 1.6}));

TEST(HelfrichOperator, IsGaussNewtonOfTheNormalPartOfTheAreaGradient) {
  const Shells shells = small_rough_shell();
  const Topology& topology = shells.topology(0);
  ShellParameters p = nothing();
  p.helfrich_rigidity = 0.3;
  p.spontaneous_curvature = 0.4;
  const auto d = random_vectors(shells.position.size(), 9);
  const auto q = apply(assemble(shells, {p}, 10.0), shells, d);
  std::vector<Vec3d> normal(d.size()), laplace(d.size());
  std::vector<double> area(d.size());
  const auto& x = shells.position;
  for (const Triangle& t : topology.faces()) {
    const Vec3d n = cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]);
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t a = t[c], b = t[(c + 1) % 3], o = t[(c + 2) % 3];
      normal[a] += n;
      area[a] += morula::norm(n) / 6.0;
      const double weight = 0.5 * morula::dot(x[a] - x[o], x[b] - x[o]) / morula::norm(n);
      laplace[a] += weight * (d[a] - d[b]);
      laplace[b] += weight * (d[b] - d[a]);
    }
  }
  double expected = 0.0;
  for (std::size_t i = 0; i < d.size(); ++i) expected += 0.3 / area[i] * std::pow(morula::dot(normalized(normal[i]), laplace[i]), 2);
  EXPECT_NEAR(dot(d, q), 10.0 * expected, 1e-4 * expected);
}

TEST(BulkViscosity, ResistsBreathingOnly) {
  const Shells shells = one_shell(162);
  ShellParameters p = nothing();
  p.bulk_viscosity = 0.7;
  const auto a = assemble(shells, {p}, 0.0);
  std::vector<Vec3d> result(shells.position.size()), turning(shells.position.size());
  std::vector<double> quadratic(1);
  friction_times_displacement(a.blocks, shells, a.friction, shells.position, result, quadratic);
  const double volume = sphere_volume(6.0);  // u·x = 3V
  EXPECT_NEAR(quadratic[0], 0.7 * 9.0 * volume, 1e-9 * volume);
  for (std::size_t i = 0; i < turning.size(); ++i) turning[i] = cross(Vec3d{0.3, 0.7, -0.2}, shells.position[i]) + Vec3d{1.0, 2.0, 3.0};
  friction_times_displacement(a.blocks, shells, a.friction, turning, result, quadratic);
  EXPECT_LE(norm(result), 1e-10);
}

TEST(BulkViscosity, WithTheBulkModulusRelaxesTheVolumeInTheirRatio) {  // no other friction: V̇/V = −(K/η) ln(V/V0)
  Shells shells = one_shell(162);
  ShellParameters p = nothing();
  p.bulk_viscosity = 5.0, p.bulk_modulus = 2.5;
  const double reference = shells.reference_volume[0];
  for (Vec3d& x : shells.position) x *= std::cbrt(1.2);
  // breathing: d = ε x, force balance (η/V)(3V)² ε/Δt = p 3V
  const double dt = 1e-3;
  double volume = 1.2 * reference;
  for (int step = 0; step < 2000; ++step) {
    const auto a = assemble(shells, {p}, 0.0);
    std::vector<Vec3d> result(shells.position.size());
    std::vector<double> quadratic(1);
    friction_times_displacement(a.blocks, shells, a.friction, shells.position, result, quadratic);
    const auto at = mechanics(shells, {p}, shells.position);
    const double rate = dot(at.force, shells.position) / quadratic[0];
    for (Vec3d& x : shells.position) x *= 1.0 + dt * rate;
    volume = at.volume[0];
  }
  EXPECT_NEAR(std::log(volume / reference), std::log(1.2) * std::exp(-2.0 / 2.0), 2e-3 * std::log(1.2));
}

TEST(IsotropicDamper, ResistsRotationButNotTranslation) {  // dcm.md §1: conserves momentum, not angular momentum
  const Shells shells = one_shell(162);
  ShellParameters p = nothing();
  p.isotropic_damping = 0.1;
  const auto a = assemble(shells, {p}, 0.0);
  std::vector<Vec3d> result(shells.position.size()), turning(shells.position.size());
  std::vector<double> quadratic(1);
  friction_times_displacement(a.blocks, shells, a.friction, std::vector<Vec3d>(result.size(), Vec3d{1.0, -2.0, 0.5}), result, quadratic);
  EXPECT_EQ(norm(result), 0.0);
  for (std::size_t i = 0; i < turning.size(); ++i) turning[i] = cross(Vec3d{0.0, 0.0, 1.0}, shells.position[i]);
  friction_times_displacement(a.blocks, shells, a.friction, turning, result, quadratic);
  double expected = 0.0;
  Vec3d net{};
  for (const Edge& edge : shells.topology(0).edges()) expected += 0.1 * norm2(turning[edge.i] - turning[edge.j]);
  for (const Vec3d& f : result) net += f;
  EXPECT_NEAR(quadratic[0], expected, 1e-10 * expected);
  EXPECT_LE(morula::norm(net), 1e-11);
}

}  // namespace
}  // namespace morula::dcm::testing
