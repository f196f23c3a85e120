#pragma once
#include "coupling/model.h"

namespace morula {

/// What is nearer than `within` [µm] to the closed surface of an obstacle, without what is on its far side; where it is not convex, about that [µm³].
double room_around(const ObstacleSpec& obstacle, double within);

}  // namespace morula
