#pragma once
#include <bit>
#include <cstdint>

namespace morula {

/// Where cube_root() starts: the exponent divided by three in the bit pattern, relative error below 4 %.
constexpr double cube_root_start(double a) noexcept {
  constexpr std::uint64_t kExponentShift = 0x2A9F7893782DA1CEull;  // 2/3 of the exponent bias, moved to even out the error
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(a) / 3 + kExponentShift);
}

/// Halley's iteration, which cubes the error: y ← y (y³ + 2a)/(2y³ + a), three times. Real: double or a lane.
template <class Real>
constexpr Real cube_root_refined(Real a, Real y) noexcept {
  for (int i = 0; i < 3; ++i) {
    const Real cube = y * y * y;
    y *= (cube + Real(2.0) * a) / (Real(2.0) * cube + a);
  }
  return y;
}

/// The cube root of a positive normal number, to 3 units in the last place; the same bits on every platform (libm's is not).
constexpr double cube_root(double a) noexcept { return cube_root_refined(a, cube_root_start(a)); }

}  // namespace morula
