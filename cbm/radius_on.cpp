#include "cbm/radius_on.h"

#include <algorithm>
#include <cmath>

namespace morula::cbm {

double radius_on(double radius, double mean_curvature, double gaussian_curvature) noexcept {
  if (mean_curvature == 0.0 && gaussian_curvature == 0.0) return radius;
  const double apart = std::sqrt(std::max(0.0, mean_curvature * mean_curvature - gaussian_curvature));
  const double least = 1.0 / (kMostOfHollow * radius), middle = 1.0 / radius + mean_curvature;
  const double first = std::max(least, middle + apart), second = std::max(least, middle - apart);
  const double factor = 1.0 - std::pow(std::pow(first / second, 0.0684) - 1.0, 1.531);
  return 1.0 / (std::sqrt(first * second) * factor * factor * factor);
}

}  // namespace morula::cbm
