#include <gtest/gtest.h>

#include <limits>

#include "tests/dcm/shell_fixtures.h"

namespace morula::dcm::testing {
namespace {

/// Faults of all shells when shell 2's nodes are spoilt by `spoil`.
template <class Spoil>
std::vector<ShellFault> faults(const Spoil& spoil) {
  Shells shells;
  for (int cell = 0; cell < 5; ++cell) add_shell(shells, icosphere(162), sphere_volume(6.0), {20.0 * cell, 0.0, 0.0});
  spoil(shells.nodes(2), shells.topology(2));
  const auto at = mechanics(shells, {ShellParameters{}}, shells.position);
  for (std::size_t s = 0; s < shells.size(); ++s) EXPECT_TRUE(s == 2 || !at.fault[s]) << "a neighbour in the lanes is not touched";
  return at.fault;
}

TEST(ShellFaults, AreNoneForASphere) {
  EXPECT_FALSE(faults([](std::span<Vec3d>, const Topology&) {})[2]);
}

TEST(ShellFaults, NameTheNodeThatIsNotANumber) {
  const auto fault = faults([](std::span<Vec3d> x, const Topology&) { x[17].y = std::numeric_limits<double>::quiet_NaN(); })[2];
  EXPECT_EQ(fault, (ShellFault{ShellFaultKind::kNotFinite, 17}));
  EXPECT_EQ(describe(fault), "position of node 17 is not a finite number");
}

TEST(ShellFaults, FindASurfaceTurnedInsideOut) {
  const auto fault = faults([](std::span<Vec3d> x, const Topology&) {
    const Vec3d center{40.0, 0.0, 0.0};
    for (Vec3d& v : x) v = center - (v - center);
  })[2];
  EXPECT_EQ(fault.kind, ShellFaultKind::kVolume);
}

TEST(ShellFaults, NameACollapsedFace) {
  std::uint32_t collapsed = 0;
  const auto fault = faults([&](std::span<Vec3d> x, const Topology& topology) {
    const Triangle& t = topology.faces()[33];
    x[t[0]] = 0.5 * (x[t[1]] + x[t[2]]) + 0.02 * (x[t[0]] - x[t[1]]);
    collapsed = 33;
  })[2];
  EXPECT_EQ(fault.kind, ShellFaultKind::kTriangleShape);
  EXPECT_EQ(fault.element, collapsed);
}

TEST(ShellFaults, NameTheEdgeBeyondTheAngleLimit) {
  Shells shells = one_shell(162);
  const std::uint32_t folded = 40;
  const Edge& edge = shells.topology(0).edges()[folded];
  std::span<Vec3d> x = shells.nodes(0);
  // Turn the right face about the edge until it almost lies on the left one: θ = 3.0 rad.
  const Vec3d middle = 0.5 * (x[edge.i] + x[edge.j]), axis = normalized(x[edge.j] - x[edge.i]);
  const Vec3d normal = normalized(cross(x[edge.j] - x[edge.i], x[edge.k] - x[edge.i]));
  const Vec3d outward = cross(axis, normal);  // away from the left face, in its plane
  const double height = morula::norm(cross(x[edge.l] - x[edge.i], axis));
  x[edge.l] = middle + height * (std::cos(3.0) * outward - std::sin(3.0) * normal);
  const auto at = mechanics(shells, {ShellParameters{}}, shells.position);
  ASSERT_GE(at.min_quality[0], ShellLimits::kQuality);
  EXPECT_NEAR(at.max_angle[0], 3.0, 0.1);
  EXPECT_EQ(at.fault[0].kind, ShellFaultKind::kDihedral);
  EXPECT_EQ(describe(at.fault[0]), "dihedral_barrier: edge " + std::to_string(at.fault[0].element) + " is folded beyond 2.9 rad");
  EXPECT_EQ(at.fault[0].element, folded);
}

}  // namespace
}  // namespace morula::dcm::testing
