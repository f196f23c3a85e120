#pragma once
#include <cstdint>

namespace morula {

/// One contact point in the friction system: a point of a source face against a point of a target face (or a sphere, or a rigid surface).
///
/// With the relative velocity u = Σ β_i v(source node i) − Σ μ_j v(target node j), the element's force on the source point is
/// −(a u + (b + Δt k) (n·u) n). a, b: friction (isotropic, extra along the normal) [nN·s/µm]; k: contact stiffness [nN/µm].
/// 48 bytes; nodes are numbered within their bodies.
struct ContactElement {
  std::uint16_t source[3];
  std::uint16_t target[3];
  float mu[2];  ///< weights of target nodes 0 and 1; the third is 1 − mu[0] − mu[1]
  float n[3];
  float a, b, k;
  std::uint16_t point;  ///< quadrature point, gives β
  std::uint16_t unused_ = 0;
};
static_assert(sizeof(ContactElement) == 48);

}  // namespace morula
