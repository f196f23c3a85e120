#include "report/pictures/coloring.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "report/pictures/camera.h"
#include "report/pictures/palette.h"

namespace morula::scenarios {
namespace {

Rgb body_color(BodyKind body) { return scenarios::body_color(body == BodyKind::kShell); }

Rgb type_color(std::size_t type, const TypeColors& given) {
  return type < given.size() && given[type] ? *given[type] : categorical_color(type);
}

constexpr Rgb kUnmarked{0.80f, 0.80f, 0.82f};

std::string type_name(const Snapshot& snapshot, std::size_t type) {
  return type < snapshot.type_names.size() ? snapshot.type_names[type] : "type " + std::to_string(type);
}

void choose_unit(ColorScale& scale, ColorBy by) {
  const double largest = std::max(std::abs(scale.low), std::abs(scale.high));
  if (by == ColorBy::kPressure) {
    const bool small = largest < 2.0;
    scale.unit = small ? "Pa" : "kPa";
    scale.per_unit = small ? 1e3 : 1.0;
  } else if (by == ColorBy::kVolume) {
    scale.unit = "µm³";
  } else if (by == ColorBy::kOutsideLaw) {
    scale.unit = "";
  } else {
    const bool small = largest < 0.02;
    scale.unit = small ? "µM" : "mM";
    scale.per_unit = small ? 1e3 : 1.0;
  }
}

// Both ends to multiples of a round step.
void widen(ColorScale& scale) {
  const double span = scale.high - scale.low;
  const double size = std::max(std::abs(scale.low), std::abs(scale.high));
  if (span <= 1e-6 * size) {  // all the same: a scale from zero
    if (size == 0.0) scale.high = 1.0;
    (scale.low < 0.0 ? scale.high : scale.low) = 0.0;
  }
  const double step = nice_below((scale.high - scale.low) / 4.0);
  constexpr double kNothing = 1e-3;  // of a step: no reason to widen by a whole one
  scale.low = std::floor(scale.low / step + kNothing) * step;
  scale.high = std::ceil(scale.high / step - kNothing) * step;
}

/// The least range of a quantity that is worth a scale: 1 Pa, the end of the range of a law; others have none. Values below a hundredth of it are
/// what the solver leaves of nothing.
double least_range(ColorBy by) { return by == ColorBy::kOutsideLaw ? 1.0 : by == ColorBy::kPressure ? 1e-3 : 0.0; }

/// The scale that suits these values, those that are not numbers left out; `beyond` is the part of them that may lie outside at each end.
ColorScale scale_of(std::vector<double> values, double beyond, double least) {
  ColorScale scale;
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  scale.data_low = 1.0;  // no data
  if (values.empty()) return scale;
  std::sort(values.begin(), values.end());
  scale.data_low = values.front();
  scale.data_high = values.back();
  const auto percentile = [&](double p) {
    return values[static_cast<std::size_t>(std::lround(p * static_cast<double>(values.size() - 1)))];
  };
  scale.low = percentile(beyond);
  scale.high = percentile(1.0 - beyond);
  if (std::max(std::abs(scale.low), std::abs(scale.high)) < 0.01 * least) {
    scale.low = 0.0, scale.high = least;
    return scale;
  }
  if (scale.low < 0.0 && -scale.low > 0.1 * scale.high) {
    scale.diverging = true;
    scale.high = std::max(-scale.low, scale.high);
    scale.low = -scale.high;
  } else if (scale.low > 0.0 && scale.low < 0.35 * scale.high) {
    scale.low = 0.0;  // zero is near: show it
  }
  widen(scale);
  return scale;
}

// A little lighter or darker from cell to cell, so that neighbours of one kind differ: −1..1 from the id.
Rgb varied(const Rgb& color, CellId id) {
  const std::uint64_t h = (id.bits() * 0x9E3779B97F4A7C15ull) >> 40;
  const float t = static_cast<float>(h & 0xFFFF) / 32767.5f - 1.0f;
  return t > 0.0f ? mix(color, {1.0f, 1.0f, 1.0f}, 0.16f * t) : color * (1.0f + 0.10f * t);
}

}  // namespace

bool is_number(ColorBy by) {
  return by == ColorBy::kPressure || by == ColorBy::kVolume || by == ColorBy::kOutsideLaw || by == ColorBy::kConcentration ||
         by == ColorBy::kField;
}

namespace {

/// How far a cell is beyond the range of the laws of spheres, as results.h5 calls it.
constexpr auto kOutsideLaw = "outside_law";

/// A number that the snapshot tells of its cells by this name; no number where it does not.
double value_of_variable(const Snapshot& snapshot, const std::string& name, std::size_t cell) {
  for (const Snapshot::Variable& variable : snapshot.variables)
    if (variable.name == name) return variable.values[cell];
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double color_value(const Snapshot& snapshot, std::size_t cell, ColorBy by, std::size_t field) {
  switch (by) {
    case ColorBy::kPressure:
      return snapshot.cells[cell].pressure;
    case ColorBy::kVolume:
      return snapshot.cells[cell].volume;
    case ColorBy::kOutsideLaw:
      return value_of_variable(snapshot, kOutsideLaw, cell);
    case ColorBy::kConcentration:
      return field < snapshot.fields.size() ? value_of_variable(snapshot, "concentration/" + snapshot.fields[field].name, cell)
                                            : std::numeric_limits<double>::quiet_NaN();
    default:
      return 0.0;
  }
}

ColorScale common_scale(std::span<const Snapshot> snapshots, ColorBy by, std::size_t field, const std::string& name) {
  if (!is_number(by)) return {};
  std::vector<double> values;
  for (const Snapshot& snapshot : snapshots)
    for (std::size_t c = 0; c < snapshot.cells.size(); ++c) values.push_back(color_value(snapshot, c, by, field));
  ColorScale scale = scale_of(std::move(values), 0.01, least_range(by));
  scale.quantity = by == ColorBy::kPressure     ? "pressure"
                   : by == ColorBy::kVolume     ? "volume"
                   : by == ColorBy::kOutsideLaw ? "outside law"
                                                : name;
  choose_unit(scale, by);
  return scale;
}

ColorScale field_scale(const Snapshot& snapshot, std::size_t field) {
  if (field >= snapshot.fields.size()) return {};
  ColorScale scale = scale_of(snapshot.fields[field].concentration, 0.0, least_range(ColorBy::kField));
  scale.quantity = snapshot.fields[field].name;
  choose_unit(scale, ColorBy::kField);
  return scale;
}

Rgb scale_color(const ColorScale& scale, double value) {
  if (!std::isfinite(value)) return {0.75f, 0.75f, 0.75f};
  const double t = scale.high > scale.low ? (value - scale.low) / (scale.high - scale.low) : 0.5;
  return scale.diverging ? diverging_color(t) : sequential_color(t);
}

std::vector<Rgb> cell_colors(const Snapshot& snapshot, ColorBy by, const ColorScale& scale, std::size_t field,
                             const TypeColors& type_colors) {
  std::vector<Rgb> colors;
  colors.reserve(snapshot.cells.size());
  for (std::size_t c = 0; c < snapshot.cells.size(); ++c) {
    const Snapshot::Cell& cell = snapshot.cells[c];
    switch (by) {
      case ColorBy::kType:
        colors.push_back(varied(type_color(cell.type, type_colors), cell.id));
        break;
      case ColorBy::kBody:
        colors.push_back(varied(body_color(cell.body), cell.id));
        break;
      case ColorBy::kIdentity:
        colors.push_back(identity_color(cell.id));
        break;
      case ColorBy::kMarks:
        colors.push_back(varied(kUnmarked, cell.id));
        break;
      default:
        colors.push_back(scale_color(scale, color_value(snapshot, c, by, field)));
    }
  }
  return colors;
}

std::vector<std::optional<Rgb>> face_colors(const Snapshot& snapshot, ColorBy by) {
  std::vector<std::optional<Rgb>> colors;
  const MarkSets marks = snapshot.marks();
  for (std::size_t face = 0; by == ColorBy::kMarks && face < marks.size(); ++face) {
    Rgb sum;
    int count = 0;
    for (std::size_t k = 0; k < snapshot.mark_names.size(); ++k)
      if (marks.has(face, static_cast<int>(k))) sum = sum + mark_color(k), ++count;
    colors.push_back(count > 0 ? std::optional(sum * (1.0f / static_cast<float>(count))) : std::nullopt);
  }
  return colors;
}

std::vector<LegendEntry> legend_entries(const Snapshot& snapshot, ColorBy by, const TypeColors& type_colors) {
  std::vector<LegendEntry> entries;
  if (by == ColorBy::kType) {
    std::vector<std::size_t> count(65536);
    for (const auto& cell : snapshot.cells) ++count[cell.type];
    for (std::size_t type = 0; type < count.size(); ++type)
      if (count[type] > 0)
        entries.push_back({type_name(snapshot, type) + " (" + std::to_string(count[type]) + ")", type_color(type, type_colors)});
  } else if (by == ColorBy::kBody) {
    std::array<std::size_t, 2> count{};
    for (const auto& cell : snapshot.cells) ++count[cell.body == BodyKind::kShell ? 1 : 0];
    if (count[1]) entries.push_back({"shell (" + std::to_string(count[1]) + ")", body_color(BodyKind::kShell)});
    if (count[0]) entries.push_back({"sphere (" + std::to_string(count[0]) + ")", body_color(BodyKind::kSphere)});
  } else if (by == ColorBy::kMarks) {
    for (std::size_t k = 0; k < snapshot.mark_names.size(); ++k)
      if (snapshot.marks().any_has(static_cast<int>(k))) entries.push_back({snapshot.mark_names[k], mark_color(k)});
  }
  return entries;
}

}  // namespace morula::scenarios
