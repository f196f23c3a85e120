#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "report/pictures/coloring.h"
#include "report/pictures/image.h"
#include "results/snapshot.h"

namespace morula::scenarios {

/// A picture with what is said about it.
struct Picture {
  std::string name;  ///< file name without folder and ending: "cut_pressure_03"
  std::string caption;
  double time = 0.0;   ///< [s]
  bool frame = false;  ///< one of a row over time; else a large picture of the last snapshot
  Image image;
};

/// A picture as files hold it.
struct EncodedPicture {
  std::string name, caption;  ///< as those of Picture
  double time = 0.0;          ///< [s]
  bool frame = false;
  int width = 0, height = 0;  ///< [pixels]
  std::vector<std::uint8_t> png;
};
/// kResources where libpng has no memory.
Result<EncodedPicture> encoded(const Picture& picture);

/// The pictures every run gets. `snapshots` in order of time, usually at 0, 25, 50, 75 and 100 % of a run.
///
/// Frames (640 pixels wide) of each snapshot: the whole tissue by type (by body where there is but one type and both bodies), and cut by
/// pressure. Large (900 pixels wide) of the last: whole and cut by body where there are both, cut by type or cell, cut by pressure, and
/// each field: as cells see it, and as it is in the plane of the cut. The view suits the tissue (view.h); a picture whose cut meets no cell
/// is left out. Cameras are the same in all, fitted to the largest snapshot, and colour scales in all frames, so that they compare; the
/// large pictures have scales of their own, since a state far from rest at the start would leave them one colour. `type_colors`: as the
/// study gives them. Deterministic.
std::vector<Picture> standard_pictures(std::span<const Snapshot> snapshots, const TypeColors& type_colors = {});

}  // namespace morula::scenarios
