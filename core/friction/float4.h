#pragma once
#include "core/vec3.h"

namespace morula {

/// One unknown of the friction system: three components and a zero, 16 bytes, so that it loads as one register.
struct alignas(16) Float4 {
  float x = 0.0f, y = 0.0f, z = 0.0f, w = 0.0f;
};

inline Vec3d to_double(const Float4& v) { return {v.x, v.y, v.z}; }

/// The same as a register.
using Float4v [[gnu::vector_size(16)]] = float;

inline Float4v load(const Float4& a) {
  return *reinterpret_cast<const Float4v*>(&a);  // NOLINT: same layout and alignment; vector types may alias
}
inline void store(Float4& a, Float4v v) { *reinterpret_cast<Float4v*>(&a) = v; }

}  // namespace morula
