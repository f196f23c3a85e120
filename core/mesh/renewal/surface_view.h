#pragma once
#include <array>
#include <span>

#include "core/mesh/topology.h"

namespace morula {

/// A closed surface that somebody else owns: positions of its nodes [µm] and its connectivity.
struct SurfaceView {
  std::span<const Vec3d> position;
  const Topology* topology = nullptr;
};

/// Corner weights of six points that stand for equal parts of a triangle.
inline constexpr std::array<std::array<double, 3>, 6> kSixPoints = {{{2.0 / 3, 1.0 / 6, 1.0 / 6},
                                                                     {1.0 / 6, 2.0 / 3, 1.0 / 6},
                                                                     {1.0 / 6, 1.0 / 6, 2.0 / 3},
                                                                     {1.0 / 6, 5.0 / 12, 5.0 / 12},
                                                                     {5.0 / 12, 1.0 / 6, 5.0 / 12},
                                                                     {5.0 / 12, 5.0 / 12, 1.0 / 6}}};

/// Four times the square root of three: 4√3 A / Σl² is 1 for an equilateral triangle.
inline constexpr double kFourRootThree = 6.928203230275509;

/// Quality of a triangle, q = 4√3 A / (l1² + l2² + l3²): 1 equilateral, 0 without area.
inline double triangle_quality(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double squares = norm2(b - a) + norm2(c - b) + norm2(a - c);
  return squares > 0.0 ? kFourRootThree * 0.5 * norm(cross(b - a, c - a)) / squares : 0.0;
}

/// Least quality of all faces.
inline double least_quality(std::span<const Triangle> faces, std::span<const Vec3d> position) {
  double least = 1.0;
  for (const auto& [a, b, c] : faces) {
    const double q = triangle_quality(position[a], position[b], position[c]);
    if (!(q >= least)) least = q;
  }
  return least;
}

/// Two unit vectors that make a right-handed frame with the unit vector n, (first, second, n); a function of n alone.
inline void frame_about(const Vec3d& n, Vec3d& first, Vec3d& second) {
  const double ax = n.x < 0 ? -n.x : n.x, ay = n.y < 0 ? -n.y : n.y, az = n.z < 0 ? -n.z : n.z;
  const Vec3d along = ax <= ay && ax <= az ? Vec3d{1, 0, 0} : ay <= az ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
  first = normalized(cross(along, n));
  second = cross(n, first);
}

}  // namespace morula
