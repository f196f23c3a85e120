#include "dcm/block_state.h"
#include "dcm/membrane.h"
#include "dcm/stencils/face.h"

namespace morula::dcm {

template <int W>
void add_membrane_laws(BlockState<W>& state, const Shells& shells, std::span<const ShellParameters> types) noexcept {
  using Real = Lane<double, W>;
  const auto membrane = Membrane<double, W>::of(state.block, shells, types);
  const auto faces = state.topology.faces();
  const auto face_edges = state.topology.face_edges();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Triangle& t = faces[f];
    const auto x0 = state.x(t[0]), x1 = state.x(t[1]), x2 = state.x(t[2]);
    const auto e0 = x2 - x1, e1 = x0 - x2, e2 = x1 - x0;
    const auto rest = rest_squares<Real>(face_edges[f], [&](std::uint32_t edge) { return state.rest_length(edge); });
    const auto strain = MembraneStrain<Real>::of(rest, {norm2(e0), norm2(e1), norm2(e2)});
    const auto stress = membrane.stress(strain);
    state.energy += strain.reference_area * stress.energy;
    if (membrane.has_stvk) {
      const Real excess = StVenantKirchhoff<Real>::excess(strain.trace, strain.det);
      state.stretch_excess = max(state.stretch_excess, select(membrane.stvk.shear > Real(0.0), excess, Real(0.0)));
    }
    const Real twice_area = Real(2.0) * strain.reference_area;
    const auto pull = [&](int c) { return twice_area * (stress.trace * strain.trace_slope[c] + stress.det * strain.det_slope[c]); };
    const auto f0 = e0 * pull(0), f1 = e1 * pull(1), f2 = e2 * pull(2);
    state.add_force(t[0], f2 - f1);
    state.add_force(t[1], f0 - f2);
    state.add_force(t[2], f1 - f0);
  }
}

template <int W>
std::array<Lane<double, W>, 2> global_area(const BlockState<W>& state, const Shells& shells,
                                           std::span<const ShellParameters> types) noexcept {
  using Real = Lane<double, W>;
  const AreaElasticity<Real> law{parameter<double, W>(state.block, shells, types, &ShellParameters::global_area_modulus)};
  Real area(0.0), reference(0.0);
  for (std::size_t f = 0; f < state.topology.face_count(); ++f) {
    area += Real(0.5) * norm(state.face_vector(f));
    const auto rest = rest_squares<Real>(state.topology.face_edges()[f], [&](std::uint32_t edge) { return state.rest_length(edge); });
    reference += MembraneStrain<Real>::of(rest, rest).reference_area;
  }
  return {law.energy(area, reference), law.tension(area, reference)};
}

std::uint32_t overstretched_face(const Topology& topology, std::span<const Vec3d> x, std::span<const double> rest_length) {
  for (std::uint32_t f = 0; f < topology.face_count(); ++f) {
    const Triangle& t = topology.faces()[f];
    const auto rest = rest_squares<double>(topology.face_edges()[f], [&](std::uint32_t edge) { return rest_length[edge]; });
    const auto strain = MembraneStrain<double>::of(rest, {norm2(x[t[2]] - x[t[1]]), norm2(x[t[0]] - x[t[2]]), norm2(x[t[1]] - x[t[0]])});
    if (!(StVenantKirchhoff<double>::excess(strain.trace, strain.det) <= 0.0)) return f;
  }
  return topology.face_count();
}

template void add_membrane_laws<1>(BlockState<1>&, const Shells&, std::span<const ShellParameters>) noexcept;
template void add_membrane_laws<4>(BlockState<4>&, const Shells&, std::span<const ShellParameters>) noexcept;
template void add_membrane_laws<8>(BlockState<8>&, const Shells&, std::span<const ShellParameters>) noexcept;
template std::array<Lane<double, 1>, 2> global_area<1>(const BlockState<1>&, const Shells&, std::span<const ShellParameters>) noexcept;
template std::array<Lane<double, 4>, 2> global_area<4>(const BlockState<4>&, const Shells&, std::span<const ShellParameters>) noexcept;
template std::array<Lane<double, 8>, 2> global_area<8>(const BlockState<8>&, const Shells&, std::span<const ShellParameters>) noexcept;

}  // namespace morula::dcm
