#include "coupling/model.h"

namespace morula {

std::shared_ptr<const RegionShape> surface_region() {
  static const auto shape = std::make_shared<const RegionShape>(RegionShape{
      .info = {.name = "surface",
               .title = "Region of the outermost layers of the tissue",
               .equation = "contacts from a cell at the surface < n; leaves at n + 1. At the surface: no touching cell within 65° of a "
                           "direction, in which half of those aside are open, too",
               .source = "choice of this project; empty cones: Marrone et al. 2010, doi:10.1016/j.jcp.2010.01.019",
               .parameters = {given_by_study("layers", "number", "1", "n.")}},
      .keys = {{OwnKey::Kind::kQuantity,
                {.name = "layers",
                 .doc = "Of `surface`: how many layers of cells: 1 are those at the surface of the tissue, 2 these and all that touch "
                        "them. The surface is where a cell has no other beside it: obstacles and walls of the domain are no "
                        "cells. In the layer behind the last a cell keeps the body that the region gives.",
                 .fallback = "1",
                 .low = 1.0,
                 .high = 100.0,
                 .example = "2",
                 .source = "chosen"}}},
      .has_center = false,
      .build = [](const Model&, Region& region) { region.contacts = region.values("layers") - 1.0; },
      .counts = CountsContacts::kFromSurface});
  return shape;
}

}  // namespace morula
