#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report/pictures/image.h"
#include "results/snapshot.h"

namespace morula::scenarios {

/// kConcentration: what each cell sees; kField: the concentration in the plane of the cut itself.
enum class ColorBy { kType, kBody, kIdentity, kPressure, kVolume, kOutsideLaw, kConcentration, kField, kMarks };

/// How a number of a cell becomes a colour, and what the colour bar says.
struct ColorScale {
  double low = 0.0, high = 1.0;            ///< internal units; what lies outside gets the colour of the end
  bool diverging = false;                  ///< colours part at zero: low = −high
  std::string quantity;                    ///< "pressure"
  std::string unit;                        ///< of the labels: "Pa"
  double per_unit = 1.0;                   ///< internal value × this = number on the bar
  double data_low = 0.0, data_high = 0.0;  ///< least and largest value of the data; internal units, no data: low > high
};

/// Colours that the study gives to its cell types, by type; where it gives none: those of the palette.
using TypeColors = std::vector<std::optional<Rgb>>;

/// A line of a legend.
struct LegendEntry {
  std::string text;
  Rgb color;
};

/// Whether `by` gives a number (colour bar) or a kind (legend).
bool is_number(ColorBy by);

/// The value that a cell is coloured by; `field` is the field's number for kConcentration.
double color_value(const Snapshot& snapshot, std::size_t cell, ColorBy by, std::size_t field);

/// One scale for all of these snapshots, so that their pictures compare: from the 1st to the 99th percentile of all cells, widened to
/// round numbers; diverging when negative values matter, so that zero is white and both signs have their own colours. `name`: of the
/// field.
ColorScale common_scale(std::span<const Snapshot> snapshots, ColorBy by, std::size_t field = 0, const std::string& name = "");

/// Scale of a field from its least to its largest concentration in the snapshot, widened to round numbers.
ColorScale field_scale(const Snapshot& snapshot, std::size_t field);

/// Colour of a scale at a value.
Rgb scale_color(const ColorScale& scale, double value);

/// Colour of every cell; kinds vary a little in lightness from cell to cell, so that neighbours can be told apart.
std::vector<Rgb> cell_colors(const Snapshot& snapshot, ColorBy by, const ColorScale& scale, std::size_t field = 0,
                             const TypeColors& type_colors = {});

/// Colours of the faces by their marks, nothing for those without; empty unless pictures are coloured by them. A face with several has their mean.
std::vector<std::optional<Rgb>> face_colors(const Snapshot& snapshot, ColorBy by);

/// Legend for kinds: the cell types that occur, the bodies, or the marks; empty otherwise.
std::vector<LegendEntry> legend_entries(const Snapshot& snapshot, ColorBy by, const TypeColors& type_colors = {});

}  // namespace morula::scenarios
