#include <algorithm>

#include "core/ball.h"
#include "core/cell_id_text.h"
#include "coupling/cell_view.h"
#include "coupling/model.h"

namespace morula {

std::shared_ptr<const RegionShape> chosen_cells_region() {
  static const auto shape = std::make_shared<const RegionShape>(RegionShape{
      .info = {.name = "cells",
               .title = "Region of cells that are named",
               .equation = "the cells of these ids, and all that come of them",
               .source = "choice of this project",
               .parameters = {}},
      .keys = {{OwnKey::Kind::kCellIds,
                {.name = "ids",
                 .doc =
                     "Of `cells`: which cells, by the ids that events and results have: 17 is a founder (they are numbered from 1 in the "
                     "order of `initial`), 17.01 the second daughter of its first daughter. Their daughters belong to it, too.",
                 .required = true,
                 .example = "[1, \"1.01\"]"}}},
      .has_center = false,
      .build =
          [](const Model& model, Region& region) {
            double largest = 0.0;
            for (const CellType& type : model.types) largest = std::max(largest, ball_volume(type.radius.mean));
            region.room = largest * static_cast<double>(region.values.ids("ids").size());
          },
      .of_cell =
          [](const Region& region, const CellView& cell) {
            const auto is_named = [&](CellId id) { return descends_from(cell.row().id, id); };
            return Standing{std::ranges::any_of(region.values.ids("ids"), is_named) ? -1.0 : kNever, 0.0};
          },
      .volume = [](const Region& region) { return region.room; }});
  return shape;
}

}  // namespace morula
