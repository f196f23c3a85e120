#include "report/pictures/line_ends.h"

#include <algorithm>
#include <cmath>

namespace morula::scenarios {

bool place_line_ends(std::vector<LineEnd>& ends, double top, double bottom, double gap, double farthest) {
  if (gap * (static_cast<double>(ends.size()) - 1.0) > bottom - top) return false;
  std::stable_sort(ends.begin(), ends.end(), [](const LineEnd& a, const LineEnd& b) { return a.y < b.y; });
  /// Names that touch: they stand `gap` apart, with the mean of their lines in the middle.
  struct Pool {
    std::size_t first, count;
    double mean;
  };
  const auto low = [&](const Pool& p) {
    const double height = gap * (static_cast<double>(p.count) - 1.0);
    return std::clamp(p.mean - 0.5 * height, top, bottom - height);
  };
  std::vector<Pool> pools;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    pools.push_back({i, 1, ends[i].y});
    while (pools.size() > 1) {
      Pool &before = pools[pools.size() - 2], &last = pools.back();
      if (low(before) + gap * static_cast<double>(before.count) <= low(last)) break;
      const auto n = static_cast<double>(before.count), m = static_cast<double>(last.count);
      before.mean = (n * before.mean + m * last.mean) / (n + m);
      before.count += last.count;
      pools.pop_back();
    }
  }
  bool near = true;
  for (const Pool& pool : pools)
    for (std::size_t i = 0; i < pool.count; ++i) {
      LineEnd& end = ends[pool.first + i];
      end.at = low(pool) + gap * static_cast<double>(i);
      near = near && std::abs(end.at - end.y) <= farthest;
    }
  return near;
}

}  // namespace morula::scenarios
