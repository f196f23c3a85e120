#pragma once
#include <dcm/isotropic_sheet.h>

/// A membrane law: shear and change of area apart, as of a lipid bilayer with its skeleton, per reference area
///   W = ½ G (tr C/√(det C) − 2) + ½ K (√(det C) − 1)².
///
/// tr C/√(det C) = λ1/λ2 + λ2/λ1 does not see a change of area, √(det C) nothing else. Linear moduli: shear G, area K = G (1 + 2α). Source: Evans &
/// Skalak 1980, Mechanics and Thermodynamics of Biomembranes, CRC Press, ch. 4.
template <class Real>
struct EvansSkalak {
  Real shear;       // G [nN/µm]
  Real area_ratio;  // α

  /// W and its slopes to tr C and det C.
  morula::dcm::MembraneStress<Real> stress(Real trace, Real det) const noexcept {
    using morula::sqrt;
    const Real ratio = sqrt(det), half = Real(0.5) * shear, area = shear * (Real(1.0) + Real(2.0) * area_ratio);
    const Real stretched = ratio - Real(1.0);
    return {half * (trace / ratio - Real(2.0)) + Real(0.5) * area * stretched * stretched, half / ratio,
            Real(0.5) * (area * stretched - half * trace / det) / ratio};
  }
  /// A positive semi-definite part of the second differential of W: that of the shear at equal stretches, ½ G (dC:dC − ½ (tr dC)²)/det C, and that of
  /// the area for itself.
  morula::dcm::MembraneModuli<Real> moduli(Real /*trace*/, Real det) const noexcept {
    using morula::sqrt;
    const Real half = Real(0.5) * shear / det, area = shear * (Real(1.0) + Real(2.0) * area_ratio);
    return {Real(0.5) * half, Real(0.0), Real(0.25) * area / (det * sqrt(det)), -half};
  }
};

/// The law as a study may name it: `elastic: evans_skalak`, with the keys that every elastic layer has.
inline morula::dcm::ShellLaw evans_skalak() {
  return morula::dcm::isotropic_sheet<EvansSkalak>(
      {.name = "evans_skalak",
       .title = "Elastic cortex: shear and change of area apart",
       .equation = "W = ½ G (tr C/√(det C) − 2) + ½ K (√(det C) − 1)², K = G (1 + 2α), G = E h/(2 (1 + ν)), α = ν/(1 − ν)",
       .source = "Evans & Skalak 1980, Mechanics and Thermodynamics of Biomembranes, CRC Press, ch. 4",
       .parameters = {}},
      {.word = "evans_skalak", .doc = "triangles of constant strain, shear and change of area apart"});
}
