#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/random/philox.h"
#include "study/initial/packing.h"
#include "study/initial/part_many.h"
#include "study/initial/scatter_densely.h"

namespace morula::scenarios {
namespace {

constexpr double kSparse = 0.30;            // of the volume: up to here cells are placed one by one
constexpr std::uint64_t kMostTries = 2000;  // of one cell; at 38 % of the volume one try in a thousand still finds a place
constexpr std::uint64_t kFirstDraw = 16;    // of the stream; lower ones are those of packing
constexpr double kNowhere = 1e300;          // [µm]
constexpr double kOblique = 1.8;            // a way along a plane over that along an axis of the domain which is not nearest to its normal
constexpr int kLayerPasses = 400;
constexpr double kLayerSlack = 1e-3;  // of the mean radius

/// Two unit vectors along the plane, the first along the axis of the domain that lies flattest.
std::pair<Vec3d, Vec3d> along(const Vec3d& normal) {
  std::size_t flattest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (std::abs(normal[axis]) < std::abs(normal[flattest])) flattest = axis;
  Vec3d u{};
  u[flattest] = 1.0;
  u = normalized(u - normal * dot(u, normal));
  return {u, cross(normal, u)};
}

/// The box that a layer keeps to: its edges that are not along the normal.
class LayerBox {
 public:
  LayerBox(const InitialCells& block, const Vec3d& middle) : middle_(middle), half_(block.size * 0.5) {
    const Vec3d& normal = block.plane.normal;
    for (std::size_t axis = 1; axis < 3; ++axis)
      if (std::abs(normal[axis]) > std::abs(normal[across_])) across_ = axis;
  }
  /// How far p is from the faces that count; negative inside [µm].
  [[nodiscard]] double beyond(const Vec3d& p) const {
    double most = -kNowhere;
    for_edges([&](std::size_t axis) { most = std::max(most, std::abs(p[axis] - middle_[axis]) - half_[axis]); });
    return most;
  }
  /// 1 on the border, as little along each edge as it is of its half.
  [[nodiscard]] double part(const Vec3d& p) const {
    double most = 0.0;
    for_edges([&](std::size_t axis) { most = std::max(most, std::abs(p[axis] - middle_[axis]) / half_[axis]); });
    return most;
  }
  [[nodiscard]] double longest_half() const {
    double most = 0.0;
    for_edges([&](std::size_t axis) { most = std::max(most, half_[axis]); });
    return most;
  }

 private:
  template <class F>
  void for_edges(F&& f) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (axis != across_) f(axis);
  }
  Vec3d middle_, half_;
  std::size_t across_ = 0;  ///< the edge that is nearest to the normal
};

bool keeps_off_walls(const Vec3d& p, double radius, const Space& space) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (space.boundary[axis][0] == BoundaryKind::kWall && p[axis] < space.box.low[axis] + radius) return false;
    if (space.boundary[axis][1] == BoundaryKind::kWall && p[axis] > space.box.high[axis] - radius) return false;
  }
  return true;
}

