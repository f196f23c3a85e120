#pragma once
#include "dcm/isotropic_sheet.h"

namespace morula::dcm {

/// Skalak's membrane, per reference area: W = ¼ G (I1² + 2 I1 − 2 I2 + C I2²), I1 = tr C − 2, I2 = det C − 1.
///
/// Shear modulus G and resistance to change of area C apart from each other, hardening with strain. Linear moduli: area G (1 + 2C),
/// Poisson ratio C/(1 + C), Young 2G (1 + 2C)/(1 + C); a sheet of Poisson ratio ν has C = ν/(1 − ν). Source: Skalak et al. 1973,
/// doi:10.1016/S0006-3495(73)85983-1; Barthès-Biesel et al. 2002, doi:10.1017/S0022112002008352.
///
/// G [nN/µm].
template <class Real>
struct Skalak {
  Real shear;       // G
  Real area_ratio;  // C

  MembraneStress<Real> stress(Real trace, Real det) const noexcept {
    const Real i1 = trace - Real(2.0), i2 = det - Real(1.0);
    return {Real(0.25) * shear * (i1 * i1 + Real(2.0) * (i1 - i2) + area_ratio * i2 * i2), Real(0.5) * shear * (i1 + Real(1.0)),
            Real(0.5) * shear * (area_ratio * i2 - Real(1.0))};
  }
  /// ∂²W/∂C² is ½ G [dC:dC + C dD² + κ ((tr dC)² − dC:dC)], κ = C (D − 1); positive semi-definite for |κ| ≤ 1, at which κ is cut.
  MembraneModuli<Real> moduli(Real /*trace*/, Real det) const noexcept {
    const Real half = Real(0.5) * shear;
    const Real kappa = max(Real(-1.0), min(Real(1.0), area_ratio * (det - Real(1.0))));
    return {half, Real(0.0), half * area_ratio, half * (kappa - Real(1.0))};
  }
};

inline std::vector<KeySpec> skalak_keys() {
  return {{.name = "shear_modulus",
           .doc = "Shear modulus G of `elastic: skalak`; `auto`: E h/(2 (1 + poisson)).",
           .quantity = Quantity::kTension,
           .fallback = "auto",
           .low = 0.0,
           .high = 1e4,
           .low_open = true,
           .specials = {{"auto", kAuto}},
           .example = "5.5 uN/m",
           .source = "thin sheet of an isotropic solid"},
          {.name = "area_ratio",
           .doc = "Resistance to change of area C of `elastic: skalak`; `auto`: poisson/(1 - poisson).",
           .fallback = "auto",
           .low = 0.0,
           .high = 1e6,
           .specials = {{"auto", kAuto}},
           .example = "50",
           .source = "Skalak et al. 1973, doi:10.1016/S0006-3495(73)85983-1"}};
}

/// The law as the registry has it.
inline ShellLaw skalak() {
  return isotropic_sheet<Skalak>(
      {.name = "skalak",
       .title = "Elastic cortex: Skalak's membrane on constant-strain triangles",
       .equation = "W = ¼ G (I1² + 2 I1 − 2 I2 + C I2²), I1 = tr C − 2, I2 = det C − 1, G = E h / (2 (1 + ν)), C = ν/(1 − ν)",
       .source = "Skalak et al. 1973, doi:10.1016/S0006-3495(73)85983-1",
       .parameters = {}},
      {.word = "skalak", .doc = "triangles of constant strain, shear and change of area apart", .keys = skalak_keys()},
      "Resistance to change of area C; ν/(1 − ν) of a sheet of Poisson ratio ν.");
}

}  // namespace morula::dcm
