#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cbm/spheres.h"

namespace morula::cbm {

/// JKR holds where a contact is small against the sphere: a/R ≲ 0.4 (cbm.md §2; small strains, Johnson 1985, ch. 5), known to one digit: contacts
/// count as beyond from 0.45.
inline constexpr double kJkrAsked = 0.4, kJkrRange = 0.45;

/// Two spheres at rest on each other.
struct RestingContact {
  double radius_ratio = 0.0;   ///< a_0/R of the smaller sphere, a_0 = (9πWR*²/(2E*))^{1/3}
  double overlap_ratio = 0.0;  ///< δ_0/(R_1 + R_2), δ_0 = a_0²/(3R*)
  double covered = 0.0;        ///< 12 π a_0²/(4π R²): part of the smaller sphere's surface in a close packing of such contacts
};

/// radius [µm], adhesion W [nN/µm].
inline RestingContact resting_contact(const SphereParameters& a, double radius_a, const SphereParameters& b, double radius_b,
                                      double adhesion) {
  const double radius = radius_a * radius_b / (radius_a + radius_b), smaller = std::min(radius_a, radius_b);
  const double modulus = 1.0 / ((1.0 - a.poisson * a.poisson) / a.young + (1.0 - b.poisson * b.poisson) / b.young);
  const double contact = std::cbrt(4.5 * std::numbers::pi * adhesion * radius * radius / modulus);
  return {contact / smaller, contact * contact / (3.0 * radius) / (radius_a + radius_b), 3.0 * contact * contact / (smaller * smaller)};
}

/// Whether a contact of this area [µm²] is larger than the law allows for on a sphere of this radius [µm].
inline bool is_beyond_range(double area, double radius) { return area > std::numbers::pi * kJkrRange * kJkrRange * radius * radius; }

/// Whether a contact of this overlap and area is outside of what its law is for: what the law was fitted to, or else contacts small against the
/// smaller sphere, of this radius [µm].
inline bool is_outside_law(const PairContact& contact, double overlap, double area, double smaller_radius) {
  if (!contact.fitted.has_ends()) return is_beyond_range(area, smaller_radius);
  return overlap < contact.fitted.least * smaller_radius || overlap > contact.fitted.most * smaller_radius;
}

}  // namespace morula::cbm
