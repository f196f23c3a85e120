#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/parallel/comm.h"
#include "core/vec3.h"

namespace morula {

/// What can be seen from a point: the nearest surface along fixed directions, 128 × 128 over each face of a cube about the eye.
///
/// Directions are fixed in the laboratory and the nearest distance is exact, so that what is seen does not depend on the order of
/// surfaces or on the number of ranks.
class SightMap {
 public:
  static constexpr int kSide = 128;
  static constexpr std::uint32_t kNothing = 0xFFFFFFFFu, kBall = kNothing - 1;
  static constexpr std::uint32_t kFirstWall = 0x80000000u;  ///< numbers of triangles are below it

  /// reach: what is further away is not seen [µm].
  SightMap(const Vec3d& eye, double reach);

  /// A triangle, as a screen on both sides. `number` is the caller's; kNothing for what only stands in the way.
  void add_triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, std::uint32_t number);
  /// A ball stands in the way.
  void add_ball(const Vec3d& center, double radius);
  /// A triangle of a wall stands in the way. Of several ranks one adds it.
  void add_wall(const Vec3d& a, const Vec3d& b, const Vec3d& c);

  /// Nearest distances over all ranks. Collective.
  void join(const Comm& comm);

  /// Numbers of the triangles of which at least half can be seen (they are the nearest ones along half of the directions in which they lie), over
  /// all that were added here; increasing. Half, so that a rim of triangles in part behind others neither adds to what is seen nor takes from it.
  [[nodiscard]] std::vector<std::uint32_t> seen() const;
  /// Part of the sphere of directions along which something is seen.
  [[nodiscard]] double covered() const;
  /// What is seen of balls and walls, over all ranks. Collective.
  struct InTheWay {
    double volume;      ///< ∫ r³/3 dΩ [µm³]
    double directions;  ///< part of the sphere of directions
    Vec3d wall;         ///< ∫ n dA over what is seen of walls, n away from the eye [µm²]
  };
  [[nodiscard]] InTheWay in_the_way(const Comm& comm) const;

 private:
  struct Window {  ///< rays [u0, u1) × [v0, v1) of one face of the cube
    int u0, u1, v0, v1;
  };
  /// Solid angle of a ray's pixel, but for a factor.
  static double weight(std::size_t ray);
  /// Of the laboratory, not of length 1.
  static Vec3d direction(std::size_t ray);
  template <class Hit>
  void cast(int side, const Window& window, std::uint32_t number, const Hit& hit);
  void cast_triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, std::uint32_t number);

  Vec3d eye_;
  double reach_;
  std::vector<double> distance_;       ///< over all ranks, by ray
  std::vector<double> own_;            ///< of what was added here
  std::vector<std::uint32_t> number_;  ///< of what was added here
  std::vector<std::uint32_t> met_;     ///< directions in which a triangle lies, by number
  std::vector<Vec3d> wall_normal_;     ///< of the triangles of walls, in the order of their numbers
};

}  // namespace morula
