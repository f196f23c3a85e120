#include "dcm/internal_forces.h"

#include <cmath>

#include "dcm/block_state.h"
#include "dcm/lane_parameters.h"
#include "dcm/laws/cortical_tension.h"
#include "dcm/laws/dihedral_barrier.h"
#include "dcm/laws/edge_spring.h"
#include "dcm/laws/hinge_bending.h"
#include "dcm/laws/triangle_shape.h"
#include "dcm/laws/volume_pressure.h"
#include "dcm/sheets_of_block.h"
#include "dcm/stencils/face.h"
#include "dcm/stencils/hinge.h"

namespace morula::dcm {
namespace {

/// Doubled area vectors of all faces, and the enclosed volume V = Σ x_0·N/6 relative to node 0.
template <int W>
void measure_faces(BlockState<W>& state) noexcept {
  using Real = Lane<double, W>;
  Real six_volumes(0.0);
  const auto faces = state.topology.faces();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto x0 = state.x(faces[f][0]);
    const auto n = cross(state.x(faces[f][1]) - x0, state.x(faces[f][2]) - x0);
    store_vec3<double, W>(state.ws.face_vector.data(), f, n);
    six_volumes += dot(x0, n);
  }
  state.volume = six_volumes * (1.0 / 6.0);
}

/// Tension (with that of the global area), triangle shape, and the pressure p with ∂V/∂x_c = Σ N/6 (equal to Σ x×x/6 on closed meshes).
template <int W>
void add_face_laws(BlockState<W>& state, const Shells& shells, const CorticalTension<Lane<double, W>>& tension,
                   Lane<double, W> global_tension, const TriangleShape<Lane<double, W>>& shape, Lane<double, W> pressure) noexcept {
  using Real = Lane<double, W>;
  const ShapeArray<double, W> unit_area(state.block, shells, &ReferenceShape::face_area);
  const Real scale = by_lane<double, W>(state.block, [&](std::uint32_t s) {
    const double size = std::cbrt(shells.rest_volume[s]);
    return size * size;
  });
  const Real pressure_sixth = pressure * (1.0 / 6.0), tension_slope = tension.slope() + global_tension;
  const auto faces = state.topology.faces();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Triangle& t = faces[f];
    FaceStencil<Real> face;
    const auto x0 = state.x(t[0]), x1 = state.x(t[1]), x2 = state.x(t[2]);
    face.e0 = x2 - x1, face.e1 = x0 - x2, face.e2 = x1 - x0;
    face.twice_area_vector = state.face_vector(f);
    const Real twice_area = norm(face.twice_area_vector);
    const Real inverse_twice_area = Real(1.0) / twice_area;
    (inverse_twice_area * inverse_twice_area).store(state.ws.face_inverse_square.data() + f * W);

    const Real area = twice_area * 0.5, inverse_area = inverse_twice_area * 2.0, reference_area = unit_area[f] * scale;
    const Real inverse_quality = shape.inverse_quality(inverse_area, face.square_sum());
    state.max_inverse_quality = max(state.max_inverse_quality, inverse_quality);
    state.energy += tension.energy(area) + shape.energy(inverse_quality, reference_area);
    const auto force =
        FaceForce<Real>::of(face, inverse_twice_area, tension_slope + shape.area_slope(inverse_quality, inverse_area, reference_area),
                            shape.square_sum_slope(inverse_quality, inverse_area, reference_area));
    const auto push = face.twice_area_vector * pressure_sixth;
    state.add_force(t[0], force.f0 + push);
    state.add_force(t[1], force.f1 + push);
    state.add_force(t[2], force.f2 + push);
  }
}

/// An edge with its two faces, loaded.
template <int W>
struct LoadedHinge {
  using Real = Lane<double, W>;
  Vec3<Real> xi, e, direction, n1, n2;
  Real length, inverse_length, angle;

  LoadedHinge(const BlockState<W>& state, const Edge& edge) noexcept
      : xi(state.x(edge.i)), e(state.x(edge.j) - xi), n1(state.face_vector(edge.left)), n2(state.face_vector(edge.right)) {
    length = norm(e);
    inverse_length = Real(1.0) / length;
    direction = e * inverse_length;
    angle = hinge_angle(n1, n2, direction);
  }
  HingeGradient<Real> gradient(const BlockState<W>& state, const Edge& edge) const noexcept {
    return HingeGradient<Real>::of(e, length, inverse_length, state.x(edge.k) - xi, state.x(edge.l) - xi, n1,
                                   state.inverse_square(edge.left), n2, state.inverse_square(edge.right));
  }
};

