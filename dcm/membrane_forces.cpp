#include "dcm/block_state.h"
#include "dcm/sheet_loops.h"
#include "dcm/sheets_of_block.h"
#include "dcm/stencils/face.h"

namespace morula::dcm {

template <int W>
void add_sheet_laws(BlockState<W>& state, const Shells& shells, const ShellMaterials& materials) noexcept {
  using Real = Lane<double, W>;
  const auto sheets = sheets_of_block<double, W>(state.block, shells, materials);
  const bool has_area = any_has<W>(state.block, shells, materials, &ShellParameters::local_area_modulus);
  const Real modulus = parameter<double, W>(state.block, shells, materials, &ShellParameters::local_area_modulus);
  const Real* const area = has_area ? &modulus : nullptr;
  if (sheets.size() == 1)
    sheets[0].law->template in_lanes<W>().add_forces(state, sheets[0].coefficient.data(), area);
  else if (sheets.size() > 1)
    add_sheet_forces<W>(state, SheetSum<W>{sheets}, area);
  else if (has_area)
    add_sheet_forces<W>(state, OneSheet<NoSheet, Real>{}, area);
}

template <int W>
std::array<Lane<double, W>, 2> global_area(const BlockState<W>& state, const Shells& shells, const ShellMaterials& materials) noexcept {
  using Real = Lane<double, W>;
  const AreaElasticity<Real> law{parameter<double, W>(state.block, shells, materials, &ShellParameters::global_area_modulus)};
  Real area(0.0), reference(0.0);
  for (std::size_t f = 0; f < state.topology.face_count(); ++f) {
    area += Real(0.5) * norm(state.face_vector(f));
    const Triangle& t = state.topology.faces()[f];
    const auto x0 = state.x(t[0]), x1 = state.x(t[1]), x2 = state.x(t[2]);
    const auto rest_length = [&](std::uint32_t edge) { return state.rest_length(edge); };
    const auto rest =
        rest_squares<Real>(state.topology.face_edges()[f], rest_length, state.strained, {norm2(x2 - x1), norm2(x0 - x2), norm2(x1 - x0)});
    reference += MembraneStrain<Real>::of(rest, rest).reference_area;
  }
  return {law.energy(area, reference), law.tension(area, reference)};
}

ShellFault overstretched_face(const Topology& topology, std::span<const Sheet> sheets, std::span<const Vec3d> x,
                              std::span<const double> rest_length) {
  for (std::uint32_t f = 0; f < topology.face_count(); ++f) {
    const Triangle& t = topology.faces()[f];
    const auto rest = rest_squares<double>(topology.face_edges()[f], [&](std::uint32_t edge) { return rest_length[edge]; });
    const auto strain = MembraneStrain<double>::of(rest, {norm2(x[t[2]] - x[t[1]]), norm2(x[t[0]] - x[t[2]]), norm2(x[t[1]] - x[t[0]])});
    for (const Sheet& sheet : sheets)
      if (sheet.law->excess != nullptr && sheet.coefficient[0] > 0.0 && !(sheet.law->excess(strain.trace, strain.det) <= 0.0))
        return {ShellFaultKind::kStretch, f, sheet.law.get()};
  }
  return {ShellFaultKind::kStretch, topology.face_count(), nullptr};
}

template void add_sheet_laws<1>(BlockState<1>&, const Shells&, const ShellMaterials&) noexcept;
template void add_sheet_laws<4>(BlockState<4>&, const Shells&, const ShellMaterials&) noexcept;
template void add_sheet_laws<8>(BlockState<8>&, const Shells&, const ShellMaterials&) noexcept;
template std::array<Lane<double, 1>, 2> global_area<1>(const BlockState<1>&, const Shells&, const ShellMaterials&) noexcept;
template std::array<Lane<double, 4>, 2> global_area<4>(const BlockState<4>&, const Shells&, const ShellMaterials&) noexcept;
template std::array<Lane<double, 8>, 2> global_area<8>(const BlockState<8>&, const Shells&, const ShellMaterials&) noexcept;

}  // namespace morula::dcm
