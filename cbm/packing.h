#pragma once
#include <span>
#include <vector>

#include "core/law_info.h"
#include "core/result.h"

namespace morula::cbm {

/// A point of a packing curve.
struct PackingKnot {
  double packing = 0.0;   ///< φ
  double pressure = 0.0;  ///< p [kPa]
};

/// Pressure of a sphere by how tightly it is packed, p(φ) with φ_i = Σ_j v_cap,ij/V_i: what the contacts of a cell do to each other because
/// the cell keeps its volume, and pairs alone know nothing of (cbm.md §3). The energy of a sphere is V_i Ψ(φ_i), Ψ′ = p.
///
/// Monotone cubic Hermite through the knots (Fritsch & Carlson 1980, doi:10.1137/0717021), slope ≥ 0; 0 below the first knot, where the slope
/// may begin with a step (the energy stays C¹); beyond the last knot, the end of the calibrated range, a straight line with the last slope.
class PackingCurve {
 public:
  /// No pressure at any packing.
  PackingCurve() = default;
  /// Errors (kInput): fewer than three knots; φ not positive and increasing; a first pressure other than 0, or pressures that fall.
  static Result<PackingCurve> through(std::span<const PackingKnot> knots);

  [[nodiscard]] bool empty() const { return knots_.empty(); }
  [[nodiscard]] std::span<const PackingKnot> knots() const { return knots_; }
  /// φ_on: no pressure up to here.
  [[nodiscard]] double onset() const { return empty() ? 0.0 : knots_.front().packing; }
  /// φ_max: end of the calibrated range.
  [[nodiscard]] double last() const { return empty() ? 0.0 : knots_.back().packing; }

  struct Value {
    double energy = 0.0;    ///< Ψ [kPa]
    double pressure = 0.0;  ///< p = Ψ′ [kPa]
    double slope = 0.0;     ///< Ψ″ [kPa]
  };
  [[nodiscard]] Value at(double packing) const noexcept;
  /// Largest Ψ″ of any knot or the middle between two [kPa].
  [[nodiscard]] double steepest() const noexcept;

 private:
  std::vector<PackingKnot> knots_;
  std::vector<double> slope_;   ///< dp/dφ at the knots
  std::vector<double> energy_;  ///< Ψ at the knots
};

/// Knots for spheres that fill space like bags of fluid: p_c with which the pressure of a face-centred cubic packing of equal Hertz spheres
/// (E, ν) becomes p_t = K_V ln(V0/V), p_c = (p_t − p_H)/(2√2π(R²/d² − ¼)); φ = 3s²(3 − s), s = 1 − d/2R, V/V0 = ((1 − s)/(1 − s_c))³,
/// p_H = (4√2/3) E* s^{3/2}/(1 − s)² (cbm.md §3). Knots: the onset and s = 0.10, 0.11, 0.12, 0.14, 0.16, 0.20, 0.25, as far as the pressure
/// rises. Errors (kInput): K_V so small that the spheres alone are as stiff.
Result<std::vector<PackingKnot>> ideal_filled_cell(double bulk_modulus, double young, double poisson);

/// s_c = 1 − ½(4√2π/3)^{1/3}: equal spheres whose face-centred cubic cells have the spheres' volume.
inline constexpr double kConfluentCubic = 0.09530010471822248;

/// What there is to say about the law.
LawInfo packing_law();

}  // namespace morula::cbm
