#include <array>

#include "cbm/sphere_keys.h"
#include "dcm/shell_keys.h"
#include "study/declare.h"
#include "study/law_keys.h"

namespace morula::scenarios {
namespace {

using Q = Quantity;
constexpr const char* kTable1 = "Van Liedekerke et al., Table 1";

void declare_life(Section& s, draft::CellType& t) {
  bool present = false;
  s.group({.name = "cycle", .doc = "Growth and division. Without it cells neither grow nor divide.", .optional_section = true}, t.has_cycle,
          [&t](Section& c) { declare_cycle(c, t); });
  s.group({.name = "inhibit_growth", .doc = "What stops growth for as long as it lasts."}, present, [&t](Section& g) {
    g.quantity({.name = "pressure_above",
                .doc = "Growth stops while neighbours, obstacles and loads press on the cell with more than this; `never`: no inhibition.",
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
          t.behaviours["death"].present, [&t](Section& d) {
            declare_behaviour_keys(d, "death", t);
            d.quantity({.name = "shrink_time",
                        .doc = "A dying cell shrinks as V0 exp(-t/shrink_time).",
                        .quantity = Q::kTime,
                        .fallback = "8 h",
                        .low = 0.0,
                        .low_open = true,
                        .example = "8 h",
                        .source = "chosen: apoptosis takes about 8 h"},
                       t.plain, &CellType::apoptosis_time);
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
                       t.plain, &CellType::removal_fraction);
          });
  declare_migration(s, t);
  declare_activity(s, t);
  declare_behaviours(s, {"death"}, t);
}

void declare_friction(Section& s, draft::CellType& t) {
  s.quantity({.name = "cell_cell",
              .doc = "Friction with cells per contact area; for two types the mean of theirs. Surfaces of shells zip together and roll "
                     "past each other, two spheres push and rub their whole contact: how much of it a sphere has, against shells, too, is "
                     "`cbm: {friction: "
                     "...}`, or told "
                     "by a law that was fitted to shells (`cbm: {law: fitted}`).",
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
  s.quantity(dcm::keys::medium_friction(), t.friction_medium);
  const auto tangential = [&s](const char* name, const char* doc, Given<double>& value) {
    s.quantity({.name = name,
                .doc = doc,
                .quantity = Q::kFrictionPerArea,
                .fallback = "same",
                .low = 0.0,
                .high = 1e6,
                .specials = {{"same", -1.0}},
                .example = "1e7 N s/m^3",
                .source = "chosen"},
               value);
  };
  tangential("cell_cell_tangential",
             "Along the contact; `cell_cell` then is the friction of approach. `same`: both alike. Spheres have `cbm: {friction: {along: "
             "...}}` of it.",
             t.tangential_cell_cell);
  tangential("obstacle_tangential", "Along the obstacle; `obstacle` then is the friction across. `same`: both alike.",
             t.tangential_obstacle);
  tangential("medium_tangential",
             "Along a shell's surface; `medium` then is the friction across it. A sphere has the mean, (normal + 2 tangential)/3. `same`: "
             "both alike.",
             t.tangential_medium);
}

/// The law of contact of spheres, with the moduli that all have and the keys of the laws' own.
void declare_sphere_law(Section& c, draft::CellType& t) {
  KeySpec law{.name = "law",
              .doc = "Contact of two spheres. ",
              .fallback = "jkr",
              .example = "jkr",
              .source = "Johnson, Kendall & Roberts 1971, doi:10.1098/rspa.1971.0141"};
  for (const auto& one : c.laws().spheres) law.doc += one->word + ": " + one->doc + "; ", law.words.push_back(one->word);
  law.doc +=
      "fitted: what `morula calibrate` found from the shells of this type, in `file`; two types with different laws meet by Hertz's.";
  law.words.emplace_back(kFittedLaw);
  c.word(law, t.sphere_law);
  c.quantity(cbm::keys::young(), t.sphere_young);
  c.quantity(cbm::keys::poisson(), t.sphere_poisson);
  c.text({.name = "file",
          .doc = "TYPE.jkr.yaml of `morula calibrate jkr`, for `law: fitted`: E, Poisson's ratio, the adhesion of two spheres and their "
                 "friction, the "
                 "pressure of packing and the range of the fit are those of the file. The type must have the `dcm`, `radius`, adhesion and "
                 "`contact` that were fitted.",
          .example = "tumour.jkr.yaml"},
         t.sphere_file);
  c.word({.name = "form",
          .doc = "Which of the laws in the file. better: that which meets what was held out; jkr: elastic with adhesion; table: force and "
                 "area through points, "
                 "between spheres of this type.",
          .fallback = "better",
          .words = {"better", "jkr", "table"},
          .example = "jkr",
          .source = "decision 0047"},
         t.sphere_form);
  declare_law_keys(c, choosable_sphere_laws(c.laws()), {"law", "young", "poisson", "packing", "file", "form", "friction", "with_shells"},
                   t.sphere_own);
}

/// How much of the friction with cells a sphere has.
void declare_sphere_friction(Section& s, draft::CellType& t) {
  const auto factor = [&](const char* name, const char* doc, const char* example, const char* source,
                          double cbm::SphereParameters::*value) {
    s.quantity({.name = name, .doc = doc, .fallback = "1", .low = 0.0, .high = 100.0, .example = example, .source = source},
               t.sphere_friction, value);
  };
  factor("approach",
         "Factor on `cell_cell`, across the contact. Shells of the same friction come together ten to twenty times as fast as spheres "
         "with 1: their surfaces zip.",
         "0.08", "chosen; fitted to pairs of shells: 0.046 to 0.093 (decision 0064)", &cbm::SphereParameters::approach_factor);
  factor("along",
         "Factor on `cell_cell_tangential`, along the contact. With 1 spheres stay where they first touched, and few cells that grow "
         "become a bush; 0.03 is what tissues of shells yield like.",
         "0.03", "chosen; fitted to balls of shells that plates press: 0.016 to 0.061 (decisions 0077, 0086)",
         &cbm::SphereParameters::along_factor);
}

/// What a sphere is to a shell, beside its modulus and W.
void declare_with_shells(Section& s, draft::CellType& t) {
  s.quantity({.name = "stiffness",
              .doc = "Factor on the stiffness of the foundation with which a sphere gives way, which follows from its modulus and W.",
              .fallback = "1",
              .low = 0.0,
              .high = 1e3,
              .low_open = true,
              .example = "0.5",
              .source = "decision 0066"},
             t.with_shells, &cbm::WithShells::stiffness);
  s.quantity({.name = "adhesion",
              .doc = "Factor on the adhesion energy W of a sphere with shells.",
              .fallback = "1",
              .low = 0.0,
              .high = 10.0,
              .example = "0.85",
              .source = "decision 0066"},
             t.with_shells, &cbm::WithShells::adhesion);
}

}  // namespace

void declare_relative_spread(Section& s, draft::Spread& value, double most) {
  s.quantity({.name = "spread",
              .doc = "Relative standard deviation from cell to cell (Gaussian, cut at 3).",
              .quantity = Q::kFraction,
              .fallback = "0 %",
              .low = 0.0,
              .high = most,
              .example = "10 %",
              .source = "chosen"},
             value.spread);
}

void declare_correlation(Section& s, draft::Spread& value) {
  s.quantity(
      {.name = "correlation",
       .doc =
           "Of a daughter with her mother: 100 %, she is as her mother was; 0 %, drawn anew. The spread is the same in every generation.",
       .quantity = Q::kFraction,
       .fallback = "0 %",
       .low = -1.0,
       .high = 1.0,
       .example = "50 %",
       .source = "chosen"},
      value.correlation);
}

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
  declare_relative_spread(s, value, 0.3);
}

namespace {

void declare_variation(Section& s, draft::CellType& t) {
  constexpr std::array<const char*, kTraits.size()> kDocs{
      "Tension of the cortex, and of all its `regions`: each cell has its own, which it keeps where it is a sphere.",
      "Young's modulus of spheres, and of shells the moduli of their cortex in the plane and against bending. Packing stays that of the "
      "type.",
      "Adhesion energy: of two cells that of their types times the geometric mean of their factors; that of `contact.pairs` by region as "
      "well."};
  for (const Trait trait : kTraits) {
    bool given = false;
    draft::Spread& value = t.variation[number_of(trait)];
    s.group({.name = kTraitNames[number_of(trait)],
             .doc = kDocs[number_of(trait)],
             .shorthand = "spread",
             .example = "{spread: 10 %, correlation: 50 %}"},
            given, [&value](Section& v) {
              declare_relative_spread(v, value, 0.2);
              declare_correlation(v, value);
            });
  }
}

}  // namespace

void declare_cell_type(Section& s, draft::CellType& t) {
  bool present = false;
  s.text({.name = "like",
          .doc = "Another cell type: what is not said here is as there, key by key in all sections; `key: default` takes a key of the "
                 "other back, as `phases: default` beside `model: none`. Adhesion, too, is that of the other, where neither of two types "
                 "names the pair, or `others`; and what it takes from fields and gives to them, where a field does not name this type.",
          .example = "hepatocyte"},
         t.like);
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
  s.text(
      {.name = "color",
       .doc = "Colour of these cells in pictures: sky, orange, green, pink, yellow, blue, vermilion, or \"#rrggbb\" in quotes. Without it "
              "types take these colours in turn.",
       .example = "vermilion"},
      t.color);
  s.group({.name = "variation",
           .doc = "How cells of the type differ from each other in their mechanics.",
           .example = "{tension: {spread: 10 %}}"},
          present, [&t](Section& v) { declare_variation(v, t); });
  declare_life(s, t);
  declare_osmosis(s, t);
  s.group({.name = "friction", .doc = "Friction with what is around."}, present, [&t](Section& f) { declare_friction(f, t); });
  s.quantities(cbm::keys::adhesion(), t.adhesion);
  s.group({.name = "cbm", .doc = "The cell as a sphere."}, present, [&t](Section& c) {
    declare_sphere_law(c, t);
    declare_packing(c, t);
    bool rubs = false, contact = false;
    c.group(
        {.name = "friction",
         .doc = "How much of the type's friction with cells, spheres and shells, these spheres have: they have no surface that zips "
                "and no spin. For spheres of two types it is the geometric mean of their factors. `law: fitted` takes both from its file.",
         .example = "{along: 0.03}"},
        rubs, [&t](Section& f) { declare_sphere_friction(f, t); });
    c.group(
        {.name = "with_shells",
         .doc =
             "Contact of these spheres with shells. `morula calibrate jkr` fits both factors, and `law: fitted` takes them from its file.",
         .example = "{stiffness: 0.5, adhesion: 0.85}"},
        contact, [&t](Section& w) { declare_with_shells(w, t); });
  });
  s.group({.name = "dcm", .doc = "The cell as a deformable shell."}, present, [&t](Section& d) { declare_shell(d, t); });
}

}  // namespace morula::scenarios
