#pragma once
#include "fields/field_spec.h"

namespace morula::fields {

/// What one cell takes at concentration c [amol/s]: V_max c/(K_m + c) (Michaelis & Menten 1913; physics: fields_and_coupling.md, A).
/// Below 0, where a concentration only comes by the error of the time integration, the tangent V_max c/K_m goes on: the cell then
/// gives back, the amounts stay balanced, and the concentration is drawn back to 0.
inline double uptake(const UptakeSpec& spec, double c) {
  return c >= 0.0 ? spec.rate * c / (spec.half_saturation + c) : spec.rate * c / spec.half_saturation;
}
/// d uptake / dc [µm³/s]; never negative.
inline double uptake_slope(const UptakeSpec& spec, double c) {
  const double k = spec.half_saturation;
  return c >= 0.0 ? spec.rate * k / ((k + c) * (k + c)) : spec.rate / k;
}

}  // namespace morula::fields
