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

/// How far an overlap over a radius is from the middle of a range, as a part of the way to the end on its side: 1 at both ends. The middle is 0 where
/// 0 lies within the range. An end that is infinite is never reached.
inline double part_of_way_to_end(const OverlapRange& range, double overlap) {
  const bool has_both = std::isfinite(range.least) && std::isfinite(range.most);
  const double middle = has_both && (range.least >= 0.0 || range.most <= 0.0) ? 0.5 * (range.least + range.most) : 0.0;
  const double way = (overlap >= middle ? range.most : range.least) - middle;
  return std::isfinite(way) && way != 0.0 ? std::max(0.0, (overlap - middle) / way) : 0.0;
}

/// How far a contact of this overlap [µm] and area [µm²] is within what its law is for: 1 at the end of the range, above outside (decision 0050).
///
/// A law that was fitted: its overlap over that at the end of the overlaps of the fit. Any other: its area over π (0.45 R)², R the radius of the
/// smaller sphere [µm]; the area of small contacts grows like the overlap.
inline double part_of_range(const PairContact& contact, double overlap, double area, double smaller_radius) {
  if (contact.fitted.has_ends()) return part_of_way_to_end(contact.fitted, overlap / smaller_radius);
  return area / (std::numbers::pi * kJkrRange * kJkrRange * smaller_radius * smaller_radius);
}

/// Whether such a contact is outside of what its law is for.
inline bool is_outside_law(const PairContact& contact, double overlap, double area, double smaller_radius) {
  return part_of_range(contact, overlap, area, smaller_radius) > 1.0;
}

}  // namespace morula::cbm
