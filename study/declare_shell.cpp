#include <utility>

#include "dcm/shell_keys.h"
#include "study/declare.h"
#include "study/law_keys.h"
#include "study/layer_words.h"

namespace morula::scenarios {
namespace {

using Q = Quantity;
namespace keys = dcm::keys;
using Of = dcm::LayerWord::Of;

/// What stands where nothing is given, for the lamina of a nucleus in place of the cortex of a cell.
KeySpec of_nucleus(KeySpec key, const char* fallback, const char* source, const char* doc = nullptr) {
  key.fallback = fallback, key.source = source;
  if (doc != nullptr) key.doc = doc;
  return key;
}
KeySpec young(bool nucleus) { return nucleus ? of_nucleus(keys::young(), "5 kPa", "chosen: five times the cortex") : keys::young(); }
KeySpec tension(bool nucleus) {
  return nucleus ? of_nucleus(keys::tension(), "0 mN/m", "chosen: off", "Active tension of the lamina.") : keys::tension();
}
KeySpec bulk_modulus(bool nucleus) {
  return nucleus ? of_nucleus(keys::bulk_modulus(), "10 kPa", "chosen: four times the cell") : keys::bulk_modulus();
}

/// "a: what a is; b: ..." of the laws that can be named here.
std::string told(const Section& s, Of of, bool in_membrane) {
  std::string out;
  for (const dcm::LayerWord* word : layer_words(s.laws(), of))
    if (!in_membrane || word->in_membrane) out += word->word + ": " + word->doc + "; ";
  return out;
}
std::vector<std::string> names(const Section& s, Of of, bool in_membrane) {
  std::vector<std::string> out{"none"};
  for (const dcm::LayerWord* word : layer_words(s.laws(), of))
    if (!in_membrane || word->in_membrane) out.push_back(word->word);
  return out;
}

/// The keys that laws have for themselves, but those that the section has already.
void own_keys(Section& s, Of of, draft::Layer& t, std::vector<std::string> there) {
  declare_law_keys(s, choosable_layer_laws(s.laws(), of), std::move(there), t.own);
}

void declare_cortex(Section& c, draft::ShellKeys& t, draft::CellType* cell) {
  const bool nucleus = cell == nullptr;
  c.word(
      {.name = "elastic",
       .doc = "Elasticity in the plane. " + told(c, Of::kElastic, false) + "none: a fluid" +
              (nucleus
                   ? "."
                   : ", which beside spheres flows into the gaps between them where it is pressed with more than some 13 tensions over the "
                     "radius."),
       .fallback = "springs",
       .words = names(c, Of::kElastic, false),
       .example = "neo_hooke",
       .source = "Van Liedekerke et al."},
      t.elastic);
  c.quantity(young(nucleus), t.young);
  c.quantity(keys::thickness(), t.thickness);
  c.quantity(keys::poisson(), t.poisson);
  own_keys(c, Of::kElastic, t, {"elastic", "young", "thickness", "poisson"});
  c.quantity(tension(nucleus), t.tension);
  c.quantity(keys::turnover(), t.turnover);
  c.quantity(keys::damping(), t.damping);
  c.quantity(keys::isotropic_damping(), t.isotropic_damping);
  if (cell != nullptr) declare_tension_regions(c, *cell);
}

void declare_area(Section& a, draft::ShellKeys& t) {
  a.quantity(keys::local_area(), t.local_area);
  a.quantity(keys::global_area(), t.global_area);
  a.flag({.name = "on_top",
          .doc = "Needed where another law resists changes of area already (" + area_words(a.laws()) +
                 ", or both moduli here): yes, the moduli shall add.",
          .fallback = "false",
          .example = "true",
          .source = "chosen: nothing is counted twice unasked"},
         t.area_on_top);
}

void declare_bending(Section& b, draft::Layer& t) {
  b.word({.name = "law",
          .doc = told(b, Of::kBending, false) + "none.",
          .fallback = "hinge",
          .words = names(b, Of::kBending, false),
          .example = "helfrich",
          .source = "chosen"},
         t.bending_law);
  b.quantity(keys::rigidity(), t.bending);
  own_keys(b, Of::kBending, t, {"law", "rigidity"});
}

void declare_membrane(Section& m, draft::Layer& t) {
  m.word({.name = "elastic",
          .doc = "Elasticity in the plane: the laws of `elastic` of the layer below.",
          .fallback = "none",
          .words = names(m, Of::kElastic, true),
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
             t.own["shear_modulus"]);
  m.quantity({.name = "area_ratio",
              .doc = "Its resistance to change of area C, for neo_hooke and stvk poisson/(1 - poisson) of the sheet. Springs have none of "
                     "their own.",
              .low = 0.0,
              .high = 1e6,
              .example = "50"},
             t.own["area_ratio"]);
  own_keys(m, Of::kElastic, t, {"elastic", "shear_modulus", "area_ratio", "bending", "rigidity"});
  m.word({.name = "bending",
          .doc = "Bending: the laws of `bending`.",
          .fallback = "none",
          .words = names(m, Of::kBending, true),
          .example = "helfrich",
          .source = "chosen"},
         t.bending_law);
  m.quantity(
      {.name = "rigidity", .doc = "Its bending rigidity.", .quantity = Q::kEnergy, .low = 0.0, .low_open = true, .example = "2e-19 J"},
      t.bending);
  own_keys(m, Of::kBending, t, {"elastic", "shear_modulus", "area_ratio", "bending", "rigidity"});
}

}  // namespace

void declare_shell_keys(Section& s, draft::ShellKeys& t, draft::CellType* cell) {
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
  s.group(layer, present, [&](Section& c) { declare_cortex(c, t, cell); });
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
  s.quantity(bulk_modulus(cell == nullptr), t.bulk_modulus);
  s.quantity(keys::bulk_viscosity(), t.bulk_viscosity);
  s.quantity(keys::shape_stiffness(), t.shape_stiffness);
  if (cell != nullptr) {
    s.quantity({.name = "self_contact",
                .doc = "Distance at which a surface touches other parts of itself, from inside or outside; at most half of "
                       "an edge of its mesh. `auto`: a quarter of an edge (`off` in studies with cells from `meshes`). `off`: it passes "
                       "through itself.",
                .quantity = Q::kLength,
                .fallback = "auto",
                .low = 0.0,
                .high = 5.0,
                .low_open = true,
                .specials = {{"auto", -1.0}, {"off", 0.0}},
                .example = "200 nm",
                .source = "decision 0089: shells that spheres press thin pass through themselves without"},
               cell->self_contact);
    s.quantity({.name = "renew_mesh_below",
                .doc = "The nodes of a shell are spread evenly along its surface, its volume kept, when the quality of a face, 4 sqrt(3) "
                       "times its area over "
                       "the sum of the squares of its sides (1: equilateral), is less than this. `never`: they stay where mechanics has "
                       "brought them.",
                .quantity = Q::kNumber,
                .fallback = "never",
                .low = 0.0,
                .high = 0.6,
                .low_open = true,
                .specials = {{"never", 0.0}},
                .example = "0.4",
                .source = "chosen: off; the shape term keeps meshes even"},
               cell->renew_mesh_below);
    s.flag(
        {.name = "own_mesh",
         .doc = "Where spreading the nodes does not make a mesh even, as on tongues, necks and rods longer than about four times their "
                "width, the shell gets connectivity of its own: edges are split, drawn together and turned, with 0.7 to 1.5 times the "
                "`nodes` of its type. For fluid cortices (`elastic: none`); springs keep their meshes even themselves. The shell goes back "
                "to the mesh of its type when it has rounded up, as cells from files do then. Needs `renew_mesh_below`.",
         .fallback = "false",
         .example = "true",
         .source = "chosen: off; lanes stay full on one connectivity"},
        cell->own_mesh);
    declare_interior(s, *cell);
  }
  s.group({.name = "fold_barrier", .doc = "Keeps edges from folding through."}, present, [&t](Section& f) {
    f.quantity(keys::barrier_stiffness(), t.fold_stiffness);
    f.quantity(keys::barrier_angle(), t.fold_angle);
  });
}

void declare_shell(Section& s, draft::CellType& t) { declare_shell_keys(s, t, &t); }

}  // namespace morula::scenarios
