#include "core/mesh/pipette.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/mesh/node_order.h"

namespace morula {
namespace {

constexpr double kHalfPi = 0.5 * std::numbers::pi;
constexpr double kMostFaces = 1e6;

struct ProfilePoint {
  double radius, z;
};

/// Heights from `low` to `high` (both left out): steps of `edge` up to `fine`, then growing to four times that.
std::vector<double> heights(double low, double high, double edge, double fine) {
  std::vector<double> out;
  double step = edge;
  for (double z = low + step; z < high - 0.5 * step; z += step) {
    out.push_back(z);
    if (z > fine) step = std::min(1.3 * step, 4.0 * edge);
  }
  return out;
}

/// The closed profile in the plane (r, z), its solid on the left: along the mouth outwards, up the outside, back along the far end, down the
/// inside.
std::vector<ProfilePoint> profile(double inner, double wall, double lip, double length, double edge) {
  std::vector<ProfilePoint> out;
  const int arcs = std::max(4, static_cast<int>(std::ceil(kHalfPi * lip / edge)));
  const auto arc = [&](double center, double from, int last) {  // angle from straight down, positive towards larger radii
    for (int i = 0; i <= last; ++i) {
      const double angle = from + kHalfPi * i / arcs;
      out.push_back({center + lip * std::sin(angle), lip - lip * std::cos(angle)});
    }
  };
  const bool flat = wall - 2.0 * lip > 1e-9 * wall;
  arc(inner + lip, -kHalfPi, flat ? arcs : arcs - 1);
  arc(inner + wall - lip, 0.0, arcs);
  const std::vector<double> inside = heights(lip, length, edge, inner), outside = heights(lip, length, edge, lip);
  for (const double z : outside) out.push_back({inner + wall, z});
  out.push_back({inner + wall, length});
  out.push_back({inner, length});
  for (std::size_t i = inside.size(); i-- > 0;) out.push_back({inner, inside[i]});
  return out;
}

}  // namespace

Result<TriangleMesh> make_pipette(double inner_radius, double wall, double lip, double length, double edge) {
  for (const double size : {inner_radius, wall, lip, length, edge})
    if (!(size > 0.0) || !std::isfinite(size))
      return Error{ErrorKind::kInput, "a length of a pipette is not positive and finite", "give all its lengths"};
  if (lip > 0.5 * wall * (1.0 + 1e-9))
    return Error{ErrorKind::kInput, "the lip of a pipette is more than half as wide as its wall", "a lip of at most half the wall"};
  if (length <= 2.0 * lip) return Error{ErrorKind::kInput, "a pipette is not longer than twice its lip", "a longer pipette"};
  if (4.0 * std::numbers::pi * (inner_radius + wall) * (2.0 * length + 2.0 * wall) / (edge * edge) > kMostFaces)
    return Error{ErrorKind::kInput, "a pipette with this edge length has more than a million faces", "a longer edge"};
  const auto ring = static_cast<std::uint32_t>(std::max(12.0, std::ceil(2.0 * std::numbers::pi * inner_radius / edge)));
  const std::vector<ProfilePoint> points = profile(inner_radius, wall, lip, length, edge);
  const auto rows = static_cast<std::uint32_t>(points.size());
  TriangleMesh mesh;
  for (const ProfilePoint& p : points)
    for (std::uint32_t k = 0; k < ring; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / ring;
      mesh.position.push_back({p.radius * std::cos(angle), p.radius * std::sin(angle), p.z});
    }
  for (std::uint32_t i = 0; i < rows; ++i)
    for (std::uint32_t k = 0; k < ring; ++k) {
      const std::uint32_t next_row = (i + 1) % rows, next = (k + 1) % ring;
      const std::uint32_t a = i * ring + k, b = i * ring + next, c = next_row * ring + next, d = next_row * ring + k;
      mesh.faces.push_back({a, b, c});
      mesh.faces.push_back({a, c, d});
    }
  return with_near_neighbour_order(mesh);
}

}  // namespace morula
