#include <algorithm>

#include "dcm/block_state.h"
#include "dcm/lane_parameters.h"
#include "dcm/laws/helfrich.h"
#include "dcm/stencils/face.h"

namespace morula::dcm {
namespace {

/// ∂A/∂x, ∂V/∂x and the area of every node.
template <int W>
void measure_nodes(BlockState<W>& state) noexcept {
  using Real = Lane<double, W>;
  ForceWorkspace& ws = state.ws;
  const std::size_t nodes = state.topology.node_count();
  ws.fit_curvature(state.topology, W);
  std::fill_n(ws.area_gradient.data(), nodes * 3 * W, 0.0);
  std::fill_n(ws.volume_gradient.data(), nodes * 3 * W, 0.0);
  std::fill_n(ws.node_area.data(), nodes * W, 0.0);
  for (std::size_t f = 0; f < state.topology.face_count(); ++f) {
    const Triangle& t = state.topology.faces()[f];
    const auto x0 = state.x(t[0]), x1 = state.x(t[1]), x2 = state.x(t[2]);
    const auto n = state.face_vector(f);
    const Real twice_area = norm(n);
    const auto half_normal = n * (Real(0.5) / twice_area), sixth = n * Real(1.0 / 6.0);
    const std::array<Vec3<Real>, 3> e{x2 - x1, x0 - x2, x1 - x0};
    for (int c = 0; c < 3; ++c) {
      add_vec3<double, W>(ws.area_gradient.data(), t[c], cross(half_normal, e[c]));
      add_vec3<double, W>(ws.volume_gradient.data(), t[c], sixth);
      double* a = ws.node_area.data() + std::size_t{t[c]} * W;
      (Real::load(a) + twice_area * Real(1.0 / 6.0)).store(a);
    }
  }
}

/// What stands for (Hessian of the area) w + β ∂A/∂x + (Hessian of the volume) u on a face.
template <class Real>
std::array<Vec3<Real>, 3> face_gradient(const std::array<Vec3<Real>, 3>& e, const Vec3<Real>& face_vector,
                                        const std::array<Vec3<Real>, 3>& w, Real beta, const Vec3<Real>& u_sum) noexcept {
  const Real inverse = Real(1.0) / norm(face_vector);
  const auto n = face_vector * inverse;
  std::array<Vec3<Real>, 3> slope;  // n × e_c = 2 ∂A/∂x_c
  for (int c = 0; c < 3; ++c) slope[c] = cross(n, e[c]);
  // change of the unit normal under w: −Σ (n × e_c)(n·w_c)/(2A)
  const auto turn = -(slope[0] * dot(n, w[0]) + slope[1] * dot(n, w[1]) + slope[2] * dot(n, w[2])) * inverse;
  std::array<Vec3<Real>, 3> out;
  for (int c = 0; c < 3; ++c) {
    const auto edge_change = w[(c + 2) % 3] - w[(c + 1) % 3];
    out[c] = (cross(turn, e[c]) + cross(n, edge_change) + slope[c] * beta) * Real(0.5) + cross(u_sum, e[c]) * Real(1.0 / 6.0);
  }
  return out;
}

}  // namespace

template <int W>
void add_helfrich(BlockState<W>& state, const Shells& shells, const ShellMaterials& materials) noexcept {
  using Real = Lane<double, W>;
  ForceWorkspace& ws = state.ws;
  const Helfrich<Real> law{parameter<double, W>(state.block, shells, materials, &ShellParameters::helfrich_rigidity),
                           parameter<double, W>(state.block, shells, materials, &ShellParameters::spontaneous_curvature)};
  measure_nodes(state);
  for (std::size_t i = 0; i < state.topology.node_count(); ++i) {
    const auto g = load_vec3<double, W>(ws.area_gradient.data(), i), v = load_vec3<double, W>(ws.volume_gradient.data(), i);
    const Real area = load_scalar<double, W>(ws.node_area.data(), i), inverse = Real(1.0) / norm(v);
    const auto normal = v * inverse;
    const auto w = law.excess(g, area, normal);
    state.energy += law.energy(w, area);
    store_vec3<double, W>(ws.area_gradient.data(), i, w * law.rigidity);
    store_vec3<double, W>(ws.volume_gradient.data(), i, law.volume_vector(g, normal, inverse));
    law.node_area_slope(w, g, area).store(ws.node_area.data() + i * W);
  }
  for (std::size_t f = 0; f < state.topology.face_count(); ++f) {
    const Triangle& t = state.topology.faces()[f];
    const auto x0 = state.x(t[0]), x1 = state.x(t[1]), x2 = state.x(t[2]);
    const auto at = [&](const LaneVector<double>& array, int c) { return load_vec3<double, W>(array.data(), t[c]); };
    Real beta(0.0);
    for (int c = 0; c < 3; ++c) beta += load_scalar<double, W>(ws.node_area.data(), t[c]);
    const auto u = at(ws.volume_gradient, 0) + at(ws.volume_gradient, 1) + at(ws.volume_gradient, 2);
    const auto gradient =
        face_gradient<Real>({x2 - x1, x0 - x2, x1 - x0}, state.face_vector(f),
                            {at(ws.area_gradient, 0), at(ws.area_gradient, 1), at(ws.area_gradient, 2)}, beta * Real(1.0 / 3.0), u);
    for (int c = 0; c < 3; ++c) state.add_force(t[c], -gradient[c]);
  }
}

template void add_helfrich<1>(BlockState<1>&, const Shells&, const ShellMaterials&) noexcept;
template void add_helfrich<4>(BlockState<4>&, const Shells&, const ShellMaterials&) noexcept;
template void add_helfrich<8>(BlockState<8>&, const Shells&, const ShellMaterials&) noexcept;

}  // namespace morula::dcm
