#pragma once
#include <span>

#include "core/mesh/lane_surface.h"
#include "dcm/lane_parameters.h"
#include "dcm/shell_operator.h"

namespace morula::dcm {

/// Arrays of one thread for assemble_shell_operator().
struct OperatorWorkspace {
  LaneVector<double> position;
  LaneVector<float> local, start, face, rest_length, contact_energy, node_area;
  LaneVector<double> rest_length_double, contact_energy_double;
  LaneVector<float> contact_lanes;                    ///< what contacts add to the edges: [edge][8][lane]
  std::vector<EdgeBlock> cell[LaneBlock::kMaxLanes];  ///< the same by lane
};

template <int W>
Lane<float, W> to_float(Lane<double, W> a) noexcept {
  return Lane<float, W>::from(__builtin_convertvector(a.v, typename Lane<float, W>::Vector));
}
template <int W>
Vec3<Lane<float, W>> to_float(const Vec3<Lane<double, W>>& a) noexcept {
  return {to_float<W>(a.x), to_float<W>(a.y), to_float<W>(a.z)};
}

/// What the edge loop needs of a face: N, the inverse of |N|, weight of the tension's stiffness, isotropic part of the shape term.
template <int W>
struct FaceRecord {
  using Real = Lane<float, W>;
  static constexpr int kSize = 6;
  Vec3<Real> n;
  Real inverse_norm, tension, isotropic;

  void store(LaneVector<float>& array, std::size_t face) const noexcept {
    float* p = array.data() + face * kSize * W;
    n.x.store(p), n.y.store(p + W), n.z.store(p + 2 * W);
    inverse_norm.store(p + 3 * W), tension.store(p + 4 * W), isotropic.store(p + 5 * W);
  }
  static FaceRecord load(const LaneVector<float>& array, std::size_t face) noexcept {
    const float* p = array.data() + face * kSize * W;
    return {{Real::load(p), Real::load(p + W), Real::load(p + 2 * W)}, Real::load(p + 3 * W), Real::load(p + 4 * W), Real::load(p + 5 * W)};
  }
};

/// What the loops over the elements of one block share.
template <int W>
struct Assembly {
  using Real = Lane<float, W>;
  const LaneBlock& block;
  const Shells& shells;
  const ShellMaterials& materials;
  const Topology& topology;
  OperatorWorkspace& ws;
  ShellOperator::Block& out;
  Real dt;
  std::span<const HeldVolume> held;
  Real strained = strained_lanes<float, W>(block, shells, materials);

  Vec3<Real> x(std::size_t node) const noexcept { return load_vec3<float, W>(ws.local.data(), node); }
  Real of_type(double ShellParameters::*member) const noexcept { return parameter<float, W>(block, shells, materials, member); }
};

/// Add the forces of an edge's stiffness against rotations of the shell about the three axes to `rotation`.
template <int W>
void add_rotation(Assembly<W>& a, const Edge& edge, const SymMat3<Lane<float, W>>& stiffness) noexcept {
  using Real = Lane<float, W>;
  const auto e = a.x(edge.j) - a.x(edge.i);
  const Real none(0.0f);
  const Vec3<Real> turns[3] = {{none, -e.z, e.y}, {e.z, none, -e.x}, {-e.y, e.x, none}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto force = stiffness * turns[axis];
    add_vec3<float, W>(a.out.rotation.data(), 3 * edge.j + axis, force);
    add_vec3<float, W>(a.out.rotation.data(), 3 * edge.i + axis, -force);
  }
}

/// From these forces Y = K R, with R the three rotations, to what ShellOperator::Block::rotation is. After all that adds stiffness to the edges, but
/// for contacts.
template <int W>
void free_rotations(Assembly<W>& assembly) noexcept;

/// Add what contacts couple within the shells to `edge`, the edge blocks of the matrix.
template <int W>
void add_contact_edges(const LaneBlock& block, const EdgeBlockSource& contacts, OperatorWorkspace& ws, LaneVector<float>& edge);

/// Add to every face's contact energy the tensions of local and global area; then their stiffness is that of a tension. For blocks in which
/// a shell has one of them, before the faces are assembled.
template <int W>
void add_area_tensions(Assembly<W>& assembly) noexcept;

/// Stiffness of the sheets and of the local area: adds to the edge blocks and writes `membrane`, where a shell of the block has one of them;
/// after the edges are assembled.
template <int W>
void assemble_sheets(Assembly<W>& assembly) noexcept;

/// ∂A/∂x and stiffness of the global area.
template <int W>
void assemble_global_area(Assembly<W>& assembly) noexcept;

/// Cotangent weights and scaled normals of the Helfrich law; needs face records and volume gradients.
template <int W>
void assemble_bending(Assembly<W>& assembly) noexcept;

}  // namespace morula::dcm
