#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "core/mesh/lane_surface.h"
#include "dcm/shell_fault.h"
#include "dcm/shells.h"

namespace morula::dcm {

/// Lane arrays of one thread for internal_forces(): [element][component][lane].
struct ForceWorkspace {
  LaneVector<double> position, force, face_vector, face_inverse_square, rest_length;
  LaneVector<double> area_gradient, volume_gradient, node_area;  ///< Helfrich only

  void fit(const Topology& topology, int lanes) {
    fit(position, topology.node_count() * std::size_t{3} * lanes);
    fit(force, topology.node_count() * std::size_t{3} * lanes);
    fit(face_vector, topology.face_count() * std::size_t{3} * lanes);
    fit(face_inverse_square, topology.face_count() * std::size_t{1} * lanes);
    fit(rest_length, topology.edge_count() * std::size_t{1} * lanes);
  }
  void fit_curvature(const Topology& topology, int lanes) {
    fit(area_gradient, topology.node_count() * std::size_t{3} * lanes);
    fit(volume_gradient, topology.node_count() * std::size_t{3} * lanes);
    fit(node_area, topology.node_count() * std::size_t{1} * lanes);
  }

 private:
  static void fit(LaneVector<double>& array, std::size_t size) {
    if (array.size() < size) array.resize(size);
  }
};

/// What the loops over the elements of one block share.
template <int W>
struct BlockState {
  using Real = Lane<double, W>;
  const LaneBlock& block;
  const Topology& topology;
  ForceWorkspace& ws;
  Real energy{0.0}, volume{0.0}, max_inverse_quality{0.0}, max_angle{0.0};
  Real stretch_excess{0.0};  ///< > 0 where a law's range of stretch is left
  Real strained{1.0};        ///< 0 of a shell without a law of the strain of faces: strained_lanes()

  Vec3<Real> x(std::size_t node) const noexcept { return load_vec3<double, W>(ws.position.data(), node); }
  Vec3<Real> face_vector(std::size_t face) const noexcept { return load_vec3<double, W>(ws.face_vector.data(), face); }
  Real inverse_square(std::size_t face) const noexcept { return load_scalar<double, W>(ws.face_inverse_square.data(), face); }
  Real rest_length(std::size_t edge) const noexcept { return load_scalar<double, W>(ws.rest_length.data(), edge); }
  void add_force(std::size_t node, const Vec3<Real>& f) noexcept { add_vec3<double, W>(ws.force.data(), node, f); }
};

/// Sheets (laws of the strain of a face) and local area elasticity, where a shell of the block has one of them; adds to force, energy and
/// stretch_excess.
template <int W>
void add_sheet_laws(BlockState<W>& state, const Shells& shells, const ShellMaterials& materials) noexcept;

/// Helfrich bending. For blocks in which a shell has it; face vectors are those of the positions.
template <int W>
void add_helfrich(BlockState<W>& state, const Shells& shells, const ShellMaterials& materials) noexcept;

/// Energy and tension K_G (A − A0)/A0 of the global area; {energy, tension} by lane.
template <int W>
std::array<Lane<double, W>, 2> global_area(const BlockState<W>& state, const Shells& shells, const ShellMaterials& materials) noexcept;

/// The first face of a shell whose strain leaves the range of one of its sheets; its number is face_count when there is none.
ShellFault overstretched_face(const Topology& topology, std::span<const Sheet> sheets, std::span<const Vec3d> position,
                              std::span<const double> rest_length);

}  // namespace morula::dcm
