#include "study/declare.h"
#include "study/law_keys.h"

namespace morula::scenarios {
namespace {

using Q = Quantity;

void declare_adhesion_region(Section& s, draft::AdhesionRegion& r) {
  s.words({.name = "faces",
           .doc = "Marks that the faces carry, in the order of `between`; `any`: all faces, as of what has no marks (obstacles, spheres). "
                  "The second "
                  "may be left away: `any`.",
           .required = true,
           .example = "[apical, any]"},
          r.faces);
  s.quantity({.name = "adhesion",
              .doc = "Adhesion energy W of such faces, in place of that of the pair.",
              .quantity = Q::kTension,
              .required = true,
              .low = 0.0,
              .high = 10.0,
              .example = "0 mJ/m^2"},
             r.adhesion);
}

void declare_pair(Section& s, draft::ContactPair& pair) {
  s.words({.name = "between",
           .doc = "Names of two cell types, of one and an obstacle, or of one alone with itself.",
           .required = true,
           .example = "[tumour, dish]"},
          pair.between);
  KeySpec law{.name = "law",
              .doc = "Traction over the gap. ",
              .fallback = "traction",
              .example = "maugis_dugdale",
              .source = "Odenthal et al. 2013, doi:10.1371/journal.pcbi.1003267; Cuvelier et al. 2023; docs/decisions/0018"};
  for (const auto& one : s.laws().surfaces) law.doc += one->word + ": " + one->doc + ". ", law.words.push_back(one->word);
  law.doc += "The work of separation is W in each.";
  s.word(law, pair.law);
  s.quantity({.name = "range",
              .doc = "Range c of this pair, not below `contact.range`; without it that range.",
              .quantity = Q::kLength,
              .low = 0.01,
              .high = 5.0,
              .example = "0.6 um"},
             pair.range);
  s.quantity({.name = "repulsion",
              .doc = "Stiffness k_r of the repulsion of this pair; without it that of `contact`.",
              .quantity = Q::kPressurePerLength,
              .low = 0.1,
              .high = 1e5,
              .example = "100 kPa/um"},
             pair.repulsion);
  declare_law_keys(s, choosable_surface_laws(s.laws()),
                   {"between", "law", "range", "repulsion", "normal_friction", "tangential_friction", "regions"}, pair.own);
  s.quantity({.name = "normal_friction",
              .doc = "Friction against coming together and apart, per contact area; without it as `friction` of the cell types says.",
              .quantity = Q::kFrictionPerArea,
              .low = 0.0,
              .high = 1e6,
              .example = "5e10 N s/m^3"},
             pair.normal_friction);
  s.quantity({.name = "tangential_friction",
              .doc = "Friction against sliding, per contact area; without it as `friction` of the cell types says. Of both, spheres have "
                     "the part that `cbm: {friction: ...}` says.",
              .quantity = Q::kFrictionPerArea,
              .low = 0.0,
              .high = 1e6,
              .example = "5e10 N s/m^3"},
             pair.tangential_friction);
  s.list({.name = "regions",
          .doc = "Adhesion by part of the surface: of these the first holds whose marks both faces carry; other faces have the adhesion of "
                 "the pair.",
          .example = "[{faces: [apical, any], adhesion: 0 mJ/m^2}]"},
         pair.regions, &declare_adhesion_region);
}

}  // namespace

void declare_contact(Section& s, draft::Contact& contact) {
  s.quantity(
      {.name = "range",
       .doc = "Range c of the adhesive traction. A mesh of edge L needs c between L/4 and L/2.",
       .quantity = Q::kLength,
       .fallback = "0.5 um",
       .low = 0.01,
       .high = 5.0,
       .example = "0.5 um",
       .source = "measured: adhesion energy recovered within 3 % with c >= L/4 and 3 points a face (162 nodes, R = 6 um: L = 1.8 um)"},
      contact.range);
  s.quantity(
      {.name = "repulsion",
       .doc = "Stiffness k_r of the repulsion of overlapping surfaces, pressure per depth. `auto`: 100 kPa/um, or 60 W/c^2 of a pair "
              "with so strong an adhesion W, where surfaces of a cell that divides adhere with twice their tension while they are new.",
       .quantity = Q::kPressurePerLength,
       .fallback = "auto",
       .low = 0.1,
       .high = 1e5,
       .specials = {{"auto", 0.0}},
       .example = "100 kPa/um",
       .source = "measured: overlap below 0.15 um at 1 kPa and W = 0.5 mJ/m^2; below 0.12 um with more adhesion (decision 0095)"},
      contact.repulsion);
  s.word({.name = "friction",
          .doc = "Friction of surfaces in contact. simple: by the relative velocity of the two points of a contact, which is not zero "
                 "where a pair of "
                 "cells turns as a whole, since the points lie apart; objective: that part is taken off.",
          .fallback = "simple",
          .words = {"simple", "objective"},
          .example = "objective",
          .source = "chosen: cheaper, and the difference matters where pairs of cells turn freely"},
         contact.friction);
  s.whole({.name = "points",
           .doc = "Quadrature points on a face, 3 or 4; 4 for strong adhesion (W >= tension) in clusters.",
           .fallback = "3",
           .low = 3,
           .high = 4,
           .example = "3",
           .source = "measured"},
          contact.points);
  s.list({.name = "pairs",
          .doc = "What is special about the contact of two materials; adhesion itself stands with the cell types.",
          .example = "[{between: [tumour, dish], law: maugis_dugdale, modulus: 20 kPa}]"},
         contact.pairs, &declare_pair);
}

}  // namespace morula::scenarios
