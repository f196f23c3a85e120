#pragma once
#include <cmath>

#include "core/contact/contact_body.h"
#include "core/vec3.h"

namespace morula {

inline constexpr double kFloatRounding = 1.0 / (1 << 24);  ///< relative, of a number kept as float

inline Vec3d to_double(const Vec3f& v) { return {v.x, v.y, v.z}; }

/// How far the surface of a sphere has moved since it had this radius, at most.
inline double growth(const ContactBody& body, float last_radius) {
  return body.radius == 0.0 ? 0.0 : std::abs(body.radius - static_cast<double>(last_radius)) + kFloatRounding * body.radius;
}

}  // namespace morula
