#include "core/mesh/mean_curvature.h"

#include <cmath>
#include <map>
#include <utility>

namespace morula {

double mean_curvature(std::span<const Vec3d> position, std::span<const Triangle> faces) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3d> normal_beside;  // by directed edge
  for (const Triangle& t : faces) {
    const Vec3d twice = cross(position[t[1]] - position[t[0]], position[t[2]] - position[t[0]]);
    if (norm2(twice) == 0.0) continue;
    for (std::size_t k = 0; k < 3; ++k) normal_beside[{t[k], t[(k + 1) % 3]}] = normalized(twice);
  }
  double out = 0.0;
  for (const auto& [edge, normal] : normal_beside) {
    const auto other = normal_beside.find({edge.second, edge.first});
    if (edge.first > edge.second || other == normal_beside.end()) continue;
    const double angle = std::atan2(norm(cross(normal, other->second)), dot(normal, other->second));
    out += 0.5 * norm(position[edge.first] - position[edge.second]) * angle;
  }
  return out;
}

}  // namespace morula
