#pragma once
#include <cstdint>
#include <span>

#include "core/contact/surface_pair.h"
#include "core/simd/lane.h"

namespace morula {

/// Up to 8 points and their nearest faces, in lanes.
struct alignas(64) PointBatch {
  static constexpr int kLanes = 8;
  using Real = Lane<double, kLanes>;

  double point[3][kLanes], source_corner[3][3][kLanes];
  double corner[3][3][kLanes], node_normal[3][3][kLanes];
  // results
  double source_normal[3][kLanes], face_area[kLanes], area[kLanes];  ///< of the source's face; what the point stands for
  double gap[kLanes], normal[3][kLanes], mu[3][kLanes];
  double unit[3][kLanes], length[kLanes];  ///< normal of the target at the foot point
  double weight_slope[kLanes], attraction[kLanes], density[kLanes], told[kLanes], pull[3][kLanes];
  double bearing[kLanes], stiffness[kLanes];
  bool inside[kLanes];                                      ///< the gap is negative
  double corner_adhesion[3][kLanes], per_adhesion[kLanes];  ///< where W differs by marks: W at the target's nodes, and energy by W
  std::int32_t rounded_mu[2][kLanes];                       ///< as ContactElement keeps them
};

inline void put(double (&array)[3][PointBatch::kLanes], int lane, const Vec3d& v) {
  array[0][lane] = v.x, array[1][lane] = v.y, array[2][lane] = v.z;
}
inline Vec3d get(const double (&array)[3][PointBatch::kLanes], int lane) { return {array[0][lane], array[1][lane], array[2][lane]}; }
inline Vec3<PointBatch::Real> load(const double (&array)[3][PointBatch::kLanes]) {
  return {PointBatch::Real::load(array[0]), PointBatch::Real::load(array[1]), PointBatch::Real::load(array[2])};
}
inline void store(double (&array)[3][PointBatch::kLanes], const Vec3<PointBatch::Real>& v) {
  v.x.store(array[0]), v.y.store(array[1]), v.z.store(array[2]);
}

/// Gaps against the nearest faces of a surface.
void gaps_to_faces(const PointsEvaluation& evaluation, std::span<const std::uint32_t> face, PointBatch& batch);

/// Gaps against a sphere: |x_q − x| − R.
void gaps_to_sphere(const PairBody& target, PointBatch& batch);

/// W at the nodes of the nearest face, for one point of a face with these marks. A sphere and an obstacle carry none.
void find_adhesion(const PointsEvaluation& evaluation, int d, std::uint8_t marks, const Triangle* face, int lane, PointBatch& batch);

/// A surface against itself acts by the unsigned distance, less that of touch (self_contact.h).
void take_distances(double touch, PointBatch& batch);

/// Energies, tractions and stiffness at the gaps, of points of which each face has so many. `kPlain`: one W everywhere, and two different bodies.
template <bool kPlain>
void respond(const PointsEvaluation& evaluation, int points, PointBatch& batch);

}  // namespace morula
