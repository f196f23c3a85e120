#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "report/pictures/coloring.h"
#include "report/pictures/rasterize.h"

namespace morula::scenarios {

/// What is seen beside cells: obstacles and walls, and the fluid of cavities in a cut.
struct DrawnSurroundings {
  std::optional<PixelBuffer> obstacles;  ///< surface: 2 × number of the obstacle, + 1 where it is cut; none: there are none
  std::vector<bool> hollow;              ///< by obstacle: cells are inside, so that its cut is only an outline
  std::vector<std::uint8_t> fluid;       ///< by pixel, 1 where a cavity is cut; empty: none is
};

/// Obstacles as the camera sees them: closed surfaces from outside, those that hold the cells and walls of the domain from within only, so
/// that they never hide the tissue. With a cut, what of the plane is within a cavity of `cells` (as drawn by rasterize with the same camera
/// and cut): the part of the plane around the cavity's centre that no cell covers, or a disc of the cavity's volume where that part is open
/// to outside.
DrawnSurroundings draw_surroundings(const Snapshot& snapshot, const Camera& camera, const std::optional<CutPlane>& cut,
                                    const PixelBuffer& cells);

/// Legend of obstacles and cavities.
std::vector<LegendEntry> surroundings_legend(const Snapshot& snapshot, bool with_cut);

inline constexpr Rgb kObstacleColor{0.62f, 0.64f, 0.67f};
inline constexpr Rgb kFluidColor{0.80f, 0.90f, 0.95f};

}  // namespace morula::scenarios
