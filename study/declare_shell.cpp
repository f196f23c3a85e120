#include "study/declare.h"

namespace morula::scenarios {
namespace {

using Q = Quantity;
constexpr const char* kTable1 = "Van Liedekerke et al., Table 1";

/// What stands where nothing is given, for the cortex of a cell or the lamina of a nucleus.
struct Defaults {
  const char *young, *young_source, *tension, *tension_doc, *tension_source, *bulk, *bulk_source;
};
constexpr Defaults kCell{"1 kPa",
                         kTable1,
                         "0.1 mN/m",
                         "Active cortical tension.",
                         "chosen between 0.03 mN/m (neutrophil, Hochmuth 2000) and 0.4 mN/m (fibroblast, Tinevez et al. 2009)",
                         "2.5 kPa",
                         kTable1};
constexpr Defaults kNucleus{"5 kPa",  "chosen: five times the cortex", "0 mN/m", "Active tension of the lamina.", "chosen: off",
                            "10 kPa", "chosen: four times the cell"};

void declare_cortex(Section& c, draft::ShellKeys& t, const Defaults& fallback, draft::CellType* cell) {
  c.word(
      {.name = "elastic",
       .doc =
           "Elasticity in the plane. springs: a net of springs, Poisson ratio 1/3 whatever `poisson` says; springs_with_area: springs and "
           "the area of every face, Poisson ratio 1/3 to 1/2; neo_hooke, stvk (St Venant-Kirchhoff, stretches 0.8 to 1.3) and skalak: "
           "triangles of constant strain, Poisson ratio 0 to 1/2; none: a fluid.",
       .fallback = "springs",
       .words = {"none", "springs", "springs_with_area", "neo_hooke", "stvk", "skalak"},
       .example = "neo_hooke",
       .source = "Van Liedekerke et al."},
      t.elastic);
  c.quantity({.name = "young",
              .doc = "Young's modulus E of the layer.",
              .quantity = Q::kPressure,
              .fallback = fallback.young,
              .low = 0.0,
              .high = 1e4,
              .example = "1 kPa",
              .source = fallback.young_source},
             t.young);
  c.quantity({.name = "thickness",
              .doc = "Thickness h of the layer.",
              .quantity = Q::kLength,
              .fallback = "200 nm",
              .low = 0.0,
              .high = 5.0,
              .low_open = true,
              .example = "200 nm",
              .source = kTable1},
             t.thickness);
  c.quantity({.name = "poisson",
              .doc = "Poisson ratio of the layer: of its bending stiffness, and of its plane where `elastic` can have it (not in a net of "
                     "springs).",
              .fallback = "0.5",
              .low = 0.0,
              .high = 0.5,
              .example = "0.5",
              .source = kTable1},
             t.poisson);
  c.quantity({.name = "shear_modulus",
              .doc = "Shear modulus G of `elastic: skalak`; `auto`: E h/(2 (1 + poisson)).",
              .quantity = Q::kTension,
              .fallback = "auto",
              .low = 0.0,
              .high = 1e4,
              .low_open = true,
              .specials = {{"auto", -1.0}},
              .example = "5.5 uN/m",
              .source = "thin sheet of an isotropic solid"},
             t.shear_modulus);
  c.quantity({.name = "area_ratio",
              .doc = "Resistance to change of area C of `elastic: skalak`; `auto`: poisson/(1 - poisson).",
              .fallback = "auto",
              .low = 0.0,
              .high = 1e6,
              .specials = {{"auto", -1.0}},
              .example = "50",
              .source = "Skalak et al. 1973, doi:10.1016/S0006-3495(73)85983-1"},
             t.area_ratio);
  c.quantity({.name = "tension",
              .doc = fallback.tension_doc,
              .quantity = Q::kTension,
              .fallback = fallback.tension,
              .low = 0.0,
              .high = 100.0,
              .example = "0.2 mN/m",
              .source = fallback.tension_source},
             t.tension);
  c.quantity({.name = "turnover",
              .doc = "Time after which 1/e of the elastic stress in the plane is left at constant shape, because the layer is renewed; "
                     "`never`: it is permanent.",
              .quantity = Q::kTime,
              .fallback = "never",
              .low = 0.0,
              .low_open = true,
              .specials = {{"never", std::numeric_limits<double>::infinity()}},
              .example = "10 min",
              .source = "chosen: off"},
             t.turnover);
  c.quantity({.name = "damping",
              .doc = "Friction of an edge against its own lengthening.",
              .quantity = Q::kFriction,
              .fallback = "1e-4 N s/m",
              .low = 0.0,
              .high = 1e4,
              .example = "1e-4 N s/m",
              .source = kTable1},
             t.damping);
  c.quantity(
      {.name = "isotropic_damping",
       .doc = "Friction of an edge against any relative motion of its ends; unlike `damping` it resists rigid rotation of the whole.",
       .quantity = Q::kFriction,
       .fallback = "0 N s/m",
       .low = 0.0,
       .high = 1e4,
       .example = "1e-5 N s/m",
       .source = "chosen: off"},
      t.isotropic_damping);
  if (cell != nullptr) declare_tension_regions(c, *cell);
}

void declare_area(Section& a, draft::ShellKeys& t) {
  a.quantity({.name = "local",
              .doc = "Modulus of the area of every face.",
              .quantity = Q::kTension,
              .fallback = "0 mN/m",
              .low = 0.0,
              .high = 1e6,
              .example = "0.07 mN/m",
              .source = "chosen: off"},
             t.local_area);
  a.quantity({.name = "global",
              .doc = "Modulus of the area of the whole surface.",
              .quantity = Q::kTension,
              .fallback = "0 mN/m",
              .low = 0.0,
              .high = 1e6,
              .example = "1 mN/m",
              .source = "chosen: off"},
             t.global_area);
  a.flag({.name = "on_top",
          .doc = "Needed where another law resists changes of area already (springs_with_area, neo_hooke, stvk, skalak, or both moduli "
                 "here): yes, the moduli shall add.",
          .fallback = "false",
          .example = "true",
          .source = "chosen: nothing is counted twice unasked"},
         t.area_on_top);
}

void spontaneous_radius(Section& s, draft::Layer& t, const char* doc) {
  s.quantity({.name = "spontaneous_radius",
              .doc = doc,
              .quantity = Q::kLength,
              .fallback = "flat",
              .low = -1e6,
              .high = 1e6,
              .specials = {{"flat", std::numeric_limits<double>::infinity()}},
              .example = "3 um",
              .source = "Helfrich 1973, doi:10.1515/znc-1973-11-1209"},
             t.spontaneous_radius);
}

void declare_bending(Section& b, draft::Layer& t) {
  b.word(
      {.name = "law",
       .doc = "hinge: springs at the edges with the angles of the sphere at rest; helfrich: mean curvature by the cotangent formula, flat "
              "at rest or of `spontaneous_radius`; none.",
       .fallback = "hinge",
       .words = {"none", "hinge", "helfrich"},
       .example = "helfrich",
       .source = "chosen"},
      t.bending_law);
  b.quantity({.name = "rigidity",
              .doc = "Bending rigidity D of the layer; `auto`: E h^3/(12 (1 - poisson^2)).",
              .quantity = Q::kEnergy,
              .fallback = "auto",
              .low = 0.0,
              .specials = {{"auto", -1.0}},
              .example = "8.9e-19 J",
              .source = "Kirchhoff plate"},
             t.bending);
  spontaneous_radius(
      b, t,
      "With `law: helfrich`, the radius of the sphere that has no bending moment (c0 = 2/R; negative: bent inwards); `flat`: "
      "no spontaneous curvature.");
}

void declare_membrane(Section& m, draft::Layer& t) {
  m.word({.name = "elastic",
          .doc = "Elasticity in the plane: the laws of `elastic` of the layer below.",
          .fallback = "none",
          .words = {"none", "springs", "neo_hooke", "stvk", "skalak"},
          .example = "skalak",
          .source = "chosen"},
         t.elastic);
  m.quantity({.name = "shear_modulus",
              .doc = "Its shear modulus G; springs have k = 4 G/sqrt(3).",
              .quantity = Q::kTension,
              .low = 0.0,
              .high = 1e4,
              .low_open = true,
              .example = "5.5 uN/m"},
             t.shear_modulus);
  m.quantity(
      {.name = "area_ratio",
       .doc =
           "Its resistance to change of area C, for neo_hooke and stvk poisson/(1 - poisson) of the sheet. Springs have none of their own.",
       .low = 0.0,
       .high = 1e6,
       .example = "50"},
      t.area_ratio);
  m.word({.name = "bending",
          .doc = "Bending: the laws of `bending`.",
          .fallback = "none",
          .words = {"none", "hinge", "helfrich"},
          .example = "helfrich",
          .source = "chosen"},
         t.bending_law);
  m.quantity(
      {.name = "rigidity", .doc = "Its bending rigidity.", .quantity = Q::kEnergy, .low = 0.0, .low_open = true, .example = "2e-19 J"},
      t.bending);
  spontaneous_radius(m, t, "With `bending: helfrich`, as in `bending`.");
}

}  // namespace

void declare_shell_keys(Section& s, draft::ShellKeys& t, draft::CellType* cell) {
  const Defaults& fallback = cell != nullptr ? kCell : kNucleus;
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
  const KeySpec layer =
      cell != nullptr
          ? KeySpec{.name = "cortex", .doc = "The cell's cortex: a thin elastic layer under active tension."}
          : KeySpec{.name = "lamina", .doc = "The nucleus' envelope with its lamina: a thin elastic layer, perhaps under tension."};
  s.group(layer, present, [&](Section& c) { declare_cortex(c, t, fallback, cell); });
  s.group(
      {.name = "membrane",
       .doc = "A second layer on the first, such as the plasma membrane: its laws add to those of the first. Where both resist changes of "
              "area, `area: {on_top: true}` says that they shall; `turnover` renews both.",
       .optional_section = true,
       .example = "{elastic: skalak, shear_modulus: 5.5 uN/m, area_ratio: 50, bending: helfrich, rigidity: 2e-19 J}"},
      t.has_membrane, [&t](Section& m) { declare_membrane(m, t.membrane); });
  s.group({.name = "area", .doc = "Elasticity of the area, apart from that of the layer."}, present,
          [&t](Section& a) { declare_area(a, t); });
  s.group({.name = "bending", .doc = "Bending of the layer.", .shorthand = "rigidity", .example = "{law: helfrich, rigidity: 2e-19 J}"},
          present, [&t](Section& b) { declare_bending(b, t); });
  s.quantity({.name = "bulk_modulus",
              .doc = "Stiffness K of the volume: p = -K ln(V/V0).",
              .quantity = Q::kPressure,
              .fallback = fallback.bulk,
              .low = 0.0,
              .high = 1e4,
              .example = "2.5 kPa",
              .source = fallback.bulk_source},
             t.bulk_modulus);
  s.quantity({.name = "bulk_viscosity",
              .doc = "Viscosity of the volume: adds -eta (dV/dt)/V to the pressure.",
              .quantity = Q::kViscosity,
              .fallback = "0 Pa s",
              .low = 0.0,
              .high = 1e9,
              .example = "100 Pa s",
              .source = "chosen: off"},
             t.bulk_viscosity);
  s.quantity(
      {.name = "shape_stiffness",
       .doc = "Keeps triangles from collapsing; no shear modulus in regular triangles, but it holds a cortex back that should flow. "
              "`auto`: 0.3 times the tension, at least a tenth of the modulus E h of an elastic layer; 0.03 mN/m where there is neither.",
       .quantity = Q::kTension,
       .fallback = "auto",
       .low = 0.0,
       .high = 100.0,
       .specials = {{"auto", -1.0}},
       .example = "0.03 mN/m",
       .source = "measured: contact angles within 1 deg, clusters up to W/(2 tension) = 0.9"},
      t.shape_stiffness);
  if (cell != nullptr) {
    s.quantity({.name = "self_contact",
                .doc = "Distance at which a surface touches other parts of itself, from inside or outside, such as the thickness of its "
                       "cortex; at most half of "
                       "an edge of its mesh. `off`: it passes through itself.",
                .quantity = Q::kLength,
                .fallback = "off",
                .low = 0.0,
                .high = 5.0,
                .low_open = true,
                .specials = {{"off", 0.0}},
                .example = "200 nm",
                .source = "chosen: off; cells under pressure do not fold"},
               cell->self_contact);
    declare_interior(s, *cell);
  }
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

void declare_shell(Section& s, draft::CellType& t) { declare_shell_keys(s, t, &t); }

}  // namespace morula::scenarios