/// Springs and bending; finds the largest angle.
template <int W>
void add_edge_laws(BlockState<W>& state, const Shells& shells, const EdgeSpring<Lane<double, W>>& spring,
                   const HingeBending<Lane<double, W>>& bending) noexcept {
  using Real = Lane<double, W>;
  const ShapeArray<double, W> rest_angle(state.block, shells, &ReferenceShape::hinge_angle);
  const auto edges = state.topology.edges();
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const Edge& edge = edges[k];
    const LoadedHinge<W> hinge(state, edge);
    const Real rest_length = load_scalar<double, W>(state.ws.rest_length.data(), k);
    const Real angle0 = rest_angle[k];
    state.max_angle = max(state.max_angle, abs(hinge.angle));
    state.energy += spring.energy(hinge.length, rest_length) + bending.energy(hinge.angle, angle0);
    const auto pull = hinge.direction * spring.slope(hinge.length, rest_length);
    const auto g = hinge.gradient(state, edge);
    const Real moment = -bending.slope(hinge.angle, angle0);
    state.add_force(edge.i, g.i * moment + pull);
    state.add_force(edge.j, g.j * moment - pull);
    state.add_force(edge.k, g.k * moment);
    state.add_force(edge.l, g.l * moment);
  }
}

/// The dihedral barrier; called only when an edge of the block is beyond its onset.
template <int W>
void add_barrier(BlockState<W>& state, const DihedralBarrier<Lane<double, W>>& barrier) noexcept {
  using Real = Lane<double, W>;
  for (const Edge& edge : state.topology.edges()) {
    const LoadedHinge<W> hinge(state, edge);
    if (!any_lane<W>(abs(hinge.angle) > barrier.onset)) continue;
    state.energy += barrier.energy(hinge.angle);
    const auto g = hinge.gradient(state, edge);
    const Real moment = -barrier.slope(hinge.angle);
    state.add_force(edge.i, g.i * moment);
    state.add_force(edge.j, g.j * moment);
    state.add_force(edge.k, g.k * moment);
    state.add_force(edge.l, g.l * moment);
  }
}

/// Which element of a shell is at fault, once it is known that one is.
ShellFault locate_fault(const Topology& topology, std::span<const Vec3d> x, double volume) {
  for (std::uint32_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i].x) || !std::isfinite(x[i].y) || !std::isfinite(x[i].z)) return {ShellFaultKind::kNotFinite, i};
  }
  if (!(volume > 0.0)) return {ShellFaultKind::kVolume, 0};
  const auto area_vector = [&](std::uint32_t f) {
    const Triangle& t = topology.faces()[f];
    return cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]);
  };
  for (std::uint32_t f = 0; f < topology.face_count(); ++f) {
    const Triangle& t = topology.faces()[f];
    const double square_sum = norm2(x[t[1]] - x[t[0]]) + norm2(x[t[2]] - x[t[1]]) + norm2(x[t[0]] - x[t[2]]);
    const double quality = 0.5 * TriangleShape<double>::kEquilateral * norm(area_vector(f)) / square_sum;
    if (!(quality >= ShellLimits::kQuality)) return {ShellFaultKind::kTriangleShape, f};
  }
  ShellFault worst{ShellFaultKind::kDihedral, 0};
  double largest = -1.0;
  for (std::uint32_t k = 0; k < topology.edge_count(); ++k) {
    const Edge& edge = topology.edges()[k];
    const double angle = std::abs(hinge_angle(area_vector(edge.left), area_vector(edge.right), normalized(x[edge.j] - x[edge.i])));
    if (angle > largest) largest = angle, worst.element = k;
  }
  return worst;
}

std::span<const double> rest_lengths(const Shells& shells, std::uint32_t shell) {
  return std::span(shells.rest_length).subspan(shells.first_edge[shell], shells.first_edge[shell + 1] - shells.first_edge[shell]);
}

template <int W>
void write_shell_results(const BlockState<W>& state, const Shells& shells, const ShellMaterials& materials, std::span<const Vec3d> position,
                         const Lane<double, W>& cytosol, ShellMechanics& out) noexcept {
  for (int lane = 0; lane < state.block.count; ++lane) {
    const std::uint32_t shell = state.block.member[lane];
    const double volume = state.volume[lane], energy = state.energy[lane];
    out.volume[shell] = volume;
    out.energy[shell] = energy;
    out.min_quality[shell] = 1.0 / state.max_inverse_quality[lane];
    out.max_angle[shell] = state.max_angle[lane];
    const bool good = std::isfinite(energy) && cytosol[lane] > 0.0 && state.max_inverse_quality[lane] <= 1.0 / ShellLimits::kQuality &&
                      state.max_angle[lane] <= ShellLimits::kAngle && state.stretch_excess[lane] <= 0.0;
    if (good) {
      out.fault[shell] = {};
      continue;
    }
    const auto x = position.subspan(shells.first_node[shell], state.topology.node_count());
    out.fault[shell] = state.stretch_excess[lane] > 0.0 && std::isfinite(energy) && cytosol[lane] > 0.0
                           ? overstretched_face(state.topology, materials.of(shells, shell).sheets, x, rest_lengths(shells, shell))
                           : locate_fault(state.topology, x, cytosol[lane]);
  }
}

