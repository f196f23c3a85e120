#include "coupling/behaviours/draw.h"

#include <cassert>
#include <cmath>

namespace morula {

double draw_truncated(const Distribution& distribution, const Random& random, CellId cell, std::uint64_t& index) {
  assert(distribution.mean > 0.0);
  if (distribution.relative_spread <= 0.0) return distribution.mean;
  for (;;) {
    const RandomPair normal = random.normal(cell, index++);
    for (const double z : {normal.first, normal.second}) {
      const double factor = 1.0 + distribution.relative_spread * z;
      if (std::abs(z) <= 3.0 && factor > 0.0) return distribution.mean * factor;
    }
  }
}

double draw_inherited(const Distribution& distribution, double mothers, const Random& random, CellId cell, std::uint64_t& index) {
  const double rho = distribution.correlation, mean = distribution.mean;
  if (rho == 0.0 || distribution.relative_spread <= 0.0) return draw_truncated(distribution, random, cell, index);
  for (;;) {
    const double own = draw_truncated(distribution, random, cell, index);
    const double value = mean + rho * (mothers - mean) + std::sqrt(1.0 - rho * rho) * (own - mean);
    if (value > 0.0) return value;
  }
}

double balanced_growth_age(double u) { return -std::log2(1.0 - 0.5 * u); }

}  // namespace morula
