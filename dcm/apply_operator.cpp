#include <algorithm>

#include "core/mesh/lane_surface.h"
#include "dcm/shell_operator.h"

namespace morula::dcm {
namespace {

struct Workspace {
  LaneVector<float> p, q, rate;
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

/// What motions do to a shell as a whole, by lane.
template <int W>
struct WholeRates {
  Lane<float, W> volume, rotation[3];
};

/// q = diagonal · p; returns g·p and Ŷᵀp of every lane, summed in double.
template <int W>
WholeRates<W> apply_diagonal(const ShellOperator::Block& matrix, std::size_t nodes, NodeVectors<W> p, NodeVectors<W> q) noexcept {
  using Real = Lane<float, W>;
  using Double = Lane<double, W>;
  Double sums[4] = {Double(0.0), Double(0.0), Double(0.0), Double(0.0)};
  const auto add = [](Double& sum, const Real& value) { sum += Double::from(__builtin_convertvector(value.v, typename Double::Vector)); };
  for (std::size_t i = 0; i < nodes; ++i) {
    const auto pi = p[i];
    add(sums[3], dot(load_vec3<float, W>(matrix.volume_gradient.data(), i), pi));
    for (std::size_t axis = 0; axis < 3; ++axis) add(sums[axis], dot(load_vec3<float, W>(matrix.rotation.data(), 3 * i + axis), pi));
    q.set(i, pi * load_scalar<float, W>(matrix.diagonal.data(), i));
    Real(0.0f).store(q.data + (i * 4 + 3) * W);
  }
  const auto rate = [&](int k) { return Real::from(__builtin_convertvector(sums[k].v, typename Real::Vector)); };
  return {rate(3), {rate(0), rate(1), rate(2)}};
}

/// q += g s_V g·p − Ŷ Ŷᵀp
template <int W>
void apply_whole_rates(const ShellOperator::Block& matrix, std::size_t nodes, const WholeRates<W>& rates, NodeVectors<W> q) noexcept {
  using Real = Lane<float, W>;
  const Real pressure = Real::load(matrix.volume_stiffness.data()) * rates.volume;
  for (std::size_t i = 0; i < nodes; ++i) {
    auto sum = load_vec3<float, W>(matrix.volume_gradient.data(), i) * pressure;
    for (std::size_t axis = 0; axis < 3; ++axis) sum -= load_vec3<float, W>(matrix.rotation.data(), 3 * i + axis) * rates.rotation[axis];
    q.add(i, sum);
  }
}

/// A face's entry of the membrane term.
template <int W>
struct MembraneFace {
  using Real = Lane<float, W>;
  Real h01, h12, h20;
  Vec3<Real> e0, e1, e2;

