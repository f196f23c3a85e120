#pragma once
#include "core/vec3.h"

namespace morula {

/// Unit eigenvector of the largest eigenvalue of a positive matrix: M² over its trace, again and again, becomes u uᵀ.
inline Vec3d largest_eigenvector(SymMat3<double> m) {
  for (int k = 0; k < 40; ++k) {
    const Vec3d x = m * Vec3d{m.xx, m.xy, m.xz}, y = m * Vec3d{m.xy, m.yy, m.yz}, z = m * Vec3d{m.xz, m.yz, m.zz};
    const double trace = x.x + y.y + z.z;
    m = {x.x / trace, x.y / trace, x.z / trace, y.y / trace, y.z / trace, z.z / trace};
  }
  if (m.xx >= m.yy && m.xx >= m.zz) return normalized(Vec3d{m.xx, m.xy, m.xz});
  return m.yy >= m.zz ? normalized(Vec3d{m.xy, m.yy, m.yz}) : normalized(Vec3d{m.xz, m.yz, m.zz});
}

}  // namespace morula