/// Balls in cubes, to be asked and added to one by one. The cubes fill the block's box; along a periodic axis the whole domain, around which they close.
class GrowingGrid {
 public:
  GrowingGrid(const InitialCells& block, double width, const Space& space) : space_(space) {
    const bool ball = block.fill == FillShape::kSphere;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      periodic_[axis] = space.periodic(static_cast<int>(axis));
      const double size = periodic_[axis] ? space.box.size()[axis] : ball ? 2.0 * block.radius : block.size[axis];
      low_[axis] = periodic_[axis] ? space.box.low[axis] : block.center[axis] - 0.5 * size;
      count_[axis] = std::clamp<std::int64_t>(static_cast<std::int64_t>(size / width), 1, 256);
      if (periodic_[axis] && count_[axis] < 3) count_[axis] = 1;  // the neighbours on both sides are three different cubes, or all is one
      width_[axis] = size / static_cast<double>(count_[axis]);
    }
    cubes_.resize(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]));
  }

  [[nodiscard]] bool has_room(const Vec3d& p, double radius, double touch) const {
    const auto at = place(p);
    for (std::int64_t z = first(2, at[2]); z <= last(2, at[2]); ++z)
      for (std::int64_t y = first(1, at[1]); y <= last(1, at[1]); ++y)
        for (std::int64_t x = first(0, at[0]); x <= last(0, at[0]); ++x)
          for (const Ball& ball : cubes_[number({x, y, z})])
            if (norm(space_.nearest_image(p - ball.center)) < touch * (radius + ball.radius)) return false;
    return true;
  }
  void add(const Vec3d& p, double radius) { cubes_[number(place(p))].push_back({p, radius}); }

 private:
  struct Ball {
    Vec3d center;
    double radius;
  };
  [[nodiscard]] std::array<std::int64_t, 3> place(const Vec3d& anywhere) const {
    const Vec3d p = space_.wrapped(anywhere);
    std::array<std::int64_t, 3> out{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      out[axis] =
          std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor((p[axis] - low_[axis]) / width_[axis])), 0, count_[axis] - 1);
    return out;
  }
  [[nodiscard]] bool closes(std::size_t axis) const { return periodic_[axis] && count_[axis] > 1; }
  [[nodiscard]] std::int64_t first(std::size_t axis, std::int64_t at) const {
    return closes(axis) ? at - 1 : std::max<std::int64_t>(0, at - 1);
  }
  [[nodiscard]] std::int64_t last(std::size_t axis, std::int64_t at) const {
    return closes(axis) ? at + 1 : std::min(count_[axis] - 1, at + 1);
  }
  [[nodiscard]] std::size_t number(std::array<std::int64_t, 3> p) const {
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = (p[axis] + count_[axis]) % count_[axis];
    return static_cast<std::size_t>((p[2] * count_[1] + p[1]) * count_[0] + p[0]);
  }

  const Space& space_;
  Vec3d low_, width_;
  std::array<bool, 3> periodic_{};
  std::array<std::int64_t, 3> count_{};
  std::vector<std::vector<Ball>> cubes_;
};

/// Random sequential adsorption.
Packing scatter_one_by_one(const InitialCells& block, std::span<const double> radius, double touch, const Space& space,
                           std::uint64_t first_number, std::uint32_t seed, const Surroundings& around) {
  Packing out;
  const Random random(seed, RandomStream::kInitialPosition);
  GrowingGrid grid(block, 2.0 * touch * *std::max_element(radius.begin(), radius.end()), space);
  const Vec3d half = block.fill == FillShape::kSphere ? Vec3d{block.radius, block.radius, block.radius} : block.size * 0.5;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const CellId id = CellId::founder(first_number + i);
    bool placed = false;
    for (std::uint64_t tries = 0; tries < kMostTries && !placed; ++tries) {
      const RandomPair a = random.uniform(id, kFirstDraw + 2 * tries), b = random.uniform(id, kFirstDraw + 2 * tries + 1);
      const Vec3d from{(2.0 * a.first - 1.0) * half.x, (2.0 * a.second - 1.0) * half.y, (2.0 * b.first - 1.0) * half.z};
      const Vec3d p = block.center + from;
      Vec3d ignored;
      if (!within(block, from, radius[i]) || !keeps_off_walls(p, radius[i], space) || !grid.has_room(p, radius[i], touch)) continue;
      if (!around.empty() && around.push(p, radius[i], touch, ignored) > 0.0) continue;
      grid.add(p, radius[i]);
      out.center.push_back(space.wrapped(p));
      placed = true;
    }
    if (!placed) break;
  }
  out.room = out.center.size();
  if (out.room < radius.size()) out.center.clear();
  return out;
}

}  // namespace

