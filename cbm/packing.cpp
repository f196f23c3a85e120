#include "cbm/packing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "cbm/monotone_cubic.h"
#include "core/numbers/number_text.h"

namespace morula::cbm {
namespace {

Error refused(const std::string& what, const std::string& help) { return Error{ErrorKind::kInput, what, help}; }

std::string number(double value) { return number_text("%.6g", value); }

}  // namespace

Result<PackingCurve> PackingCurve::through(std::span<const PackingKnot> knots) {
  const std::string help = "for example (8.3 %, 0 Pa), (8.7 %, 37 Pa), (10.5 %, 171 Pa), ...";
  if (knots.size() < 3) return refused("a packing curve needs at least three knots", help);
  if (!(knots.front().packing > 0.0)) return refused("the packing of the first knot must be above 0", help);
  if (knots.front().pressure != 0.0)
    return refused("the pressure of the first knot must be 0, for there is none below it; it is " + number(knots.front().pressure) + " kPa",
                   "begin with the packing at which the pressure sets in");
  for (std::size_t k = 1; k < knots.size(); ++k) {
    if (!(knots[k].packing > knots[k - 1].packing))
      return refused(
          "the packing of the knots must increase, but " + number(knots[k].packing) + " is not above " + number(knots[k - 1].packing),
          "sort the knots by packing");
    if (!(knots[k].pressure >= knots[k - 1].pressure) || !std::isfinite(knots[k].pressure))
      return refused("the pressure must not fall with the packing, but it goes from " + number(knots[k - 1].pressure) + " to " +
                         number(knots[k].pressure) + " kPa",
                     "a pressure that falls would let packings collapse");
  }
  PackingCurve out;
  out.knots_.assign(knots.begin(), knots.end());
  std::vector<double> packing, pressure;
  for (const PackingKnot& knot : knots) packing.push_back(knot.packing), pressure.push_back(knot.pressure);
  out.slope_ = monotone_slopes(packing, pressure);
  out.energy_.assign(1, 0.0);
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    const double h = knots[k + 1].packing - knots[k].packing;
    out.energy_.push_back(out.energy_[k] +
                          h * (0.5 * (knots[k].pressure + knots[k + 1].pressure) + h * (out.slope_[k] - out.slope_[k + 1]) / 12.0));
  }
  return out;
}

PackingCurve::Value PackingCurve::at(double packing) const noexcept {
  if (empty() || packing <= knots_.front().packing) return {};
  std::size_t k = 0;
  while (k + 1 < knots_.size() && packing > knots_[k + 1].packing) ++k;
  const double from = packing - knots_[k].packing, p = knots_[k].pressure, m = slope_[k];
  if (k + 1 == knots_.size()) return {energy_[k] + from * (p + 0.5 * m * from), p + m * from, m};
  // p + m x + c x² + e x³ on a segment of width h.
  const double h = knots_[k + 1].packing - knots_[k].packing;
  const double rise = (knots_[k + 1].pressure - p) / h, end = slope_[k + 1];
  const double c = (3.0 * rise - 2.0 * m - end) / h, e = (m + end - 2.0 * rise) / (h * h);
  return {energy_[k] + from * (p + from * (m / 2.0 + from * (c / 3.0 + from * e / 4.0))), p + from * (m + from * (c + from * e)),
          std::max(0.0, m + from * (2.0 * c + from * 3.0 * e))};
}

double PackingCurve::steepest() const noexcept {
  double most = 0.0;
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    most = std::max(most, slope_[k]);
    if (k > 0) most = std::max(most, at(0.5 * (knots_[k - 1].packing + knots_[k].packing)).slope);
  }
  return most;
}

Result<std::vector<PackingKnot>> ideal_filled_cell(double bulk_modulus, double young, double poisson) {
  const double modulus = young / (2.0 * (1.0 - poisson * poisson));
  const auto missing = [&](double s) {  // p_t − p_H
    return -3.0 * bulk_modulus * std::log((1.0 - s) / (1.0 - kConfluentCubic)) -
           4.0 * std::numbers::sqrt2 / 3.0 * modulus * s * std::sqrt(s) / ((1.0 - s) * (1.0 - s));
  };
  const auto packing = [](double s) { return 3.0 * s * s * (3.0 - s); };
  double low = kConfluentCubic, high = low;  // the onset lies where `missing` becomes positive
  while (high < 0.25 && missing(high) <= 0.0) high += 1e-3;
  std::vector<PackingKnot> out;
  if (high < 0.25) {
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (missing(middle) > 0.0 ? high : low) = middle;
    }
    out.push_back({packing(high), 0.0});
    for (const double s : {0.10, 0.11, 0.12, 0.14, 0.16, 0.20, 0.25}) {
      if (s < high + 1e-3) continue;
      const double half = 0.5 / (1.0 - s);  // R/d
      const double pressure = missing(s) / (2.0 * std::numbers::sqrt2 * std::numbers::pi * (half * half - 0.25));
      if (pressure <= out.back().pressure) break;
      out.push_back({packing(s), pressure});
    }
  }
  if (out.size() < 3)
    return refused("spheres of Young's modulus " + number(young) + " kPa are stiffer than a filled cell of bulk modulus " +
                       number(bulk_modulus) + " kPa: nothing is missing that packing could add",
                   "a larger bulk modulus, or no `packing`");
  return out;
}

LawInfo packing_law() {
  return {.name = "packing",
          .title = "Pressure of packing",
          .equation = "U = Σ_i V_i Ψ(φ_i), φ_i = Σ_j v_cap,ij/V_i, p_i = Ψ′(φ_i); pair force + πa_g² [p_i l_j/d + p_j l_i/d]",
          .source =
              "choice of this project after Van Liedekerke et al. 2019, doi:10.1371/journal.pcbi.1006273; monotone cubic of Fritsch & "
              "Carlson 1980, doi:10.1137/0717021",
          .parameters = {{.name = "packing_onset",
                          .quantity = "fraction",
                          .unit = "1",
                          .fallback = {},
                          .minimum = 0.0,
                          .source = "the study",
                          .doc = "φ up to which there is no pressure."},
                         {.name = "packing_last",
                          .quantity = "fraction",
                          .unit = "1",
                          .fallback = {},
                          .minimum = 0.0,
                          .source = "the study",
                          .doc = "φ up to which the curve is calibrated."},
                         {.name = "packing_last_pressure",
                          .quantity = "pressure",
                          .unit = "kPa",
                          .fallback = {},
                          .minimum = 0.0,
                          .source = "the study",
                          .doc = "Pressure there."}}};
}

}  // namespace morula::cbm
