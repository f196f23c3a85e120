#include "coupling/sight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel/order_free_sum.h"

namespace morula {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kNear = 1e-9;     // of what is before the eye [µm]
constexpr double kGrazing = 0.05;  // cosine to the normal of a ball below which the area that a ray stands for no longer grows

double ray_coordinate(int i) { return (2.0 * i + 1.0) / SightMap::kSide - 1.0; }

/// A vector in the frame of a side of the cube: x and y across, z outwards.
Vec3d turned(const Vec3d& p, int side) {
  const int axis = side / 2;
  const double sign = side % 2 ? -1.0 : 1.0;
  return {p[static_cast<std::size_t>((axis + 1) % 3)], p[static_cast<std::size_t>((axis + 2) % 3)],
          sign * p[static_cast<std::size_t>(axis)]};
}

/// Whether corners, each a ball of this radius, lie beyond one of the four planes through the eye and the edges of the side in whose frame they are: no ray of this
/// side meets what is between them.
bool is_beside(std::span<const Vec3d> corners, double radius) {
  const double far = radius * std::numbers::sqrt2;
  return std::ranges::all_of(corners, [far](const Vec3d& p) { return p.x - p.z > far; }) ||
         std::ranges::all_of(corners, [far](const Vec3d& p) { return -p.x - p.z > far; }) ||
         std::ranges::all_of(corners, [far](const Vec3d& p) { return p.y - p.z > far; }) ||
         std::ranges::all_of(corners, [far](const Vec3d& p) { return -p.y - p.z > far; });
}

/// Parts of the sphere of directions that the rays of a side stand for, not yet divided by their sum over all sides.
const std::vector<double>& weights_of_side() {
  static const std::vector<double> weights = [] {
    std::vector<double> out;
    for (int j = 0; j < SightMap::kSide; ++j)
      for (int i = 0; i < SightMap::kSide; ++i) {
        const double u = ray_coordinate(i), v = ray_coordinate(j);
        out.push_back(std::pow(1.0 + u * u + v * v, -1.5));
      }
    return out;
  }();
  return weights;
}

/// Another for any two places, also for those that mirror each other.
double place_number(const Vec3d& p) { return dot(p, Vec3d{1.0, std::numbers::sqrt2, std::numbers::pi}); }

/// First ray at or after a coordinate, within 0 to kSide.
int first_ray(double u) {
  return static_cast<int>(std::clamp(std::ceil((u + 1.0) * 0.5 * SightMap::kSide - 0.5), 0.0, static_cast<double>(SightMap::kSide)));
}

}  // namespace

SightMap::SightMap(const Vec3d& eye, double reach)
    : eye_(eye), reach_(reach), own_(std::size_t{6} * kSide * kSide, kFar), place_(own_.size(), kFar), number_(own_.size(), kNothing) {}

template <class Hit>
void SightMap::cast(int side, const Window& w, std::uint32_t number, double at, const Hit& hit) {
  for (int j = w.v0; j < w.v1; ++j)
    for (int i = w.u0; i < w.u1; ++i) {
      const Vec3d ray{ray_coordinate(i), ray_coordinate(j), 1.0};
      const double along = hit(ray);
      if (!(along > 0.0)) continue;
      const double distance = along * norm(ray);
      if (number < kFirstWall) ++met_[number];
      const std::size_t place =
          (static_cast<std::size_t>(side) * kSide + static_cast<std::size_t>(j)) * kSide + static_cast<std::size_t>(i);
      if (distance > reach_ || !(distance < own_[place] || (distance == own_[place] && at < place_[place]))) continue;
      own_[place] = distance;
      place_[place] = at;
      number_[place] = number;
    }
}

void SightMap::add_triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, std::uint32_t number) {
  if (number != kNothing && met_.size() <= number) met_.resize(number + std::size_t{1}, 0);
  cast_triangle(a, b, c, number);
}

void SightMap::add_wall(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d n = cross(b - a, c - a);
  wall_normal_.push_back(normalized(dot(n, a - eye_) < 0.0 ? -n : n));
  cast_triangle(a, b, c, kFirstWall + static_cast<std::uint32_t>(wall_normal_.size() - 1));
}

void SightMap::cast_triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, std::uint32_t number) {
  if (std::min({norm(a - eye_), norm(b - eye_), norm(c - eye_)}) > reach_) return;
  for (int side = 0; side < 6; ++side) {
    const Vec3d p[3] = {turned(a - eye_, side), turned(b - eye_, side), turned(c - eye_, side)};
    if (std::max({p[0].z, p[1].z, p[2].z}) <= kNear || is_beside(p, 0.0)) continue;
    Window w{0, kSide, 0, kSide};
    if (std::min({p[0].z, p[1].z, p[2].z}) > kNear) {
      const double u[3] = {p[0].x / p[0].z, p[1].x / p[1].z, p[2].x / p[2].z}, v[3] = {p[0].y / p[0].z, p[1].y / p[1].z, p[2].y / p[2].z};
      const double margin = 1e-9;
      w = {first_ray(std::min({u[0], u[1], u[2]}) - margin), first_ray(std::max({u[0], u[1], u[2]}) + margin),
           first_ray(std::min({v[0], v[1], v[2]}) - margin), first_ray(std::max({v[0], v[1], v[2]}) + margin)};
    }
    const Vec3d n = cross(p[1] - p[0], p[2] - p[0]), c01 = cross(p[0], p[1]), c12 = cross(p[1], p[2]), c20 = cross(p[2], p[0]);
    const double height = dot(n, p[0]);
    cast(side, w, number, place_number(a + b + c), [&](const Vec3d& ray) {
      const double s0 = dot(ray, c01), s1 = dot(ray, c12), s2 = dot(ray, c20);
      const bool inside = (s0 >= 0.0 && s1 >= 0.0 && s2 >= 0.0) || (s0 <= 0.0 && s1 <= 0.0 && s2 <= 0.0);
      return inside ? height / dot(n, ray) : -1.0;
    });
  }
}

