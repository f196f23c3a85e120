#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "core/mesh/triangle_tree.h"
#include "coupling/model.h"
#include "coupling/regions/region.h"

namespace morula {
namespace {

using Kind = OwnKey::Kind;

/// What is nearer than a distance to a closed surface, without what is on its far side: Σ over faces, edges and nodes of a convex body (Steiner 1840).
/// Where it is not convex, about that [µm³].
double room_around(const ObstacleSpec& obstacle, double within) {
  double area = 0.0, bend = 0.0;  // bend: half the sum over edges of length times turn, as Minkowski's quermass integral has it
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3d> normal_beside;
  for (const Triangle& t : obstacle.faces) {
    const Vec3d twice = cross(obstacle.position[t[1]] - obstacle.position[t[0]], obstacle.position[t[2]] - obstacle.position[t[0]]);
    if (norm2(twice) == 0.0) continue;
    area += 0.5 * norm(twice);
    for (int k = 0; k < 3; ++k) normal_beside[{t[k], t[(k + 1) % 3]}] = normalized(twice);
  }
  for (const auto& [edge, normal] : normal_beside) {
    const auto other = normal_beside.find({edge.second, edge.first});
    if (edge.first > edge.second || other == normal_beside.end()) continue;
    const double turn = std::atan2(norm(cross(normal, other->second)), dot(normal, other->second));
    bend += 0.5 * turn * norm(obstacle.position[edge.second] - obstacle.position[edge.first]);
  }
  if (obstacle.inside) bend = -bend;
  const double corners = obstacle.inside ? 0.0 : 4.0 / 3.0 * std::numbers::pi * within * within * within;
  return std::max(0.0, area * within + bend * within * within + corners);
}

}  // namespace

std::shared_ptr<const RegionShape> around_region() {
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
      .volume = [](const Region& region) { return region.room; }});
  return shape;
}

}  // namespace morula
