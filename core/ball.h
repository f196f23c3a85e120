#pragma once
#include <cmath>
#include <numbers>

namespace morula {

/// Volume of a ball [µm³ of µm].
constexpr double ball_volume(double radius) { return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; }

/// Surface of a ball [µm² of µm].
constexpr double ball_surface(double radius) { return 4.0 * std::numbers::pi * radius * radius; }

/// Radius of the ball of a volume [µm of µm³].
inline double ball_radius(double volume) { return std::cbrt(3.0 * volume / (4.0 * std::numbers::pi)); }

}  // namespace morula
