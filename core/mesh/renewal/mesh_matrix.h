#pragma once
#include <span>
#include <vector>

#include "core/mesh/topology.h"
#include "core/vec3.h"

namespace morula {

/// A symmetric, positive definite 3N × 3N matrix with a symmetric 3 × 3 block for each node and each edge of a mesh: what is left of
/// functionals that are sums of quadratic forms in points of its faces.
class MeshMatrix {
 public:
  explicit MeshMatrix(const Topology& topology) : topology_(&topology), node_(topology.node_count()), edge_(topology.edge_count()) {}

  void set_zero();
  /// Add the form ½ K (Σ_c weight_c x_c)² of the corners x_c of a face.
  void add_point(std::uint32_t face, std::span<const double, 3> weight, const SymMat3<double>& k);
  void add_node(std::uint32_t node, const SymMat3<double>& k) { node_[node] += k; }

  /// out = A x
  void multiply(std::span<const Vec3d> x, std::span<Vec3d> out) const;

  /// A⁻¹ b by conjugate gradients with the inverse blocks of the nodes as preconditioner, until the residual in that norm has fallen by
  /// `tolerance`.
  [[nodiscard]] std::vector<Vec3d> solve(std::span<const Vec3d> b, double tolerance) const;

 private:
  const Topology* topology_;
  std::vector<SymMat3<double>> node_, edge_;
};

}  // namespace morula
