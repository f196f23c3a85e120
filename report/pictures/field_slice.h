#pragma once
#include "report/pictures/coloring.h"
#include "report/pictures/rasterize.h"
#include "report/pictures/surroundings.h"

namespace morula::scenarios {

/// Concentration at a point: linear between the centres of voxels, where the grid's values hold, and as in the nearest centre on the last
/// half voxel before its border [mM]. NaN outside of the grid.
double concentration_at(const Snapshot::Grid& grid, const Vec3d& point);

/// What is drawn of a field: its concentration in the plane of the cut.
struct FieldSlice {
  const Snapshot::Grid& grid;
  const Camera& camera;  ///< of the sub-pixels
  const CutPlane& cut;
  const ColorScale& scale;
  int samples = 3;  ///< sub-pixels along each side of a pixel
};

/// The field in the plane of the cut, with the outlines of the cells and obstacles that the plane goes through, into the image from row
/// `top` on; white outside of the grid. `cells`: as drawn by rasterize with the same camera and cut.
void draw_field_slice(const FieldSlice& slice, const PixelBuffer& cells, const DrawnSurroundings& around, Image& image, int top);

}  // namespace morula::scenarios
