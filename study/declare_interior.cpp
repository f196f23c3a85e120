// What is inside a cell: water and solutes, a nucleus, a cytoskeleton.
#include "study/declare.h"
#include "study/given_keys.h"

namespace morula::scenarios {
namespace {

using Q = Quantity;

void declare_osmosis_keys(Section& o, draft::Osmosis& osmosis) {
  o.quantity({.name = "permeability",
              .doc = "Permeability L_p of the cell's membrane to water.",
              .quantity = Q::kPermeability,
              .fallback = "1e-12 m/s/Pa",
              .low = 0.0,
              .high = 1e3,
              .low_open = true,
              .example = "1e-12 m/s/Pa",
              .source = "chosen within 1e-13 to 1e-11 m/s/Pa"},
             osmosis.law, &Osmosis::permeability);
  o.quantity({.name = "inactive",
              .doc = "Part of the target volume that is no solvent.",
              .quantity = Q::kFraction,
              .fallback = "30 %",
              .low = 0.0,
              .high = 0.9,
              .example = "30 %",
              .source = "chosen within 20 to 40 %"},
             osmosis.inactive);
  o.quantity({.name = "inside",
              .doc = "Osmolarity inside at the target volume: the cell holds n = inside * (1 - inactive) * target volume of solutes that "
                     "cannot leave. Growth, division and death act on n with the target volume.",
              .quantity = Q::kConcentration,
              .fallback = "300 mM",
              .low = 0.0,
              .high = 1e4,
              .low_open = true,
              .example = "300 mM",
              .source = "chosen: physiological saline"},
             osmosis.inside);
  o.quantity({.name = "outside",
              .doc = "Osmolarity of the medium.",
              .quantity = Q::kConcentration,
              .fallback = "300 mM",
              .low = 0.0,
              .high = 1e4,
              .low_open = true,
              .example = "150 mM",
              .source = "chosen: physiological saline"},
             osmosis.outside);
  o.list(
      {.name = "course",
       .doc = "`outside` over time as a factor: straight lines between these points, constant before the first and after the last. Steps "
              "land on the points.",
       .not_empty = true,
       .example = "[{time: 10 min, factor: 1}, {time: 11 min, factor: 0.5}]"},
      osmosis.course, &declare_course_point);
  o.text({.name = "field", .doc = "A field whose concentration at the cell adds to `outside`.", .example = "sucrose"}, osmosis.field);
}

void declare_nucleus(Section& n, draft::Nucleus& nucleus) {
  n.word({.name = "kind",
          .doc = "rigid: a sphere that floats in the cell, meets the cortex from inside and grows with the cell; shell: the same as a "
                 "deformable shell of its own, with the keys of `dcm` for its mesh and mechanics (`lamina` for `cortex`); none.",
          .fallback = "rigid",
          .words = {"none", "rigid", "shell"},
          .example = "rigid",
          .source = "Van Liedekerke et al."},
         nucleus.kind);
  n.quantity({.name = "volume_fraction",
              .doc = "Volume of the nucleus in parts of the cell's target volume.",
              .quantity = Q::kFraction,
              .low = 0.0,
              .low_open = true,
              .example = "10 %"},
             nucleus.volume_fraction);
  n.quantity(
      {.name = "radius",
       .doc = "Radius of the nucleus in a newborn cell of the mean radius (Table 1 of Van Liedekerke et al.: 2.5 um in 6 um), instead "
              "of `volume_fraction`.",
       .quantity = Q::kLength,
       .low = 0.0,
       .low_open = true,
       .example = "2.5 um"},
      nucleus.radius);
  n.quantity({.name = "cytoplasm_viscosity",
              .doc = "Viscosity of the cytoplasm, which drags on the nucleus (Stokes).",
              .quantity = Q::kViscosity,
              .fallback = "1 Pa s",
              .low = 0.0,
              .high = 1e6,
              .low_open = true,
              .example = "1 Pa s",
              .source = "chosen: cytoplasm at the size of organelles"},
             nucleus.viscosity);
  // Keys of its mechanics that stand beside another kind are noted, so that they can be refused.
  const bool is_shell = nucleus.kind.value != "rigid" && nucleus.kind.value != "none";
  draft::ShellKeys unused;
  declare_shell_keys(n, is_shell ? nucleus.shell : unused, nullptr);
  for (const GivenKey& key : keys_written_in(n.laws(), [&unused](Section& shell) { declare_shell_keys(shell, unused, nullptr); }))
    nucleus.no_effect.push_back({key.path.substr(key.path.rfind('.') + 1), key.place, true});
}

void declare_links(Section& l, draft::Links& links, const char* number) {
  l.whole({.name = "number",
           .doc = number,
           .fallback = "all",
           .low = 1,
           .high = 2562,
           .specials = {{"all", std::numeric_limits<double>::infinity()}},
           .example = "60",
           .source = "chosen"},
          links.number);
  l.quantity({.name = "stiffness",
              .doc = "Spring constant of one link.",
              .quantity = Q::kTension,
              .required = true,
              .low = 0.0,
              .high = 1e4,
              .example = "0.01 nN/um"},
             links.stiffness);
  l.quantity({.name = "damping",
              .doc = "Friction of one link against its own lengthening.",
              .quantity = Q::kFriction,
              .fallback = "0 N s/m",
              .low = 0.0,
              .high = 1e4,
              .example = "1e-5 N s/m",
              .source = "chosen: off"},
             links.damping);
  l.flag({.name = "tension_only",
          .doc = "true: a link goes slack below its rest length, as a filament does.",
          .fallback = "false",
          .example = "true",
          .source = "chosen"},
         links.law, &dcm::LinkParameters::tension_only);
}

}  // namespace

void declare_interior(Section& s, draft::CellType& t) {
  s.group({.name = "nucleus", .doc = "The nucleus of the cell.", .optional_section = true, .example = "{radius: 2.5 um}"},
          t.nucleus.present, [&t](Section& n) { declare_nucleus(n, t.nucleus); });
  bool present = false;
  s.group({.name = "cytoskeleton", .doc = "Viscoelastic links inside the cell. They are at rest in the undeformed cell and grow with it."},
          present, [&t](Section& c) {
            c.group({.name = "nucleus_links",
                     .doc = "Links from nodes of the cortex to the centre of the nucleus, or to its nodes where it is a shell.",
                     .optional_section = true,
                     .example = "{stiffness: 0.01 nN/um, damping: 1e-5 N s/m}"},
                    t.nucleus_links.present,
                    [&t](Section& l) { declare_links(l, t.nucleus_links, "How many nodes have one, spread evenly; all: every node."); });
            c.group({.name = "cortex_links",
                     .doc = "Links across the cell, between opposite nodes of the cortex.",
                     .optional_section = true,
                     .example = "{stiffness: 0.01 nN/um, number: 40}"},
                    t.cortex_links.present, [&t](Section& l) {
                      declare_links(l, t.cortex_links, "How many, spread evenly; all: one for every pair of opposite nodes.");
                    });
          });
}

void declare_osmosis(Section& s, draft::CellType& t) {
  s.group({.name = "osmosis",
           .doc = "Water flows through the cell's membrane until solutes and pressure are in balance; without it the volume a free cell "
                  "tends to is its target volume. Shells hold their water against what presses them; spheres give way by `bulk_modulus` as "
                  "if it left.",
           .optional_section = true,
           .example = "{outside: 150 mM}"},
          t.osmosis.present, [&t](Section& o) { declare_osmosis_keys(o, t.osmosis); });
}

}  // namespace morula::scenarios
