#include "coupling/behaviours/osmosis.h"

#include <algorithm>
#include <cmath>

#include "coupling/beside_nucleus.h"

namespace morula {
namespace {

/// dV/dt of a cell whose area was `cell.area` at the volume `start`.
struct Flux {
  const OsmoticCell& cell;
  double start;

  [[nodiscard]] double operator()(double volume) const {
    const double area = cell.area * std::cbrt(volume / start) * std::cbrt(volume / start);
    const double osmotic = kGasEnergy * (cell.osmolytes / (volume - cell.inactive) - cell.outside);
    return cell.permeability * area * (osmotic - cell.pressure);
  }
};

/// The root V > V_b of V − known − step · flux(V), which rises with V: the flux falls with it. Newton, kept between bounds.
double solve_stage(const Flux& flux, double known, double step, double guess) {
  const double least = flux.cell.inactive;
  double low = least, high = std::numeric_limits<double>::infinity(), volume = guess;
  for (int k = 0; k < 60; ++k) {
    const double value = volume - known - step * flux(volume);
    (value > 0.0 ? high : low) = volume;
    const double nudge = 1e-7 * (volume - least);
    const double slope = 1.0 - step * (flux(volume + nudge) - flux(volume)) / nudge;
    double next = volume - value / slope;
    if (!(next > low && next < high)) next = std::isfinite(high) ? 0.5 * (low + high) : 2.0 * volume - least;
    const bool done = std::abs(next - volume) <= 1e-14 * volume;
    volume = next;
    if (done) break;
  }
  return volume;
}

}  // namespace

double osmotic_volume(const OsmoticCell& cell) { return cell.inactive + cell.osmolytes / (cell.outside + cell.pressure / kGasEnergy); }

double osmotic_time(const OsmoticCell& cell, double volume) {
  const double water = volume - cell.inactive;
  return water * water / (cell.permeability * cell.area * kGasEnergy * cell.osmolytes);
}

double volume_after_flux(const OsmoticCell& cell, double volume, double dt) {
  constexpr double kGamma = 1.0 - 0.70710678118654752440;  // 1 − 1/√2
  constexpr double kStep = 0.008;                          // of the relaxation time, longer the nearer to rest
  if (!(cell.permeability > 0.0) || !(dt > 0.0)) return volume;
  const Flux flux{cell, volume};
  const double rest = osmotic_volume(cell);
  for (double left = dt; left > 0.0;) {
    const double distance = std::abs(volume - rest) / volume;
    if (distance <= 1e-14) break;
    const double step = std::min(left, kStep / std::sqrt(distance) * osmotic_time(cell, volume));
    const double first = solve_stage(flux, volume, kGamma * step, volume);
    const double next = solve_stage(flux, volume + (1.0 - kGamma) / kGamma * (first - volume), kGamma * step, first);
    volume = (next - rest) * (volume - rest) < 0.0 ? rest : next;  // the flow never crosses its rest
    left -= step;
  }
  return volume;
}

OsmoticCell osmotic_cell(const CellState& row, const CellType& type, double time, double area, double pressure) {
  const Osmosis& law = type.osmosis;
  OsmoticCell cell;
  cell.permeability = law.permeability;
  cell.inactive = law.inactive * row.target_volume;
  cell.osmolytes = law.inside * (row.target_volume - cell.inactive);
  cell.outside = law.outside * law.course.at(time);
  if (law.field >= 0) cell.outside += row.variable(concentration_of(static_cast<std::size_t>(law.field)));
  cell.pressure = pressure;
  cell.area = area;
  return cell;
}

void exchange_water(CellState& row, const CellType& type, double time, double dt, double volume, double area, double pressure) {
  const OsmoticCell cell = osmotic_cell(row, type, time, area, pressure);
  const double start = std::max(volume, cell.inactive + 1e-3 * (row.target_volume - cell.inactive));  // squeezed below V_b: water comes in
  const double end = volume_after_flux(cell, start, dt);
  const auto with_body = [&](double v) {
    return row.body == BodyKind::kShell ? volume_beside_resting_nucleus(type, v, row.target_volume) : v;
  };
  const double before = with_body(volume), after = with_body(end);
  row.reference_excess += std::log(before > 0.0 && after > 0.0 ? after / before : end / volume);
}

}  // namespace morula
