#pragma once
#include <array>

#include "core/simd/lane.h"

namespace morula::dcm {

/// Strain of a constant-strain triangle, from the squared lengths q_c of its edges (edge c is opposite to corner c) and those of its
/// stress-free state, which are its reference metric.
///
/// An isotropic membrane needs two invariants of C = FᵀF only: I = tr C and D = det C = (A/A0)². Both are functions of the six squared
/// lengths: I = Σ w_c q_c with w_c = cot α0_c/(2 A0), and D = P(q)/P(q0) with Heron's P(q) = 16 A² = 2(q0 q1 + q1 q2 + q2 q0) − Σ q².
/// No local frame is needed, the result does not feel rigid motion, and nodal forces are three forces along the edges; they equal
/// −A0 F S b_a with S = 2 ∂W/∂C and shape gradients b_a (dcm.md §2b).
///
/// Lengths [µm]; I and D are numbers, their slopes [1/µm²].
template <class Real>
struct MembraneStrain {
  using Three = std::array<Real, 3>;
  Real reference_area;  ///< A0
  Real twist;           ///< 1/(8 A0²): ∂²D/∂q_c∂q_d is −twist for c = d and +twist else
  Three trace_slope;    ///< ∂I/∂q_c = w_c
  Three det_slope;      ///< ∂D/∂q_c = (q_a + q_b − q_c) twist
  Real trace, det;      ///< I, D; both at rest: 2, 1

  static MembraneStrain of(const Three& rest, const Three& now) noexcept {
    const Three opposite{rest[1] + rest[2] - rest[0], rest[2] + rest[0] - rest[1], rest[0] + rest[1] - rest[2]};
    // P = Σ q_c (q_a + q_b − q_c)
    const Real sixteen_squares = opposite[0] * rest[0] + opposite[1] * rest[1] + opposite[2] * rest[2];
    MembraneStrain s;
    s.reference_area = Real(0.25) * sqrt(sixteen_squares);
    s.twist = Real(2.0) / sixteen_squares;
    s.trace = s.det = Real(0.0);
    for (int c = 0; c < 3; ++c) {
      s.trace_slope[c] = opposite[c] * s.twist;
      s.det_slope[c] = (now[(c + 1) % 3] + now[(c + 2) % 3] - now[c]) * s.twist;
      s.trace += s.trace_slope[c] * now[c];
      s.det += s.det_slope[c] * now[c];
    }
    s.det *= Real(0.5);
    return s;
  }
};

/// Energy W per reference area and its slopes ∂W/∂I and ∂W/∂D [nN/µm].
template <class Real>
struct MembraneStress {
  Real energy{}, trace{}, det{};

  MembraneStress& operator+=(const MembraneStress& b) noexcept {
    energy += b.energy, trace += b.trace, det += b.det;
    return *this;
  }
};

/// Positive semi-definite quadratic form of a change of C: tt dI² + 2 td dI dD + dd dD² + d d²D, where d²D = 2 det(dC) = (tr dC)² − dC:dC
/// [nN/µm].
template <class Real>
struct MembraneModuli {
  Real tt{}, td{}, dd{}, d{};

  MembraneModuli& operator+=(const MembraneModuli& b) noexcept {
    tt += b.tt, td += b.td, dd += b.dd, d += b.d;
    return *this;
  }
};

/// Principal stretches squared, λ² = I/2 ± √(I²/4 − D): {larger, smaller}.
template <class Real>
std::array<Real, 2> principal_squares(Real trace, Real det) noexcept {
  const Real mean = Real(0.5) * trace, root = sqrt(max(Real(0.0), mean * mean - det));
  return {mean + root, mean - root};
}

/// The tensile part S⁺ of S = 2 (∂W/∂I I + ∂W/∂D D C⁻¹), as the slopes {trace, det} that give it; compressive principal stresses are cut
/// off. The geometric stiffness of S⁺ is positive semi-definite (time_stepping.md §1).
template <class Real>
MembraneStress<Real> tensile_part(const MembraneStress<Real>& stress, Real trace, Real det) noexcept {
  const auto square = principal_squares(trace, det);
  // halves of the principal stresses: D/λ² of one direction is λ² of the other
  const Real s1 = stress.trace + stress.det * square[1], s2 = stress.trace + stress.det * square[0];
  const auto pulls1 = s1 > Real(0.0), pulls2 = s2 > Real(0.0);
  const Real apart = max(square[0] - square[1], Real(1e-6));
  // only direction 1 pulls: trace + det λ1² = 0, trace + det λ2² = s1; only direction 2: the other way round
  const Real one = -s1 / apart, other = s2 / apart, zero(0.0);
  MembraneStress<Real> out;
  out.trace = select(pulls1, select(pulls2, stress.trace, -one * square[0]), select(pulls2, -other * square[1], zero));
  out.det = select(pulls1, select(pulls2, stress.det, one), select(pulls2, other, zero));
  return out;
}

}  // namespace morula::dcm
