#include "report/pictures/standard_pictures.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "report/pictures/annotate.h"
#include "report/pictures/png.h"
#include "report/pictures/renderer.h"
#include "report/pictures/view.h"

namespace morula::scenarios {
namespace {

struct Set {
  std::span<const Snapshot> snapshots;
  const TypeColors& type_colors;
  View view;
  std::vector<Picture> pictures;

  void add(const Snapshot& snapshot, std::string name, const std::string& what, RenderOptions options, bool cut, bool frame) {
    options.camera = cut ? view.cut : view.whole;
    if (cut && !(options.cut = place_cut(snapshot, view.cut_normal))) return;
    options.width = options.height = frame ? 640 : 900;
    options.legend_rows = 1;
    for (const Snapshot& each : frame ? snapshots : std::span(&snapshot, 1))
      options.legend_rows = std::max(options.legend_rows, rows_of_legend(each, options));
    const int margins = options.height - view_height(options);
    options.height = margins + static_cast<int>(aspect_of(options.camera, snapshots) * view_height(options));
    fit_camera(options.camera, snapshots, options.width, view_height(options));
    if (options.color_by == ColorBy::kField) options.camera.pixels_per_um *= 0.7;  // the field around the cells, too
    options.type_colors = type_colors;
    options.title = "t = " + short_time(snapshot.time);
    const std::string cells = std::to_string(snapshot.cells.size()) + (snapshot.cells.size() == 1 ? " cell, " : " cells, ");
    pictures.push_back({std::move(name), options.title + ", " + cells + (cut && options.color_by != ColorBy::kField ? "cut, " : "") + what,
                        snapshot.time, frame, render(snapshot, options)});
  }
};

std::string two_digits(std::size_t i) {
  std::string text(i < 10 ? 1 : 0, '0');
  return text += std::to_string(i);
}

/// Scale of the last state by itself; that of all states where its values are a hundredth of theirs or less, which are errors of the solver.
ColorScale own_scale(const Snapshot& last, const ColorScale& of_all) {
  const auto size = [](const ColorScale& scale) { return std::max(std::abs(scale.low), std::abs(scale.high)); };
  const ColorScale own = common_scale({&last, 1}, ColorBy::kPressure);
  return size(own) > 0.01 * size(of_all) ? own : of_all;
}

RenderOptions colored(ColorBy by, const ColorScale& scale = {}, std::size_t field = 0) {
  RenderOptions options;
  options.color_by = by;
  options.scale = scale;
  options.field = field;
  return options;
}

}  // namespace

Result<EncodedPicture> encoded(const Picture& picture) {
  MORULA_TRY_ASSIGN(std::vector<std::uint8_t> png, encode_png(picture.image));
  return EncodedPicture{picture.name,        picture.caption,      picture.time,  picture.frame,
                        picture.image.width, picture.image.height, std::move(png)};
}

std::vector<Picture> standard_pictures(std::span<const Snapshot> snapshots, const TypeColors& type_colors) {
  if (snapshots.empty()) return {};
  Set set{snapshots, type_colors, choose_view(snapshots), {}};
  std::set<std::uint16_t> types;
  std::set<BodyKind> bodies;
  for (const auto& snapshot : snapshots)
    for (const auto& cell : snapshot.cells) types.insert(cell.type), bodies.insert(cell.body);
  const bool one_type = types.size()<2, both_bodies = bodies.size()> 1;
  const ColorBy kind = one_type && both_bodies ? ColorBy::kBody : ColorBy::kType;
  const ColorScale pressure = common_scale(snapshots, ColorBy::kPressure);

  for (std::size_t i = 0; i < snapshots.size(); ++i)
    set.add(snapshots[i], "cells_" + two_digits(i), kind == ColorBy::kBody ? "coloured by body" : "coloured by type", colored(kind), false,
            true);
  for (std::size_t i = 0; i < snapshots.size(); ++i)
    set.add(snapshots[i], "cut_pressure_" + two_digits(i), "coloured by pressure", colored(ColorBy::kPressure, pressure), true, true);

  const Snapshot& last = snapshots.back();
  set.add(last, "cells_final", both_bodies ? "coloured by body" : "coloured by type",
          colored(both_bodies ? ColorBy::kBody : ColorBy::kType), false, false);
  if (both_bodies) set.add(last, "cut_body_final", "coloured by body", colored(ColorBy::kBody), true, false);
  if (!one_type)
    set.add(last, "cut_type_final", "coloured by type", colored(ColorBy::kType), true, false);
  else if (last.cells.size() > 1)
    set.add(last, "cut_cells_final", "each cell in its own colour", colored(ColorBy::kIdentity), true, false);
  set.add(last, "cut_pressure_final", "coloured by pressure", colored(ColorBy::kPressure, own_scale(last, pressure)), true, false);
  if (const ColorScale scale = common_scale({&last, 1}, ColorBy::kOutsideLaw); bodies.contains(BodyKind::kSphere) && scale.data_high > 0.01)
    set.add(last, "cut_outside_law_final", "coloured by how far they are beyond the range of the laws of spheres (1: at its end)",
            colored(ColorBy::kOutsideLaw, scale), true, false);
  for (std::size_t field = 0; field < last.fields.size(); ++field) {
    const std::string& name = last.fields[field].name;
    const ColorScale scale = field_scale(last, field);  // of both pictures: what cells see, and what is around them
    set.add(last, "cut_" + name + "_final", "coloured by the " + name + " they see", colored(ColorBy::kConcentration, scale, field), true,
            false);
    set.add(last, "slice_" + name + "_final", name + " in the plane of the cut", colored(ColorBy::kField, scale, field), true, false);
  }
  if (std::any_of(last.face_marks.begin(), last.face_marks.end(), [](std::uint8_t marks) { return marks != 0; })) {
    set.add(last, "marks_final", "faces coloured by their marks", colored(ColorBy::kMarks), false, false);
    set.add(last, "cut_marks_final", "faces coloured by their marks", colored(ColorBy::kMarks), true, false);
  }
  return std::move(set.pictures);
}

}  // namespace morula::scenarios
