/// What the friction of a shell does to its motion as a whole (dcm.md T1.1, T9.4), in the form that the residual of a step uses.
#include "dcm/shell_friction.h"

#include <gtest/gtest.h>

#include "tests/dcm/shell_fixtures.h"

namespace morula::dcm::testing {
namespace {

constexpr double kMedium = 0.1;

std::vector<ShellParameters> with_friction(double medium, double edges, double isotropic, double bulk) {
  ShellParameters p = nothing();
  p.medium_friction = medium;
  p.edge_damping = edges;
  p.isotropic_damping = isotropic;
  p.bulk_viscosity = bulk;
  return {p, p};
}

std::vector<Vec3d> drag(const Shells& shells, const std::vector<ShellParameters>& types, std::span<const Vec3d> velocity) {
  const auto blocks = make_shell_blocks(shells);
  std::vector<Vec3d> out(velocity.size());
  std::vector<double> quadratic(shells.size());
  friction_times_displacement(blocks, shells, friction_of(shells, blocks, types, shells.position), velocity, out, quadratic);
  return out;
}

/// T1.1: F spread over the nodes of a cell by their area moves all of them with F/(γ_ECM ΣA). Γ is positive definite, so that this velocity
/// is the only one if Γ V is the force, node by node.
TEST(ShellFriction, LetsAForceSpreadByAreaMoveAllNodesAlike) {
  const Shells shells = rough_shells();
  const auto geometry = geometry_of(shells, make_shell_blocks(shells), shells.position);
  const Vec3d force{0.6, -0.3, 0.8};
  std::vector<Vec3d> velocity, expected;
  double most = 0.0;
  for (std::size_t s = 0; s < shells.size(); ++s)
    for (std::uint32_t i = shells.first_node[s]; i < shells.first_node[s + 1]; ++i) {
      velocity.push_back(force * (1.0 / (kMedium * geometry.area[s])));
      expected.push_back(force * (geometry.node_area[i] / geometry.area[s]));
      most = std::max(most, morula::norm(expected.back()));
    }
  const auto found = drag(shells, with_friction(kMedium, 0.4, 0.2, 0.3), velocity);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_LT(morula::norm(found[i] - expected[i]), 1e-12 * most) << i;
}

/// T9.4: |Σ (Γ_nn v)_i| and the torque, for velocities that differ from node to node. Dampers that act in all directions have no net force,
/// but resist a rotation: dcm.md §1 flags them.
TEST(ShellFriction, OfDampersAndOfTheVolumeHasNoNetForceAndNoNetTorque) {
  const Shells shells = rough_shells();
  const auto v = random_vectors(shells.position.size(), 5);
  struct Kind {
    double edges, isotropic, bulk;
    bool torque_free;
  };
  for (const Kind& kind : {Kind{0.4, 0.0, 0.0, true}, Kind{0.0, 0.0, 0.3, true}, Kind{0.0, 0.2, 0.0, false}}) {
    const auto f = drag(shells, with_friction(0.0, kind.edges, kind.isotropic, kind.bulk), v);
    for (std::size_t s = 0; s < shells.size(); ++s) {
      const Vec3d origin = shells.position[shells.first_node[s]];
      Vec3d sum, torque;
      double size = 0.0, lever = 0.0;
      for (std::uint32_t i = shells.first_node[s]; i < shells.first_node[s + 1]; ++i) {
        const Vec3d x = shells.position[i] - origin;
        sum += f[i], torque += cross(x, f[i]);
        size += morula::norm(f[i]), lever += morula::norm(x) * morula::norm(f[i]);
      }
      ASSERT_GT(size, 0.1);
      EXPECT_LT(morula::norm(sum), 1e-12 * size);
      if (kind.torque_free)
        EXPECT_LT(morula::norm(torque), 1e-12 * lever);
      else
        EXPECT_GT(morula::norm(torque), 1e-5 * lever);
    }
  }
}

}  // namespace
}  // namespace morula::dcm::testing
