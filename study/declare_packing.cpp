#include "study/declare.h"

namespace morula::scenarios {
namespace {

using Q = Quantity;

void declare_knot(Section& s, draft::PackingKnot& knot) {
  s.quantity(
      {.name = "packing",
       .doc = "Part of the sphere that lies behind the planes of contact with its neighbours, summed over them: 7.9 % where equal spheres "
              "in cubic close packing have the volume of their cells; above 100 % where planes cut each other often.",
       .quantity = Q::kFraction,
       .required = true,
       .low = 0.0,
       .high = 10.0,
       .low_open = true,
       .example = "10.5 %"},
      knot.packing);
  s.quantity({.name = "pressure",
              .doc = "Pressure at this packing; 0 at the first knot, and never falling.",
              .quantity = Q::kPressure,
              .required = true,
              .low = 0.0,
              .high = 1e4,
              .example = "171 Pa"},
             knot.pressure);
}

}  // namespace

void declare_packing(Section& s, draft::CellType& t) {
  bool present = false;
  s.group(
      {.name = "packing",
       .doc = "Pressure of packing: a cell keeps its volume, so that its neighbours push each other apart, which pairs of spheres do not "
              "know. Without it (`packing: none`) spheres in a dense tissue are as if they could be squeezed to nothing, and softer than "
              "shells.",
       .shorthand = "law",
       .example = "{law: ideal_filled_cell, bulk_modulus: 2.5 kPa}"},
      present, [&t](Section& p) {
        p.word({.name = "law",
                .doc = "ideal_filled_cell: knots with which a cubic close packing of these spheres (without adhesion) has the pressure "
                       "K_V ln(V0/V), where they alone have less; knots: as given; none: pairs alone; fitted: of the file of `cbm: "
                       "{law: fitted}`, the default where it has any.",
                .fallback = "ideal_filled_cell",
                .words = {"ideal_filled_cell", "knots", "none", kFittedLaw},
                .example = "knots",
                .source = "choice of this project after Van Liedekerke et al. 2019, doi:10.1371/journal.pcbi.1006273"},
               t.packing_law);
        p.quantity(
            {.name = "bulk_modulus",
             .doc = "K_V of the ideal filled cell; `shell`: that of the cell as a shell, so that both bodies resist compression alike; "
                    "spheres that are stiffer than that have no pressure of packing.",
             .quantity = Q::kPressure,
             .fallback = "shell",
             .low = 0.0,
             .high = 1e4,
             .low_open = true,
             .specials = {{"shell", -1.0}},
             .example = "2.5 kPa",
             .source = "chosen"},
            t.packing_bulk_modulus);
        p.list(
            {.name = "knots",
             .doc =
                 "Pressure by packing: a monotone cubic through these points (three or more, eight are good), nothing below the first, a "
                 "straight line beyond the last.",
             .not_empty = true,
             .example = "[{packing: 8.3 %, pressure: 0 Pa}, {packing: 10.5 %, pressure: 171 Pa}, {packing: 16.8 %, pressure: 440 Pa}]"},
            t.packing_knots, &declare_knot);
      });
}

}  // namespace morula::scenarios
