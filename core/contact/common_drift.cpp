#include "core/contact/common_drift.h"

#include <algorithm>
#include <cmath>

#include "core/contact/float_rounding.h"

namespace morula {
namespace {

constexpr std::size_t kFewest = 64, kSample = 2048;
constexpr double kFlat = 1e-6;  // determinant of the second moments, over that of a ball with the same trace

}  // namespace

CommonDrift common_drift(std::span<const Vec3f> before, std::span<const Vec3d> now) {
  CommonDrift out;
  const std::size_t n = std::min(before.size(), now.size());
  if (n < kFewest) return out;
  const std::size_t stride = std::max<std::size_t>(1, n / kSample);
  Vec3d place, way;
  double count = 0.0;
  for (std::size_t i = 0; i < n; i += stride) {
    place += to_double(before[i]);
    way += now[i] - to_double(before[i]);
    count += 1.0;
  }
  out.center = place * (1.0 / count);
  out.way = way * (1.0 / count);
  SymMat3<double> spread;
  Vec3d moment[3];
  for (std::size_t i = 0; i < n; i += stride) {
    const Vec3d from = to_double(before[i]) - out.center, u = now[i] - to_double(before[i]) - out.way;
    spread += outer(1.0, from);
    moment[0] += from * u.x, moment[1] += from * u.y, moment[2] += from * u.z;
  }
  const double mean = (spread.xx + spread.yy + spread.zz) / 3.0;
  const double determinant = spread.xx * (spread.yy * spread.zz - spread.yz * spread.yz) -
                             spread.xy * (spread.xy * spread.zz - spread.yz * spread.xz) +
                             spread.xz * (spread.xy * spread.yz - spread.yy * spread.xz);
  if (!(determinant > kFlat * mean * mean * mean)) return out;
  const SymMat3<double> inverted = inverse(spread);
  double squares = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    out.row[axis] = inverted * moment[axis];
    squares += norm2(out.row[axis]);
  }
  out.strain = std::sqrt(squares);
  return out;
}

}  // namespace morula
