#pragma once
#include "dcm/isotropic_sheet.h"

namespace morula::dcm {

/// St Venant–Kirchhoff membrane, per reference area: W = G [tr E² + α (tr E)²], E = (C − I)/2, α = ν/(1 − ν).
///
/// It is S = E_h/(1 − ν²) [(1 − ν) E + ν tr(E) I] with E_h = Young's modulus times thickness and G = E_h/(2 (1 + ν)) (dcm.md §2b). Hooke's
/// law in the Green strain: its stress falls again under compression and the face collapses, so that a shell whose principal stretches
/// leave [0.8, 1.3] is at fault.
///
/// G [nN/µm].
template <class Real>
struct StVenantKirchhoff {
  Real shear;       // G
  Real area_ratio;  // α

  static constexpr double kMinStretch = 0.8, kMaxStretch = 1.3;

  MembraneStress<Real> stress(Real trace, Real det) const noexcept {
    const Real excess = trace - Real(2.0);  // 2 tr E
    const Real trace_e2 = Real(0.25) * (trace * trace - Real(2.0) * (det + trace) + Real(2.0));
    return {shear * (trace_e2 + Real(0.25) * area_ratio * excess * excess), Real(0.5) * shear * (trace - Real(1.0) + area_ratio * excess),
            Real(-0.5) * shear};
  }
  /// ∂²W/∂C², positive definite everywhere: ½ G [dC:dC + α (tr dC)²].
  MembraneModuli<Real> moduli(Real /*trace*/, Real /*det*/) const noexcept {
    return {Real(0.5) * shear * (Real(1.0) + area_ratio), Real(0.0), Real(0.0), Real(-0.5) * shear};
  }
  /// > 0 where a principal stretch is outside the range of validity: the excess of λ².
  static Real excess(Real trace, Real det) noexcept {
    const auto square = principal_squares(trace, det);
    return max(square[0] - Real(kMaxStretch * kMaxStretch), Real(kMinStretch * kMinStretch) - square[1]);
  }
};

/// The law as the registry has it.
inline ShellLaw st_venant_kirchhoff() {
  return isotropic_sheet<StVenantKirchhoff>(
      {.name = "st_venant_kirchhoff",
       .title = "Elastic cortex: St Venant–Kirchhoff membrane on constant-strain triangles",
       .equation = "W = G [tr E² + α (tr E)²], E = (C − 1)/2, G = E h / (2 (1 + ν)), α = ν/(1 − ν); stretches within 0.8 to 1.3",
       .source = "Holzapfel 2000, Nonlinear Solid Mechanics, §6.5",
       .parameters = {}},
      {.word = "stvk",
       .doc = "St Venant-Kirchhoff on triangles of constant strain, Poisson ratio 0 to 1/2; stretches from 0.8 to 1.3 only"},
      "α = ν/(1 − ν), from the Poisson ratio ν.", "is stretched beyond 0.8 to 1.3, where the law softens; neo_hooke holds there");
}

}  // namespace morula::dcm
