#include "core/mesh/renewal/mesh_matrix.h"

#include <algorithm>

namespace morula {
namespace {

constexpr int kMostIterations = 500;

double inner_product(std::span<const Vec3d> a, std::span<const Vec3d> b) {
  double sum = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) sum += dot(a[n], b[n]);
  return sum;
}

}  // namespace

void MeshMatrix::set_zero() {
  std::ranges::fill(node_, SymMat3<double>{});
  std::ranges::fill(edge_, SymMat3<double>{});
}

void MeshMatrix::add_point(std::uint32_t face, std::span<const double, 3> weight, const SymMat3<double>& k) {
  const Triangle& corner = topology_->faces()[face];
  const auto& side = topology_->face_edges()[face];
  for (std::size_t c = 0; c < 3; ++c) {
    node_[corner[c]] += weight[c] * weight[c] * k;
    edge_[side[c]] += weight[(c + 1) % 3] * weight[(c + 2) % 3] * k;
  }
}

void MeshMatrix::multiply(std::span<const Vec3d> x, std::span<Vec3d> out) const {
  for (std::size_t n = 0; n < node_.size(); ++n) out[n] = node_[n] * x[n];
  const auto edges = topology_->edges();
  for (std::size_t e = 0; e < edge_.size(); ++e) {
    out[edges[e].i] += edge_[e] * x[edges[e].j];
    out[edges[e].j] += edge_[e] * x[edges[e].i];
  }
}

std::vector<Vec3d> MeshMatrix::solve(std::span<const Vec3d> b, double tolerance) const {
  const std::size_t n = node_.size();
  std::vector<SymMat3<double>> inverse_node(n);
  for (std::size_t i = 0; i < n; ++i) inverse_node[i] = inverse(node_[i]);
  std::vector<Vec3d> x(n), r(b.begin(), b.end()), z(n), p(n), ap(n);
  for (std::size_t i = 0; i < n; ++i) p[i] = z[i] = inverse_node[i] * r[i];
  double rz = inner_product(r, z);
  const double end = tolerance * tolerance * rz;
  for (int iteration = 0; iteration < kMostIterations && rz > end; ++iteration) {
    multiply(p, ap);
    const double alpha = rz / inner_product(p, ap);
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += p[i] * alpha;
      r[i] -= ap[i] * alpha;
      z[i] = inverse_node[i] * r[i];
    }
    const double next = inner_product(r, z), beta = next / rz;
    rz = next;
    for (std::size_t i = 0; i < n; ++i) p[i] = z[i] + p[i] * beta;
  }
  return x;
}

}  // namespace morula
