#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/friction/contact_element.h"
#include "core/friction/float4.h"
#include "core/mesh/face_quadrature.h"

namespace morula {

/// How contact couples node i of one body with node j of another: the force on i is −C (v_i − v_j), on j the opposite.
///
/// C is symmetric and positive definite; its entries are kept in units of the row, rounded to 16 bits. What rounding could take from its
/// smallest eigenvalue is given back on the diagonal where friction alone does not make up for it.
struct alignas(16) NodePairBlock {
  std::int16_t xx;
  std::uint16_t j;  ///< node of the second body
  std::int16_t xy, yy, xz, yz, zz, unused;

  static constexpr float kMost = 32760.0f;  ///< of an entry: room is left for what is given back
  [[nodiscard]] SymMat3<float> matrix(float unit) const { return {unit * xx, unit * xy, unit * xz, unit * yy, unit * yz, unit * zz}; }
};
static_assert(sizeof(NodePairBlock) == 16);

/// The blocks of node i of the first body come one after the other.
struct NodePairRow {
  std::uint16_t i, count;
  float unit;  ///< [nN·s/µm]
};

/// Blocks of a pair of bodies, by row.
struct NodePairBlocks {
  std::span<const NodePairRow> rows;
  std::span<const NodePairBlock> blocks;
};

/// Blocks of many pairs, one after the other.
struct NodePairArena {
  std::vector<NodePairRow> rows;
  std::vector<NodePairBlock> blocks;

  void clear() { rows.clear(), blocks.clear(); }
};

/// The contact points of a pair of bodies as blocks over pairs of nodes.
///
/// A point with weights w_k (β_i on its face, −μ_j on the other, Σ w = 0) and matrix D = a I + (b + Δt k) n nᵀ adds uᵀD u with u = Σ w_k v_k
/// to the quadratic form, and for Σ w = 0
///   uᵀ D u = −Σ_{k<l} w_k w_l (v_k − v_l)ᵀ D (v_k − v_l).
/// Pairs across the two bodies get C_ij = β_i μ_j D (here); pairs within one body are edges of its mesh and get −β_i β_j D or −μ_i μ_j D
/// (add_edge_blocks()), which joins the edge blocks that the shell has anyway. All of it acts on differences of velocities, so that rigid
/// translation stays exact in float. An obstacle counts as a node at rest.
class PairCondenser {
 public:
  PairCondenser(const FaceQuadrature& quadrature, float time_step);

  /// Append the blocks across the bodies of a group to `out`, sorted by i, then j.
  void add_pair_blocks(const ElementGroup& group, NodePairArena& out);
  /// Add the blocks within body `side` (0 or 1) of a group to `edges`, by edge of its Topology.
  void add_edge_blocks(const ElementGroup& group, int side, std::span<EdgeBlock> edges) const;

 private:
  void mark_pairs(const ElementGroup& group);
  std::uint32_t number_pairs(const ElementGroup& group);

  float beta_[4][3];
  float time_step_;
  std::size_t words_ = 1;                  ///< of a row of the pattern
  std::vector<std::uint64_t> pattern_;     ///< by row (node of body 0): one bit for each node of body 1
  std::vector<std::uint32_t> first_slot_;  ///< by word of the pattern
  std::vector<std::uint64_t> row_used_;    ///< one bit for each row
  std::vector<EdgeBlock> sum_;
};

/// How an obstacle holds a point of a body: the force on it is −C v.
struct HeldPoint {
  std::uint32_t body = 0, point = 0;
  SymMat3<double> block;  ///< C, with friction and stiffness [nN·s/µm]
};

/// Appends what a group whose second body is an obstacle couples with it, by point in ascending order; not rounded. Nothing for other groups, and for bodies that
/// are not written.
void add_held_points(const ElementGroup& group, const FaceQuadrature& quadrature, float time_step, std::vector<HeldPoint>& out);

/// What the points of all groups couple within one body; `groups` and their points must live as long as the result is used. By number of
/// body, of which there are `bodies`.
EdgeBlockSource edge_blocks_of(std::span<const ElementGroup> groups, std::size_t bodies, const FaceQuadrature& quadrature, float time_step);

/// q += the blocks applied to p: `p0`, `q0` at the first point of body 0, `p1`, `q1` of body 1 (null: an obstacle at rest). A side whose q
/// is null is not written.
void apply_pair_blocks(const NodePairBlocks& pair, const Float4* p0, Float4* q0, const Float4* p1, Float4* q1);

}  // namespace morula