template <int W>
void block_mechanics(const LaneBlock& block, const Shells& shells, const ShellMaterials& materials, std::span<const Vec3d> position,
                     std::span<Vec3d> force, ShellMechanics& out, std::span<const HeldVolume> held, ForceWorkspace& ws) noexcept {
  using Real = Lane<double, W>;
  const Topology& topology = *block.topology;
  ws.fit(topology, W);
  load_relative_positions<W>(block, lane_pointers<W>(&position.data()->x, block, shells.first_node, 3), ws.position.data());
  load_lanes<W, double>(lane_pointers<W>(shells.rest_length.data(), block, shells.first_edge), topology.edge_count(),
                        ws.rest_length.data());
  std::fill_n(ws.force.data(), std::size_t{topology.node_count()} * 3 * W, 0.0);

  BlockState<W> state{block, topology, ws};
  state.strained = strained_lanes<double, W>(block, shells, materials);
  const auto of_type = [&](double ShellParameters::*member) { return parameter<double, W>(block, shells, materials, member); };
  measure_faces(state);
  Real pressure(0.0), volume_energy(0.0), cytosol(0.0);
  for (int lane = 0; lane < W; ++lane) {
    const std::uint32_t shell = block.member[lane];
    const VolumePressure law{materials.of(shells, shell).bulk_modulus};
    const HeldVolume inside = held.empty() ? HeldVolume{} : held[shell];
    const double volume = inside.cytosol(state.volume[lane]), reference = shells.reference_volume[shell];
    cytosol.set(lane, volume);
    pressure.set(lane, volume > 0.0 ? law.pressure(volume, reference) : 0.0);
    volume_energy.set(lane, volume > 0.0 ? (1.0 - inside.part) * law.energy(volume, reference) : 0.0);
    out.pressure[shell] = pressure[lane];
  }
  Real global_tension(0.0), area_energy(0.0);
  if (any_has<W>(block, shells, materials, &ShellParameters::global_area_modulus)) {
    const auto both = global_area<W>(state, shells, materials);
    area_energy = both[0], global_tension = both[1];
  }
  add_face_laws<W>(state, shells, {of_type(&ShellParameters::tension)}, global_tension, {of_type(&ShellParameters::shape_stiffness)},
                   pressure);
  add_edge_laws<W>(state, shells, {of_type(&ShellParameters::spring_stiffness)}, {of_type(&ShellParameters::hinge_stiffness)});
  const DihedralBarrier<Real> barrier{of_type(&ShellParameters::barrier_stiffness), of_type(&ShellParameters::barrier_angle)};
  if (any_lane<W>(state.max_angle > barrier.onset)) add_barrier(state, barrier);
  add_sheet_laws<W>(state, shells, materials);
  if (any_has<W>(block, shells, materials, &ShellParameters::helfrich_rigidity)) add_helfrich<W>(state, shells, materials);
  state.energy += volume_energy + area_energy;
  store_lanes<W, double>(ws.force.data(), std::size_t{topology.node_count()} * 3,
                         lane_pointers<W>(&force.data()->x, block, shells.first_node, 3));
  write_shell_results(state, shells, materials, position, cytosol, out);
}

}  // namespace

void internal_forces(const ShellBlocks& blocks, const Shells& shells, const ShellMaterials& materials, std::span<const Vec3d> position,
                     ShellMechanics& out) {
  out.force.resize(shells.node_count());
  internal_forces(blocks, shells, materials, position, out.force, out);
}

void internal_forces(const ShellBlocks& blocks, const Shells& shells, const ShellMaterials& materials, std::span<const Vec3d> position,
                     std::span<Vec3d> force, ShellMechanics& out, std::span<const HeldVolume> held) {
  for (std::vector<double>* array : {&out.energy, &out.volume, &out.pressure, &out.min_quality, &out.max_angle})
    array->resize(shells.size());
  out.fault.resize(shells.size());
  for_each_block<ForceWorkspace>(blocks, [&]<int W>(std::size_t, const LaneBlock& block, ForceWorkspace& ws) {
    block_mechanics<W>(block, shells, materials, position, force, out, held, ws);
  });
}

}  // namespace morula::dcm
