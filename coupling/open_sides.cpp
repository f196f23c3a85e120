#include "coupling/open_sides.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/numbers/principal_axis.h"
#include "core/spiral.h"

namespace morula {
namespace {

constexpr std::size_t kDirections = OpenSides::kDirections;
constexpr float kClosed = 0.42261826F;  // cosine of 65°
constexpr float kAside = -0.34202014F;  // cosine of 110°
constexpr double kOneSided = 0.2;       // length of the mean open direction from which on it is the middle
constexpr double kRound = 0.02;         // difference of the two largest moments, as a part, below which no direction stands out

/// By coordinate, so that all of them are compared with a neighbour at once.
struct Directions {
  std::array<float, kDirections> x, y, z;

  Directions() {
    for (std::size_t k = 0; k < kDirections; ++k) {
      const Vec3d u = spiral_direction(static_cast<int>(k), static_cast<int>(kDirections));
      x[k] = static_cast<float>(u.x), y[k] = static_cast<float>(u.y), z[k] = static_cast<float>(u.z);
    }
  }
};

const Directions& directions() {
  static const Directions all;
  return all;
}

using Cosines = std::array<float, kDirections>;

/// Cosines of the angles between a neighbour and all directions.
Cosines cosines_to(const Vec3d& neighbour) {
  const Directions& u = directions();
  const Vec3d n = normalized(neighbour);
  const auto x = static_cast<float>(n.x), y = static_cast<float>(n.y), z = static_cast<float>(n.z);
  Cosines out;
  for (std::size_t k = 0; k < kDirections; ++k) out[k] = u.x[k] * x + u.y[k] * y + u.z[k] * z;
  return out;
}

}  // namespace

OpenSides::OpenSides(std::span<const Vec3d> neighbours) {
  Cosines nearest;
  nearest.fill(-2.0F);
  for (const Vec3d& neighbour : neighbours) {
    const Cosines cosine = cosines_to(neighbour);
    for (std::size_t k = 0; k < kDirections; ++k) nearest[k] = std::max(nearest[k], cosine[k]);
  }
  for (std::size_t k = 0; k < kDirections; ++k) set(k, nearest[k] < kClosed);
}

void OpenSides::set(std::size_t direction, bool open) {
  const std::uint64_t bit = std::uint64_t{1} << (direction % 64);
  words[direction / 64] = open ? words[direction / 64] | bit : words[direction / 64] & ~bit;
}

OpenSides OpenSides::outward(std::span<const Vec3d> neighbours, std::span<const OpenSides> of_neighbours) const {
  if (!any()) return {};
  std::array<int, kDirections> open{}, aside{};
  for (std::size_t j = 0; j < neighbours.size(); ++j) {
    const Cosines cosine = cosines_to(neighbours[j]);
    for (std::size_t k = 0; k < kDirections; ++k) {
      if (cosine[k] <= kAside) continue;
      ++aside[k];
      open[k] += of_neighbours[j].has(k) ? 1 : 0;
    }
  }
  OpenSides out;
  for (std::size_t k = 0; k < kDirections; ++k) out.set(k, has(k) && 2 * open[k] >= aside[k]);
  return out;
}

Vec3d OpenSides::middle() const {
  Vec3d sum{};
  SymMat3<double> moments;
  double count = 0.0;
  for (std::size_t k = 0; k < kDirections; ++k) {
    if (!has(k)) continue;
    const Vec3d u = spiral_direction(static_cast<int>(k), static_cast<int>(kDirections));
    sum += u;
    moments += outer(1.0, u);
    count += 1.0;
  }
  if (count == 0.0) return {};
  if (norm(sum) >= kOneSided * count) return normalized(sum);
  const PrincipalAxes axes(moments);
  return axes.moment[1] > (1.0 - kRound) * axes.moment[0] ? Vec3d{} : axes.axis[0];
}

}  // namespace morula
