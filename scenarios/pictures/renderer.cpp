#include "scenarios/pictures/renderer.h"

#include <algorithm>
#include <cmath>

#include "scenarios/pictures/annotate.h"
#include "scenarios/pictures/font.h"
#include "scenarios/pictures/rasterize.h"
#include "scenarios/pictures/shade.h"
#include "scenarios/pictures/smooth.h"
#include "scenarios/pictures/surroundings.h"

namespace morula::scenarios {
namespace {

constexpr Rgb kWhite{1.0f, 1.0f, 1.0f};
constexpr Rgb kInk{0.13f, 0.14f, 0.18f};

double cap_height(const RenderOptions& options) { return std::max(8.0, options.width / 72.0); }
int top_margin(const RenderOptions& options) { return options.annotations ? static_cast<int>(3.2 * cap_height(options)) : 0; }
int bottom_margin(const RenderOptions& options) { return options.annotations ? static_cast<int>(6.0 * cap_height(options)) : 0; }

double median_radius(const Snapshot& snapshot) {
  std::vector<double> radii;
  for (const auto& cell : snapshot.cells)
    if (cell.radius > 0.0) radii.push_back(cell.radius);
  if (radii.empty()) return 5.0;
  std::nth_element(radii.begin(), radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2), radii.end());
  return radii[radii.size() / 2];
}

void annotate(const Snapshot& snapshot, const RenderOptions& options, Image& image) {
  const double cap = cap_height(options), margin = 1.8 * cap;
  draw_text(image, margin, margin + cap, options.title, 1.08 * cap, kInk);
  const ScaleBar bar = make_scale_bar(options.camera.pixels_per_um, 0.24 * options.width);
  draw_scale_bar(image, margin, options.height - margin - 1.2 * cap, bar, cap);
  if (is_number(options.color_by))
    draw_color_bar(image, options.width - 2.0 * margin, options.height - margin - 1.2 * cap, 0.38 * options.width, options.scale, cap);
  std::vector<LegendEntry> legend = legend_entries(snapshot, options.color_by, options.type_colors);
  for (LegendEntry& entry : surroundings_legend(snapshot, options.cut.has_value())) legend.push_back(std::move(entry));
  draw_legend(image, options.width - margin, margin, legend, cap);
}

}  // namespace

int view_height(const RenderOptions& options) { return std::max(1, options.height - top_margin(options) - bottom_margin(options)); }

Image render(const Snapshot& coarse, const RenderOptions& options) {
  const Snapshot snapshot = smoothed(coarse, smoothing_level(coarse, options.camera.pixels_per_um));
  Image image(options.width, options.height, kWhite);
  const int samples = std::clamp(options.samples, 1, 4), rows = view_height(options);
  Camera camera = options.camera;
  camera.pixels_per_um *= samples;
  PixelBuffer pixels(options.width * samples, rows * samples);
  rasterize(snapshot, camera, options.cut, pixels);
  const Surroundings around = draw_surroundings(snapshot, camera, options.cut, pixels);
  auto colors = cell_colors(snapshot, options.color_by, options.scale, options.field, options.type_colors);
  for (const Snapshot::Nucleus& nucleus : snapshot.nuclei) colors.push_back(colors[nucleus.cell] * 0.6f);
  for (const Snapshot::NuclearShell& nucleus : snapshot.nuclear_shells) colors.push_back(colors[nucleus.cell] * 0.6f);
  shade(pixels, colors, mark_colors(snapshot, options.color_by), around,
        {samples, camera.pixels_per_um, median_radius(snapshot), options.outlines,
         is_number(options.color_by)              ? 0.06f
         : options.color_by == ColorBy::kIdentity ? 0.12f
                                                  : 0.3f},
        image, 0, top_margin(options));
  if (options.annotations) annotate(snapshot, options, image);
  return image;
}

}  // namespace morula::scenarios
