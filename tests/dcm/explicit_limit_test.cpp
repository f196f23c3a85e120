// Largest stable step of explicit Euler of every law alone, 2/λ_max(Γ⁻¹K), against the published table (dcm.md §1, T1.4: ± 5 %). It checks
// the second derivative of each energy at the scale of the mesh.
#include <gtest/gtest.h>

#include "dcm/derived_parameters.h"
#include "tests/dcm/shell_fixtures.h"

namespace morula::dcm::testing {
namespace {

struct Limit {
  const char* name;
  LawStrength strength;
  double value;
  double published[3];  ///< [s], for 162, 642, 2562 nodes with nodes at R = 6 and γ_ECM = 0.1
  double tolerance;     ///< relative: 5 %, or the digits of the table
};
void PrintTo(const Limit& limit, std::ostream* out) { *out << limit.name; }

class ExplicitLimit : public ::testing::TestWithParam<Limit> {};

/// 2/λ_max by power iteration with directional derivatives of the force.
double stable_step(std::uint32_t nodes, const ShellParameters& p) {
  Shells shells = one_shell(nodes);
  const double scale = 6.0 / morula::norm(shells.position[0]);
  for (Vec3d& x : shells.position) x *= scale;
  for (double& length : shells.rest_length) length *= scale;
  const auto blocks = make_shell_blocks(shells);
  const auto area = geometry_of(shells, blocks, shells.position).node_area;
  shells.reference_volume[0] = enclosed_volume(shells.topology(0).faces(), shells.position, {});
  auto d = random_vectors(shells.position.size(), 3);
  const double h = 1e-4;
  double eigenvalue = 0.0;
  for (int iteration = 0; iteration < 150; ++iteration) {
    const double size = 1.0 / norm(d);
    for (Vec3d& v : d) v *= size;
    const auto plus = mechanics(shells, {p}, moved(shells.position, d, h)).force;
    const auto minus = mechanics(shells, {p}, moved(shells.position, d, -h)).force;
    double work = 0.0, drag = 0.0;  // Rayleigh quotient dᵀKd/dᵀΓd: converges twice as fast as the vector
    std::vector<Vec3d> next(d.size());
    for (std::size_t i = 0; i < d.size(); ++i) {
      const Vec3d stiffness = (minus[i] - plus[i]) * (0.5 / h);
      work += morula::dot(d[i], stiffness);
      drag += 0.1 * area[i] * norm2(d[i]);
      next[i] = stiffness * (1.0 / (0.1 * area[i]));
    }
    eigenvalue = work / drag;
    d = next;
  }
  return 2.0 / eigenvalue;
}

TEST_P(ExplicitLimit, IsThePublishedOne) {
  ShellParameters p = nothing();
  GetParam().strength.in(p) = GetParam().value;
  const std::uint32_t nodes[] = {162, 642, 2562};
  for (int level = 0; level < 3; ++level) {
    const double step = stable_step(nodes[level], p);
    EXPECT_NEAR(step / GetParam().published[level], 1.0, GetParam().tolerance) << nodes[level] << " nodes: " << step << " s";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Laws, ExplicitLimit,
    ::testing::Values(Limit{"edge_spring", &ShellParameters::spring_stiffness, 0.173205, {0.540, 0.131, 0.0317}, 0.05},
                      Limit{
                          "neo_hooke", shell_law("neo_hooke").strength(), sheet_shear_modulus(1.0, 0.2, 0.5), {0.432, 0.104, 0.0245}, 0.05},
                      Limit{"skalak", shell_law("skalak").strength(), sheet_shear_modulus(1.0, 0.2, 0.5), {0.432, 0.104, 0.0245}, 0.05},
                      Limit{"cortical_tension", &ShellParameters::tension, 0.5, {0.191, 0.0449, 0.0110}, 0.05},
                      Limit{"volume_pressure", &ShellParameters::bulk_modulus, 2.5, {0.162, 0.161, 0.160}, 0.05},
                      Limit{"hinge_bending", &ShellParameters::hinge_stiffness, 1.0264e-3, {42.8, 2.52, 0.153}, 0.05},
                      Limit{"helfrich", &ShellParameters::helfrich_rigidity, 8.8889e-4, {54.1, 2.87, 0.169}, 0.05}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace morula::dcm::testing
