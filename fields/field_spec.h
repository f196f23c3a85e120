#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/law_values.h"
#include "core/numbers/time_course.h"

namespace morula::fields {

struct Reaction;

/// What holds at one face of the domain for one concentration.
struct FaceCondition {
  enum class Kind { kValue, kNoFlux } kind = Kind::kNoFlux;
  double value = 0.0;  ///< concentration on the face [mM]
  double slope = 0.0;  ///< how it changes from the start of an interval on, where it is `value` [mM/s]

  [[nodiscard]] double at(double time) const { return value + slope * time; }
};

/// A reaction of a field with the values that a study gives its keys.
struct FieldReaction {
  std::shared_ptr<const Reaction> what;
  LawValues values;
  std::uint16_t type = 0;  ///< of the cells, of a reaction of cells; after all types come these again, for cells that are dying
};

/// One diffusing concentration: ∂c/∂t = D ∇²c − what reactions take (physics: fields_and_coupling.md, A).
struct FieldSpec {
  std::string name;
  double diffusion = 0.0;            ///< D [µm²/s]
  double initial = 0.0;              ///< [mM]
  double voxel = 0.0;                ///< wanted voxel size h [µm]; the domain is divided evenly, h never larger
  double relative_tolerance = 1e-4;  ///< of the integrator
  double interval_tolerance = 5e-3;  ///< change of any concentration in an interval, over the largest; 0: intervals of one step
  std::array<std::array<FaceCondition, 2>, 3> boundary;  ///< axis, then low and high face; ignored on periodic axes
  TimeCourse course;                                     ///< of all concentrations on faces, as a factor; empty: they stay
  std::vector<FieldReaction> reactions;                  ///< in the order of the registry
};

/// The field with the concentrations that its faces have in an interval without corners of their course, from a time on [s].
inline FieldSpec in_interval(FieldSpec spec, double from, double interval) {
  const double first = spec.course.at(from), last = spec.course.at(from + interval);
  for (auto& axis : spec.boundary)
    for (FaceCondition& face : axis) {
      face.slope = interval > 0.0 ? face.value * (last - first) / interval : 0.0;
      face.value *= first;
    }
  return spec;
}

}  // namespace morula::fields
