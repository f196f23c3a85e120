#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/space/space.h"

namespace morula::scenarios {

/// Points sorted into cubes that are as large as the longest distance that matters.
class CellGrid {
 public:
  /// `reach`: the longest distance, above 0 [µm].
  CellGrid(const std::vector<Vec3d>& center, double reach, const Space& space) {
    Box box;
    for (const Vec3d& c : center) box.include(c);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      periodic_[axis] = space.periodic(static_cast<int>(axis));
      low_[axis] = periodic_[axis] ? space.box.low[axis] : box.low[axis];
      const double size = (periodic_[axis] ? space.box.high[axis] : box.high[axis]) - low_[axis];
      count_[axis] = std::clamp<std::int64_t>(static_cast<std::int64_t>(size / reach), 1, 1024);
      width_[axis] = std::max(size / static_cast<double>(count_[axis]), reach);
    }
    fit_number_of_cubes(center.size(), reach);
    first_.assign(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]) + 1, 0);
    cube_.resize(center.size());
    for (std::size_t i = 0; i < center.size(); ++i) ++first_[(cube_[i] = number(place(center[i]))) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    item_.resize(center.size());
    for (std::size_t i = 0; i < center.size(); ++i) item_[next[cube_[i]]++] = i;
  }

  /// All points by the cube in which they lie.
  [[nodiscard]] const std::vector<std::size_t>& items() const { return item_; }

  /// function(j) for every point j near to a place, each once, in an order that depends on the positions alone.
  template <class F>
  void near(const Vec3d& point, F&& function) const {
    const auto at = place(point);
    std::array<std::array<std::int64_t, 3>, 3> along{};
    std::array<int, 3> used{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::int64_t d = -1; d <= 1; ++d) {
        std::int64_t p = at[axis] + d;
        if (periodic_[axis]) p = (p + count_[axis]) % count_[axis];
        if (p < 0 || p >= count_[axis]) continue;
        auto& list = along[axis];
        const auto end = list.begin() + used[axis];
        if (std::find(list.begin(), end, p) == end) list[static_cast<std::size_t>(used[axis]++)] = p;
      }
    for (int z = 0; z < used[2]; ++z)
      for (int y = 0; y < used[1]; ++y)
        for (int x = 0; x < used[0]; ++x) {
          const auto cube =
              number({along[0][static_cast<std::size_t>(x)], along[1][static_cast<std::size_t>(y)], along[2][static_cast<std::size_t>(z)]});
          for (std::size_t k = first_[cube]; k < first_[cube + 1]; ++k) function(item_[k]);
        }
  }

 private:
  /// Points far apart must not fill the memory with empty cubes.
  void fit_number_of_cubes(std::size_t points, double reach) {
    const auto most = static_cast<double>(std::max<std::size_t>(4 * points, 1000));
    while (static_cast<double>(count_[0]) * static_cast<double>(count_[1]) * static_cast<double>(count_[2]) > most) {
      const std::size_t axis = static_cast<std::size_t>(std::max_element(count_.begin(), count_.end()) - count_.begin());
      const double size = width_[axis] * static_cast<double>(count_[axis]);
      count_[axis] = (count_[axis] + 1) / 2;
      width_[axis] = std::max(size / static_cast<double>(count_[axis]), reach);
    }
  }
  /// A place beside the points lies in the cube before the first or after the last.
  [[nodiscard]] std::array<std::int64_t, 3> place(const Vec3d& p) const {
    std::array<std::int64_t, 3> out{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double cube = std::floor((p[axis] - low_[axis]) / width_[axis]);
      const bool open = !periodic_[axis];
      out[axis] = static_cast<std::int64_t>(std::clamp(cube, open ? -2.0 : 0.0, static_cast<double>(count_[axis]) - (open ? -1.0 : 1.0)));
    }
    return out;
  }
  [[nodiscard]] std::size_t number(std::array<std::int64_t, 3> p) const {
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = std::clamp<std::int64_t>(p[axis], 0, count_[axis] - 1);
    return static_cast<std::size_t>((p[2] * count_[1] + p[1]) * count_[0] + p[0]);
  }

  Vec3d low_, width_;
  std::array<bool, 3> periodic_{};
  std::array<std::int64_t, 3> count_{};
  std::vector<std::size_t> first_, cube_, item_;
};

}  // namespace morula::scenarios