Packing layer_cells(const InitialCells& block, std::span<const double> radius, double touch, const Space& space, const Surroundings& around,
                    int threads) {
  Packing out;
  const double mean = mean_radius(radius), spacing = lattice_spacing(radius, touch);
  const LayerPlane& plane = block.plane;
  const auto [u, v] = along(plane.normal);
  const Vec3d middle = block.center - plane.normal * dot(block.center - plane.point, plane.normal);
  const double row = spacing * 0.5 * std::numbers::sqrt3;
  const std::optional<LayerBox> box = block.fill == FillShape::kBox ? std::optional<LayerBox>(std::in_place, block, middle) : std::nullopt;
  const double widest = box ? box->longest_half() : block.radius > 0.0 ? block.radius - mean : kNowhere;
  struct Site {
    double distance;
    Vec3d p;
  };
  std::vector<Site> sites;
  // A disc of n hexagonal sites has the radius spacing √(n √3/(2 π)); what is in the way asks for a wider one, up to four times. A box fills as a box.
  const double disc = spacing * (std::sqrt(static_cast<double>(radius.size()) * std::numbers::sqrt3 / (2.0 * std::numbers::pi)) + 1.0);
  for (double reach = disc;; reach *= 1.3) {
    sites.clear();
    const double limit = std::min(reach, widest);
    const double along_plane = box ? kOblique * limit : limit;
    const auto rows = static_cast<std::int64_t>(along_plane / row) + 1, columns = static_cast<std::int64_t>(along_plane / spacing) + 2;
    for (std::int64_t j = -rows; j <= rows; ++j)
      for (std::int64_t i = -columns; i <= columns; ++i) {
        const double x = spacing * (static_cast<double>(i) + (j % 2 != 0 ? 0.5 : 0.0)), y = row * static_cast<double>(j);
        const Vec3d p = middle + u * x + v * y + plane.normal * mean;
        const double distance = box ? box->part(p) * widest : std::hypot(x, y);
        Vec3d ignored;
        if (distance > limit || (box && box->beyond(p) > -mean) || !space.box.contains(p) ||
            !keeps_off_walls(p, mean * (1.0 - 1e-9), space))
          continue;
        if (around.push(p, mean * (1.0 - 1e-9), touch, ignored) <= 0.0) sites.push_back({distance, p});
      }
    if (sites.size() >= radius.size() || reach >= widest || (!box && reach > 4.0 * disc)) break;
  }
  out.room = std::min<std::uint64_t>(sites.size(), radius.size());
  if (out.room < radius.size()) return out;
  std::stable_sort(sites.begin(), sites.end(), [](const Site& a, const Site& b) { return a.distance < b.distance - 1e-9; });
  for (std::size_t i = 0; i < radius.size(); ++i) out.center.push_back(sites[i].p + plane.normal * (radius[i] - mean));
  if (radius.size() >= kMany) {
    out.allowed_overlap = slack_of_many(touch, mean);
    const PartMany how{.slack = out.allowed_overlap, .around = &around, .plane = &plane, .threads = threads};
    const Parted parted = part_many(out.center, radius, how, space);
    out.worst_overlap = parted.overlap;
    out.worst_intrusion = parted.intrusion;
  } else {
    const PushApart how{touch, kLayerSlack * mean, kLayerPasses, 0, middle, &around, &plane};
    out.worst_overlap = push_apart(out.center, radius, how, space, &out.worst_intrusion);
  }
  const auto beyond = [&](const Vec3d& p) {
    if (box) return box->beyond(p);
    const Vec3d from = p - middle;
    return norm(from - plane.normal * dot(from, plane.normal)) - block.radius;
  };
  for (std::size_t i = 0; widest < kNowhere && i < radius.size(); ++i)
    out.reach_beyond = std::max(out.reach_beyond, beyond(out.center[i]) + radius[i]);
  return out;
}

Packing scatter_cells(const InitialCells& block, std::span<const double> radius, double touch, const Space& space,
                      std::uint64_t first_number, std::uint32_t seed, const Surroundings& around, int threads) {
  if (filled_part(block, radius) * std::pow(touch, 3) <= kSparse) {
    Packing out = scatter_one_by_one(block, radius, touch, space, first_number, seed, around);
    if (out.room == radius.size()) return out;
  }
  return scatter_densely(block, radius, touch, space, first_number, seed, around, threads);
}

}  // namespace morula::scenarios
