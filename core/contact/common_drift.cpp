#include "core/contact/common_drift.h"

#include <algorithm>
#include <cmath>

#include "core/contact/float_rounding.h"

namespace morula {
namespace {

constexpr std::size_t kFewest = 64, kSample = 2048;
constexpr double kFlat = 1e-6;  // determinant of the second moments, over that of a ball with the same trace

}  // namespace

CommonDrift drift_of(const DriftSums& sums) {
  if (!(sums.count > 0.0)) return {};
  CommonDrift out;
  out.center = sums.place * (1.0 / sums.count);
  out.way = sums.way * (1.0 / sums.count);
  const SymMat3<double> spread = sums.second + outer(-sums.count, out.center);
  const double mean = (spread.xx + spread.yy + spread.zz) / 3.0;
  if (!(determinant(spread) > kFlat * mean * mean * mean)) return out;
  const SymMat3<double> inverted = inverse(spread);
  const double way[3] = {sums.way.x, sums.way.y, sums.way.z};
  double squares = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    out.row[axis] = inverted * (sums.moment[axis] - out.center * way[axis]);
    squares += norm2(out.row[axis]);
  }
  out.strain = std::sqrt(squares);
  return out;
}

CommonDrift common_drift(std::span<const Vec3f> before, std::span<const Vec3d> now) {
  const std::size_t n = std::min(before.size(), now.size());
  if (n < kFewest) return {};
  const Vec3d origin = to_double(before[0]);
  DriftSums sums;
  for (std::size_t i = 0; i < n; i += std::max<std::size_t>(1, n / kSample)) {
    const Vec3d x = to_double(before[i]) - origin, u = now[i] - to_double(before[i]);
    sums.count += 1.0;
    sums.place += x, sums.way += u;
    sums.second += outer(1.0, x);
    sums.moment[0] += x * u.x, sums.moment[1] += x * u.y, sums.moment[2] += x * u.z;
  }
  CommonDrift out = drift_of(sums);
  out.center += origin;
  return out;
}

}  // namespace morula
