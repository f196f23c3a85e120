#pragma once
#include <cassert>
#include <numbers>

#include "cbm/laws/hertz.h"
#include "cbm/laws/pair_law.h"

namespace morula::cbm {

/// Adhesive contact of two elastic bodies (Johnson, Kendall & Roberts 1971, doi:10.1098/rspa.1971.0141):
///   F = 4E*a³/(3R*) − √(8πWE*a³),  δ = a²/R* − √(2πWa/E*).
///
/// With δ̃ = δ/X, F̃ = F/(πWR*), Ũ = U/(πWR*X) and y = √(2a/a_s) the law is polynomial:
///   δ̃ = y⁴/4 − y,  F̃ = y⁶/6 − y³,  dF̃/dδ̃ = y²(y³ − 3)/(y³ − 1),  Ũ = y¹⁰/60 − y⁷/6 + y⁴/4 − 1/10.
/// Bodies that touch (δ = 0) jump into contact; they part when δ̃ falls below −3/4, which is y = 1, where the branch folds back. The
/// constant of Ũ makes the energy 0 there, so that energy goes on without a jump (and stays 0) when an attached pair is pulled
/// beyond the fold within a step. The pair is always on the outer branch y ≥ 1.
///
/// Whether a pair is attached is state, and fixed within a step; `update_attached` gives it for the next. An unattached pair that
/// overlaps within a step feels the Hertz force. Without adhesion (W = 0) the law is Hertz's.

/// Fold of the branch: contact breaks at δ = −0.75 X when the distance is controlled.
inline constexpr double kBreakOverlap = -0.75;
/// Overlap of the unloaded attached pair in units of X, and its contact radius in units of a_s: y³ = 6.
inline constexpr double kZeroLoadOverlap = 0.9085602964160697;
inline constexpr double kZeroLoadRadius = 1.6509636244473134;

/// y ≥ 1 of the attached branch at the dimensionless overlap δ̃; y = 1 below the fold.
///
/// Solved for e = y − 1, which is small near the fold: e²(e² + 4e + 6) = 4δ̃ + 3. A rational start (fitted, relative error below 1e-4
/// for any overlap) and two Newton steps reach machine precision; there is no loop and no branch, so that lanes work.
template <class Real>
Real jkr_branch(Real overlap_ratio) noexcept {
  // The floor keeps the division below finite; it moves the fold by 2.5e-16 in δ̃, less than the rounding of δ̃ itself.
  const Real m = max(Real(4.0) * overlap_ratio + Real(3.0), Real(1e-15));
  const Real s = sqrt(m);
  const Real top = Real(0.8164965809277261) + s * (Real(0.379323) + s * Real(0.020354));
  const Real bottom = Real(1.0) + s * (Real(0.397045) + s * Real(0.020354));
  const Real t = s * top / bottom;
  Real e = t / (Real(1.0) + sqrt(Real(1.0) + t));
  for (int i = 0; i < 2; ++i) {
    const Real residual = e * e * (e * (e + Real(4.0)) + Real(6.0)) - m;
    e -= residual / (Real(4.0) * e * (e * (e + Real(3.0)) + Real(3.0)));
  }
  return Real(1.0) + e;
}

/// The attached branch at this overlap [µm]; nothing beyond the fold. Precondition: W > 0.
template <class Real>
ContactResponse<Real> jkr_contact(const PairLaw<Real>& law, Real overlap) noexcept {
  const Real ratio = overlap * law.inverse_length;
  const Real y = jkr_branch(ratio);
  const Real y2 = y * y;
  const Real y3 = y2 * y;
  const Real y4 = y2 * y2;
  const Real contact_radius = Real(0.5) * law.radius * y2;
  const auto holds = overlap >= Real(kBreakOverlap) * law.length;  // the same comparison as update_attached
  const Real zero(0.0);
  ContactResponse<Real> out;
  out.force = select(holds, law.force * y3 * (y3 * Real(1.0 / 6.0) - Real(1.0)), zero);
  // Where the slope is negative (y³ < 3) the numerator is 0 already, so that the denominator may be kept away from 0.
  const Real slope = y2 * max(y3 - Real(3.0), zero) / max(y3 - Real(1.0), Real(1.0));
  out.stiffness = select(holds, law.force * law.inverse_length * slope, zero);
  out.contact_radius = select(holds, contact_radius, zero);
  out.area = Real(std::numbers::pi) * out.contact_radius * out.contact_radius;
  const Real energy = y4 * (y3 * (y3 * Real(1.0 / 60.0) - Real(1.0 / 6.0)) + Real(0.25)) - Real(0.1);
  out.energy = select(holds, law.force * law.length * energy, zero);
  return out;
}

/// dF/dδ of the attached branch, of either sign; −∞ at the fold [nN/µm]. Precondition: W > 0 and δ ≥ −0.75 X.
inline double jkr_slope(const PairLaw<double>& law, double overlap) noexcept {
  assert(law.length > 0.0 && overlap >= kBreakOverlap * law.length);
  const double y = jkr_branch(overlap / law.length);
  const double y3 = y * y * y;
  return law.force / law.length * y * y * (y3 - 3.0) / (y3 - 1.0);
}

[[nodiscard]] constexpr bool is_adhesive(const PairLaw<double>& law) noexcept { return law.force > 0.0; }

/// The law of a pair: the attached branch if the pair is attached and adhesive, else Hertz's. overlap [µm].
inline ContactResponse<double> contact_response(const PairLaw<double>& law, double overlap, bool attached) noexcept {
  return attached && is_adhesive(law) ? jkr_contact(law, overlap) : hertz_contact(law, overlap);
}

/// Whether the pair is attached after a step that ended at this overlap [µm]: touched at δ ≥ 0, broken at δ < −0.75 X.
[[nodiscard]] constexpr bool update_attached(double overlap, bool attached, const PairLaw<double>& law) noexcept {
  if (!is_adhesive(law)) return false;
  return overlap >= (attached ? kBreakOverlap * law.length : 0.0);
}

/// Overlap at which the pair carries no load: 0.90856 X, and 0 without adhesion [µm].
[[nodiscard]] constexpr double zero_load_overlap(const PairLaw<double>& law) noexcept { return kZeroLoadOverlap * law.length; }
/// Largest gap over which an attached pair still pulls [µm]: what a neighbour list must reach beyond R_i + R_j.
[[nodiscard]] constexpr double adhesive_reach(const PairLaw<double>& law) noexcept { return -kBreakOverlap * law.length; }
/// Largest tension 1.5 πWR*: the pull-off force when the force is controlled [nN].
[[nodiscard]] constexpr double pull_off_force(const PairLaw<double>& law) noexcept { return 1.5 * law.force; }

}  // namespace morula::cbm
