#include "dcm/growth.h"

#include <cmath>
#include <utility>

#include "core/ball.h"

namespace morula::dcm {

void set_rest_volume(Shells& shells, std::size_t shell, double rest_volume) {
  const double length_scale = std::cbrt(rest_volume / shells.rest_volume[shell]);
  shells.rest_volume[shell] = rest_volume;
  for (std::uint32_t edge = shells.first_edge[shell]; edge < shells.first_edge[shell + 1]; ++edge) shells.rest_length[edge] *= length_scale;
}

void turn_over(Shells& shells, const ShellMaterials& materials, double dt) {
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const double rate = materials.of(shells, s).turnover_rate;
    if (rate == 0.0) continue;
    const double keep = std::exp(-rate * dt);
    const auto edges = shells.topology(s).edges();
    const auto x = std::as_const(shells).nodes(s);
    double* rest = shells.rest_length.data() + shells.first_edge[s];
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const double length = norm(x[edges[k].j] - x[edges[k].i]);
      rest[k] = length + (rest[k] - length) * keep;
    }
  }
}

double pressure_free_reference(double volume, double tension, double bulk_modulus) {
  const double radius = ball_radius(volume);
  return volume * std::exp(2.0 * tension / (radius * bulk_modulus));
}

}  // namespace morula::dcm
