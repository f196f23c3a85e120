#include "scenarios/measures/point_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace morula::scenarios {
namespace {

Vec3d mean_of(std::span<const Vec3d> points) {
  Vec3d sum{};
  for (const Vec3d& p : points) sum += p;
  return sum * (1.0 / static_cast<double>(points.size()));
}

double determinant(const std::array<std::array<double, 4>, 4>& m) {
  double det = 0.0;
  for (std::size_t c = 0; c < 4; ++c) {
    std::array<std::array<double, 3>, 3> s{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0, k = 0; j < 4; ++j)
        if (j != c) s[i][k++] = m[i + 1][j];
    const double minor = s[0][0] * (s[1][1] * s[2][2] - s[1][2] * s[2][1]) - s[0][1] * (s[1][0] * s[2][2] - s[1][2] * s[2][0]) +
                         s[0][2] * (s[1][0] * s[2][1] - s[1][1] * s[2][0]);
    det += (c % 2 ? -1.0 : 1.0) * m[0][c] * minor;
  }
  return det;
}

}  // namespace

double rms_after_rigid_motion(std::span<const Vec3d> a, std::span<const Vec3d> b) {
  const Vec3d mean_a = mean_of(a), mean_b = mean_of(b);
  std::array<std::array<double, 3>, 3> m{};
  double both = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Vec3d p = a[k] - mean_a, q = b[k] - mean_b;
    both += norm2(p) + norm2(q);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) m[i][j] += p[i] * q[j];
  }
  const double xx = m[0][0], xy = m[0][1], xz = m[0][2], yx = m[1][0], yy = m[1][1], yz = m[1][2], zx = m[2][0], zy = m[2][1], zz = m[2][2];
  const std::array<std::array<double, 4>, 4> horn{{{xx + yy + zz, yz - zy, zx - xz, xy - yx},
                                                   {yz - zy, xx - yy - zz, xy + yx, zx + xz},
                                                   {zx - xz, xy + yx, yy - xx - zz, yz + zy},
                                                   {xy - yx, zx + xz, yz + zy, zz - xx - yy}}};
  double squares = 0.0;
  for (const auto& row : m)
    for (const double x : row) squares += x * x;
  const double det3 = xx * (yy * zz - yz * zy) - xy * (yx * zz - yz * zx) + xz * (yx * zy - yy * zx);
  const double c2 = -2.0 * squares, c1 = -8.0 * det3, c0 = determinant(horn);
  double largest = 0.5 * both;  // a bound from above: Newton's method falls to the largest root
  for (int k = 0; k < 100; ++k) {
    const double l2 = largest * largest, value = (l2 + c2) * l2 + c1 * largest + c0, slope = 4.0 * l2 * largest + 2.0 * c2 * largest + c1;
    if (slope == 0.0) break;
    const double next = largest - value / slope;
    if (!(next < largest)) break;
    largest = next;
  }
  return std::sqrt(std::max(0.0, both - 2.0 * largest) / static_cast<double>(a.size()));
}

double mann_whitney_p(std::span<const double> lower, std::span<const double> upper) {
  const double n = static_cast<double>(lower.size()), m = static_cast<double>(upper.size()), all = n + m;
  if (n == 0.0 || m == 0.0) return 1.0;
  double wins = 0.0;
  for (const double l : lower)
    for (const double u : upper) wins += u > l ? 1.0 : u == l ? 0.5 : 0.0;
  std::vector<double> values(lower.begin(), lower.end());
  values.insert(values.end(), upper.begin(), upper.end());
  std::sort(values.begin(), values.end());
  double ties = 0.0;
  for (std::size_t i = 0, j = 0; i < values.size(); i = j) {
    while (j < values.size() && values[j] == values[i]) ++j;
    const double t = static_cast<double>(j - i);
    ties += t * t * t - t;
  }
  const double variance = n * m / 12.0 * (all + 1.0 - ties / (all * (all - 1.0)));
  if (!(variance > 0.0)) return 1.0;
  return 0.5 * std::erfc((wins - 0.5 * n * m - 0.5) / std::sqrt(2.0 * variance));
}

}  // namespace morula::scenarios
