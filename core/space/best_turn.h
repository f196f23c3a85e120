#pragma once
#include <cassert>
#include <cmath>
#include <span>

#include "core/random/rotation.h"
#include "core/vec3.h"

namespace morula {

/// The turn about their means that brings places `from` nearest to places `to`, by least squares: the orthogonal polar factor of Σ to fromᵀ by Newton's
/// iteration (Higham 1986, doi:10.1137/0907079). As many of both. No turn where they do not span space, or are mirrored.
inline Rotation best_turn(std::span<const Vec3d> from, std::span<const Vec3d> to) {
  assert(from.size() == to.size());
  Vec3d middle_from, middle_to;
  for (std::size_t i = 0; i < from.size(); ++i) middle_from += from[i], middle_to += to[i];
  const double part = 1.0 / static_cast<double>(from.size());
  Rotation m{{}, {}, {}};
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vec3d a = from[i] - middle_from * part, b = to[i] - middle_to * part;
    m.x += a * b.x, m.y += a * b.y, m.z += a * b.z;
  }
  const double size = std::sqrt(norm2(m.x) + norm2(m.y) + norm2(m.z));
  if (!(dot(m.x, cross(m.y, m.z)) > 1e-9 * size * size * size)) return {};
  for (int k = 0; k < 60; ++k) {
    const double volume = dot(m.x, cross(m.y, m.z)), scale = 1.0 / std::cbrt(volume), back = 1.0 / (volume * scale);
    const Rotation inverse{cross(m.y, m.z) * back, cross(m.z, m.x) * back, cross(m.x, m.y) * back};  // transposed
    const Rotation next{(m.x * scale + inverse.x) * 0.5, (m.y * scale + inverse.y) * 0.5, (m.z * scale + inverse.z) * 0.5};
    const double change = norm2(next.x - m.x) + norm2(next.y - m.y) + norm2(next.z - m.z);
    m = next;
    if (change < 1e-30) break;
  }
  return m;
}

}  // namespace morula
