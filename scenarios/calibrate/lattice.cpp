#include "scenarios/calibrate/lattice.h"

#include <cmath>
#include <numbers>

#include "cbm/laws/sphere_caps.h"

namespace morula::calibrate {

LatticeGeometry lattice_geometry(Lattice lattice, double volume_ratio) {
  constexpr double kBall = 4.0 / 3.0 * std::numbers::pi;
  LatticeGeometry out;
  out.room = volume_ratio * kBall;
  if (lattice == Lattice::kFaceCentred) {
    const double d = std::cbrt(std::numbers::sqrt2 * out.room);
    out.shells = {{{12, d}, {6, std::numbers::sqrt2 * d}}};
  } else {
    const double d = std::cbrt(0.75 * std::numbers::sqrt3 * out.room);
    out.shells = {{{8, d}, {6, 2.0 / std::numbers::sqrt3 * d}}};
  }
  if (out.shells[1].distance > 2.0) out.shells[1].neighbours = 0;
  for (const LatticeShell& shell : out.shells) {
    const cbm::SphereCaps caps = cbm::sphere_caps(1.0, 1.0, shell.distance);
    out.packing += shell.neighbours * caps.volume_a / kBall;
    // The disc between two equal spheres bears the mean of their pressures, on both caps half of it each.
    out.press += shell.neighbours * shell.distance * (caps.slope_a + caps.slope_b) / (6.0 * out.room);
  }
  return out;
}

double pair_pressure(const LatticeGeometry& at, double radius, const PairModel& pair) {
  double sum = 0.0;
  for (const LatticeShell& shell : at.shells)
    if (shell.neighbours > 0) sum += shell.neighbours * shell.distance * pair((2.0 - shell.distance) * radius, 0.5 * radius).force;
  return sum / (6.0 * at.room * radius * radius);
}

}  // namespace morula::calibrate
