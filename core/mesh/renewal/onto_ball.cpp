#include "core/mesh/renewal/onto_ball.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/numbers/principal_axis.h"

namespace morula {
namespace {

/// Where the ray from `center` along `direction` leaves the surface for the last time. A ray through an edge hits one of its faces, whatever rounding says.
std::optional<SurfacePlace> last_hit(const AskedSurface& surface, const Vec3d& center, const Vec3d& direction) {
  constexpr double kRounding = 1e-9;
  std::optional<SurfacePlace> out;
  double farthest = 0.0;
  for (std::uint32_t f = 0; f < surface.faces().size(); ++f) {
    const auto& [na, nb, nc] = surface.faces()[f];
    const auto position = surface.view().position;
    const Vec3d a = position[na] - center, ab = position[nb] - position[na], ac = position[nc] - position[na];
    const Vec3d normal = cross(ab, ac), turned = cross(direction, a);
    const double facing = dot(direction, normal);
    if (!(std::abs(facing) > 0.0)) continue;
    const double way = dot(a, normal) / facing, u = -dot(turned, ac) / facing, v = dot(turned, ab) / facing;
    if (way <= farthest || u < -kRounding || v < -kRounding || u + v > 1.0 + kRounding) continue;
    farthest = way;
    out = SurfacePlace{f, center + direction * way};
  }
  return out;
}

}  // namespace

double elongation(const SurfaceView& surface) {
  const PrincipalAxes axes(second_moments(surface.position, surface.topology->faces()));
  return std::sqrt(axes.moment[0] / axes.moment[1]);
}

Result<RenewedSurface> onto_ball(const SurfaceView& surface, std::span<const SurfaceView> neighbours, const ReferenceShape& shape,
                                 const RenewalLimits& limits) {
  MORULA_TRY_ASSIGN(const auto old, SurfaceAmongWalls::of(surface, neighbours));
  std::vector<SurfacePlace> start;
  for (const Vec3d& x : shape.position) {
    const auto place = last_hit(old.surface, old.center, normalized(x));
    if (!place) return Error{ErrorKind::kPhysics, "a ray from the centroid does not meet the surface", "the shape is no ball yet"};
    start.push_back(*place);
  }
  return renew_by_ladder(old.surface, old.walls(), *shape.topology, start, old.volume, limits,
                         "the mesh of the library does not hold this surface");
}

}  // namespace morula
