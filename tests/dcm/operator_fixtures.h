#pragma once
#include <gtest/gtest.h>

#define EIGEN_DONT_VECTORIZE  // the compiler warns about Eigen's AVX-512 reductions
#include <Eigen/Dense>
#include <algorithm>
#include <utility>

#include "dcm/shell_operator.h"
#include "tests/dcm/shell_fixtures.h"

namespace morula::dcm::testing {

struct Assembled {
  ShellBlocks blocks;
  ShellFriction friction;
  ShellOperator matrix;
};

inline Assembled assemble(const Shells& shells, const std::vector<ShellParameters>& types, double dt, int lanes = 8,
                          std::span<const double> contact_energy = {}, const EdgeBlockSource& contacts = {}) {
  Assembled a;
  a.blocks = make_shell_blocks(shells, lanes);
  a.friction = friction_of(shells, a.blocks, types, shells.position);
  assemble_shell_operator(a.blocks, shells, types, shells.position, a.friction, contact_energy, dt, contacts, a.matrix);
  return a;
}

/// The matrix with what it lacks against rotations: the stiffness of each law for itself.
inline Assembled with_rotations(Assembled a) {
  for (ShellOperator::Block& block : a.matrix.blocks) std::fill(block.rotation.begin(), block.rotation.end(), 0.0f);
  return a;
}

inline std::vector<Float4> to_float4(std::span<const Vec3d> v) {
  std::vector<Float4> out(v.size());
  for (std::size_t i = 0; i < v.size(); ++i)
    out[i] = {static_cast<float>(v[i].x), static_cast<float>(v[i].y), static_cast<float>(v[i].z), 0.0f};
  return out;
}

inline std::vector<Vec3d> apply(const Assembled& a, const Shells& shells, std::span<const Vec3d> p) {
  std::vector<Float4> q(p.size(), Float4{9.0f, 9.0f, 9.0f, 9.0f});
  apply_shell_operator(a.blocks, shells, a.matrix, to_float4(p), q);
  std::vector<Vec3d> out(p.size());
  for (std::size_t i = 0; i < q.size(); ++i) {
    EXPECT_EQ(q[i].w, 0.0f);
    out[i] = {q[i].x, q[i].y, q[i].z};
  }
  return out;
}

inline Eigen::MatrixXd dense(const Assembled& a, const Shells& shells) {
  const std::size_t n = 3 * shells.position.size();
  Eigen::MatrixXd matrix(n, n);
  for (std::size_t column = 0; column < n; ++column) {
    std::vector<Vec3d> unit(shells.position.size());
    unit[column / 3][column % 3] = 1.0;
    const auto result = apply(a, shells, unit);
    for (std::size_t row = 0; row < n; ++row) matrix(row, column) = result[row / 3][row % 3];
  }
  return matrix;
}

/// A rough shell of 42 nodes, far from its reference shape: stretched, so that tension, shape and barrier all act.
inline Shells small_rough_shell() {
  Shells shells = one_shell(42, 3.0);
  const auto noise = random_vectors(shells.position.size(), 3);
  for (std::size_t i = 0; i < shells.position.size(); ++i) {
    Vec3d& x = shells.position[i];
    x = Vec3d{1.25 * x.x, x.y, 0.8 * x.z} + 0.1 * noise[i];
  }
  return shells;
}

/// K̃ d for the laws whose Hessian is positive semi-definite at this state is the derivative of the force.
inline void expect_force_derivative(const Shells& shells, const std::vector<ShellParameters>& types, double tolerance) {
  const double dt = 10.0, h = 1e-5;
  const auto a = with_rotations(assemble(shells, types, dt));
  const auto d = random_vectors(shells.position.size(), 21);
  const auto plus = mechanics(shells, types, moved(shells.position, d, h)), minus = mechanics(shells, types, moved(shells.position, d, -h));
  const auto result = apply(a, shells, d);
  std::vector<Vec3d> expected(d.size());
  for (std::size_t i = 0; i < d.size(); ++i) expected[i] = (minus.force[i] - plus.force[i]) * (dt / (2.0 * h));
  ASSERT_GT(norm(expected), 0.0);
  for (std::size_t i = 0; i < d.size(); ++i) EXPECT_LE(morula::norm(result[i] - expected[i]), tolerance * norm(expected));
}

}  // namespace morula::dcm::testing
