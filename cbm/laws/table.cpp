#include "cbm/laws/table.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "cbm/monotone_cubic.h"
#include "core/numbers/number_text.h"

namespace morula::cbm {
namespace {

Error refused(std::string what, std::string help) { return Error{ErrorKind::kInput, std::move(what), std::move(help)}; }

Status check(std::span<const PairTableKnot> knots, double touch) {
  const auto number = [](double x) { return number_text("%.6g", x); };
  if (knots.size() < 3)
    return refused("a table of a law needs three knots at least, and has " + std::to_string(knots.size()), "more of them");
  for (std::size_t k = 0; k < knots.size(); ++k) {
    const PairTableKnot& knot = knots[k];
    const std::string name = "knot " + std::to_string(k + 1) + " of the table";
    if (!std::isfinite(knot.overlap) || !std::isfinite(knot.force) || !std::isfinite(knot.area) || knot.area < 0.0)
      return refused(name + " has overlap " + number(knot.overlap) + ", force " + number(knot.force) + " and area " + number(knot.area),
                     "finite numbers, and no negative area");
    if (k == 0) continue;
    if (!(knot.overlap > knots[k - 1].overlap)) return refused("the overlap of " + name + " is not above that before", "sort the knots");
    if (!(knot.force > knots[k - 1].force))
      return refused("the force of " + name + ", " + number(knot.force) + " nN/um, is not above that before",
                     "a force that falls with the overlap would let pairs collapse");
    if (knot.area < knots[k - 1].area) return refused("the area of " + name + " is below that before", "areas grow with the overlap");
  }
  if (knots.front().force > 0.0 || knots.back().force <= 0.0)
    return refused("the forces of the table go from " + number(knots.front().force) + " to " + number(knots.back().force) + " nN/um",
                   "begin where a pair breaks, with a tension or 0, and end where it is pressed");
  if (!(touch >= knots.front().overlap) || !std::isfinite(touch))
    return refused("pairs become attached at " + number(touch) + " and break at " + number(knots.front().overlap) + " R*",
                   "a touch at the break or above");
  return {};
}

/// A segment of a cubic Hermite curve of width h: y + m x + c x² + e x³.
struct Cubic {
  double y, m, c, e;
  static Cubic between(double h, double y, double m, double next_y, double next_m) noexcept {
    const double rise = (next_y - y) / h;
    return {y, m, (3.0 * rise - 2.0 * m - next_m) / h, (m + next_m - 2.0 * rise) / (h * h)};
  }
  [[nodiscard]] double value(double x) const noexcept { return y + x * (m + x * (c + x * e)); }
  [[nodiscard]] double slope(double x) const noexcept { return m + x * (2.0 * c + x * 3.0 * e); }
  [[nodiscard]] double integral(double x) const noexcept { return x * (y + x * (m / 2.0 + x * (c / 3.0 + x * e / 4.0))); }
};

}  // namespace

Result<PairTable> PairTable::through(std::span<const PairTableKnot> knots, double touch) {
  MORULA_TRY(check(knots, touch));
  PairTable out;
  out.knots_.assign(knots.begin(), knots.end());
  out.touch_ = touch;
  std::vector<double> x, force, area;
  for (const PairTableKnot& knot : knots) x.push_back(knot.overlap), force.push_back(knot.force), area.push_back(knot.area);
  out.slope_ = monotone_slopes(x, force);
  out.area_slope_ = monotone_slopes(x, area);
  // The straight line beyond must push more and more: half the slope of the last segment at least, which keeps that segment monotone.
  const std::size_t n = knots.size();
  out.slope_[n - 1] = std::max(out.slope_[n - 1], 0.5 * (force[n - 1] - force[n - 2]) / (x[n - 1] - x[n - 2]));
  out.energy_.assign(1, 0.0);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    const double h = x[k + 1] - x[k];
    out.energy_.push_back(out.energy_[k] + Cubic::between(h, force[k], out.slope_[k], force[k + 1], out.slope_[k + 1]).integral(h));
  }
  double low = x.front(), high = x.back();  // f(low) <= 0 < f(high)
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    (out.at(middle).force > 0.0 ? high : low) = middle;
  }
  out.rest_ = low, out.rest_energy_ = out.at(low).energy;
  return out;
}

PairTable::Scaled PairTable::at(double ratio) const noexcept {
  const auto above =
      std::upper_bound(knots_.begin() + 1, knots_.end(), ratio, [](double x, const PairTableKnot& knot) { return x < knot.overlap; });
  const auto k = static_cast<std::size_t>(above - knots_.begin()) - 1;
  const PairTableKnot& knot = knots_[k];
  const double from = ratio - knot.overlap;
  if (above == knots_.end())
    return {knot.force + slope_[k] * from, slope_[k], knot.area + area_slope_[k] * from,
            energy_[k] + from * (knot.force + 0.5 * slope_[k] * from)};
  const double h = above->overlap - knot.overlap;
  const Cubic force = Cubic::between(h, knot.force, slope_[k], above->force, slope_[k + 1]);
  const Cubic area = Cubic::between(h, knot.area, area_slope_[k], above->area, area_slope_[k + 1]);
  return {force.value(from), force.slope(from), area.value(from), energy_[k] + force.integral(from)};
}

ContactResponse<double> PairTable::respond(double reduced_radius, double overlap, bool attached) const noexcept {
  const double ratio = overlap / reduced_radius;
  if (ratio < (attached && adheres() ? break_overlap() : rest_)) return {};
  const Scaled found = at(ratio);
  const double square = reduced_radius * reduced_radius, area = square * std::max(0.0, found.area);
  return {.force = reduced_radius * found.force,
          .stiffness = std::max(0.0, found.slope),
          .contact_radius = std::sqrt(area / std::numbers::pi),
          .area = area,
          .energy = square * (attached && adheres() ? found.energy : found.energy - rest_energy_)};
}

bool PairTable::attached_next(double reduced_radius, double overlap, bool attached) const noexcept {
  return adheres() && overlap >= (attached ? break_overlap() : touch_) * reduced_radius;
}

}  // namespace morula::cbm
