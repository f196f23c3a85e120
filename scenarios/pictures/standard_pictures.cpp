#include "scenarios/pictures/standard_pictures.h"

#include <algorithm>
#include <numbers>
#include <set>

#include "scenarios/pictures/annotate.h"
#include "scenarios/pictures/renderer.h"

namespace morula::scenarios {
namespace {

constexpr double kAzimuth = 30.0 * std::numbers::pi / 180.0, kElevation = 22.0 * std::numbers::pi / 180.0;
constexpr double kCutAzimuth = 8.0 * std::numbers::pi / 180.0;  // the plane is seen a little from the side and from above

struct Set {
  std::span<const Snapshot> snapshots;
  std::vector<Picture> pictures;

  void add(const Snapshot& snapshot, std::string name, const std::string& what, RenderOptions options, bool cut, bool frame) {
    options.width = options.height = frame ? 640 : 900;
    options.camera = make_camera(kAzimuth, kElevation);
    fit_camera(options.camera, snapshots, options.width, view_height(options));
    if (cut) options.cut = CutPlane{middle_of(snapshot), make_camera(kCutAzimuth, 0.0).toward};
    options.title = "t = " + short_time(snapshot.time);
    const std::string caption = options.title + ", " + std::to_string(snapshot.cells.size()) + " cells, " + what;
    pictures.push_back({std::move(name), caption, snapshot.time, frame, render(snapshot, options)});
  }
};

std::string two_digits(std::size_t i) {
  std::string text(i < 10 ? 1 : 0, '0');
  return text += std::to_string(i);
}

RenderOptions colored(ColorBy by, const ColorScale& scale = {}, std::size_t field = 0) {
  RenderOptions options;
  options.color_by = by;
  options.scale = scale;
  options.field = field;
  return options;
}

}  // namespace

std::vector<Picture> standard_pictures(std::span<const Snapshot> snapshots) {
  Set set{snapshots, {}};
  if (snapshots.empty()) return {};
  std::set<std::uint16_t> types;
  std::set<BodyKind> bodies;
  for (const auto& snapshot : snapshots)
    for (const auto& cell : snapshot.cells) types.insert(cell.type), bodies.insert(cell.body);
  const bool one_type = types.size() < 2;
  const ColorBy kind = one_type && bodies.size() > 1 ? ColorBy::kBody : ColorBy::kType;
  const ColorScale pressure = common_scale(snapshots, ColorBy::kPressure);

  for (std::size_t i = 0; i < snapshots.size(); ++i)
    set.add(snapshots[i], "cells_" + two_digits(i), kind == ColorBy::kBody ? "coloured by body" : "coloured by type", colored(kind), false,
            true);
  for (std::size_t i = 0; i < snapshots.size(); ++i)
    set.add(snapshots[i], "cut_pressure_" + two_digits(i), "cut through the middle, coloured by pressure",
            colored(ColorBy::kPressure, pressure), true, true);

  const Snapshot& last = snapshots.back();
  set.add(last, "cells_final", "coloured by body", colored(ColorBy::kBody), false, false);
  set.add(last, "cut_body_final", "cut through the middle, coloured by body", colored(ColorBy::kBody), true, false);
  const ColorBy inner = one_type ? ColorBy::kIdentity : ColorBy::kType;
  set.add(last, one_type ? "cut_cells_final" : "cut_type_final",
          one_type ? "cut through the middle, each cell in its own colour" : "cut through the middle, coloured by type", colored(inner),
          true, false);
  set.add(last, "cut_pressure_final", "cut through the middle, coloured by pressure", colored(ColorBy::kPressure, pressure), true, false);
  for (std::size_t field = 0; field < last.fields.size() && field < kMaxFields; ++field) {
    const std::string& name = last.fields[field].name;
    set.add(last, "cut_" + name + "_final", "cut through the middle, coloured by " + name,
            colored(ColorBy::kConcentration, common_scale(snapshots, ColorBy::kConcentration, field, name), field), true, false);
  }
  if (std::any_of(last.face_marks.begin(), last.face_marks.end(), [](std::uint8_t marks) { return marks != 0; })) {
    set.add(last, "marks_final", "faces coloured by their marks", colored(ColorBy::kMarks), false, false);
    set.add(last, "cut_marks_final", "cut through the middle, faces coloured by their marks", colored(ColorBy::kMarks), true, false);
  }
  return std::move(set.pictures);
}

}  // namespace morula::scenarios
