#pragma once
#include <memory>

#include "core/mesh/topology.h"

namespace morula::scenarios {

/// The icosphere mapped to the resting shape of a red blood cell, as a stress-free shape: with R the disc's radius and q = (x² + y²)/R²,
/// z = ±(R/2) √(1 − q) (0.207161 + 2.002558 q − 1.122762 q²); the disc's axis is z (Evans & Fung 1972, doi:10.1016/0026-2862(72)90069-6).
/// As for every reference shape the enclosed volume of the mesh is 1. For R = 3.91 µm the true surface has 94.1 µm³ and 134.1 µm².
std::shared_ptr<const ReferenceShape> biconcave_shape(const ReferenceShape& icosphere);

}  // namespace morula::scenarios
