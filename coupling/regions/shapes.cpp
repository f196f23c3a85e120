#include <algorithm>
#include <cmath>

#include "core/ball.h"
#include "coupling/regions/region.h"

namespace morula {
namespace {

using Kind = OwnKey::Kind;
constexpr auto kOurs = "choice of this project";

bool meets_box(const Box& domain, const Region& region, const Vec3d& half) {
  return domain.overlaps({region.center - half, region.center + half});
}

}  // namespace

std::shared_ptr<const RegionShape> sphere_region() {
  static const auto shape = std::make_shared<const RegionShape>(
      RegionShape{.info = {.name = "sphere",
                           .title = "Region that is a ball",
                           .equation = "|x − c| < r",
                           .source = kOurs,
                           .parameters = {given_by_study("radius", "length", "µm", "r.")}},
                  .keys = {{Kind::kQuantity,
                            {.name = "radius",
                             .doc = "Radius of a sphere.",
                             .quantity = Quantity::kLength,
                             .required = true,
                             .low = 0.0,
                             .low_open = true,
                             .example = "25 um"}}},
                  .build = [](const Model&, Region& region) { region.radius = region.values("radius"); },
                  .distance = [](const Region& region, const Vec3d& from) { return norm(from) - region.radius; },
                  .repeats = true,
                  .meets =
                      [](const Region& r, const Box& domain) {
                        return meets_box(domain, r, {r.radius, r.radius, r.radius});
                      },
                  .volume = [](const Region& region) { return ball_volume(region.radius); }});
  return shape;
}

std::shared_ptr<const RegionShape> box_region() {
  static const auto shape = std::make_shared<const RegionShape>(RegionShape{
      .info = {.name = "box",
               .title = "Region that is a box",
               .equation = "|x_k − c_k| < s_k/2",
               .source = kOurs,
               .parameters = {given_by_study("size", "length", "µm", "Length of the diagonal of the edges s.")}},
      .keys = {{Kind::kVector,
                {.name = "size",
                 .doc = "Edges of a box.",
                 .quantity = Quantity::kLength,
                 .required = true,
                 .low = 0.0,
                 .low_open = true,
                 .example = "[50 um, 50 um, 50 um]"}}},
      .build = [](const Model&, Region& region) { region.size = region.values.vector("size"); },
      .distance =
          [](const Region& region, const Vec3d& from) {
            return std::max(
                {std::abs(from.x) - 0.5 * region.size.x, std::abs(from.y) - 0.5 * region.size.y, std::abs(from.z) - 0.5 * region.size.z});
          },
      .repeats = true,
      .meets = [](const Region& r, const Box& domain) { return meets_box(domain, r, r.size * 0.5); },
      .volume = [](const Region& region) { return region.size.x * region.size.y * region.size.z; }});
  return shape;
}

std::shared_ptr<const RegionShape> half_space_region() {
  static const auto shape = std::make_shared<const RegionShape>(RegionShape{
      .info =
          {.name = "half_space", .title = "Region that is a half space", .equation = "(x − c)·n < 0", .source = kOurs, .parameters = {}},
      .keys = {{Kind::kDirection,
                {.name = "normal", .doc = "Of a half space: direction out of it.", .required = true, .example = "[0, 0, 1]"}}},
      .build = [](const Model&, Region& region) { region.normal = region.values.vector("normal"); },
      .distance = [](const Region& region, const Vec3d& from) { return dot(from, normalized(region.normal)); },
      .meets = [](const Region& region, const Box& domain) {  // the corner that lies farthest against the normal decides
        const Vec3d n = region.normal;
        const Vec3d corner{n.x > 0 ? domain.low.x : domain.high.x, n.y > 0 ? domain.low.y : domain.high.y,
                           n.z > 0 ? domain.low.z : domain.high.z};
        return !(dot(corner - region.center, n) > 0.0);
      }});
  return shape;
}

std::shared_ptr<const RegionShape> everything_region() {
  static const auto shape = std::make_shared<const RegionShape>(RegionShape{
      .info = {.name = "everything", .title = "Region that is all there is", .equation = "always", .source = kOurs, .parameters = {}},
      .has_center = false,
      .of_cell = [](const Region&, const CellView&) {
        return Standing{-1e300, 0.0};
      }});
  return shape;
}

std::vector<std::shared_ptr<const RegionShape>> builtin_region_shapes() {
  return {sphere_region(),     box_region(),          half_space_region(), everything_region(), around_region(),
          neighbours_region(), chosen_cells_region(), surface_region(),    level_region()};
}

}  // namespace morula
