#pragma once
#include <array>
#include <span>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/vec3.h"

namespace morula {

/// ∂x̄/∂x_i of a node i: row k is the gradient of coordinate k of the centre of volume.
using CentroidGradient = std::array<Vec3d, 3>;

/// Wᵀ f of a matrix W given by its rows: what a node bears of a force f on the centre of volume.
template <class Real>
Vec3<Real> transposed_product(const std::array<Vec3<Real>, 3>& rows, const Vec3<Real>& f) {
  return rows[0] * f.x + rows[1] * f.y + rows[2] * f.z;
}

/// Derivatives of volume_centroid() by node. They sum up to the unit matrix, and act along the normals of the surface alone: nodes that move along it
/// leave the centre of volume where it is.
///
/// x̄ = Σ_f V_f c_f / V over the tetrahedra of the faces with a common apex, c_f their centroids; with the apex in x̄
/// ∂x̄/∂x_i = (1/V) Σ_{f∋i} ((c_f − x̄) ⊗ ∂V_f/∂x_i + V_f/4 I). Precondition: a closed surface that encloses a volume.
std::vector<CentroidGradient> volume_centroid_gradient(std::span<const Triangle> faces, std::span<const Vec3d> position);

}  // namespace morula
