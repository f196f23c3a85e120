#pragma once
#include "cbm/sphere_law.h"
#include "core/vec3.h"

namespace morula::cbm {

/// Centres closer than this have no direction: the z axis stands for it [µm].
inline constexpr double kCoincident = 1e-9;

/// Up to eight pairs at once: what evaluate() reads and what it finds, one pair a lane.
///
/// Force on a is −force·normal, on b +force·normal. stiffness·nnᵀ is the positive semi-definite part of ∂²U/∂x_b² along the normal. The
/// overlap at which the law is evaluated is R_a + R_b − d − offset.
struct PairBlock {
  static constexpr int kWidth = 8;
  using Row = double[kWidth];

  alignas(64) Row between[3] = {};  ///< x_b − x_a [µm]
  alignas(64) Row radius_a = {};    ///< [µm]
  alignas(64) Row radius_b = {};    ///< [µm]
  alignas(64) Row offset = {};      ///< overlap forgiven to fresh sisters (division_ramp.h) [µm]
  alignas(64) Row attached = {};    ///< 1: on the adhesive branch, fixed within a step; 0: not
  const PairContact* contact[kWidth] = {};

  alignas(64) Row normal[3] = {};   ///< from a to b
  alignas(64) Row distance = {};    ///< of the centres [µm]
  alignas(64) Row force = {};       ///< [nN]
  alignas(64) Row stiffness = {};   ///< max(0, dF/dδ) [nN/µm]
  alignas(64) Row area = {};        ///< [µm²]
  alignas(64) Row energy = {};      ///< [nN·µm]
  bool attached_next[kWidth] = {};  ///< at the end of a step that ends here

  void set(int lane, const Vec3d& x, double a, double b, const PairContact& c, bool is_attached, double forgiven) noexcept {
    between[0][lane] = x.x;
    between[1][lane] = x.y;
    between[2][lane] = x.z;
    radius_a[lane] = a;
    radius_b[lane] = b;
    contact[lane] = &c;
    attached[lane] = is_attached ? 1.0 : 0.0;
    offset[lane] = forgiven;
  }
  /// The pair of one lane in another one as well.
  void copy_pair(int from, int to) noexcept {
    set(to, {between[0][from], between[1][from], between[2][from]}, radius_a[from], radius_b[from], *contact[from], attached[from] != 0.0,
        offset[from]);
  }
  /// What another block found for this lane.
  void take_result(const PairBlock& other, int lane) noexcept {
    for (int axis = 0; axis < 3; ++axis) normal[axis][lane] = other.normal[axis][lane];
    distance[lane] = other.distance[lane], force[lane] = other.force[lane], stiffness[lane] = other.stiffness[lane];
    area[lane] = other.area[lane], energy[lane] = other.energy[lane], attached_next[lane] = other.attached_next[lane];
  }
};

}  // namespace morula::cbm
