#include "study/initial/biconcave.h"

namespace morula::scenarios {

std::shared_ptr<const ReferenceShape> biconcave_shape(const ReferenceShape& icosphere) {
  std::vector<Vec3d> position;
  position.reserve(icosphere.position.size());
  for (const Vec3d& p : icosphere.position) {
    const Vec3d n = normalized(p);  // √(1 − q) = |n_z|
    const double q = n.x * n.x + n.y * n.y;
    position.push_back({n.x, n.y, 0.5 * n.z * (0.207161 + 2.002558 * q - 1.122762 * q * q)});
  }
  return make_reference_shape(icosphere.topology, std::move(position));
}

}  // namespace morula::scenarios
