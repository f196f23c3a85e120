#pragma once
#include <cstdint>

#include "core/simd/transpose.h"
#include "core/vec3.h"

namespace morula::dcm {

/// The symmetric 3×3 block of an edge in W lanes, as the solver reads it: [edge][word][lane], the six numbers xx xy xz yy yz zz.
///
/// They keep their full precision. In 16 bits, with what rounding may take given back on the diagonal, a stiff contact stiffened the soft
/// directions of the same edge by a tenth of their friction (docs/decisions/0019).
template <int W>
struct PackedEdge {
  using Real = Lane<float, W>;
  static constexpr std::size_t kWords = 6;

  static SymMat3<Real> load(const std::int32_t* edges, std::size_t edge) noexcept {
    SymMat3<Real> m;
    const std::int32_t* p = edges + edge * kWords * W;
    for (Real* entry : {&m.xx, &m.xy, &m.xz, &m.yy, &m.yz, &m.zz}) {
      __builtin_memcpy(&entry->v, p, sizeof entry->v);
      p += W;
    }
    return m;
  }
  static void store(const SymMat3<Real>& m, std::int32_t* edges, std::size_t edge) noexcept {
    std::int32_t* p = edges + edge * kWords * W;
    for (const Real& entry : {m.xx, m.xy, m.xz, m.yy, m.yz, m.zz}) {
      __builtin_memcpy(p, &entry.v, sizeof entry.v);
      p += W;
    }
  }
};

}  // namespace morula::dcm
