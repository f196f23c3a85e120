#include "study/initial/part_many.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel/threads.h"
#include "study/initial/cell_grid.h"
#include "study/initial/packing.h"

namespace morula::scenarios {
namespace {

constexpr double kStep = 0.3;     // of the overlaps, in a pass
constexpr double kInertia = 0.9;  // of the way of the last pass
constexpr double kLongest = 0.1;  // way of a pass, in mean radii
constexpr double kMargin = 0.6;   // of the lists of neighbours, in mean radii
constexpr double kWall = 2.0;     // push of what does not move, over that of a ball of which half the way is expected

/// Balls in an order in which neighbours lie near to each other in memory, and what they do.
class Crowd {
 public:
  Crowd(std::span<const Vec3d> center, std::span<const double> radius, const PartMany& how, const Space& space)
      : how_(how), space_(space), longest_(kLongest * mean_radius(radius)), margin_(kMargin * mean_radius(radius)) {
    const double largest = *std::max_element(radius.begin(), radius.end());
    reach_ = 2.0 * how.touch * largest + margin_;
    const std::vector<Vec3d> as_given(center.begin(), center.end());
    order_ = CellGrid(as_given, reach_, space).items();
    for (const std::size_t i : order_) {
      x_.push_back(center[i]);
      r_.push_back(radius[i]);
    }
    way_.resize(x_.size());
    find_neighbours();
  }

  /// One pass: what overlaps now; then, where that is more than allowed, everything moves.
  Parted pass(bool last) {
    const Parted now = measure();
    if (!last && std::max({now.overlap, now.intrusion, now.beyond}) > how_.slack) move();
    return now;
  }

  void give(std::vector<Vec3d>& center) const {
    for (std::size_t k = 0; k < x_.size(); ++k) center[order_[k]] = x_[k];
  }

 private:
  void find_neighbours() {
    at_ = x_;
    const CellGrid grid(x_, reach_, space_);
    neighbours_.resize(x_.size());
    parallel_for(how_.threads, x_.size(), [&](std::size_t i) {
      auto& list = neighbours_[i];
      list.clear();
      grid.near(x_[i], [&](std::size_t j) {
        const double limit = how_.touch * (r_[i] + r_[j]) + margin_;
        if (j != i && norm2(between(x_[j], x_[i])) < limit * limit) list.push_back(static_cast<std::uint32_t>(j));
      });
    });
  }

  Parted measure() {
    push_.resize(x_.size());
    const auto threads = static_cast<std::size_t>(std::max(1, how_.threads));
    std::vector<Parted> of_thread(threads);
    on_each_thread(how_.threads, [&](std::size_t t) {
      Parted& worst = of_thread[t];
      for (std::size_t i = x_.size() * t / threads; i < x_.size() * (t + 1) / threads; ++i) push_[i] = push_on(i, worst);
    });
    Parted out;
    for (const Parted& one : of_thread) {
      out.overlap = std::max(out.overlap, one.overlap);
      out.intrusion = std::max(out.intrusion, one.intrusion);
      out.beyond = std::max(out.beyond, one.beyond);
    }
    return out;
  }

  Vec3d push_on(std::size_t i, Parted& worst) const {
    Vec3d push{};
    for (const std::uint32_t j : neighbours_[i]) {
      const Vec3d away = between(x_[j], x_[i]);
      const double touch = how_.touch * (r_[i] + r_[j]), square = norm2(away);
      if (square >= touch * touch || square == 0.0) continue;
      const double distance = std::sqrt(square), overlap = touch - distance;
      worst.overlap = std::max(worst.overlap, overlap);
      push += away * (overlap / distance);
    }
    if (how_.around && !how_.around->empty()) {
      Vec3d out{};
      worst.intrusion = std::max(worst.intrusion, how_.around->push(x_[i], r_[i], how_.touch, out));
      push += out * kWall;
    }
    if (how_.within) push += into_shape(i, worst) * kWall;
    return push;
  }

  /// From where a ball reaches out of the shape back into it.
  Vec3d into_shape(std::size_t i, Parted& worst) const {
    const InitialCells& block = *how_.within;
    const Vec3d from = space_.nearest_image(x_[i] - block.center);
    if (block.fill == FillShape::kSphere) {
      const double distance = norm(from), out = distance + r_[i] - block.radius;
      if (out <= 0.0 || distance == 0.0) return {};
      worst.beyond = std::max(worst.beyond, out);
      return from * (-out / distance);
    }
    Vec3d push{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (space_.periodic(static_cast<int>(axis)) && block.size[axis] >= space_.box.size()[axis] * (1.0 - 1e-9)) continue;
      const double out = std::abs(from[axis]) + r_[i] - 0.5 * block.size[axis];
      if (out <= 0.0) continue;
      worst.beyond = std::max(worst.beyond, out);
      push[axis] = from[axis] > 0.0 ? -out : out;
    }
    return push;
  }

  void move() {
    const double furthest = parallel_max(how_.threads, x_.size(), [&](std::size_t i) {
      way_[i] = norm2(push_[i]) > 0.0 ? way_[i] * kInertia + push_[i] * kStep : Vec3d{};
      const double length = norm(way_[i]);
      if (length > longest_) way_[i] *= longest_ / length;
      x_[i] += way_[i];
      if (how_.plane) {
        const double off = r_[i] - dot(x_[i] - how_.plane->point, how_.plane->normal);
        x_[i] += how_.plane->normal * off;
        way_[i] += how_.plane->normal * -dot(way_[i], how_.plane->normal);
      }
      keep_within_walls(x_[i], r_[i], space_);
      return norm2(between(at_[i], x_[i]));
    });
    if (std::sqrt(furthest) > 0.5 * margin_) find_neighbours();
  }

  [[nodiscard]] Vec3d between(const Vec3d& a, const Vec3d& b) const { return periodic_ ? space_.nearest_image(b - a) : b - a; }

  const PartMany& how_;
  const Space& space_;
  const bool periodic_ = space_.any_periodic();
  double longest_, margin_, reach_ = 0.0;
  std::vector<std::size_t> order_;  ///< number of the k-th ball among those given
  std::vector<Vec3d> x_, at_;       ///< where they are, and where they were when their neighbours were found
  std::vector<double> r_;
  std::vector<Vec3d> way_, push_;
  std::vector<std::vector<std::uint32_t>> neighbours_;
};

}  // namespace

Parted part_many(std::vector<Vec3d>& center, std::span<const double> radius, const PartMany& how, const Space& space) {
  Parted out;
  if (center.empty()) return out;
  Crowd crowd(center, radius, how, space);
  for (int pass = 0; pass <= how.most_passes; ++pass) {
    out = crowd.pass(pass == how.most_passes);
    out.passes = pass;
    if (std::max({out.overlap, out.intrusion, out.beyond}) <= how.slack) break;
  }
  crowd.give(center);
  return out;
}

}  // namespace morula::scenarios
