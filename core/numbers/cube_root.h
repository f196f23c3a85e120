#pragma once
#include <bit>
#include <cstdint>

namespace morula {

/// The cube root of a positive normal number, to 3 units in the last place; the same bits on every platform (libm's is not).
///
/// Start by dividing the exponent by three in the bit pattern (relative error below 4 %), then Halley's iteration, which cubes the
/// error: y ← y (y³ + 2a)/(2y³ + a), three times.
constexpr double cube_root(double a) noexcept {
  constexpr std::uint64_t kExponentShift = 0x2A9F7893782DA1CEull;  // 2/3 of the exponent bias, moved to even out the error
  double y = std::bit_cast<double>(std::bit_cast<std::uint64_t>(a) / 3 + kExponentShift);
  for (int i = 0; i < 3; ++i) {
    const double cube = y * y * y;
    y *= (cube + 2.0 * a) / (2.0 * cube + a);
  }
  return y;
}

}  // namespace morula
