#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/traction_law.h"
#include "core/friction/contact_element.h"
#include "core/friction/float4.h"

namespace morula {

/// How contact couples node i of one body with node j of another: the force on i is −C (v_i − v_j), on j the opposite.
struct NodePairBlock {
  std::uint16_t i, j;  ///< nodes within their bodies
  float c[6];          ///< xx xy xz yy yz zz [nN·s/µm]
};
static_assert(sizeof(NodePairBlock) == 28);

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
  void add_pair_blocks(const ElementGroup& group, std::vector<NodePairBlock>& out);
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

/// q += the blocks applied to p: `p0`, `q0` at the first point of body 0, `p1`, `q1` of body 1 (null: an obstacle at rest). A side whose q
/// is null is not written.
void apply_pair_blocks(std::span<const NodePairBlock> blocks, const Float4* p0, Float4* q0, const Float4* p1, Float4* q1);

}  // namespace morula
