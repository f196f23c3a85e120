#pragma once
#include "core/vec3.h"

namespace morula {

/// What a force f has of the virial at a place x: the symmetric part of x ⊗ f.
inline SymMat3<double> virial_of(const Vec3d& x, const Vec3d& f) {
  return {x.x * f.x, 0.5 * (x.x * f.y + x.y * f.x), 0.5 * (x.x * f.z + x.z * f.x), x.y * f.y, 0.5 * (x.y * f.z + x.z * f.y), x.z * f.z};
}

}  // namespace morula
