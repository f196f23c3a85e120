#include "cbm/contact_on.h"

#include <algorithm>
#include <cmath>

namespace morula::cbm {

ContactOn contact_on(double radius, const SurfaceCurvature& surface) noexcept {
  if (surface.mean == 0.0 && surface.gaussian == 0.0) return {radius};
  const double apart = std::sqrt(std::max(0.0, surface.mean * surface.mean - surface.gaussian));
  const double least = 1.0 / (kMostOfHollow * radius), middle = 1.0 / radius + surface.mean;
  const double first = std::max(least, middle + apart), second = std::max(least, middle - apart), ratio = first / second;
  const double f1 = 1.0 - std::pow(std::pow(ratio, 0.0602) - 1.0, 1.456), f2 = 1.0 - std::pow(std::pow(ratio, 0.0684) - 1.0, 1.531);
  return {1.0 / (std::sqrt(first * second) * f2 * f2 * f2), f1 * f1 * f2 * f2};
}

}  // namespace morula::cbm
