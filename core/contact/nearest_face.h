#pragma once
#include "core/contact/surface_pair.h"

namespace morula {

/// Search the candidates of source face `source_place` for the face nearest to `point`, ties to the lowest face. `guess` only saves work.
FoundFace find_nearest_face(const Vec3d& point, std::size_t source_place, std::uint16_t guess, const PointsEvaluation& evaluation,
                              const PointsAgainstBody& lists);

/// Whether a point lies inside the target, given its nearest face, the weights of the nearest point there and the way from it.
bool is_inside(const Vec3d& away, const PairBody& target, std::uint32_t face, const double (&mu)[3]);

/// Note what a search has found for point number `index`, and up to which motion it is sure; `gap` is the signed distance.
void remember(const FoundFace& nearest, double gap, std::size_t index, const PointsEvaluation& evaluation, PointsAgainstBody& lists);

}  // namespace morula
