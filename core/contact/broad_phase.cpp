#include "core/contact/broad_phase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/parallel/threads.h"

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
    lay_out(centers, widest, extents.size(), space);
  }
  /// Of so many bodies whose centres lie in this box, and whose balls are no wider than this.
  BinGrid(const Box& centers, double widest, std::size_t bodies, const Space& space) { lay_out(centers, widest, bodies, space); }

  void lay_out(const Box& centers, double widest, std::size_t bodies, const Space& space) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      wraps[axis] = space.periodic(static_cast<int>(axis));
      low[axis] = wraps[axis] ? space.box.low[axis] : centers.low[axis];
      const double size = wraps[axis] ? space.box.size()[axis] : centers.size()[axis];
      const double most = std::cbrt(4.0 * static_cast<double>(bodies)) + 4.0;  // not many more bins than bodies
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

/// A body as its neighbours meet it; those of a bin lie one behind the other.
struct Member {
  Vec3d center;
  double radius;
  std::uint32_t body, place;
};

/// The bodies in the order of their bins: those of bin k are begin[k] .. begin[k + 1]−1.
struct BinnedBodies {
  std::vector<std::uint32_t> begin;
  std::vector<Member> members;

  BinnedBodies(const BinGrid& grid, std::span<const Extent> extents, std::span<const std::uint32_t> place, const Space& space, int threads)
      : begin(grid.size() + 1, 0), members(extents.size()) {
    std::vector<std::uint32_t> bin(extents.size());
    parallel_for(threads, extents.size(),
                 [&](std::size_t i) { bin[i] = static_cast<std::uint32_t>(grid.index(grid.bin_of(space.wrapped(extents[i].center)))); });
    for (const std::uint32_t at : bin) ++begin[at + 1];
    for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::uint32_t i = 0; i < extents.size(); ++i) members[next[bin[i]]++] = {extents[i].center, extents[i].radius, i, place[i]};
  }
};

/// Looks for the pairs of one body.
struct PairSearch {
  std::span<const Extent> extents;
  std::span<const std::uint32_t> place;
  const Space& space;
  const BinGrid& grid;
  const BinnedBodies& bins;

  /// Calls look_at(member) for all bodies in the bin of a body and in those beside it.
  template <class LookAt>
  void for_beside(std::uint32_t i, LookAt&& look_at) const {
    const Bin bin = grid.bin_of(space.wrapped(extents[i].center));
    std::array<std::array<int, 3>, 3> near{};
    std::array<int, 3> n{};
    for (std::size_t axis = 0; axis < 3; ++axis) n[axis] = grid.neighbours(axis, bin[axis], near[axis]);
    const auto& [xs, ys, zs] = near;
    for (std::size_t z = 0; z < static_cast<std::size_t>(n[2]); ++z)
      for (std::size_t y = 0; y < static_cast<std::size_t>(n[1]); ++y)
        for (std::size_t x = 0; x < static_cast<std::size_t>(n[0]);) {
          std::size_t last = x;  // bins that follow each other along x are one stretch of members
          while (last + 1 < static_cast<std::size_t>(n[0]) && xs[last + 1] == xs[last] + 1) ++last;
          const std::size_t from = grid.index({xs[x], ys[y], zs[z]}), to = from + (last - x) + 1;
          for (std::uint32_t k = bins.begin[from]; k < bins.begin[to]; ++k) look_at(bins.members[k]);
          x = last + 1;
        }
  }
  /// Adds the pair of body i and a member of a later place, if they may touch.
  void add_pair(std::uint32_t i, const Vec3d& center, double radius, std::uint32_t later, const Vec3d& its_center, double its_radius,
                bool periodic, std::vector<BodyPair>& out) const {
    const Vec3d direct = its_center - center, nearest = periodic ? space.nearest_image(direct) : direct;
    const double reach = radius + its_radius;
    if (norm2(nearest) > reach * reach) return;
    const Vec3d shift = periodic ? nearest - direct : Vec3d{};
    const Box& box = extents[later].box;
    if (extents[i].box.overlaps({box.low + shift, box.high + shift})) out.push_back({i, later, shift});
  }
  /// Adds the pairs of body i with bodies of later places, in the order of these. `owned`: one of the two must be.
  void add_pairs_of(std::uint32_t i, std::span<const char> owned, std::vector<BodyPair>& out) const {
    const bool periodic = space.any_periodic();
    const std::size_t before = out.size();
    const Extent& mine = extents[i];
    for_beside(i, [&](const Member& other) {
      if (other.place <= place[i] || !(owned[i] || owned[other.body])) return;
      add_pair(i, mine.center, mine.radius, other.body, other.center, other.radius, periodic, out);
    });
    std::sort(out.begin() + static_cast<std::ptrdiff_t>(before), out.end(),
              [&](const BodyPair& a, const BodyPair& b) { return place[a.b] < place[b.b]; });
  }
  /// Adds all pairs of body i, in any order; those with one of `some` that comes before it are left to that one.
  void add_all_pairs_of(std::uint32_t i, std::span<const char> some, std::vector<BodyPair>& out) const {
    const bool periodic = space.any_periodic();
    const Extent& mine = extents[i];
    for_beside(i, [&](const Member& other) {
      if (other.place > place[i])
        add_pair(i, mine.center, mine.radius, other.body, other.center, other.radius, periodic, out);
      else if (other.body != i && !some[other.body])
        add_pair(other.body, other.center, other.radius, i, mine.center, mine.radius, periodic, out);
    });
  }
};

