#pragma once
#include "study/build.h"

namespace morula::scenarios {

/// An entry of `initial` with `meshes`: its settings, and whether its files hold cells that can be used (E545–E550, E620–E625). Reads the
/// files and, where asked to, remeshes the cells once.
void build_meshes(BuildContext& context, draft::Initial& draft, const Place& place, InitialCells& cells);

/// Whether all cells of a type bring their own surface, now and later: then the number of nodes of the type has no meaning.
bool only_from_meshes(const Study& study, std::size_t type);

}  // namespace morula::scenarios
