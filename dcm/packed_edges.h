#pragma once
#include <cstdint>

#include "core/simd/transpose.h"
#include "core/vec3.h"

namespace morula::dcm {

/// The symmetric 3×3 block of an edge in W lanes, in 16 bytes a lane: [edge][word][lane], words xx|xy, xz|yy, yz|zz of 16 bits each, and
/// their unit, that of the block. The solver reads little else as often, and a large tissue waits for memory.
///
/// Rounding takes at most 1.5 units from an eigenvalue; this is given back on the diagonal, so that what was positive stays positive. A unit is
/// 1/32764 of the largest entry.
template <int W>
struct PackedEdge {
  using Real = Lane<float, W>;
  using Word [[gnu::vector_size(W * sizeof(std::int32_t))]] = std::int32_t;
  static constexpr std::size_t kWords = 4;
  static constexpr float kMost = 32764.0f;  ///< room is left for what is given back

  SymMat3<Real> units;
  Real unit;

  static PackedEdge load(const std::int32_t* edges, std::size_t edge) noexcept {
    const std::int32_t* const p = edges + edge * kWords * W;
    PackedEdge out;
    const auto both = [&](int word, Real& low, Real& high) {
      Word w;
      __builtin_memcpy(&w, p + word * W, sizeof w);
      low = Real::from(__builtin_convertvector((w << 16) >> 16, typename Real::Vector));
      high = Real::from(__builtin_convertvector(w >> 16, typename Real::Vector));
    };
    both(0, out.units.xx, out.units.xy);
    both(1, out.units.xz, out.units.yy);
    both(2, out.units.yz, out.units.zz);
    __builtin_memcpy(&out.unit.v, p + 3 * W, sizeof out.unit.v);
    return out;
  }

  static void store(const SymMat3<Real>& m, std::int32_t* edges, std::size_t edge) noexcept {
    const Real zero(0.0f);
    const auto size = [](Real a) { return abs(a); };
    const Real most = max(max(max(size(m.xx), size(m.xy)), max(size(m.xz), size(m.yy))), max(size(m.yz), size(m.zz)));
    const Real unit = most * Real(1.0f / kMost);
    const auto positive = unit > zero;  // what is below the smallest float is none
    const Real per_unit = select(positive, Real(1.0f) / select(positive, unit, Real(1.0f)), zero);
    const auto whole = [&](Real a, float back) {
      const Real scaled = a * per_unit + Real(back);
      return __builtin_convertvector((scaled + select(scaled < zero, Real(-0.5f), Real(0.5f))).v, Word);
    };
    const auto put = [&](int word, Word low, Word high) {
      const Word both = (low & 0xFFFF) | (high << 16);
      __builtin_memcpy(edges + (edge * kWords + static_cast<std::size_t>(word)) * W, &both, sizeof both);
    };
    put(0, whole(m.xx, 1.5f), whole(m.xy, 0.0f));
    put(1, whole(m.xz, 0.0f), whole(m.yy, 1.5f));
    put(2, whole(m.yz, 0.0f), whole(m.zz, 1.5f));
    __builtin_memcpy(edges + (edge * kWords + 3) * W, &unit.v, sizeof unit.v);
  }
};

}  // namespace morula::dcm
