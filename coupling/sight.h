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
/// Directions are fixed in the laboratory and the nearest distance is exact; of surfaces at the same distance, as symmetric places have them, that is seen whose
/// place comes first. So what is seen does not depend on the order of surfaces or on the number of ranks.
class SightMap {
 public:
  static constexpr int kSide = 128;
  static constexpr std::uint32_t kNothing = 0xFFFFFFFFu;
  static constexpr std::uint32_t kFirstWall = 0x80000000u;  ///< numbers of triangles are below it
  static constexpr std::uint32_t kFirstBall = 0xC0000000u;  ///< and of walls below this

  /// reach: what is further away is not seen [µm].
  SightMap(const Vec3d& eye, double reach);

  /// A triangle, as a screen on both sides. `number` is the caller's; kNothing for what only stands in the way.
  void add_triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, std::uint32_t number);
  /// A ball stands in the way; of no radius: it does not.
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
  /// What is seen of balls and walls, n away from the eye.
  struct InTheWay {
    double volume;             ///< ∫ r³/3 dΩ [µm³]
    double directions;         ///< part of the sphere of directions
    Vec3d normal;              ///< ∫ n dA [µm²]
    std::vector<Vec3d> balls;  ///< the same of each ball that was added here, in their order; the rest is over all ranks
  };
  /// Collective.
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
  void cast(int side, const Window& window, std::uint32_t number, double at, const Hit& hit);
  void cast_triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, std::uint32_t number);

  Vec3d eye_;
  double reach_;
  std::vector<double> distance_;       ///< over all ranks, by ray
  std::vector<double> own_;            ///< of what was added here
  std::vector<double> place_;          ///< a number for where that is, another for each surface
  std::vector<char> is_seen_;          ///< whether that is what is seen, over all ranks
  std::vector<std::uint32_t> number_;  ///< of what was added here
  std::vector<std::uint32_t> met_;     ///< directions in which a triangle lies, by number
  std::vector<Vec3d> wall_normal_;     ///< of the triangles of walls, in the order of their numbers
  std::vector<Vec3d> ball_;            ///< centres, in the order of their numbers, from the eye
};

}  // namespace morula
