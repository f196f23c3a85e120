#include "scenarios/study/declare.h"

namespace morula::scenarios {
namespace {

using Q = Quantity;
constexpr const char* kTable1 = "Van Liedekerke et al., Table 1";

void declare_spread(Section& s, draft::Spread& value, Quantity quantity, const char* mean, const char* doc, const char* source, double low,
                    double high) {
  s.quantity({.name = "mean",
              .doc = doc,
              .quantity = quantity,
              .fallback = mean,
              .low = low,
              .high = high,
              .low_open = low == 0.0,
              .example = mean,
              .source = source},
             value.mean);
  s.quantity({.name = "spread",
              .doc = "Relative standard deviation from cell to cell (Gaussian, cut at 3).",
              .quantity = Q::kFraction,
              .fallback = "0 %",
              .low = 0.0,
              .high = 0.3,
              .example = "10 %",
              .source = "chosen"},
             value.spread);
}

void declare_life(Section& s, draft::CellType& t) {
  bool present = false;
  s.group({.name = "cycle", .doc = "Growth and division. Without it cells neither grow nor divide.", .optional_section = true}, t.has_cycle,
          [&t](Section& c) {
            c.word({.name = "model",
                    .doc = "volume_threshold: a cell grows from its birth volume to twice that and divides; none: it rests.",
                    .fallback = "volume_threshold",
                    .words = {"none", "volume_threshold"},
                    .example = "volume_threshold",
                    .source = "chosen"},
                   t.cycle_model);
            bool given = false;
            c.group({.name = "duration",
                     .doc = "Time from birth to twice the birth volume.",
                     .shorthand = "mean",
                     .example = "{mean: 18 h, spread: 10 %}"},
                    given, [&t](Section& d) {
                      declare_spread(d, t.cycle_duration, Q::kTime, "24 h", "Mean over cells.", "chosen: human stem cells and epithelia",
                                     60.0, 1e9);
                    });
            c.word({.name = "growth",
                    .doc = "Volume against time.",
                    .fallback = "linear",
                    .words = {"linear", "exponential"},
                    .example = "linear",
                    .source = "Van Liedekerke et al."},
                   t.growth);
            c.word({.name = "axis",
                    .doc = "Axis of division.",
                    .fallback = "random",
                    .words = {"random"},
                    .example = "random",
                    .source = "Van Liedekerke et al."},
                   t.axis);
          });
  s.group({.name = "inhibit_growth", .doc = "What stops growth for as long as it lasts."}, present, [&t](Section& g) {
    g.quantity({.name = "pressure_above",
                .doc = "Growth stops above this pressure; `never`: no inhibition.",
                .quantity = Q::kPressure,
                .fallback = "1 kPa",
                .low = 0.0,
                .specials = {{"never", std::numeric_limits<double>::infinity()}},
                .example = "800 Pa",
                .source = "chosen; Van Liedekerke et al. 2019 work with volumetric strain"},
               t.pressure_above);
  });
  s.group({.name = "death",
           .doc = "Death by lack of a field: while the concentration is below a threshold, cells die at a rate.",
           .optional_section = true},
          t.has_death, [&t](Section& d) {
            d.suffixed("_below", {.name = "field", .doc = "The field whose lack kills.", .example = "oxygen"}, t.death_field,
                       {.name = "below",
                        .doc = "Concentration below which cells die.",
                        .quantity = Q::kConcentration,
                        .low = 0.0,
                        .example = "0.02 mM"},
                       t.death_below);
            d.quantity({.name = "rate",
                        .doc = "Probability of death per time while below.",
                        .quantity = Q::kRate,
                        .required = true,
                        .low = 0.0,
                        .example = "0.05 1/h"},
                       t.death_rate);
            d.quantity({.name = "shrink_time",
                        .doc = "A dying cell shrinks as V0 exp(-t/shrink_time).",
                        .quantity = Q::kTime,
                        .fallback = "8 h",
                        .low = 0.0,
                        .low_open = true,
                        .example = "8 h",
                        .source = "chosen: apoptosis takes about 8 h"},
                       t.shrink_time);
            d.quantity({.name = "removed_below",
                        .doc = "Removed when its volume is below this part of that at death.",
                        .quantity = Q::kFraction,
                        .fallback = "10 %",
                        .low = 0.0,
                        .high = 1.0,
                        .low_open = true,
                        .high_open = true,
                        .example = "10 %",
                        .source = "chosen"},
                       t.removed_below);
          });
  s.group({.name = "migration", .doc = "Persistent random walk."}, present, [&t](Section& m) {
    m.quantity({.name = "speed",
                .doc = "Root mean square speed in three dimensions; 0: no migration.",
                .quantity = Q::kSpeed,
                .fallback = "0 um/h",
                .low = 0.0,
                .high = 1.0,
                .example = "2 um/h",
                .source = "chosen"},
               t.migration_speed);
    m.quantity({.name = "persistence",
                .doc = "Time over which the direction is remembered.",
                .quantity = Q::kTime,
                .fallback = "30 min",
                .low = 0.0,
                .low_open = true,
                .example = "30 min",
                .source = "chosen"},
               t.persistence);
  });
}

void declare_friction(Section& s, draft::CellType& t) {
  s.quantity({.name = "cell_cell",
              .doc = "Friction with cells per contact area; for two types the mean of theirs.",
              .quantity = Q::kFrictionPerArea,
              .fallback = "5e10 N s/m^3",
              .low = 0.0,
              .high = 1e6,
              .example = "5e10 N s/m^3",
              .source = kTable1},
             t.friction_cell_cell);
  s.quantity({.name = "obstacle",
              .doc = "Friction with obstacles per contact area.",
              .quantity = Q::kFrictionPerArea,
              .fallback = "1e11 N s/m^3",
              .low = 0.0,
              .high = 1e6,
              .example = "1e11 N s/m^3",
              .source = "chosen: order of Galle et al. 2005, doi:10.1529/biophysj.104.041459"},
             t.friction_obstacle);
  s.quantity({.name = "medium",
              .doc = "Friction with the medium or matrix per area of surface.",
              .quantity = Q::kFrictionPerArea,
              .fallback = "1e8 N s/m^3",
              .low = 0.0,
              .high = 1e6,
              .example = "1e8 N s/m^3",
              .source = kTable1},
             t.friction_medium);
}

void declare_shell(Section& s, draft::CellType& t) {
  bool present = false;
  s.whole({.name = "nodes",
           .doc = "Nodes of the shell's mesh: 42, 162, 642 or 2562 (subdivided icosahedra).",
           .fallback = "162",
           .low = 42,
           .high = 2562,
           .words = {"42", "162", "642", "2562"},
           .example = "162",
           .source = "Van Liedekerke et al.: 160 to 2600 nodes a cell"},
          t.nodes);
  s.group({.name = "cortex", .doc = "The cell's cortex: a thin elastic layer under active tension."}, present, [&t](Section& c) {
    c.quantity({.name = "young",
                .doc = "Young's modulus E of the cortex.",
                .quantity = Q::kPressure,
                .fallback = "1 kPa",
                .low = 0.0,
                .high = 1e4,
                .example = "1 kPa",
                .source = kTable1},
               t.young);
    c.quantity({.name = "thickness",
                .doc = "Thickness h of the cortex.",
                .quantity = Q::kLength,
                .fallback = "200 nm",
                .low = 0.0,
                .high = 5.0,
                .low_open = true,
                .example = "200 nm",
                .source = kTable1},
               t.thickness);
    c.quantity({.name = "poisson",
                .doc = "Poisson ratio in the bending stiffness. In its plane a net of springs has 1/3 whatever this says.",
                .fallback = "0.5",
                .low = 0.0,
                .high = 0.5,
                .example = "0.5",
                .source = kTable1},
               t.poisson);
    c.quantity({.name = "tension",
                .doc = "Active cortical tension.",
                .quantity = Q::kTension,
                .fallback = "0.1 mN/m",
                .low = 0.0,
                .high = 100.0,
                .example = "0.2 mN/m",
                .source = "chosen between 0.03 mN/m (neutrophil, Hochmuth 2000) and 0.4 mN/m (fibroblast, Tinevez et al. 2009)"},
               t.tension);
    c.quantity({.name = "damping",
                .doc = "Friction of an edge against its own lengthening.",
                .quantity = Q::kFriction,
                .fallback = "1e-4 N s/m",
                .low = 0.0,
                .high = 1e4,
                .example = "1e-4 N s/m",
                .source = kTable1},
               t.damping);
  });
  s.quantity({.name = "bending",
              .doc = "Bending rigidity D of the cortex; `auto`: E h^3/(12 (1 - poisson^2)).",
              .quantity = Q::kEnergy,
              .fallback = "auto",
              .low = 0.0,
              .specials = {{"auto", -1.0}},
              .example = "8.9e-19 J",
              .source = "Kirchhoff plate"},
             t.bending);
  s.quantity({.name = "bulk_modulus",
              .doc = "Stiffness K of the volume: p = -K ln(V/V0).",
              .quantity = Q::kPressure,
              .fallback = "2.5 kPa",
              .low = 0.0,
              .high = 1e4,
              .low_open = true,
              .example = "2.5 kPa",
              .source = kTable1},
             t.bulk_modulus);
  s.quantity({.name = "shape_stiffness",
              .doc = "Keeps triangles from collapsing; no shear modulus in regular triangles.",
              .quantity = Q::kTension,
              .fallback = "0.3 mN/m",
              .low = 0.0,
              .high = 100.0,
              .example = "0.3 mN/m",
              .source = "measured: clusters up to W/(2 tension) = 0.9"},
             t.shape_stiffness);
  s.group({.name = "fold_barrier", .doc = "Keeps edges from folding through."}, present, [&t](Section& f) {
    f.quantity({.name = "stiffness",
                .doc = "Energy scale of the barrier.",
                .quantity = Q::kEnergy,
                .fallback = "1 fJ",
                .low = 0.0,
                .example = "1 fJ",
                .source = "measured: clusters up to W/(2 tension) = 0.9"},
               t.fold_stiffness);
    f.quantity({.name = "angle",
                .doc = "Turning angle of an edge from which the barrier acts.",
                .quantity = Q::kAngle,
                .fallback = "1.6 rad",
                .low = 0.2,
                .high = 3.0,
                .example = "1.6 rad",
                .source = "measured"},
               t.fold_angle);
  });
}

}  // namespace

void declare_cell_type(Section& s, draft::CellType& t) {
  bool present = false;
  s.group({.name = "radius", .doc = "Radius of a cell at birth.", .shorthand = "mean", .example = "{mean: 6 um, spread: 10 %}"}, present,
          [&t](Section& r) { declare_spread(r, t.radius, Q::kLength, "6 um", "Mean over cells.", kTable1, 0.5, 100.0); });
  s.word({.name = "body",
          .doc = "Body of these cells before any region or trigger: a sphere, or a deformable shell.",
          .fallback = "sphere",
          .words = {"sphere", "shell"},
          .synonyms = {{"cbm", "sphere"}, {"dcm", "shell"}},
          .example = "sphere",
          .source = "chosen"},
         t.body);
  declare_life(s, t);
  s.group({.name = "friction", .doc = "Friction with what is around."}, present, [&t](Section& f) { declare_friction(f, t); });
  s.quantities(
      {.name = "adhesion",
       .doc = "Adhesion energy W per contact area of the pair, by name of a cell type or obstacle; holds for both bodies. Give a pair "
              "once. Pairs that no type names have 1e-4 J/m^2 between cells and 1e-5 J/m^2 with obstacles.",
       .quantity = Q::kTension,
       .low = 0.0,
       .high = 100.0,
       .example = "{hepatocyte: 1e-4 J/m^2, capsule: 1e-6 J/m^2}",
       .source = kTable1},
      t.adhesion);
  s.group({.name = "cbm", .doc = "The cell as a sphere."}, present, [&t](Section& c) {
    c.word({.name = "law",
            .doc = "Contact of two spheres: JKR (elastic with adhesion) or Hertz (elastic, adhesion ignored).",
            .fallback = "jkr",
            .words = {"jkr", "hertz"},
            .example = "jkr",
            .source = "Johnson, Kendall & Roberts 1971, doi:10.1098/rspa.1971.0141"},
           t.sphere_law);
    c.quantity({.name = "young",
                .doc = "Young's modulus of the sphere.",
                .quantity = Q::kPressure,
                .fallback = "450 Pa",
                .low = 0.0,
                .high = 1e4,
                .low_open = true,
                .example = "450 Pa",
                .source = "Galle et al. 2005, doi:10.1529/biophysj.104.041459; Drasdo & Hoehme 2005, doi:10.1088/1478-3975/2/3/001"},
               t.sphere_young);
    c.quantity({.name = "poisson",
                .doc = "Poisson ratio of the sphere.",
                .fallback = "0.4",
                .low = 0.0,
                .high = 0.5,
                .example = "0.4",
                .source = "Galle et al. 2005, doi:10.1529/biophysj.104.041459"},
               t.sphere_poisson);
  });
  s.group({.name = "dcm", .doc = "The cell as a deformable shell."}, present, [&t](Section& d) { declare_shell(d, t); });
}

}  // namespace morula::scenarios
