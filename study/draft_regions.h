#pragma once
#include "coupling/model.h"
#include "study/section.h"

namespace morula::scenarios::draft {

/// A corner of something that is prescribed over time.
struct CoursePoint {
  Given<double> time, value;
};

/// Tension of a part of the surface.
struct TensionRegion {
  Given<double> tension, amplitude, period;
  PlainKeys<morula::TensionRegion> plain;
  std::vector<Named<CoursePoint>> course;
};

/// Which faces carry a mark.
struct Mark {
  Given<std::vector<std::string>> types;
  bool cone = false, band = false, ball = false, box = false, touched = false;
  Given<Vec3d> cone_axis, cone_toward, band_axis, ball_center, box_center, box_size;
  Given<bool> cone_polarity, keep;
  Given<double> angle, half_width, ball_radius;
  Given<std::string> material, when;
};

struct Lumen {
  Given<Vec3d> center;
  Given<std::string> faces, solute;
  Given<double> pressure;
  PlainKeys<morula::Lumen> plain;
  std::vector<Named<CoursePoint>> course;
};

struct ApicalSpring {
  Given<std::string> mark;
  PlainKeys<morula::ApicalSpring> plain;
};

/// What moves cells of a type beside their migration.
struct Activity {
  bool has_fluctuations = false, has_protrusion = false, has_polarity = false;
  Given<double> energy, resolve;
  Given<double> contact_area;
  PlainKeys<morula::Protrusion> protrusion;
  Given<std::string> reaction, substrate;
  Given<Vec3d> start;
};

}  // namespace morula::scenarios::draft
