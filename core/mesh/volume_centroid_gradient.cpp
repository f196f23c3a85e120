#include "core/mesh/volume_centroid_gradient.h"

#include "core/mesh/topology.h"

namespace morula {

std::vector<CentroidGradient> volume_centroid_gradient(std::span<const Triangle> faces, std::span<const Vec3d> position) {
  std::vector<CentroidGradient> out(position.size());
  const Vec3d center = volume_centroid(faces, position);
  double volume = 0.0;
  for (const Triangle& face : faces) {
    const std::array<Vec3d, 3> corner{position[face[0]] - center, position[face[1]] - center, position[face[2]] - center};
    const double part = dot(corner[0], cross(corner[1], corner[2])) / 6.0;
    const Vec3d middle = (corner[0] + corner[1] + corner[2]) * 0.25;
    volume += part;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3d growth = cross(corner[(c + 1) % 3], corner[(c + 2) % 3]) * (1.0 / 6.0);  // ∂V_f/∂x
      CentroidGradient& of_node = out[face[c]];
      for (std::size_t k = 0; k < 3; ++k) {
        of_node[k] += growth * middle[k];
        of_node[k][k] += 0.25 * part;
      }
    }
  }
  for (CentroidGradient& of_node : out)
    for (Vec3d& row : of_node) row = row * (1.0 / volume);
  return out;
}

}  // namespace morula
