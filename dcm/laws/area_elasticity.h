#pragma once
#include "dcm/stencils/membrane.h"

namespace morula::dcm {

/// Elasticity of the area: E = ½ K (A − A0)²/A0, for every face by itself (local) or for the whole surface (global); A0 is the area that
/// the rest lengths give.
///
/// Local: adds K to the area modulus of the membrane. A net of springs has the Poisson ratio 1/3; springs of k = 2 E_h/(√3 (1 + ν)) with
/// K = E_h (3ν − 1)/(2 (1 − ν²)) have Young's modulus E_h and Poisson ratio ν ≥ 1/3 (dcm.md §2a). Global: as lipids that flow along the
/// surface do. Source: Seifert 1997, doi:10.1080/00018739700101488.
///
/// K [nN/µm], areas [µm²]; energy [fJ], tension ∂E/∂A [nN/µm].
template <class Real>
struct AreaElasticity {
  Real modulus;  // K

  Real energy(Real area, Real reference) const noexcept {
    const Real excess = area - reference;
    return Real(0.5) * modulus * excess * excess / reference;
  }
  Real tension(Real area, Real reference) const noexcept { return modulus * (area - reference) / reference; }
  /// ∂²E/∂A²; Gauss–Newton: K_x = E″ ∇A ∇Aᵀ. The tension's own stiffness is that of CorticalTension.
  Real curvature_psd(Real reference) const noexcept { return modulus / reference; }

  /// Local form as a membrane law of D = (A/A0)²: W = ½ K (√D − 1)².
  MembraneStress<Real> stress(Real det) const noexcept {
    const Real ratio = sqrt(det), excess = ratio - Real(1.0);
    return {Real(0.5) * modulus * excess * excess, Real(0.0), Real(0.5) * modulus * excess / ratio};
  }
  MembraneModuli<Real> moduli(Real det) const noexcept { return {Real(0.0), Real(0.0), Real(0.25) * modulus / det, Real(0.0)}; }
};

}  // namespace morula::dcm
