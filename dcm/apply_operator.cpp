#include <algorithm>

#include "core/mesh/lane_surface.h"
#include "dcm/shell_operator.h"

namespace morula::dcm {
namespace {

struct Workspace {
  LaneVector<float> p, q;
};

/// Node vectors in lanes: [node][x y z 0][lane], the transpose of one Float4 per node and shell.
template <int W>
struct NodeVectors {
  using Real = Lane<float, W>;
  float* data;

  Vec3<Real> operator[](std::size_t node) const noexcept {
    const float* v = data + node * 4 * W;
    return {Real::load(v), Real::load(v + W), Real::load(v + 2 * W)};
  }
  void set(std::size_t node, const Vec3<Real>& value) const noexcept {
    float* v = data + node * 4 * W;
    value.x.store(v), value.y.store(v + W), value.z.store(v + 2 * W);
  }
  void add(std::size_t node, const Vec3<Real>& value) const noexcept { set(node, (*this)[node] + value); }
};

template <int W>
SymMat3<Lane<float, W>> load_matrix(const float* m) noexcept {
  using Real = Lane<float, W>;
  return {Real::load(m), Real::load(m + W), Real::load(m + 2 * W), Real::load(m + 3 * W), Real::load(m + 4 * W), Real::load(m + 5 * W)};
}

/// q = diagonal · p; returns g·p of every lane, summed in double.
template <int W>
Lane<double, W> apply_diagonal(const ShellOperator::Block& matrix, std::size_t nodes, NodeVectors<W> p, NodeVectors<W> q) noexcept {
  using Real = Lane<float, W>;
  using Double = Lane<double, W>;
  Double volume_rate(0.0);
  for (std::size_t i = 0; i < nodes; ++i) {
    const auto pi = p[i];
    const Real rate = dot(load_vec3<float, W>(matrix.volume_gradient.data(), i), pi);
    volume_rate += Double::from(__builtin_convertvector(rate.v, typename Double::Vector));
    q.set(i, pi * load_scalar<float, W>(matrix.diagonal.data(), i));
    Real(0.0f).store(q.data + (i * 4 + 3) * W);
  }
  return volume_rate;
}

/// q_i += M (p_i − p_j), q_j −= the same. Edges are sorted by i, whose sum stays in registers over its run.
template <int W>
void apply_edges(const ShellOperator::Block& matrix, std::span<const Edge> edges, NodeVectors<W> p, NodeVectors<W> q) noexcept {
  for (std::size_t k = 0; k < edges.size();) {
    const std::uint32_t i = edges[k].i;
    const auto pi = p[i];
    auto qi = q[i];
    for (; k < edges.size() && edges[k].i == i; ++k) {
      const auto force = load_matrix<W>(matrix.edge.data() + k * 6 * W) * (pi - p[edges[k].j]);
      qi += force;
      q.add(edges[k].j, -force);
    }
    q.set(i, qi);
  }
}

template <int W>
void apply_rank_one_terms(const ShellOperator::Block& matrix, const Topology& topology, NodeVectors<W> p, NodeVectors<W> q) noexcept {
  for (std::size_t entry = 0; entry < matrix.shape_face.size(); ++entry) {
    const Triangle& t = topology.faces()[matrix.shape_face[entry]];
    const auto b1 = load_vec3<float, W>(matrix.shape.data(), 2 * entry), b2 = load_vec3<float, W>(matrix.shape.data(), 2 * entry + 1);
    const auto p0 = p[t[0]];
    const auto s = dot(b1, p[t[1]] - p0) + dot(b2, p[t[2]] - p0);
    q.add(t[1], b1 * s);
    q.add(t[2], b2 * s);
    q.add(t[0], -((b1 + b2) * s));
  }
  for (std::size_t entry = 0; entry < matrix.barrier_edge.size(); ++entry) {
    const Edge& edge = topology.edges()[matrix.barrier_edge[entry]];
    const float* b = matrix.barrier.data();
    const auto bj = load_vec3<float, W>(b, 3 * entry), bk = load_vec3<float, W>(b, 3 * entry + 1),
               bl = load_vec3<float, W>(b, 3 * entry + 2);
    const auto pi = p[edge.i];
    const auto s = dot(bj, p[edge.j] - pi) + dot(bk, p[edge.k] - pi) + dot(bl, p[edge.l] - pi);
    q.add(edge.j, bj * s);
    q.add(edge.k, bk * s);
    q.add(edge.l, bl * s);
    q.add(edge.i, -((bj + bk + bl) * s));
  }
}

template <int W>
void apply_block(const LaneBlock& block, const Shells& shells, const ShellOperator::Block& matrix, std::span<const Float4> input,
                 std::span<Float4> output, Workspace& ws) noexcept {
  using Real = Lane<float, W>;
  const Topology& topology = *block.topology;
  const std::size_t nodes = topology.node_count();
  ws.p.resize(std::max(ws.p.size(), nodes * 4 * W));
  ws.q.resize(std::max(ws.q.size(), nodes * 4 * W));
  const NodeVectors<W> p{ws.p.data()}, q{ws.q.data()};
  load_lanes<W, float>(lane_pointers<W>(&input.data()->x, block, shells.first_node, 4), nodes * 4, p.data);
  const auto volume_rate = apply_diagonal<W>(matrix, nodes, p, q);
  apply_edges<W>(matrix, topology.edges(), p, q);
  apply_rank_one_terms<W>(matrix, topology, p, q);
  const Real pressure =
      Real::load(matrix.volume_stiffness.data()) * Real::from(__builtin_convertvector(volume_rate.v, typename Real::Vector));
  for (std::size_t i = 0; i < nodes; ++i) q.add(i, load_vec3<float, W>(matrix.volume_gradient.data(), i) * pressure);
  store_lanes<W, float>(q.data, nodes * 4, lane_pointers<W>(&output.data()->x, block, shells.first_node, 4));
}

template <int W>
void add_diagonal_block(const LaneBlock& block, const Shells& shells, const ShellOperator::Block& matrix,
                        std::span<SymMat3<float>> diagonal, Workspace& ws) noexcept {
  using Real = Lane<float, W>;
  const Topology& topology = *block.topology;
  const std::size_t nodes = topology.node_count();
  ws.p.resize(std::max(ws.p.size(), nodes * 6 * W));
  float* const sum = ws.p.data();
  load_lanes<W, float>(lane_pointers<W>(static_cast<const float*>(&diagonal.data()->xx), block, shells.first_node, 6), nodes * 6, sum);
  const auto add = [&](std::size_t node, const SymMat3<Real>& m) {
    float* d = sum + node * 6 * W;
    const auto total = load_matrix<W>(d) + m;
    total.xx.store(d), total.xy.store(d + W), total.xz.store(d + 2 * W);
    total.yy.store(d + 3 * W), total.yz.store(d + 4 * W), total.zz.store(d + 5 * W);
  };
  for (std::size_t i = 0; i < nodes; ++i) add(i, isotropic(load_scalar<float, W>(matrix.diagonal.data(), i)));
  for (std::size_t k = 0; k < topology.edges().size(); ++k) {
    const auto m = load_matrix<W>(matrix.edge.data() + k * 6 * W);
    add(topology.edges()[k].i, m);
    add(topology.edges()[k].j, m);
  }
  for (std::size_t entry = 0; entry < matrix.shape_face.size(); ++entry) {
    const Triangle& t = topology.faces()[matrix.shape_face[entry]];
    const auto b1 = load_vec3<float, W>(matrix.shape.data(), 2 * entry), b2 = load_vec3<float, W>(matrix.shape.data(), 2 * entry + 1);
    add(t[0], outer(Real(1.0f), b1 + b2));
    add(t[1], outer(Real(1.0f), b1));
    add(t[2], outer(Real(1.0f), b2));
  }
  for (std::size_t entry = 0; entry < matrix.barrier_edge.size(); ++entry) {
    const Edge& edge = topology.edges()[matrix.barrier_edge[entry]];
    const float* b = matrix.barrier.data();
    const auto bj = load_vec3<float, W>(b, 3 * entry), bk = load_vec3<float, W>(b, 3 * entry + 1),
               bl = load_vec3<float, W>(b, 3 * entry + 2);
    add(edge.i, outer(Real(1.0f), bj + bk + bl));
    add(edge.j, outer(Real(1.0f), bj));
    add(edge.k, outer(Real(1.0f), bk));
    add(edge.l, outer(Real(1.0f), bl));
  }
  store_lanes<W, float>(sum, nodes * 6, lane_pointers<W>(&diagonal.data()->xx, block, shells.first_node, 6));
}

}  // namespace

void apply_shell_operator(const ShellBlocks& blocks, const Shells& shells, const ShellOperator& matrix, std::span<const Float4> p,
                          std::span<Float4> q) {
  for_each_block<Workspace>(blocks, [&]<int W>(std::size_t b, const LaneBlock& block, Workspace& ws) {
    apply_block<W>(block, shells, matrix.blocks[b], p, q, ws);
  });
}

void add_block_diagonal(const ShellBlocks& blocks, const Shells& shells, const ShellOperator& matrix, std::span<SymMat3<float>> diagonal) {
  for_each_block<Workspace>(blocks, [&]<int W>(std::size_t b, const LaneBlock& block, Workspace& ws) {
    add_diagonal_block<W>(block, shells, matrix.blocks[b], diagonal, ws);
  });
}

}  // namespace morula::dcm
