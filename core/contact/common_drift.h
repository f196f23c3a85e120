#pragma once
#include <span>

#include "core/vec3.h"

namespace morula {

/// The part of the motion of many points that is common to all: u(x) = A (x − c) + b. Points that follow it keep their distances, but for the strain.
struct CommonDrift {
  Vec3d center, way;    ///< c [µm], b [µm]
  Vec3d row[3];         ///< of A
  double strain = 0.0;  ///< bound on |A v|/|v| (Frobenius)

  [[nodiscard]] Vec3d at(const Vec3d& x) const {
    const Vec3d from = x - center;
    return way + Vec3d{dot(row[0], from), dot(row[1], from), dot(row[2], from)};
  }
};

/// Sums over points of their places x and ways u, of which a drift follows.
struct DriftSums {
  double count = 0.0;
  Vec3d place, way;          ///< Σ x, Σ u
  SymMat3<double> second{};  ///< Σ x ⊗ x
  Vec3d moment[3];           ///< Σ u_k x
};

/// The drift that fits the ways best (least squares); none of points that do not spread over three dimensions.
CommonDrift drift_of(const DriftSums& sums);

/// The drift that fits the ways from `before` to `now` of these points best (least squares of some of them); none of fewer than 64, or of points that do
/// not spread over three dimensions. A bound that holds for any drift may use it: it needs not be exact, and no result may depend on it.
CommonDrift common_drift(std::span<const Vec3f> before, std::span<const Vec3d> now);

}  // namespace morula
