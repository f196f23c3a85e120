#pragma once
#include <span>
#include <vector>

#include "core/mesh/renewal/asked_surface.h"
#include "core/mesh/renewal/cut_halves.h"

namespace morula {

/// Marks of the faces of a new mesh from those of the surface it stands for: faces are taken in the order of how much of them is covered by
/// marked faces, until the marked area is met as nearly as whole faces allow. The error is at most half the area of the last face taken; no
/// face that is not covered at all is taken. `marked` by face of the surface, not zero: marked.
std::vector<char> transfer_marks(const AskedSurface& surface, std::span<const char> marked, const SurfaceView& mesh);

}  // namespace morula
