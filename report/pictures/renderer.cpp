#include "report/pictures/renderer.h"

#include <algorithm>
#include <cmath>

#include "report/pictures/annotate.h"
#include "report/pictures/field_slice.h"
#include "report/pictures/font.h"
#include "report/pictures/rasterize.h"
#include "report/pictures/shade.h"
#include "report/pictures/smooth.h"
#include "report/pictures/surroundings.h"

namespace morula::scenarios {
namespace {

constexpr Rgb kWhite{1.0f, 1.0f, 1.0f};
constexpr Rgb kInk{0.13f, 0.14f, 0.18f};

double cap_height(const RenderOptions& options) { return std::max(8.0, options.width / 72.0); }
int top_margin(const RenderOptions& options) {
  const double rows = 3.5 + kLegendLine * (static_cast<double>(options.legend_rows) - 1.0);
  return options.annotations ? static_cast<int>(rows * cap_height(options)) : 0;
}
int bottom_margin(const RenderOptions& options) { return options.annotations ? static_cast<int>(7.4 * cap_height(options)) : 0; }
double margin_of(const RenderOptions& options) { return 1.8 * cap_height(options); }

double median_radius(const Snapshot& snapshot) {
  std::vector<double> radii;
  for (const auto& cell : snapshot.cells)
    if (cell.radius > 0.0) radii.push_back(cell.radius);
  if (radii.empty()) return 5.0;
  std::nth_element(radii.begin(), radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2), radii.end());
  return radii[radii.size() / 2];
}

std::vector<LegendEntry> whole_legend(const Snapshot& snapshot, const RenderOptions& options) {
  std::vector<LegendEntry> legend = legend_entries(snapshot, options.color_by, options.type_colors);
  constexpr std::size_t kMost = 24;
  if (legend.size() > kMost) {
    const std::string more = "and " + std::to_string(legend.size() - kMost + 1) + " more";
    legend.resize(kMost - 1);
    legend.push_back({more, kWhite});
  }
  for (LegendEntry& entry : surroundings_legend(snapshot, options.cut.has_value())) legend.push_back(std::move(entry));
  return legend;
}

/// Rows of the legend: beside the title and below it.
std::vector<std::size_t> arranged(std::span<const LegendEntry> legend, const RenderOptions& options) {
  constexpr double kTitle = 14.0;  // "t = 119.9 min", whatever the time is: pictures of a row have the same legend
  const double cap = cap_height(options), width = options.width - 2.0 * margin_of(options);
  return legend_rows(legend, width - kTitle * cap, width, cap);
}

void annotate(const Snapshot& snapshot, const RenderOptions& options, Image& image) {
  const double cap = cap_height(options), margin = margin_of(options), base = options.height - 4.0 * cap, bar_width = 0.24 * options.width;
  draw_text(image, margin, margin + cap, options.title, 1.08 * cap, kInk);
  draw_scale_bar(image, margin, base, make_scale_bar(options.camera.pixels_per_um, bar_width), cap);
  draw_triad(image, margin + bar_width + 3.0 * cap, base + 0.8 * cap, 2.4 * cap, options.camera, 0.9 * cap);
  if (is_number(options.color_by)) draw_color_bar(image, options.width - 2.0 * margin, base, 0.38 * options.width, options.scale, cap);
  const std::vector<LegendEntry> legend = whole_legend(snapshot, options);
  draw_legend(image, options.width - margin, margin, legend, arranged(legend, options), cap);
}

void draw_cells(const Snapshot& snapshot, const RenderOptions& options, const PixelBuffer& pixels, const DrawnSurroundings& around,
                int samples, Image& image) {
  auto colors = cell_colors(snapshot, options.color_by, options.scale, options.field, options.type_colors);
  for (const Snapshot::Nucleus& nucleus : snapshot.nuclei) colors.push_back(colors[nucleus.cell] * 0.6f);
  for (const Snapshot::NuclearShell& nucleus : snapshot.nuclear_shells) colors.push_back(colors[nucleus.cell] * 0.6f);
  const float lightening = is_number(options.color_by) ? 0.06f : options.color_by == ColorBy::kIdentity ? 0.12f : 0.3f;
  shade(pixels, colors, face_colors(snapshot, options.color_by), around,
        {samples, options.camera.pixels_per_um * samples, median_radius(snapshot), options.outlines, lightening}, image, 0,
        top_margin(options));
}

}  // namespace

std::size_t rows_of_legend(const Snapshot& snapshot, const RenderOptions& options) {
  return std::max<std::size_t>(1, arranged(whole_legend(snapshot, options), options).size());
}

int view_height(const RenderOptions& options) { return std::max(1, options.height - top_margin(options) - bottom_margin(options)); }

Image render(const Snapshot& coarse, const RenderOptions& options) {
  const Snapshot snapshot = smoothed(coarse, smoothing_level(coarse, options.camera.pixels_per_um));
  Image image(options.width, options.height, kWhite);
  const int samples = std::clamp(options.samples, 1, 4), rows = view_height(options);
  Camera camera = options.camera;
  camera.pixels_per_um *= samples;
  PixelBuffer pixels(options.width * samples, rows * samples);
  rasterize(snapshot, camera, options.cut, pixels);
  const DrawnSurroundings around = draw_surroundings(snapshot, camera, options.cut, pixels);
  if (options.color_by == ColorBy::kField) {
    if (options.cut && options.field < snapshot.fields.size())
      draw_field_slice({snapshot.fields[options.field], camera, *options.cut, options.scale, samples}, pixels, around, image,
                       top_margin(options));
  } else {
    draw_cells(snapshot, options, pixels, around, samples, image);
  }
  if (options.annotations) annotate(snapshot, options, image);
  return image;
}

}  // namespace morula::scenarios
