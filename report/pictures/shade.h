#pragma once
#include <optional>
#include <span>

#include "report/pictures/image.h"
#include "report/pictures/rasterize.h"
#include "report/pictures/surroundings.h"

namespace morula::scenarios {

struct ShadeOptions {
  int samples = 3;             ///< sub-pixels along each side of a pixel
  double pixels_per_um = 1.0;  ///< of the sub-pixels
  double cell_radius = 6.0;    ///< typical; sets the reach of the ambient occlusion [µm]
  bool outlines = true;
  float cut_lightening = 0.3f;  ///< white in the colour of a cut face; little where the colour is a number to be read off
};

/// Light the surfaces and write them into the image at (left, top), `samples`² sub-pixels to a pixel.
///
/// A key light from the upper left, ambient light with screen-space occlusion, so that the furrow between cells in contact is dark
/// (estimator: McGuire et al. 2011, eq. 10, doi:10.1145/2018323.2018327; its samples are rotated from pixel to pixel, and the mean over the
/// pixels around that show the same surface counts), a slight fade with depth, and a thin dark line where one cell ends and another one
/// begins. Cut faces are flat and a little lighter.
///
/// Obstacles are grey: behind cells they are hidden, before them a thin veil, where no cell is they are seen. Fluid of cavities is a pale
/// blue.
///
/// `colors` are indexed by cell; `face_colors` by face of all shells, with nothing where the face has none of its own; empty: no face has.
void shade(const PixelBuffer& pixels, std::span<const Rgb> colors, std::span<const std::optional<Rgb>> face_colors,
           const DrawnSurroundings& around, const ShadeOptions& options, Image& image, int left, int top);

}  // namespace morula::scenarios
