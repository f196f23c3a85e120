#pragma once
#include "core/contact/surface_pair.h"

namespace morula {

/// Find the nearest faces of workspace.points[i] for all i in workspace.search, ties to the lowest face; `place` of such a point may hold a
/// guess, which only saves work.
void find_nearest_faces(const PointsEvaluation& evaluation, const PointsAgainstBody& lists, PointsWorkspace& workspace);

/// Whether a point lies inside the target, given its nearest face, the weights of the nearest point there and the way from it.
bool is_inside(const Vec3d& away, const PairBody& target, std::uint32_t face, const double (&mu)[3]);

/// Note what a search has found for point number `index`, and up to which motion it is sure; `gap` is the signed distance.
void remember(const ContactPoint& point, double gap, std::size_t index, const PointsEvaluation& evaluation, PointsAgainstBody& lists);

}  // namespace morula
