#include <numbers>

#include "coupling/behaviours/migration_law.h"
#include "coupling/behaviours/polarity_rule.h"
#include "study/declare.h"
#include "study/own_section.h"

namespace morula::scenarios {
namespace {

using Q = Quantity;

void declare_protrusion(Section& p, draft::Activity& a) {
  p.quantity({.name = "force", .doc = "Size of the force.", .quantity = Q::kForce, .required = true, .low = 0.0, .example = "1 nN"},
             a.protrusion, &Protrusion::force);
  p.quantity({.name = "angle",
              .doc = "Half angle of the front about the polarity; on a `substrate`, along it.",
              .quantity = Q::kAngle,
              .fallback = "45 deg",
              .low = 0.0,
              .high = 0.5 * std::numbers::pi,
              .low_open = true,
              .example = "45 deg",
              .source = "chosen"},
             a.protrusion, &Protrusion::angle);
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

void declare_migration(Section& s, draft::CellType& t) {
  bool present = false;
  s.group({.name = "migration", .doc = "Cells that drive themselves against the friction of what is around."}, present, [&t](Section& m) {
    m.quantity({.name = "speed",
                .doc = "Root mean square speed of an otherwise free cell, in three dimensions in the open and along the surface of an "
                       "obstacle that it touches: the force is that against all friction with the medium and with obstacles. A cell "
                       "among others is slower, for its force does not make up for friction with neighbours. 0: no migration.",
                .quantity = Q::kSpeed,
                .fallback = "0 um/h",
                .low = 0.0,
                .high = 1.0,
                .example = "2 um/h",
                .source = "chosen"},
               t.migration_speed);
    KeySpec law{
        .name = "law", .doc = "How the velocity changes. ", .fallback = "persistent_walk", .example = "run_and_tumble", .source = "chosen"};
    std::vector<const std::vector<OwnKey>*> keys;
    for (const auto& one : m.laws().migration) {
      law.doc += (law.words.empty() ? "" : "; ") + one->info.name + ": " + one->doc;
      law.words.push_back(one->info.name);
      keys.push_back(&one->keys);
    }
    law.doc += ".";
    m.word(law, t.migration_law);
    declare_own_keys(m, keys, t.migration, false);
    m.text({.name = "substrate",
            .doc = "Obstacle that the cell must touch, and along which its force acts then; without it the cell is driven "
                   "everywhere.",
            .example = "plane"},
           t.migration_substrate);
  });
}

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
                 .low = 1e-6,
                 .specials = {{"no", 0.0}},
                 .example = "30 s",
                 .source = "chosen"},
                a.resolve);
          });
  s.group(
      {.name = "polarity", .doc = "A direction that the cell has and turns.", .optional_section = true, .example = "{turning: 0.5 1/h}"},
      a.has_polarity, [&a, &t](Section& p) {
        p.vector({.name = "start", .doc = "At time 0; without it random.", .example = "[1, 0, 0]"}, a.start);
        std::vector<const std::vector<OwnKey>*> keys;
        for (const auto& rule : p.laws().polarity) keys.push_back(&rule->keys);
        declare_own_keys(p, keys, t.polarity, true);
      });
  s.group({.name = "protrusion",
           .doc = "A force of the leading edge of a cell along its polarity: on the front of a shell, on the whole of a sphere.",
           .optional_section = true,
           .example = "{force: 1 nN, substrate: plane}"},
          a.has_protrusion, [&a](Section& p) { declare_protrusion(p, a); });
}

}  // namespace morula::scenarios
