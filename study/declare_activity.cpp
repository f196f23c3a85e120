#include <numbers>

#include "study/declare.h"

namespace morula::scenarios {
namespace {

using Q = Quantity;

void declare_protrusion(Section& p, draft::Activity& a) {
  p.quantity({.name = "force", .doc = "Size of the force.", .quantity = Q::kForce, .required = true, .low = 0.0, .example = "1 nN"},
             a.force);
  p.quantity({.name = "angle",
              .doc = "Half angle of the front about the polarity.",
              .quantity = Q::kAngle,
              .fallback = "45 deg",
              .low = 0.0,
              .high = 0.5 * std::numbers::pi,
              .low_open = true,
              .example = "45 deg",
              .source = "chosen"},
             a.angle);
  p.word(
      {.name = "reaction",
       .doc =
           "Who bears the reaction. substrate: what is outside, the cell feels the whole force; cell: its own rear, so that it moves only "
           "by what its surface rubs on or adheres to.",
       .fallback = "substrate",
       .words = {"substrate", "cell"},
       .example = "cell",
       .source = "chosen"},
      a.reaction);
  p.text({.name = "substrate",
          .doc = "Obstacle that the front must touch, along which the force then acts; without it the front acts everywhere.",
          .example = "plane"},
         a.substrate);
  p.quantity({.name = "contact_area",
              .doc = "The force grows with the area in contact with the substrate up to this area; 0: it does not depend on it.",
              .quantity = Q::kArea,
              .fallback = "0 um^2",
              .low = 0.0,
              .example = "30 um^2",
              .source = "chosen: off"},
             a.contact_area);
}

}  // namespace

void declare_activity(Section& s, draft::CellType& t) {
  draft::Activity& a = t.activity;
  s.group({.name = "fluctuations",
           .doc = "Random forces that belong to the friction by the fluctuation-dissipation theorem. `numerics.tolerance` is at most 1e-4 "
                  "then.",
           .optional_section = true,
           .example = "{energy: 4e-18 J}"},
          a.has_fluctuations, [&a](Section& f) {
            f.quantity({.name = "energy",
                        .doc = "k_B T of an effective temperature (4.28e-21 J is that of 310 K).",
                        .quantity = Q::kEnergy,
                        .required = true,
                        .low = 0.0,
                        .high = 1e3,
                        .example = "4e-18 J"},
                       a.energy);
            f.quantity(
                {.name = "resolve",
                 .doc = "Shortest relaxation time of a motion whose variance shall be right within 3 %: steps are at most 0.06 of it. "
                        "Faster motion comes out too small, by 1/(1 + step/(2 relaxation time)). `no`: steps are not limited.",
                 .quantity = Q::kTime,
                 .fallback = "no",
                 .low = 0.0,
                 .low_open = true,
                 .specials = {{"no", 0.0}},
                 .example = "30 s",
                 .source = "chosen"},
                a.resolve);
          });
  s.group(
      {.name = "polarity", .doc = "A direction that the cell has and turns.", .optional_section = true, .example = "{turning: 0.5 1/h}"},
      a.has_polarity, [&a](Section& p) {
        p.vector({.name = "start", .doc = "At time 0; without it random.", .example = "[1, 0, 0]"}, a.start);
        p.quantity({.name = "turning",
                    .doc = "D_r of rotational diffusion: the mean of p(0).p(t) falls as exp(-2 D_r t).",
                    .quantity = Q::kRate,
                    .fallback = "0 1/h",
                    .low = 0.0,
                    .high = 10.0,
                    .example = "0.5 1/h",
                    .source = "chosen: off"},
                   a.turning);
        p.quantity({.name = "follow_velocity",
                    .doc = "Time in which the polarity turns to the cell's velocity; `never`: it does not.",
                    .quantity = Q::kTime,
                    .fallback = "never",
                    .low = 0.0,
                    .low_open = true,
                    .specials = {{"never", 0.0}},
                    .example = "20 min",
                    .source = "chosen: off"},
                   a.follow_velocity);
      });
  s.group({.name = "protrusion",
           .doc = "A force of the leading edge of a shell along its polarity.",
           .optional_section = true,
           .example = "{force: 1 nN, substrate: plane}"},
          a.has_protrusion, [&a](Section& p) { declare_protrusion(p, a); });
}

}  // namespace morula::scenarios
