#pragma once
#include <span>

#include "dcm/lane_parameters.h"
#include "dcm/laws/area_elasticity.h"
#include "dcm/laws/neo_hooke.h"
#include "dcm/laws/skalak.h"
#include "dcm/laws/st_venant_kirchhoff.h"

namespace morula::dcm {

/// Whether any shell of a block has this law.
template <int W>
bool any_has(const LaneBlock& block, const Shells& shells, std::span<const ShellParameters> types, double ShellParameters::*strength) {
  for (int lane = 0; lane < W; ++lane)
    if (types[shells.type[block.member[lane]]].*strength > 0.0) return true;
  return false;
}

/// The sum of all laws of the strain of a face, of the shells of one block. Laws that no shell has cost nothing; a shell without the law of
/// its neighbour in the lanes gets zero from it.
template <class T, int W>
struct Membrane {
  using Real = Lane<T, W>;
  NeoHooke<Real> neo_hooke;
  StVenantKirchhoff<Real> stvk;
  Skalak<Real> skalak;
  AreaElasticity<Real> area;
  bool has_neo_hooke, has_stvk, has_skalak, has_area;

  static bool acts(const LaneBlock& block, const Shells& shells, std::span<const ShellParameters> types) {
    for (const auto strength : {&ShellParameters::neo_hooke_shear, &ShellParameters::stvk_shear, &ShellParameters::skalak_shear,
                                &ShellParameters::local_area_modulus})
      if (any_has<W>(block, shells, types, strength)) return true;
    return false;
  }
  static Membrane of(const LaneBlock& block, const Shells& shells, std::span<const ShellParameters> types) {
    const auto of_type = [&](double ShellParameters::*member) { return parameter<T, W>(block, shells, types, member); };
    const auto has = [&](double ShellParameters::*member) { return any_has<W>(block, shells, types, member); };
    const Real ratio = of_type(&ShellParameters::membrane_area_ratio);
    return {{of_type(&ShellParameters::neo_hooke_shear), ratio},
            {of_type(&ShellParameters::stvk_shear), ratio},
            {of_type(&ShellParameters::skalak_shear), ratio},
            {of_type(&ShellParameters::local_area_modulus)},
            has(&ShellParameters::neo_hooke_shear),
            has(&ShellParameters::stvk_shear),
            has(&ShellParameters::skalak_shear),
            has(&ShellParameters::local_area_modulus)};
  }

  /// Without the local area, whose stiffness has another form.
  MembraneStress<Real> elastic_stress(const MembraneStrain<Real>& s) const noexcept {
    MembraneStress<Real> out;
    if (has_neo_hooke) out += neo_hooke.stress(s.trace, s.det);
    if (has_stvk) out += stvk.stress(s.trace, s.det);
    if (has_skalak) out += skalak.stress(s.trace, s.det);
    return out;
  }
  MembraneStress<Real> stress(const MembraneStrain<Real>& s) const noexcept {
    auto out = elastic_stress(s);
    if (has_area) out += area.stress(s.det);
    return out;
  }
  MembraneModuli<Real> moduli(const MembraneStrain<Real>& s) const noexcept {
    MembraneModuli<Real> out;
    if (has_neo_hooke) out += neo_hooke.moduli(s.det);
    if (has_stvk) out += stvk.moduli();
    if (has_skalak) out += skalak.moduli(s.det);
    if (has_area) out += area.moduli(s.det);
    return out;
  }
};

/// Squared lengths of a face's edges at rest: its reference metric. `rest_length(edge)`.
template <class Real, class RestLength>
std::array<Real, 3> rest_squares(const std::array<std::uint32_t, 3>& edges, const RestLength& rest_length) noexcept {
  const Real a = rest_length(edges[0]), b = rest_length(edges[1]), c = rest_length(edges[2]);
  return {a * a, b * b, c * c};
}

}  // namespace morula::dcm