void SightMap::add_ball(const Vec3d& center, double radius) {
  const std::uint32_t number = kFirstBall + static_cast<std::uint32_t>(ball_.size());
  ball_.push_back(center - eye_);
  if (!(radius > 0.0) || norm(center - eye_) - radius > reach_) return;
  for (int side = 0; side < 6; ++side) {
    const Vec3d p = turned(center - eye_, side);
    if (p.z + radius <= kNear || is_beside({&p, 1}, radius)) continue;
    Window w{0, kSide, 0, kSide};
    if (const double low = p.z - radius, high = p.z + radius; low > kNear) {
      const auto least = [&](double x) { return std::min((x - radius) / low, (x - radius) / high); };
      const auto most = [&](double x) { return std::max((x + radius) / low, (x + radius) / high); };
      w = {first_ray(least(p.x)), first_ray(most(p.x)), first_ray(least(p.y)), first_ray(most(p.y))};
    }
    cast(side, w, number, place_number(center), [&](const Vec3d& ray) {  // |t ray − p| = r
      const double square = norm2(ray), half = dot(ray, p), root = half * half - square * (norm2(p) - radius * radius);
      if (root < 0.0) return -1.0;
      const double near = (half - std::sqrt(root)) / square;
      return near > 0.0 ? near : (half + std::sqrt(root)) / square;
    });
  }
}

void SightMap::join(const Comm& comm) {
  distance_ = own_;
  comm.min(distance_);
  std::vector<double> first = place_;
  for (std::size_t i = 0; i < first.size(); ++i)
    if (own_[i] != distance_[i]) first[i] = kFar;
  comm.min(first);
  is_seen_.resize(own_.size());
  for (std::size_t i = 0; i < own_.size(); ++i) is_seen_[i] = own_[i] == distance_[i] && place_[i] == first[i];
}

std::vector<std::uint32_t> SightMap::seen() const {
  std::vector<std::uint32_t> nearest(met_.size(), 0), out;
  for (std::size_t i = 0; i < own_.size(); ++i)
    if (number_[i] < kFirstWall && is_seen_[i]) ++nearest[number_[i]];
  for (std::uint32_t k = 0; k < met_.size(); ++k)
    if (met_[k] > 0 && 2 * nearest[k] >= met_[k]) out.push_back(k);
  return out;
}

double SightMap::weight(std::size_t ray) { return weights_of_side()[ray % (std::size_t{kSide} * kSide)]; }

Vec3d SightMap::direction(std::size_t ray) {
  const std::size_t side = ray / (std::size_t{kSide} * kSide), axis = side / 2;
  Vec3d out{};
  out[(axis + 1) % 3] = ray_coordinate(static_cast<int>(ray % kSide));
  out[(axis + 2) % 3] = ray_coordinate(static_cast<int>(ray / kSide % kSide));
  out[axis] = side % 2 ? -1.0 : 1.0;
  return out;
}

SightMap::InTheWay SightMap::in_the_way(const Comm& comm) const {
  InTheWay out{};
  out.balls.resize(ball_.size());
  OrderFreeSum sums[5];
  double all = 0.0;
  for (std::size_t i = 0; i < own_.size(); ++i) {
    const double part = weight(i);
    all += part;
    if (number_[i] == kNothing || number_[i] < kFirstWall || !is_seen_[i]) continue;
    sums[0].add(part * own_[i] * own_[i] * own_[i] / 3.0);
    sums[1].add(part);
    const Vec3d ray = normalized(direction(i));
    const bool is_ball = number_[i] >= kFirstBall;
    const Vec3d normal = is_ball ? normalized(ball_[number_[i] - kFirstBall] - ray * own_[i]) : wall_normal_[number_[i] - kFirstWall];
    const double along = dot(normal, ray);
    const Vec3d area = normal * (part * own_[i] * own_[i] / (is_ball ? std::max(kGrazing, along) : along));
    if (is_ball) out.balls[number_[i] - kFirstBall] += area;
    for (std::size_t axis = 0; axis < 3; ++axis) sums[2 + axis].add(area[axis]);
  }
  double total[5];
  comm.sum(sums, total);
  const double of_part = 4.0 * std::numbers::pi / all;
  for (Vec3d& ball : out.balls) ball *= of_part;
  out.volume = of_part * total[0], out.directions = total[1] / all, out.normal = Vec3d{total[2], total[3], total[4]} * of_part;
  return out;
}

double SightMap::covered() const {
  double hit = 0.0, all = 0.0;
  for (std::size_t i = 0; i < distance_.size(); ++i) {
    const double part = weight(i);
    all += part;
    if (distance_[i] < kFar) hit += part;
  }
  return hit / all;
}

}  // namespace morula
