#pragma once
#include <array>

#include "dcm/operator_assembly.h"
#include "dcm/stencils/membrane.h"

namespace morula::dcm {

/// Squared lengths of a face's edges at rest: its reference metric. `rest_length(edge)`.
template <class Real, class RestLength>
std::array<Real, 3> rest_squares(const std::array<std::uint32_t, 3>& edges, const RestLength& rest_length) noexcept {
  const Real a = rest_length(edges[0]), b = rest_length(edges[1]), c = rest_length(edges[2]);
  return {a * a, b * b, c * c};
}
/// The same in a block; of a shell that is not strained (strained_lanes()) the present ones.
template <class Real, class RestLength>
std::array<Real, 3> rest_squares(const std::array<std::uint32_t, 3>& edges, const RestLength& rest_length, const Real& strained,
                                 const std::array<Real, 3>& now) noexcept {
  const auto rest = rest_squares<Real>(edges, rest_length);
  const auto of = [&](int c) { return select(strained > Real(0), rest[c], now[c]); };
  return {of(0), of(1), of(2)};
}

/// A face of the block that is assembled: its edges and its strain.
template <int W>
struct StrainedFace {
  using Real = Lane<float, W>;
  std::array<Vec3<Real>, 3> e;
  MembraneStrain<Real> strain;

  static StrainedFace of(const Assembly<W>& a, std::size_t f) noexcept {
    const Triangle& t = a.topology.faces()[f];
    const auto x0 = a.x(t[0]), x1 = a.x(t[1]), x2 = a.x(t[2]);
    StrainedFace out;
    out.e = {x2 - x1, x0 - x2, x1 - x0};
    const std::array<Real, 3> now{norm2(out.e[0]), norm2(out.e[1]), norm2(out.e[2])};
    const auto rest_length = [&](std::uint32_t edge) { return load_scalar<float, W>(a.ws.rest_length.data(), edge); };
    out.strain = MembraneStrain<Real>::of(rest_squares<Real>(a.topology.face_edges()[f], rest_length, a.strained, now), now);
    return out;
  }
};

template <int W>
void add_to_edge(Assembly<W>& a, std::size_t edge, const SymMat3<Lane<float, W>>& m) noexcept {
  using Real = Lane<float, W>;
  float* p = a.out.edge.data() + edge * 6 * W;
  const auto add = [&](int entry, Real value) { (Real::load(p + entry * W) + value).store(p + entry * W); };
  add(0, m.xx), add(1, m.xy), add(2, m.xz), add(3, m.yy), add(4, m.yz), add(5, m.zz);
}

}  // namespace morula::dcm
