#pragma once
#include <optional>
#include <string>

#include "report/pictures/camera.h"
#include "report/pictures/coloring.h"
#include "report/pictures/image.h"

namespace morula::scenarios {

struct RenderOptions {
  int width = 900, height = 900;  ///< of the picture [px]
  int samples = 3;                ///< sub-pixels along each side of a pixel, 1..4
  Camera camera;                  ///< see view_height() for what it is fitted to
  std::optional<CutPlane> cut;    ///< its normal must point towards the eye
  ColorBy color_by = ColorBy::kType;
  std::size_t field = 0;  ///< for ColorBy::kConcentration and kField; kField needs a cut
  ColorScale scale;       ///< for numbers; see common_scale()
  TypeColors type_colors;
  std::string title;            ///< written at the top left
  std::size_t legend_rows = 1;  ///< room at the top; what a legend needs: rows_of_legend()
  bool outlines = true;
  bool annotations = true;  ///< title, scale bar, triad, colour bar, legend
};

/// Rows of the picture that show the tissue: between the title and the scale bar [px].
int view_height(const RenderOptions& options);

/// Rows that the legend of this picture takes.
std::size_t rows_of_legend(const Snapshot& snapshot, const RenderOptions& options);

/// A picture of the snapshot with its obstacles, walls and cavities; shells are smoothed for the eye (smooth.h). Its bytes depend on the
/// arguments alone, not on threads or time. An empty snapshot gives an empty view.
Image render(const Snapshot& snapshot, const RenderOptions& options);

}  // namespace morula::scenarios
