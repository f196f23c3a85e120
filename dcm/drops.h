#pragma once
#include <algorithm>
#include <cmath>

namespace morula::dcm {

/// δ/R of two equal cells at rest that are drops of a tension T and an adhesion W [nN/µm], cos θ = 1 − W/(2T): each is a ball of radius R′ cut at R′ cos θ,
/// of the volume of the free cell, V = πR′³(2/3 + c − c³/3), whose centre of volume is R′c + π R′⁴(1 − c²)²/(4V) from the cut. 0 without a tension.
inline double overlap_of_doublet(double adhesion, double tension) {
  if (!(tension > 0.0)) return 0.0;
  const double c = std::max(0.0, 1.0 - 0.5 * adhesion / tension), part = 2.0 / 3.0 + c - c * c * c / 3.0;
  const double radius = std::cbrt(4.0 / 3.0 / part);
  return 2.0 - 2.0 * radius * (c + std::pow(1.0 - c * c, 2) / (4.0 * part));
}

}  // namespace morula::dcm
