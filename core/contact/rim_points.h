#pragma once
#include <cstddef>
#include <cstdint>

#include "core/mesh/topology.h"
#include "core/vec3.h"

namespace morula {

/// How much of a face's contact its nine finer points bear, by the gaps at its three or four coarse ones.
///
/// Points that enter the range one by one make steps in the force, which pin the line of contact (time_stepping.md §12.2). Where a face is neither
/// in touch as a whole nor out of range, finer points take over: E = (1 − ψ) E_coarse + ψ E_fine. ψ is C¹ and a function of present gaps, hence of the
/// positions alone: E is one energy at all times, nothing is switched between steps, and nothing has to be remembered.
///
/// ψ = [1 − Π(1 − n_q)] [1 − Π(1 − f_q)] with smoothsteps: n_q (near) from 0 at the range c to 1 at kNear c, f_q (far) from 0 at kTouch c to 1 at
/// kFar c.
struct RimWeight {
  static constexpr double kNear = 0.75, kTouch = 0.1, kFar = 0.35;
  static constexpr std::size_t kMostPoints = 4;

  double value = 0.0;              ///< ψ
  double slope[kMostPoints] = {};  ///< ∂ψ/∂g_q [1/µm]

  /// `gap`: of all `count` coarse points, 1e300 for those out of range [µm].
  static RimWeight of(const double (&gap)[kMostPoints], std::size_t count, double range) noexcept {
    double near[kMostPoints], near_slope[kMostPoints], far[kMostPoints], far_slope[kMostPoints];
    bool any_near = false, any_far = false;
    for (std::size_t q = 0; q < count; ++q) {
      smoothstep((range - gap[q]) / ((1.0 - kNear) * range), near[q], near_slope[q]);
      smoothstep((gap[q] - kTouch * range) / ((kFar - kTouch) * range), far[q], far_slope[q]);
      any_near = any_near || near[q] > 0.0;
      any_far = any_far || far[q] > 0.0;
    }
    RimWeight out;
    if (!any_near || !any_far) return out;
    double away = 1.0, touching = 1.0;
    for (std::size_t q = 0; q < count; ++q) away *= 1.0 - near[q], touching *= 1.0 - far[q];
    out.value = (1.0 - away) * (1.0 - touching);
    for (std::size_t q = 0; q < count; ++q) {
      double others_away = 1.0, others_touching = 1.0;
      for (std::size_t p = 0; p < count; ++p)
        if (p != q) others_away *= 1.0 - near[p], others_touching *= 1.0 - far[p];
      out.slope[q] = others_touching * far_slope[q] / ((kFar - kTouch) * range) * (1.0 - away) -
                     others_away * near_slope[q] / ((1.0 - kNear) * range) * (1.0 - touching);
    }
    return out;
  }

 private:
  static void smoothstep(double t, double& value, double& slope) noexcept {
    const bool within = t > 0.0 && t < 1.0;
    value = within ? t * t * (3.0 - 2.0 * t) : t > 0.0 ? 1.0 : 0.0;
    slope = within ? 6.0 * t * (1.0 - t) : 0.0;
  }
};

/// A face that is at the rim now, between the evaluation of its coarse and of its fine points.
struct RimFace {
  struct Coarse {
    double slope = 0.0;  ///< ∂ψ/∂g [1/µm]
    Vec3d normal;        ///< ∂g/∂x
    double mu[3] = {};
    std::uint32_t q = 0;
    Triangle target{};  ///< nodes of the nearest face
  };

  std::uint32_t place = 0;   ///< in the pair's source faces
  double share = 0.0;        ///< ψ
  double area = 0.0;         ///< of the face [µm²]
  double coarse_mean = 0.0;  ///< energy by area, by either set of points [nN/µm]
  double fine_mean = 0.0;
  std::size_t count = 0;  ///< of coarse points in range
  Coarse coarse[RimWeight::kMostPoints] = {};
};

}  // namespace morula
