#include <algorithm>

#include "dcm/laws/helfrich.h"
#include "dcm/operator_assembly.h"
#include "dcm/sheet_loops.h"
#include "dcm/sheets_of_block.h"
#include "dcm/stencils/face.h"

namespace morula::dcm {
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
void assemble_sheets(Assembly<W>& a) noexcept {
  using Real = Lane<float, W>;
  const auto sheets = sheets_of_block<float, W>(a.block, a.shells, a.materials);
  const bool has_area = any_has<W>(a.block, a.shells, a.materials, &ShellParameters::local_area_modulus);
  const Real modulus = a.of_type(&ShellParameters::local_area_modulus);
  const Real* const area = has_area ? &modulus : nullptr;
  if (sheets.size() == 1)
    sheets[0].law->template in_lanes<W>().assemble(a, sheets[0].coefficient.data(), area);
  else if (sheets.size() > 1)
    assemble_sheet_stiffness<W>(a, SheetSumFloat<W>{sheets}, area);
  else if (has_area)
    assemble_sheet_stiffness<W>(a, OneSheet<NoSheet, Real>{}, area);
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
template void assemble_sheets<1>(Assembly<1>&) noexcept;
template void assemble_sheets<4>(Assembly<4>&) noexcept;
template void assemble_sheets<8>(Assembly<8>&) noexcept;
template void assemble_global_area<1>(Assembly<1>&) noexcept;
template void assemble_global_area<4>(Assembly<4>&) noexcept;
template void assemble_global_area<8>(Assembly<8>&) noexcept;
template void assemble_bending<1>(Assembly<1>&) noexcept;
template void assemble_bending<4>(Assembly<4>&) noexcept;
template void assemble_bending<8>(Assembly<8>&) noexcept;

}  // namespace morula::dcm
