#pragma once
#include <optional>
#include <span>

#include "report/pictures/camera.h"

namespace morula::scenarios {

/// How a tissue lies in space, which decides from where it is looked at.
enum class Layout {
  kBall,   ///< about as far in all directions: from the side and a little from above; beside obstacles straight from the front
  kLayer,  ///< much thinner along one direction: along that direction, a horizontal layer from above
  kRow,    ///< much longer along one direction: from the side, the row across the picture
};

/// Cameras and cut of a set of snapshots, the same for all of them.
struct View {
  Layout layout = Layout::kBall;
  Camera whole, cut;  ///< not yet fitted
  Vec3d cut_normal;   ///< unit, towards the eye of `cut`
};

/// The view that suits the extent of the cells in all snapshots together. Every cut is seen face to face: of balls and rows along x the
/// plane across y.
View choose_view(std::span<const Snapshot> snapshots);

/// A plane across `normal` that goes through cells: through the middle of the tissue, or where that shows less than 60 % of the area of
/// cells that the best plane shows, that one. Nothing when no cell can be cut.
std::optional<CutPlane> place_cut(const Snapshot& snapshot, const Vec3d& normal);

/// Height over width of what the camera sees of the cells of all snapshots, within 0.25 and 1.
double aspect_of(const Camera& camera, std::span<const Snapshot> snapshots);

}  // namespace morula::scenarios
