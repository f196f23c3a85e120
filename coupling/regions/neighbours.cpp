#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/ball.h"
#include "coupling/regions/counts_from.h"
#include "coupling/regions/room_around.h"

namespace morula {
namespace {

using Kind = OwnKey::Kind;

constexpr double kAnywhere = std::numeric_limits<double>::infinity();

/// How much room the cells take that are within so many contacts of what the region begins with; cells are two radii apart at most [µm³].
double room_of_neighbours(const Model& model, const Region& region) {
  using What = CountsFrom::What;
  double radius = 0.0;
  for (const CellType& type : model.types) radius = std::max(radius, type.radius.mean);
  const double reach = 2.0 * radius * region.contacts;
  const std::optional<CountsFrom> from = counts_from(model, model.swaps.regions, region.values.name("of"));
  if (!from || from->what == What::kType) return kAnywhere;
  if (from->what == What::kObstacle) return room_around(model.obstacles[from->number], reach);
  const Region& core = model.swaps.regions[from->number];
  const double inner = core.shape->volume != nullptr ? core.shape->volume(core) : kAnywhere;
  return ball_volume(ball_radius(inner) + reach);
}

}  // namespace

std::optional<CountsFrom> counts_from(const Model& model, std::span<const Region> before, const std::string& name) {
  std::optional<CountsFrom> out;
  const auto look = [&](const auto& all, CountsFrom::What what) {
    const auto at = std::ranges::find_if(all, [&name](const auto& one) { return one.name == name; });
    if (!out && at != all.end()) out = CountsFrom{what, static_cast<std::size_t>(at - all.begin())};
  };
  look(before, CountsFrom::What::kRegion);
  look(model.types, CountsFrom::What::kType);
  look(model.obstacles, CountsFrom::What::kObstacle);
  return out;
}

std::shared_ptr<const RegionShape> neighbours_region() {
  static const auto shape = std::make_shared<const RegionShape>(RegionShape{
      .info = {.name = "neighbours",
               .title = "Region of the cells within some contacts of others",
               .equation = "least number of contacts from a cell of `of` ≤ n; leaves beyond n + 1",
               .source = "choice of this project",
               .parameters = {given_by_study("cells", "number", "1", "n.")}},
      .keys =
          {{Kind::kCells,
            {.name = "of",
             .doc =
                 "Of `neighbours`: where counting begins: the cells of a region before this one, or of a cell type, which are 0 contacts "
                 "away; or an obstacle, whose touching cells are 1 away. A region comes before a type of the same name.",
             .required = true,
             .example = "needle"}},
           {Kind::kQuantity,
            {.name = "cells",
             .doc = "Of `neighbours`: within so many contacts. One contact more away a cell keeps the body that the region gives; it "
                    "leaves beyond.",
             .required = true,
             .low = 1.0,
             .high = 100.0,
             .example = "3"}}},
      .has_center = false,
      .build =
          [](const Model& model, Region& region) {
            region.contacts = region.values("cells");
            region.room = room_of_neighbours(model, region);
          },
      .counts = CountsContacts::kFromNamed,
      .volume = [](const Region& region) { return region.room; }});
  return shape;
}

}  // namespace morula
