#pragma once
#include <cmath>
#include <numbers>

#include "core/vec3.h"

namespace morula {

/// Direction k of `count` that are spread evenly over the sphere along a golden spiral, each for the same solid angle (Swinbank & Purser 2006, doi:10.1256/qj.05.227).
inline Vec3d spiral_direction(int k, int count) {
  const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0)), z = 1.0 - (2.0 * k + 1.0) / count, r = std::sqrt(1.0 - z * z);
  return {r * std::cos(turn * k), r * std::sin(turn * k), z};
}

}  // namespace morula
