#pragma once
#include <numbers>

#include "core/simd/lane.h"

namespace morula {

/// Angle of the vector (x, y) in (−π, π], for a double or a lane of doubles; the same bits for every lane width.
///
/// The ratio is brought into [−tan π/8, tan π/8], where atan t = t + t·s·P(s) with s = t² and P of degree 10 that interpolates
/// (atan(√s)/√s − 1)/s at the Chebyshev nodes of [0, tan² π/8] (truncation below 5e-18; with rounding about 2 ulp).
/// x = y = 0 gives 0. Not a number in, not a number out.
template <class Real>
Real lane_atan2(Real y, Real x) noexcept {
  constexpr double kTanPi8 = 0.41421356237309503;
  constexpr double kTiny = 1e-300;
  const Real ax = abs(x), ay = abs(y);
  const auto steep = ay > ax;
  const Real low = select(steep, ax, ay);
  const Real high = max(select(steep, ay, ax), Real(kTiny));
  const auto turned = low > high * kTanPi8;  // rotate by −π/4
  const Real t = select(turned, low - high, low) / select(turned, low + high, high);
  const Real s = t * t, s2 = s * s, s4 = s2 * s2;
  const Real p0 = (Real(-0.3333333333333333) + s * 0.1999999999999552) + s2 * (Real(-0.14285714284666542) + s * 0.11111111015256361);
  const Real p1 = (Real(-0.09090904578123903) + s * 0.07692183190826087) + s2 * (Real(-0.06664511447381948) + s * 0.0585814891280221);
  const Real p2 = (Real(-0.0508544973794026) + s * 0.03923165829558719) + s2 * Real(-0.01917688711906226);
  Real angle = t + t * s * (p0 + s4 * (p1 + s4 * p2));
  angle = select(turned, angle + Real(std::numbers::pi / 4), angle);
  angle = select(steep, Real(std::numbers::pi / 2) - angle, angle);
  angle = select(x < Real(0.0), Real(std::numbers::pi) - angle, angle);
  return select(y < Real(0.0), -angle, angle);
}

}  // namespace morula
