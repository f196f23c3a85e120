#pragma once
#include <cmath>

#include "dcm/isotropic_sheet.h"

namespace morula::dcm {

/// {D^{−α}, (D^{−α} − 1)/α}; the second is −ln D at α = 0.
struct InversePower {
  double value, integral;
  static InversePower of(double det, double alpha) noexcept {
    if (alpha == 1.0) return {1.0 / det, 1.0 / det - 1.0};
    const double exponent = -alpha * std::log(det);
    return {std::exp(exponent), alpha == 0.0 ? -std::log(det) : std::expm1(exponent) / alpha};
  }
};

/// Neo-Hookean membrane, per reference area: W = ½ G [I − 2 + (D^{−α} − 1)/α], I = tr C, D = det C.
///
/// It is the plane-stress state of the Blatz–Ko form of a compressible neo-Hookean solid (Blatz & Ko 1962, doi:10.1122/1.548937;
/// Holzapfel 2000, §6.5): W3 = ½ µ [I1 − 3 + (J^{−2β} − 1)/β] with β = ν/(1 − 2ν). No stress through the thickness means λ3² = J^{−2β} =
/// D^{−α}, α = β/(1 + β) = ν/(1 − ν), and W = h W3. With ν = ½ (α = 1) it is the incompressible W = ½ G (tr C + 1/det C − 3). Linear
/// moduli: G = E h/(2 (1 + ν)), area modulus G (1 + 2α), Poisson ratio ν.
///
/// W is convex in C for 0 ≤ ν ≤ ½, because ln D is concave there; all of its second derivative goes into the stiffness.
/// G [nN/µm].
template <class Real>
struct NeoHooke {
  Real shear;       // G
  Real area_ratio;  // α = ν/(1 − ν)

  MembraneStress<Real> stress(Real trace, Real det) const noexcept {
    Real power, integral;
    powers(det, power, integral);
    const Real half = Real(0.5) * shear;
    return {half * (trace - Real(2.0) + integral), half, -half * power / det};
  }
  MembraneModuli<Real> moduli(Real /*trace*/, Real det) const noexcept {
    Real power, integral;
    powers(det, power, integral);
    const Real slope = Real(-0.5) * shear * power / det;
    return {Real(0.0), Real(0.0), -slope * (area_ratio + Real(1.0)) / det, slope};
  }

 private:
  /// Every lane by itself, so that a cell gets the same bits whoever its neighbours are.
  void powers(Real det, Real& power, Real& integral) const noexcept {
    if constexpr (requires { det.set(0, 1.0); }) {
      bool incompressible = true;
      for (int lane = 0; lane < Real::width; ++lane) incompressible = incompressible && area_ratio[lane] == 1.0;
      if (incompressible) {
        power = Real(1.0) / det, integral = power - Real(1.0);
        return;
      }
      power = integral = Real(0.0);
      for (int lane = 0; lane < Real::width; ++lane) {
        const auto p = InversePower::of(det[lane], area_ratio[lane]);
        power.set(lane, static_cast<typename Real::Scalar>(p.value));
        integral.set(lane, static_cast<typename Real::Scalar>(p.integral));
      }
    } else {
      const auto p = InversePower::of(det, area_ratio);
      power = static_cast<Real>(p.value), integral = static_cast<Real>(p.integral);
    }
  }
};

/// The law as the registry has it.
inline ShellLaw neo_hooke() {
  return isotropic_sheet<NeoHooke>(
      {.name = "neo_hooke",
       .title = "Elastic cortex: neo-Hookean membrane on constant-strain triangles",
       .equation = "W = ½ G [tr C − 2 + (det C^(−α) − 1)/α], G = E h / (2 (1 + ν)), α = ν/(1 − ν); ν = ½: ½ G (tr C + 1/det C − 3)",
       .source = "Blatz & Ko 1962, doi:10.1122/1.548937, in plane stress; Holzapfel 2000, Nonlinear Solid Mechanics, §6.5",
       .parameters = {}},
      {.word = "neo_hooke", .doc = "triangles of constant strain, Poisson ratio 0 to 1/2"});
}

}  // namespace morula::dcm
