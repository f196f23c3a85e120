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

/// The three axes of a positive matrix, of length 1, by decreasing eigenvalue.
struct PrincipalAxes {
  Vec3d axis[3];
  double moment[3];

  explicit PrincipalAxes(SymMat3<double> m) {
    const SymMat3<double> whole = m;
    for (int k = 0; k < 2; ++k) {
      axis[k] = largest_eigenvector(m);
      moment[k] = dot(axis[k], m * axis[k]);
      m += -moment[k] * outer(1.0, axis[k]);
    }
    axis[2] = cross(axis[0], axis[1]);
    moment[2] = dot(axis[2], whole * axis[2]);
  }
};

}  // namespace morula
