#include "fields/interval_control.h"

#include <algorithm>

namespace morula::fields {

namespace {

/// What a cell may go between two integrations, in voxels. What it sees differs from what is where it is by a tenth of the difference between
/// neighbouring voxels, as much as the voxels themselves leave open.
constexpr double kWay = 0.1;
constexpr double kLongest = 300.0;  ///< deaths and exchanges are felt after this at the latest [s]
constexpr double kMostGrowth = 2.0;
constexpr double kSafety = 0.9;

}  // namespace

bool is_due(const Field& field, double now) {
  const Vec3d h = field.grid.spacing();
  return now >= field.time + field.interval || field.way > kWay * std::min({h.x, h.y, h.z});
}

double next_interval(double interval, double change, double tolerance) {
  if (!(tolerance > 0.0)) return 0.0;
  return std::min(interval * std::min(kMostGrowth, kSafety * tolerance / change), kLongest);  // no change: twice as long
}

}  // namespace morula::fields
