#pragma once
#include <vector>

#include "coupling/mechanics/term.h"
#include "coupling/traits.h"

namespace morula {

/// The own factor of a trait of every body of the scene, ghosts too; empty where no type of the model varies in it. Collective.
std::vector<double> factors_of_bodies(const World& world, Trait trait);

/// How far the owned shells are from their types in a trait, as parts; empty where no type of the model varies in it.
std::vector<double> deviations_of_shells(const Model& model, const Cells& cells, Trait trait);

}  // namespace morula
