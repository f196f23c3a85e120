#include "coupling/cell_view.h"
#include "coupling/model.h"

namespace morula {

std::shared_ptr<const RegionShape> level_region() {
  using Kind = OwnKey::Kind;
  static const auto shape =
      std::make_shared<const RegionShape>(RegionShape{
          .info = {.name = "level",
                   .title = "Region where a field is above or below a level",
                   .equation = "c > c_l; leaves below (1 − s) c_l. Below a level: c < c_l; leaves above (1 + s) c_l",
                   .source = "choice of this project",
                   .parameters = {given_by_study("level", "concentration", "mM", "c_l."), given_by_study("slack", "fraction", "1", "s.")}},
          .keys = {{Kind::kField,
                    {.name = "field", .doc = "Of `level`: the field, as the cell sees it.", .required = true, .example = "oxygen"}},
                   {Kind::kQuantity,
                    {.name = "level",
                     .doc = "Of `level`: the concentration.",
                     .quantity = Quantity::kConcentration,
                     .required = true,
                     .low = 0.0,
                     .low_open = true,
                     .example = "0.05 mM"}},
                   {Kind::kWord,
                    {.name = "side",
                     .doc = "Of `level`: on which side of it cells are in the region.",
                     .fallback = "above",
                     .words = {"above", "below"},
                     .example = "below",
                     .source = "chosen"}},
                   {Kind::kQuantity,
                    {.name = "slack",
                     .doc = "Of `level`: a cell leaves the region only where the field is this part of the level beyond it.",
                     .quantity = Quantity::kFraction,
                     .fallback = "20 %",
                     .low = 0.0,
                     .high = 1.0,
                     .high_open = true,
                     .example = "20 %",
                     .source = "chosen"}}},
          .has_center = false,
          .of_cell =
              [](const Region& region, const CellView& cell) {
                const double over =
                    cell.concentration(static_cast<std::size_t>(region.values.number("field"))) / region.values("level") - 1.0;
                return Standing{region.values.number("side") == 0 ? -over : over, region.values("slack")};
              },
          .awaited = "fields that cells answer to"});
  return shape;
}

}  // namespace morula
