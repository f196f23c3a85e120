#include "core/contact/broad_phase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace morula {
namespace {

using Bin = std::array<int, 3>;

/// A uniform grid over the centres, with wrapping along periodic axes.
struct BinGrid {
  Vec3d low, inverse_width;
  Bin count{1, 1, 1};
  std::array<bool, 3> wraps{};

  BinGrid(std::span<const Extent> extents, const Space& space) {
    Box centers;
    double widest = 1e-9;
    for (const Extent& e : extents) {
      centers.include(space.wrapped(e.center));
      widest = std::max(widest, 2.0 * e.radius);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      wraps[axis] = space.periodic(static_cast<int>(axis));
      low[axis] = wraps[axis] ? space.box.low[axis] : centers.low[axis];
      const double size = wraps[axis] ? space.box.size()[axis] : centers.size()[axis];
      const double most = std::cbrt(4.0 * static_cast<double>(extents.size())) + 4.0;  // not many more bins than bodies
      count[axis] = static_cast<int>(std::clamp(std::floor(size / widest), 1.0, std::max(1.0, most * 4.0)));
      inverse_width[axis] = size > 0.0 ? count[axis] / size : 0.0;
    }
  }

  [[nodiscard]] Bin bin_of(const Vec3d& p) const {
    Bin bin{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      bin[axis] = std::clamp(static_cast<int>((p[axis] - low[axis]) * inverse_width[axis]), 0, count[axis] - 1);
    return bin;
  }
  [[nodiscard]] std::size_t index(const Bin& bin) const {
    return (static_cast<std::size_t>(bin[2]) * static_cast<std::size_t>(count[1]) + static_cast<std::size_t>(bin[1])) *
               static_cast<std::size_t>(count[0]) +
           static_cast<std::size_t>(bin[0]);
  }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]);
  }

  /// Distinct bins within one step along an axis.
  [[nodiscard]] int neighbours(std::size_t axis, int at, std::array<int, 3>& out) const {
    int n = 0;
    for (int step = -1; step <= 1; ++step) {
      int bin = at + step;
      if (wraps[axis])
        bin = (bin + count[axis]) % count[axis];
      else if (bin < 0 || bin >= count[axis])
        continue;
      if (std::find(out.begin(), out.begin() + n, bin) == out.begin() + n) out[static_cast<std::size_t>(n++)] = bin;
    }
    return n;
  }
};

bool touching(const Extent& a, const Extent& b, const Vec3d& shift, const Vec3d& between) {
  const double reach = a.radius + b.radius;
  if (norm2(between) > reach * reach) return false;
  return a.box.overlaps(Box{b.box.low + shift, b.box.high + shift});
}

}  // namespace

void find_body_pairs(std::span<const Extent> extents, std::span<const std::uint32_t> place, std::span<const char> owned, const Space& space,
                     const std::function<void(const BodyPair&)>& found) {
  if (extents.empty()) return;
  const BinGrid grid(extents, space);
  std::vector<std::uint32_t> begin(grid.size() + 1, 0), member(extents.size());
  std::vector<Bin> bin(extents.size());
  for (std::size_t i = 0; i < extents.size(); ++i) {
    bin[i] = grid.bin_of(space.wrapped(extents[i].center));
    ++begin[grid.index(bin[i]) + 1];
  }
  for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  {
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t i = 0; i < extents.size(); ++i) member[next[grid.index(bin[i])]++] = static_cast<std::uint32_t>(i);
  }

  std::vector<std::uint32_t> by_place(extents.size());
  for (std::size_t i = 0; i < extents.size(); ++i) by_place[place[i]] = static_cast<std::uint32_t>(i);

  std::vector<BodyPair> of_body;
  for (const std::uint32_t i : by_place) {
    of_body.clear();
    std::array<std::array<int, 3>, 3> near{};
    std::array<int, 3> n{};
    for (std::size_t axis = 0; axis < 3; ++axis) n[axis] = grid.neighbours(axis, bin[i][axis], near[axis]);
    for (int z = 0; z < n[2]; ++z)
      for (int y = 0; y < n[1]; ++y)
        for (int x = 0; x < n[0]; ++x) {
          const std::size_t cell = grid.index(
              {near[0][static_cast<std::size_t>(x)], near[1][static_cast<std::size_t>(y)], near[2][static_cast<std::size_t>(z)]});
          for (std::uint32_t k = begin[cell]; k < begin[cell + 1]; ++k) {
            const std::uint32_t j = member[k];
            if (place[j] <= place[i] || !(owned[i] || owned[j])) continue;
            const Vec3d direct = extents[j].center - extents[i].center;
            const Vec3d nearest = space.nearest_image(direct);
            const Vec3d shift = space.any_periodic() ? nearest - direct : Vec3d{};
            if (touching(extents[i], extents[j], shift, nearest)) of_body.push_back({i, j, shift});
          }
        }
    std::sort(of_body.begin(), of_body.end(), [&](const BodyPair& a, const BodyPair& b) { return place[a.b] < place[b.b]; });
    for (const BodyPair& pair : of_body) found(pair);
  }
}

}  // namespace morula