/// Bodies whose pairs are kept before they are told.
constexpr std::size_t kAtOnce = 1u << 14;

}  // namespace

void find_body_pairs(std::span<const Extent> extents, std::span<const std::uint32_t> place, std::span<const char> owned, const Space& space,
                     int threads, const std::function<void(const BodyPair&)>& found) {
  if (extents.empty()) return;
  const BinGrid grid(extents, space);
  const BinnedBodies bins(grid, extents, place, space, threads);
  std::vector<std::uint32_t> by_place(extents.size());
  for (std::size_t i = 0; i < extents.size(); ++i) by_place[place[i]] = static_cast<std::uint32_t>(i);

  const PairSearch search{extents, place, space, grid, bins};
  const auto count = static_cast<std::size_t>(std::max(threads, 1));
  std::vector<std::vector<BodyPair>> by_thread(count);
  for (std::size_t first = 0; first < by_place.size(); first += kAtOnce) {
    const std::size_t bodies = std::min(kAtOnce, by_place.size() - first);
    on_each_thread(threads, [&](std::size_t t) {
      by_thread[t].clear();
      for (std::size_t k = bodies * t / count; k < bodies * (t + 1) / count; ++k)
        search.add_pairs_of(by_place[first + k], owned, by_thread[t]);
    });
    for (const std::vector<BodyPair>& pairs : by_thread)
      for (const BodyPair& pair : pairs) found(pair);
  }
}

void find_body_pairs_of(std::span<const std::uint32_t> some, std::span<const Extent> extents, std::span<const std::uint32_t> place,
                        const Space& space, int threads, const std::function<void(const BodyPair&)>& found) {
  if (some.empty()) return;
  const BinGrid grid(extents, space);
  const BinnedBodies bins(grid, extents, place, space, threads);
  std::vector<char> is_one(extents.size(), 0);
  for (const std::uint32_t i : some) is_one[i] = 1;
  const PairSearch search{extents, place, space, grid, bins};
  std::vector<BodyPair> pairs = gather<BodyPair>(
      threads, some.size(), [&](std::size_t k, std::vector<BodyPair>& out) { search.add_all_pairs_of(some[k], is_one, out); });
  std::ranges::sort(pairs, [&](const BodyPair& p, const BodyPair& q) {
    return place[p.a] != place[q.a] ? place[p.a] < place[q.a] : place[p.b] < place[q.b];
  });
  for (const BodyPair& pair : pairs) found(pair);
}

void find_ball_pairs(std::span<const Ball> balls, const Space& space, const std::function<void(const BodyPair&)>& found) {
  std::vector<Extent> extents;
  for (const Ball& ball : balls) extents.push_back({Box{ball.center, ball.center}.inflated(ball.radius), ball.center, ball.radius});
  std::vector<std::uint32_t> place(balls.size());
  std::iota(place.begin(), place.end(), 0u);
  find_body_pairs(extents, place, std::vector<char>(balls.size(), 1), space, 1, found);
}

std::vector<std::uint32_t> bodies_near(std::span<const std::uint32_t> some, std::size_t count,
                                       const std::function<Ball(std::uint32_t)>& ball_of, const Space& space) {
  std::vector<std::uint32_t> out;
  if (some.empty()) return out;
  Box centers;
  double widest = 1e-9;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Ball ball = ball_of(i);
    centers.include(space.wrapped(ball.center));
    widest = std::max(widest, 2.0 * ball.radius);
  }
  const BinGrid grid(centers, widest, count, space);
  std::vector<char> near(grid.size(), 0);  // what touches a body lies in its bin or beside it
  for (const std::uint32_t i : some) {
    const Bin bin = grid.bin_of(space.wrapped(ball_of(i).center));
    std::array<std::array<int, 3>, 3> beside{};
    std::array<int, 3> n{};
    for (std::size_t axis = 0; axis < 3; ++axis) n[axis] = grid.neighbours(axis, bin[axis], beside[axis]);
    for (int z = 0; z < n[2]; ++z)
      for (int y = 0; y < n[1]; ++y)
        for (int x = 0; x < n[0]; ++x)
          near[grid.index({beside[0][static_cast<std::size_t>(x)], beside[1][static_cast<std::size_t>(y)],
                           beside[2][static_cast<std::size_t>(z)]})] = 1;
  }
  for (std::uint32_t i = 0; i < count; ++i)
    if (near[grid.index(grid.bin_of(space.wrapped(ball_of(i).center)))]) out.push_back(i);
  return out;
}

}  // namespace morula
