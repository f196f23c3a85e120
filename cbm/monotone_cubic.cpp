#include "cbm/monotone_cubic.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace morula::cbm {

std::vector<double> monotone_slopes(std::span<const double> x, std::span<const double> y) {
  const std::size_t n = x.size();
  assert(n >= 3 && y.size() == n);
  std::vector<double> width(n - 1), rise(n - 1), slope(n, 0.0);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    width[k] = x[k + 1] - x[k];
    rise[k] = (y[k + 1] - y[k]) / width[k];
  }
  for (std::size_t k = 1; k + 1 < n; ++k) slope[k] = (width[k - 1] * rise[k] + width[k] * rise[k - 1]) / (width[k - 1] + width[k]);
  const auto at_end = [&](std::size_t outer, std::size_t inner) {
    const double near = width[outer], far = width[inner];
    return std::max(0.0, ((2.0 * near + far) * rise[outer] - near * rise[inner]) / (near + far));
  };
  slope[0] = at_end(0, 1);
  slope[n - 1] = at_end(n - 2, n - 3);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    if (rise[k] == 0.0) {
      slope[k] = slope[k + 1] = 0.0;
      continue;
    }
    const double alpha = slope[k] / rise[k], beta = slope[k + 1] / rise[k], square = alpha * alpha + beta * beta;
    if (square <= 9.0) continue;
    const double shorten = 3.0 / std::sqrt(square);
    slope[k] *= shorten;
    slope[k + 1] *= shorten;
  }
  return slope;
}

}  // namespace morula::cbm
