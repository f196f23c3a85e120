#include <algorithm>

#include "dcm/laws/helfrich.h"
#include "dcm/membrane.h"
#include "dcm/operator_assembly.h"
#include "dcm/stencils/face.h"

namespace morula::dcm {
namespace {

/// A face of the block: its edges and its strain.
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
    const auto rest = rest_squares<Real>(a.topology.face_edges()[f],
                                         [&](std::uint32_t edge) { return load_scalar<float, W>(a.ws.rest_length.data(), edge); });
    out.strain = MembraneStrain<Real>::of(rest, {norm2(out.e[0]), norm2(out.e[1]), norm2(out.e[2])});
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

}  // namespace

template <int W>
void add_area_tensions(Assembly<W>& a) noexcept {
  using Real = Lane<float, W>;
  const AreaElasticity<Real> local{a.of_type(&ShellParameters::local_area_modulus)};
  const AreaElasticity<Real> global{a.of_type(&ShellParameters::global_area_modulus)};
  Real area(0.0f), reference(0.0f);
  const std::size_t faces = a.topology.face_count();
  float* const tension = a.ws.contact_energy.data();
  for (std::size_t f = 0; f < faces; ++f) {
    const auto face = StrainedFace<W>::of(a, f);
    const Real ratio = sqrt(face.strain.det);
    area += ratio * face.strain.reference_area;
    reference += face.strain.reference_area;
    (Real::load(tension + f * W) + local.modulus * (ratio - Real(1.0f))).store(tension + f * W);
  }
  const Real whole = global.tension(area, reference);
  for (std::size_t f = 0; f < faces; ++f) (Real::load(tension + f * W) + whole).store(tension + f * W);
}

template <int W>
void assemble_membrane(Assembly<W>& a) noexcept {
  using Real = Lane<float, W>;
  const auto membrane = Membrane<float, W>::of(a.block, a.shells, a.types);
  const auto face_edges = a.topology.face_edges();
  a.out.membrane.resize(face_edges.size() * 9 * W);
  for (std::size_t f = 0; f < face_edges.size(); ++f) {
    const auto [e, s] = StrainedFace<W>::of(a, f);
    const auto moduli = membrane.moduli(s);
    const auto pull = tensile_part(membrane.elastic_stress(s), s.trace, s.det);
    const Real area = s.reference_area * a.dt, four_areas = Real(4.0f) * area;
    // ∂²W/∂q_c∂q_d of the quadratic form in the squared lengths; a squared length changes by 2 e_c·Δv
    const auto h = [&](int c, int d) {
      const Real mixed = s.trace_slope[c] * s.det_slope[d] + s.det_slope[c] * s.trace_slope[d];
      return four_areas * (moduli.tt * (s.trace_slope[c] * s.trace_slope[d]) + moduli.td * mixed +
                           moduli.dd * (s.det_slope[c] * s.det_slope[d]) + (c == d ? -moduli.d : moduli.d) * s.twist);
    };
    for (int c = 0; c < 3; ++c) {
      const Real across = Real(2.0f) * area * (pull.trace * s.trace_slope[c] + pull.det * s.det_slope[c]);
      add_to_edge(a, face_edges[f][c], outer(h(c, c), e[c]) + isotropic(across));
    }
    float* p = a.out.membrane.data() + f * 9 * W;
    h(0, 1).store(p), h(1, 2).store(p + W), h(2, 0).store(p + 2 * W);
    store_vec3<float, W>(p + 3 * W, 0, e[1]);
    store_vec3<float, W>(p + 3 * W, 1, e[2]);
  }
}

template <int W>
void assemble_global_area(Assembly<W>& a) noexcept {
  using Real = Lane<float, W>;
  const AreaElasticity<Real> law{a.of_type(&ShellParameters::global_area_modulus)};
  a.out.area_gradient.assign(a.topology.node_count() * std::size_t{3} * W, 0.0f);
  Real reference(0.0f);
  for (std::size_t f = 0; f < a.topology.face_count(); ++f) {
    const auto face = StrainedFace<W>::of(a, f);
    const auto record = FaceRecord<W>::load(a.ws.face, f);
    const auto half_normal = record.n * (Real(0.5f) * record.inverse_norm);
    reference += face.strain.reference_area;
    for (int c = 0; c < 3; ++c) add_vec3<float, W>(a.out.area_gradient.data(), a.topology.faces()[f][c], cross(half_normal, face.e[c]));
  }
  const Real stiffness = law.curvature_psd(reference) * a.dt;
  stiffness.store(a.out.area_stiffness.data());
}

template <int W>
void assemble_bending(Assembly<W>& a) noexcept {
  using Real = Lane<float, W>;
  const Helfrich<Real> law{a.of_type(&ShellParameters::helfrich_rigidity), Real(0.0f)};
  const std::size_t nodes = a.topology.node_count(), edges = a.topology.edge_count();
  a.out.bending_weight.resize(edges * W);
  for (std::size_t k = 0; k < edges; ++k) {
    const Edge& edge = a.topology.edges()[k];
    const auto xi = a.x(edge.i), xj = a.x(edge.j), xk = a.x(edge.k), xl = a.x(edge.l);
    const auto left = FaceRecord<W>::load(a.ws.face, edge.left), right = FaceRecord<W>::load(a.ws.face, edge.right);
    const Real weight = dot(xi - xk, xj - xk) * left.inverse_norm + dot(xi - xl, xj - xl) * right.inverse_norm;
    (Real(0.5f) * weight).store(a.out.bending_weight.data() + k * W);
  }
  a.ws.node_area.assign(nodes * W, 0.0f);
  for (std::size_t f = 0; f < a.topology.face_count(); ++f) {
    const auto record = FaceRecord<W>::load(a.ws.face, f);
    const Real sixth = norm2(record.n) * record.inverse_norm * Real(1.0f / 6.0f);
    for (const std::uint32_t node : a.topology.faces()[f]) {
      float* area = a.ws.node_area.data() + std::size_t{node} * W;
      (Real::load(area) + sixth).store(area);
    }
  }
  a.out.bending_normal.resize(nodes * 3 * W);
  for (std::size_t i = 0; i < nodes; ++i) {
    const Real root = sqrt(a.dt * law.gauss_newton_weight(load_scalar<float, W>(a.ws.node_area.data(), i)));
    store_vec3<float, W>(a.out.bending_normal.data(), i, normalized(load_vec3<float, W>(a.out.volume_gradient.data(), i)) * root);
  }
}

template void add_area_tensions<1>(Assembly<1>&) noexcept;
template void add_area_tensions<4>(Assembly<4>&) noexcept;
template void add_area_tensions<8>(Assembly<8>&) noexcept;
template void assemble_membrane<1>(Assembly<1>&) noexcept;
template void assemble_membrane<4>(Assembly<4>&) noexcept;
template void assemble_membrane<8>(Assembly<8>&) noexcept;
template void assemble_global_area<1>(Assembly<1>&) noexcept;
template void assemble_global_area<4>(Assembly<4>&) noexcept;
template void assemble_global_area<8>(Assembly<8>&) noexcept;
template void assemble_bending<1>(Assembly<1>&) noexcept;
template void assemble_bending<4>(Assembly<4>&) noexcept;
template void assemble_bending<8>(Assembly<8>&) noexcept;

}  // namespace morula::dcm
