#pragma once
#include <algorithm>
#include <cmath>

#include "coupling/behaviours/migration_law.h"

namespace morula {

/// A step of du = −(u − w) dt/P + σ√(2/P) dB per component, which begins at u: its end, and the mean of u over it, which are drawn together:
///   u ← w + ρ(u − w) + σ√(1 − ρ²) ξ,  ū = w + [q(u − w) + σ(α ξ + β ξ')]/a,  a = dt/P, ρ = e^(−a), q = 1 − ρ,
///   α = q√(q/(2 − q)), α² + β² = 2a − 2q − q²
/// (the covariances of an Ornstein–Uhlenbeck process and its integral: Gillespie 1996, doi:10.1103/PhysRevE.54.2084). Exact for steps of any length.
inline Walk walk_about(const Vec3d& w, double sigma, double persistence, const MigratingCell& cell) {
  const double a = cell.dt / persistence, kept = std::exp(-a), q = -std::expm1(-a);
  const Vec3d away = cell.velocity - w, xi = cell.normal();
  const double alpha = q * std::sqrt(q / (2.0 - q)), beta = std::sqrt(std::max(0.0, 2.0 * (a - q) - q * q - alpha * alpha));
  return {w + kept * away + sigma * std::sqrt(-std::expm1(-2.0 * a)) * xi,
          w + (q * away + sigma * (alpha * xi + beta * cell.other_normal())) * (1.0 / a)};
}

}  // namespace morula
