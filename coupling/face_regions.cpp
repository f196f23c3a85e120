#include "coupling/face_regions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace morula {

double TensionRegion::at(double time) const {
  const double wave = period > 0.0 ? 1.0 + amplitude * std::sin(2.0 * std::numbers::pi * time / period + phase) : 1.0;
  return tension * course.at(time) * wave;
}

double TensionRegion::least() const {
  const double factor = course.empty() ? 1.0 : *std::ranges::min_element(course.value);
  return tension * factor * (1.0 - (period > 0.0 ? amplitude : 0.0));
}

bool RegionalTension::varies() const { return std::ranges::any_of(regions, &TensionRegion::varies); }

const TensionRegion* RegionalTension::lateral() const {
  const auto at = std::ranges::find(regions, TensionRegion::kLateral, &TensionRegion::mark);
  return at != regions.end() ? &*at : nullptr;
}

double RegionalTension::of_face(double own, MarkSet marks, double contact, double time) const {
  double free = own;
  bool marked = false;
  for (const TensionRegion& region : regions) {
    if (region.mark == TensionRegion::kWhole) {
      if (!marked) free = region.at(time);
    } else if (!marked && region.mark != TensionRegion::kLateral && has_mark(marks, region.mark)) {
      free = region.at(time);
      marked = true;
    }
  }
  return eases_contact() ? free + contact * (lateral()->at(time) - free) : free;
}

double RegionalTension::drop_in_contact(double own, double time) const {
  return lateral_adheres && lateral() != nullptr ? of_face(own, {}, 0.0, time) - lateral()->at(time) : 0.0;
}

}  // namespace morula
