#pragma once
#include <utility>

#include "dcm/block_state.h"
#include "dcm/laws/area_elasticity.h"
#include "dcm/operator_assembly.h"
#include "dcm/stencils/strained_face.h"

namespace morula::dcm {

/// A law of the strain of a face with the coefficients of the shells of a block. `Law<Real>` is a plain struct of its coefficients, the strength
/// first, with `stress(trace, det)` and `moduli(trace, det)`; one that holds in a range of strains only has a static `excess(trace, det)` as
/// well, > 0 outside it.
template <template <class> class Law, class Real>
struct OneSheet {
  static constexpr std::size_t kCount = std::is_empty_v<Law<double>> ? 0 : sizeof(Law<double>) / sizeof(double);
  static_assert(kCount <= std::tuple_size_v<SheetCoefficients>);
  static constexpr bool kHasRange = requires(Real x) { Law<Real>::excess(x, x); };

  Law<Real> law;
  Real strength;

  static OneSheet of(const Real* c) noexcept {
    return [c]<std::size_t... I>(std::index_sequence<I...>) {
      if constexpr (kCount == 0)
        return OneSheet{{}, Real(0.0)};
      else
        return OneSheet{{c[I]...}, c[0]};
    }
    (std::make_index_sequence<kCount>());
  }
  MembraneStress<Real> stress(const Real& trace, const Real& det) const noexcept { return law.stress(trace, det); }
  MembraneModuli<Real> moduli(const Real& trace, const Real& det) const noexcept { return law.moduli(trace, det); }
  /// Raises `most` to the excess of the shells that have the law.
  void raise_excess(const Real& trace, const Real& det, Real& most) const noexcept {
    if constexpr (kHasRange) most = max(most, select(strength > Real(0.0), Law<Real>::excess(trace, det), Real(0.0)));
  }
};

/// Forces, energy and excess of stretch of the faces of a block: those of its sheets and of the area of every face (`area`: its modulus, or
/// null).
template <int W, class Sheets>
void add_sheet_forces(BlockState<W>& state, const Sheets& sheets, const Lane<double, W>* area) noexcept {
  using Real = Lane<double, W>;
  const AreaElasticity<Real> local{area != nullptr ? *area : Real(0.0)};
  const auto faces = state.topology.faces();
  const auto face_edges = state.topology.face_edges();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Triangle& t = faces[f];
    const auto x0 = state.x(t[0]), x1 = state.x(t[1]), x2 = state.x(t[2]);
    const auto e0 = x2 - x1, e1 = x0 - x2, e2 = x1 - x0;
    const std::array<Real, 3> now{norm2(e0), norm2(e1), norm2(e2)};
    const auto rest_length = [&](std::uint32_t edge) { return state.rest_length(edge); };
    const auto strain = MembraneStrain<Real>::of(rest_squares<Real>(face_edges[f], rest_length, state.strained, now), now);
    auto stress = sheets.stress(strain.trace, strain.det);
    if (area != nullptr) stress += local.stress(strain.det);
    state.energy += strain.reference_area * stress.energy;
    sheets.raise_excess(strain.trace, strain.det, state.stretch_excess);
    const Real twice_area = Real(2.0) * strain.reference_area;
    const auto pull = [&](int c) { return twice_area * (stress.trace * strain.trace_slope[c] + stress.det * strain.det_slope[c]); };
    const auto f0 = e0 * pull(0), f1 = e1 * pull(1), f2 = e2 * pull(2);
    state.add_force(t[0], f2 - f1);
    state.add_force(t[1], f0 - f2);
    state.add_force(t[2], f1 - f0);
  }
}

/// Stiffness of the same: adds to the edge blocks and writes `membrane`. After the edges are assembled.
template <int W, class Sheets>
void assemble_sheet_stiffness(Assembly<W>& a, const Sheets& sheets, const Lane<float, W>* area_modulus) noexcept {
  using Real = Lane<float, W>;
  const AreaElasticity<Real> local{area_modulus != nullptr ? *area_modulus : Real(0.0f)};
  const auto face_edges = a.topology.face_edges();
  a.out.membrane.resize(face_edges.size() * 9 * W);
  for (std::size_t f = 0; f < face_edges.size(); ++f) {
    const auto [e, s] = StrainedFace<W>::of(a, f);
    auto moduli = sheets.moduli(s.trace, s.det);
    if (area_modulus != nullptr) moduli += local.moduli(s.det);
    // the geometric stiffness of the area is that of a tension (add_area_tensions)
    const auto pull = tensile_part(sheets.stress(s.trace, s.det), s.trace, s.det);
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
      add_rotation(a, a.topology.edges()[face_edges[f][c]], isotropic(across));
    }
    float* p = a.out.membrane.data() + f * 9 * W;
    h(0, 1).store(p), h(1, 2).store(p + W), h(2, 0).store(p + 2 * W);
    store_vec3<float, W>(p + 3 * W, 0, e[1]);
    store_vec3<float, W>(p + 3 * W, 1, e[2]);
  }
}

/// The loops of one law for W shells at once.
template <template <class> class Law, int W>
SheetFunctions<W> sheet_functions() {
  using Real = Lane<double, W>;
  using Float = Lane<float, W>;
  using OfReal = OneSheet<Law, Real>;
  using OfFloat = OneSheet<Law, Float>;
  return {.add_forces = [](BlockState<W>& state, const Real* c, const Real* area) { add_sheet_forces<W>(state, OfReal::of(c), area); },
          .assemble = [](Assembly<W>& a, const Float* c, const Float* area) { assemble_sheet_stiffness<W>(a, OfFloat::of(c), area); },
          .add_stress = [](const Real* c, const Real& trace, const Real& det,
                           MembraneStress<Real>& out) { out += OfReal::of(c).stress(trace, det); },
          .add_excess = [](const Real* c, const Real& trace, const Real& det, Real& out) { OfReal::of(c).raise_excess(trace, det, out); },
          .add_stress_float = [](const Float* c, const Float& trace, const Float& det,
                                 MembraneStress<Float>& out) { out += OfFloat::of(c).stress(trace, det); },
          .add_moduli = [](const Float* c, const Float& trace, const Float& det,
                           MembraneModuli<Float>& out) { out += OfFloat::of(c).moduli(trace, det); }};
}

/// A law of the strain of a face for the loops, from its struct.
template <template <class> class Law>
std::shared_ptr<const SheetLaw> sheet_law(std::string name, std::string limit = {}) {
  auto out = std::make_shared<SheetLaw>();
  out->name = std::move(name);
  out->limit = std::move(limit);
  if constexpr (OneSheet<Law, double>::kHasRange) out->excess = [](double trace, double det) { return Law<double>::excess(trace, det); };
  out->coefficient_count = OneSheet<Law, double>::kCount;
  out->functions = {sheet_functions<Law, 1>(), sheet_functions<Law, 4>(), sheet_functions<Law, 8>()};
  return out;
}

}  // namespace morula::dcm
