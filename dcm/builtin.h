#pragma once
#include <vector>

#include "core/law_info.h"
#include "dcm/shells.h"

namespace morula::dcm {

/// On what a law acts: what its energy (or friction) is a function of.
enum class LawStencil { kEdge, kHinge, kFace, kCell, kNode };

/// A law of the single-cell mechanics and how to switch it on.
struct ShellLaw {
  LawInfo info;
  LawStencil stencil = LawStencil::kEdge;
  bool conservative = true;                     ///< has an energy; otherwise it is a friction
  bool zero_in_reference = true;                ///< no force in the reference shape at its rest volume
  bool in_operator = true;                      ///< adds to the matrix of the implicit step
  double ShellParameters::*strength = nullptr;  ///< the coefficient that the law grows with; 0 switches the law off
};

/// All laws of this folder, in the order of the documentation. Tests, the law reference and `morula explain` walk this list.
const std::vector<ShellLaw>& shell_laws();

}  // namespace morula::dcm
