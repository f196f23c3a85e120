#include "core/contact/self_contact.h"

#include <limits>

#include "core/contact/surface_pair.h"

namespace morula {

bool may_meet_itself(const PairBody& body, double reach, int rings) {
  Vec3d middle{};
  const std::size_t nodes = body.position.size();
  for (std::uint32_t i = 0; i < nodes; ++i) middle += body.node(i);
  middle = middle * (1.0 / static_cast<double>(nodes));
  double nearest = std::numeric_limits<double>::infinity(), lowest = nearest, farthest2 = 0.0;
  for (std::uint32_t i = 0; i < nodes; ++i) farthest2 = std::max(farthest2, norm2(body.node(i) - middle));
  for (const Triangle& t : body.topology->faces()) {
    const Vec3d a = body.node(t[0]), b = body.node(t[1]), c = body.node(t[2]), normal = cross(b - a, c - a);
    const double twice = norm(normal), longest2 = std::max({norm2(b - a), norm2(c - b), norm2(a - c)});
    if (!(twice > 0.0)) return true;
    nearest = std::min(nearest, dot(normal, a - middle) / twice);
    lowest = std::min(lowest, twice / std::sqrt(longest2));
  }
  if (!(nearest > reach)) return true;
  return 2.0 * std::asin(0.5 * reach / nearest) * farthest2 / nearest > rings * lowest;
}

}  // namespace morula