  MembraneFace(const ShellOperator::Block& matrix, std::size_t face) noexcept {
    const float* m = matrix.membrane.data() + face * 9 * W;
    h01 = Real::load(m), h12 = Real::load(m + W), h20 = Real::load(m + 2 * W);
    e1 = load_vec3<float, W>(m + 3 * W, 0), e2 = load_vec3<float, W>(m + 3 * W, 1);
    e0 = -(e1 + e2);
  }
};

/// q_i += M (p_i − p_j), q_j −= the same. Edges are sorted by i, whose sum stays in registers over its run.
template <int W>
void apply_edges(const ShellOperator::Block& matrix, std::span<const Edge> edges, NodeVectors<W> p, NodeVectors<W> q) noexcept {
  for (std::size_t k = 0; k < edges.size();) {
    const std::uint32_t i = edges[k].i;
    const auto pi = p[i];
    auto qi = q[i];
    for (; k < edges.size() && edges[k].i == i; ++k) {
      const auto force = load_sym_mat3<float, W>(matrix.edge.data(), k) * (pi - p[edges[k].j]);
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
  for (std::size_t entry = 0; entry < matrix.hinge_edge.size(); ++entry) {
    const Edge& edge = topology.edges()[matrix.hinge_edge[entry]];
    const float* b = matrix.hinge.data();
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

/// Forces along the edges of a face from each other's strains; an edge's own strain is in its edge block.
template <int W>
void apply_membrane(const ShellOperator::Block& matrix, std::span<const Triangle> faces, NodeVectors<W> p, NodeVectors<W> q) noexcept {
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Triangle& t = faces[f];
    const MembraneFace<W> face(matrix, f);
    const auto p0 = p[t[0]], p1 = p[t[1]], p2 = p[t[2]];
    const auto s0 = dot(face.e0, p2 - p1), s1 = dot(face.e1, p0 - p2), s2 = dot(face.e2, p1 - p0);
    const auto f0 = face.e0 * (face.h01 * s1 + face.h20 * s2), f1 = face.e1 * (face.h01 * s0 + face.h12 * s2),
               f2 = face.e2 * (face.h12 * s1 + face.h20 * s0);
    q.add(t[0], f1 - f2);
    q.add(t[1], f2 - f0);
    q.add(t[2], f0 - f1);
  }
}

/// q += Hᵀ H p with H_i p = n_i · Σ_j w_ij (p_i − p_j), n_i the scaled normals.
template <int W>
void apply_bending(const ShellOperator::Block& matrix, const Topology& topology, NodeVectors<W> p, NodeVectors<W> q,
                   LaneVector<float>& rate) noexcept {
  using Real = Lane<float, W>;
  const auto normal = [&](std::size_t i) { return load_vec3<float, W>(matrix.bending_normal.data(), i); };
  const auto weight = [&](std::size_t k) { return load_scalar<float, W>(matrix.bending_weight.data(), k); };
  rate.assign(topology.node_count() * std::size_t{W}, 0.0f);
  const auto add_rate = [&](std::size_t i, Real value) { (Real::load(rate.data() + i * W) + value).store(rate.data() + i * W); };
  const auto edges = topology.edges();
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto d = (p[edges[k].i] - p[edges[k].j]) * weight(k);
    add_rate(edges[k].i, dot(normal(edges[k].i), d));
    add_rate(edges[k].j, -dot(normal(edges[k].j), d));
  }
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const std::size_t i = edges[k].i, j = edges[k].j;
    const auto force = (normal(i) * load_scalar<float, W>(rate.data(), i) - normal(j) * load_scalar<float, W>(rate.data(), j)) * weight(k);
    q.add(i, force);
    q.add(j, -force);
  }
}

/// q += stiffness g (g·p), summed in double.
template <int W>
void apply_whole_shell(const LaneVector<float>& gradient, const std::array<float, LaneBlock::kMaxLanes>& stiffness, std::size_t nodes,
                       NodeVectors<W> p, NodeVectors<W> q) noexcept {
  using Real = Lane<float, W>;
  using Double = Lane<double, W>;
  Double rate(0.0);
  for (std::size_t i = 0; i < nodes; ++i)
    rate += Double::from(__builtin_convertvector(dot(load_vec3<float, W>(gradient.data(), i), p[i]).v, typename Double::Vector));
  const Real scale = Real::load(stiffness.data()) * Real::from(__builtin_convertvector(rate.v, typename Real::Vector));
  for (std::size_t i = 0; i < nodes; ++i) q.add(i, load_vec3<float, W>(gradient.data(), i) * scale);
}

template <int W>
void apply_block(const LaneBlock& block, const Shells& shells, const ShellOperator::Block& matrix, std::span<const Float4> input,
                 std::span<Float4> output, Workspace& ws) noexcept {
  const Topology& topology = *block.topology;
  const std::size_t nodes = topology.node_count();
  ws.p.resize(std::max(ws.p.size(), nodes * 4 * W));
  ws.q.resize(std::max(ws.q.size(), nodes * 4 * W));
  const NodeVectors<W> p{ws.p.data()}, q{ws.q.data()};
  load_lanes<W, float>(lane_pointers<W>(&input.data()->x, block, shells.first_node, 4), nodes * 4, p.data);
  const auto rates = apply_diagonal<W>(matrix, nodes, p, q);
  apply_edges<W>(matrix, topology.edges(), p, q);
  apply_rank_one_terms<W>(matrix, topology, p, q);
  if (!matrix.membrane.empty()) apply_membrane<W>(matrix, topology.faces(), p, q);
  if (!matrix.bending_normal.empty()) apply_bending<W>(matrix, topology, p, q, ws.rate);
  if (!matrix.area_gradient.empty()) apply_whole_shell<W>(matrix.area_gradient, matrix.area_stiffness, nodes, p, q);
  if (!matrix.bulk_gradient.empty()) apply_whole_shell<W>(matrix.bulk_gradient, matrix.bulk_friction, nodes, p, q);
  apply_whole_rates<W>(matrix, nodes, rates, q);
  store_lanes<W, float>(q.data, nodes * 4, lane_pointers<W>(&output.data()->x, block, shells.first_node, 4));
}

/// s (a bᵀ + b aᵀ)
template <class Real>
SymMat3<Real> symmetric_outer(Real s, const Vec3<Real>& a, const Vec3<Real>& b) noexcept {
  return {Real(2.0f) * s * a.x * b.x, s * (a.x * b.y + a.y * b.x), s * (a.x * b.z + a.z * b.x),
          Real(2.0f) * s * a.y * b.y, s * (a.y * b.z + a.z * b.y), Real(2.0f) * s * a.z * b.z};
}

/// Diagonal blocks of the membrane (but for what the edge blocks hold) and of bending; `add(node, block)`.
template <int W, class Add>
void add_membrane_diagonal(const ShellOperator::Block& matrix, std::span<const Triangle> faces, const Add& add) noexcept {
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const MembraneFace<W> face(matrix, f);
    add(faces[f][0], symmetric_outer(-face.h12, face.e1, face.e2));
    add(faces[f][1], symmetric_outer(-face.h20, face.e2, face.e0));
    add(faces[f][2], symmetric_outer(-face.h01, face.e0, face.e1));
  }
}
template <int W, class Add>
void add_bending_diagonal(const ShellOperator::Block& matrix, const Topology& topology, LaneVector<float>& sum, const Add& add) noexcept {
  using Real = Lane<float, W>;
  const auto normal = [&](std::size_t i) { return load_vec3<float, W>(matrix.bending_normal.data(), i); };
  sum.assign(topology.node_count() * std::size_t{W}, 0.0f);
  for (std::size_t k = 0; k < topology.edges().size(); ++k) {
    const Edge& edge = topology.edges()[k];
    const Real weight = load_scalar<float, W>(matrix.bending_weight.data(), k);
    for (const std::uint32_t node : {edge.i, edge.j}) {
      float* total = sum.data() + std::size_t{node} * W;
      (Real::load(total) + weight).store(total);
      add(node, outer(weight * weight, normal(node == edge.i ? edge.j : edge.i)));
    }
  }
  for (std::size_t i = 0; i < topology.node_count(); ++i) {
    const Real total = load_scalar<float, W>(sum.data(), i);
    add(i, outer(total * total, normal(i)));
  }
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
    const auto total = load_sym_mat3<float, W>(d, 0) + m;
    total.xx.store(d), total.xy.store(d + W), total.xz.store(d + 2 * W);
    total.yy.store(d + 3 * W), total.yz.store(d + 4 * W), total.zz.store(d + 5 * W);
  };
  for (std::size_t i = 0; i < nodes; ++i) add(i, isotropic(load_scalar<float, W>(matrix.diagonal.data(), i)));
  for (std::size_t k = 0; k < topology.edges().size(); ++k) {
    const auto m = load_sym_mat3<float, W>(matrix.edge.data(), k);
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
  for (std::size_t entry = 0; entry < matrix.hinge_edge.size(); ++entry) {
    const Edge& edge = topology.edges()[matrix.hinge_edge[entry]];
    const float* b = matrix.hinge.data();
    const auto bj = load_vec3<float, W>(b, 3 * entry), bk = load_vec3<float, W>(b, 3 * entry + 1),
               bl = load_vec3<float, W>(b, 3 * entry + 2);
    add(edge.i, outer(Real(1.0f), bj + bk + bl));
    add(edge.j, outer(Real(1.0f), bj));
    add(edge.k, outer(Real(1.0f), bk));
    add(edge.l, outer(Real(1.0f), bl));
  }
  if (!matrix.membrane.empty()) add_membrane_diagonal<W>(matrix, topology.faces(), add);
  if (!matrix.bending_normal.empty()) add_bending_diagonal<W>(matrix, topology, ws.rate, add);
  store_lanes<W, float>(sum, nodes * 6, lane_pointers<W>(&diagonal.data()->xx, block, shells.first_node, 6));
}

}  // namespace

void apply_shell_operator(const ShellBlocks& blocks, const Shells& shells, const ShellOperator& matrix, std::span<const Float4> p,
                          std::span<Float4> q) {
  for_each_block<Workspace>(blocks, [&]<int W>(std::size_t b, const LaneBlock& block, Workspace& ws) {
    apply_block<W>(block, shells, matrix.blocks[b], p, q, ws);
  });
}

void apply_shell_operator(const ShellBlocks& blocks, std::size_t first, std::size_t last, const Shells& shells, const ShellOperator& matrix,
                          std::span<const Float4> p, std::span<Float4> q) {
  Workspace workspace;
  const auto kernel = [&]<int W>(std::size_t b, const LaneBlock& block, Workspace& ws) {
    apply_block<W>(block, shells, matrix.blocks[b], p, q, ws);
  };
  for (std::size_t b = first; b < last; ++b) for_block(blocks, b, kernel, workspace);
}

void add_block_diagonal(const ShellBlocks& blocks, const Shells& shells, const ShellOperator& matrix, std::span<SymMat3<float>> diagonal) {
  for_each_block<Workspace>(blocks, [&]<int W>(std::size_t b, const LaneBlock& block, Workspace& ws) {
    add_diagonal_block<W>(block, shells, matrix.blocks[b], diagonal, ws);
  });
}

}  // namespace morula::dcm
