#include "coupling/tissue_middle.h"

#include <cmath>
#include <numbers>

#include "core/parallel/order_free_sum.h"

namespace morula {

TissueMiddle tissue_middle(const Space& space, std::span<const Vec3d> center, std::span<const double> weight, const Comm& comm) {
  TissueMiddle out{space.box.center()};
  if (!space.any_periodic()) return out;
  constexpr double kTurn = 2.0 * std::numbers::pi;
  constexpr double kEven = 1e-6;  // part of the weight: cells all around have no direction
  double Vec3d::*const along[] = {&Vec3d::x, &Vec3d::y, &Vec3d::z};
  const Vec3d from = out.at;
  OrderFreeSum sums[7];
  for (std::size_t i = 0; i < center.size(); ++i) {
    const double w = weight.empty() ? 1.0 : weight[i];
    sums[6].add(w);
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = along[axis];
      const double angle = kTurn * (center[i].*at - from.*at) / (space.box.size().*at);
      sums[2 * axis].add(w * std::cos(angle));
      sums[2 * axis + 1].add(w * std::sin(angle));
    }
  }
  double total[7];
  comm.sum(sums, total);
  for (int axis = 0; axis < 3; ++axis) {
    const double c = total[2 * axis], s = total[2 * axis + 1], size = std::hypot(c, s);
    if (!space.periodic(axis) || !(size > kEven * total[6])) continue;
    out.at.*along[axis] += space.box.size().*along[axis] * std::atan2(s, c) / kTurn;
    out.directed[axis] = size / total[6];
  }
  return out;
}

}  // namespace morula
