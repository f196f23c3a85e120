#include "coupling/face_regions.h"

#include <cmath>
#include <numbers>

namespace morula {

double TensionRegion::at(double time) const {
  const double wave = period > 0.0 ? 1.0 + amplitude * std::sin(2.0 * std::numbers::pi * time / period + phase) : 1.0;
  return tension * course.at(time) * wave;
}

double RegionalTension::of_face(double own, MarkSet marks, double contact, double time) const {
  double free = own, lateral = 0.0;
  bool marked = false, has_contact_tension = false;
  for (const TensionRegion& region : regions) {
    if (region.mark == TensionRegion::kLateral) {
      lateral = region.at(time);
      has_contact_tension = true;
    } else if (region.mark == TensionRegion::kWhole) {
      if (!marked) free = region.at(time);
    } else if (!marked && has_mark(marks, region.mark)) {
      free = region.at(time);
      marked = true;
    }
  }
  return has_contact_tension ? free + contact * (lateral - free) : free;
}

}  // namespace morula
