#pragma once
#include <numbers>

#include "cbm/laws/pair_law.h"

namespace morula::cbm {

/// Hertz contact: F = (4/3) E* √R* δ^(3/2), a = √(R*δ), dF/dδ = 2 E* a, U = (8/15) E* √R* δ^(5/2) for overlap δ > 0, else nothing.
///
/// Hertz 1882, doi:10.1515/crll.1882.92.156. Good for a/R ≲ 0.3. overlap [µm].
template <class Real>
ContactResponse<Real> hertz_contact(const PairLaw<Real>& law, Real overlap) noexcept {
  const Real pressed = max(overlap, Real(0.0));
  const Real square = law.reduced_radius * pressed;
  const Real contact_radius = sqrt(square);
  const Real stiffness = Real(2.0) * law.modulus * contact_radius;
  const Real force = Real(2.0 / 3.0) * stiffness * pressed;
  return {force, stiffness, contact_radius, Real(std::numbers::pi) * square, Real(0.4) * force * pressed};
}

}  // namespace morula::cbm
