#include "dcm/growth.h"

#include <cmath>
#include <numbers>

namespace morula::dcm {

void set_rest_volume(Shells& shells, std::size_t shell, double rest_volume) {
  const double length_scale = std::cbrt(rest_volume / shells.rest_volume[shell]);
  shells.rest_volume[shell] = rest_volume;
  for (std::uint32_t edge = shells.first_edge[shell]; edge < shells.first_edge[shell + 1]; ++edge) shells.rest_length[edge] *= length_scale;
}

double pressure_free_reference(double volume, double tension, double bulk_modulus) {
  const double radius = std::cbrt(3.0 * volume / (4.0 * std::numbers::pi));
  return volume * std::exp(2.0 * tension / (radius * bulk_modulus));
}

}  // namespace morula::dcm
