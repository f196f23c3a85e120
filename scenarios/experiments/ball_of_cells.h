#pragma once
#include <cstdint>
#include <vector>

#include "core/vec3.h"

namespace morula::scenarios {

/// Centres of equal balls that touch without order, together a ball around the origin: random places in a ball that are drawn together until the cells are
/// jammed. Neighbours overlap by up to 0.5 % of the distance of their centres, so that they touch. Rounded to 1e-4 of the radius [µm].
std::vector<Vec3d> ball_of_cells(int count, double radius, std::uint32_t seed);

}  // namespace morula::scenarios
