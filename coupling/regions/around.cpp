#include <algorithm>
#include <cmath>

#include "core/mesh/mean_curvature.h"
#include "core/mesh/triangle_tree.h"
#include "coupling/model.h"
#include "coupling/regions/room_around.h"

namespace morula {

double room_around(const ObstacleSpec& obstacle, double within) {
  double area = 0.0;
  for (const Triangle& t : obstacle.faces)
    area += 0.5 * norm(cross(obstacle.position[t[1]] - obstacle.position[t[0]], obstacle.position[t[2]] - obstacle.position[t[0]]));
  const double bend = mean_curvature(obstacle.position, obstacle.faces);
  return obstacle.inside ? std::max(0.0, within * (area - within * bend)) : layer_around(area, bend, within);
}

std::shared_ptr<const RegionShape> around_region() {
  using Kind = OwnKey::Kind;
  static const auto shape = std::make_shared<const RegionShape>(RegionShape{
      .info = {.name = "around",
               .title = "Region around an obstacle",
               .equation = "min |x − s| < d, s on the obstacle's surface",
               .source = "choice of this project",
               .parameters = {given_by_study("within", "length", "µm", "d.")}},
      .keys = {{Kind::kObstacle,
                {.name = "geometry",
                 .doc = "Of `around`: the obstacle that the region lies around; it moves along with it.",
                 .required = true,
                 .example = "needle"}},
               {Kind::kQuantity,
                {.name = "within",
                 .doc = "Of `around`: how far a cell's centre is from the surface of the obstacle.",
                 .quantity = Quantity::kLength,
                 .required = true,
                 .low = 0.0,
                 .low_open = true,
                 .example = "30 um"}}},
      .has_center = false,
      .build =
          [](const Model& model, Region& region) {
            region.obstacle = region.values.number("geometry");
            region.reach = region.values("within");
            const ObstacleSpec& obstacle = model.obstacles[static_cast<std::size_t>(region.obstacle)];
            region.surface = std::make_shared<const TriangleTree>(obstacle.position, obstacle.faces);
            region.room = room_around(obstacle, region.reach);
          },
      .distance =
          [](const Region& region, const Vec3d& from) {
            const double far = region.reach + region.margin;
            if (!region.surface->bounds().inflated(far).contains(from)) return 2.0 * region.margin + 1.0;
            const auto nearest = region.surface->nearest(from, far);
            return nearest ? std::sqrt(nearest->closest.distance2) - region.reach : 2.0 * region.margin + 1.0;
          },
      .repeats = true,
      .volume = [](const Region& region) { return region.room; }});
  return shape;
}

}  // namespace morula
