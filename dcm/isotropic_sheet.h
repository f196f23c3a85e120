#pragma once
#include <string>
#include <utility>

#include "dcm/sheet_loops.h"
#include "dcm/shell_keys.h"
#include "dcm/shell_law.h"
#include "dcm/stencils/membrane.h"

namespace morula::dcm {

/// A law of the strain of a face that has two coefficients, a shear modulus G and a resistance to changes of area α (SheetModuli), chosen by one word
/// of `elastic`. What differs from law to law: `info` without parameters and keys, which follow; the word with its sentence and its own keys; what
/// the second coefficient is; and what a face beyond the range of the law is told to be.
template <template <class> class Law>
ShellLaw isotropic_sheet(LawInfo info, LayerWord word, const char* area_ratio = "α = ν/(1 − ν), from the Poisson ratio ν.",
                         const char* limit = "") {
  static const auto law = sheet_law<Law>(info.name, limit);
  info.parameters = {given_by_study("shear_modulus", "tension", "nN/µm", "Shear modulus G of the sheet, E h/(2 (1 + ν))."),
                     given_by_study("area_ratio", "number", "1", area_ratio)};
  info.keys = keys::layer(word.keys);
  word.resists_area = true;
  word.has_area_ratio = true;
  word.build = [](const LawValues& values, ShellParameters& shell) {
    const auto [shear, ratio] = SheetModuli::of(values);
    add_sheet(shell, law, {shear, ratio});
  };
  word.stiffness = &sheet_stiffness;
  return {.info = std::move(info), .stencil = LawStencil::kFace, .sheet = law, .words = {std::move(word)}};
}

}  // namespace morula::dcm
