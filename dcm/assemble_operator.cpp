#include <algorithm>
#include <cmath>
#include <numbers>

#include "dcm/laws/cortical_tension.h"
#include "dcm/laws/dihedral_barrier.h"
#include "dcm/laws/edge_damper.h"
#include "dcm/laws/edge_spring.h"
#include "dcm/laws/hinge_bending.h"
#include "dcm/laws/triangle_shape.h"
#include "dcm/laws/volume_pressure.h"
#include "dcm/operator_assembly.h"
#include "dcm/sheets_of_block.h"
#include "dcm/stencils/face.h"
#include "dcm/stencils/hinge.h"

namespace morula::dcm {
namespace {

/// The Gauss–Newton part of a face's shape term is kept where its stiffness w |∇(1/q)|² exceeds ¼ k + γ/100. It grows from zero with
/// the deviation from equilateral, so that most faces of an elastic mesh have none worth its memory (a node holds 3 k in the plane);
/// in a fluid mesh, where it is the only stiffness in the plane, nearly all keep it. What is left out changes the path of the
/// iteration, never the state it ends in.
template <class Real>
Real shape_threshold(Real spring_stiffness, Real sheet_shear, Real tension) noexcept {
  // a spring lattice has the shear modulus √3/4 k
  const Real stiffness = spring_stiffness + Real(static_cast<float>(4.0 / std::numbers::sqrt3)) * sheet_shear;
  return max(Real(1e-30f), Real(0.25f) * stiffness + Real(0.01f) * tension);
}

/// Append √w ∇(1/q) of corners 1 and 2 where any lane's term is worth it; the others get zeros.
template <int W>
void add_shape_term(Assembly<W>& a, std::uint32_t f, const FaceStencil<Lane<float, W>>& face, Lane<float, W> inverse_norm,
                    Lane<float, W> inverse_quality, Lane<float, W> weight, Lane<float, W> threshold) noexcept {
  using Real = Lane<float, W>;
  // 1/q = Σl²/(4√3 A): ∇(1/q) = [∇Σl² − 4√3 (1/q) ∇A] / (4√3 A)
  const Real scale = inverse_norm * Real(static_cast<float>(2.0 / TriangleShape<float>::kEquilateral));
  const auto unit_normal = face.twice_area_vector * inverse_norm;
  const Real area_part = inverse_quality * inverse_norm;  // (1/q) / (2A)
  const auto g1 = (face.e2 - face.e0) * (Real(2.0f) * scale) - cross(unit_normal, face.e1) * area_part;
  const auto g2 = (face.e0 - face.e1) * (Real(2.0f) * scale) - cross(unit_normal, face.e2) * area_part;
  const Real size = weight * (norm2(g1) + norm2(g2) + norm2(g1 + g2));
  const auto counts = size >= threshold;
  if (!any_lane<W>(counts)) return;
  const Real root = select(counts, sqrt(weight * a.dt), Real(0.0f));
  const std::size_t place = a.out.shape.size();
  a.out.shape_face.push_back(f);
  a.out.shape.resize(place + 6 * W);
  store_vec3<float, W>(a.out.shape.data() + place, 0, g1 * root);
  store_vec3<float, W>(a.out.shape.data() + place, 1, g2 * root);
}

/// Face records, shape terms, volume gradient and volume term.
template <int W>
void assemble_faces(Assembly<W>& a) noexcept {
  using Real = Lane<float, W>;
  const CorticalTension<Real> tension{a.of_type(&ShellParameters::tension)};
  const TriangleShape<Real> shape{a.of_type(&ShellParameters::shape_stiffness)};
  const bool has_shape = any_lane<W>(shape.stiffness > Real(0.0f));
  const Real sheet_shear = by_lane<float, W>(a.block, [&](std::uint32_t s) { return sheet_strengths<float>(a.materials.of(a.shells, s)); });
  const Real threshold = shape_threshold(a.of_type(&ShellParameters::spring_stiffness), sheet_shear, tension.tension);
  const ShapeArray<float, W> unit_area(a.block, a.shells, &ReferenceShape::face_area);
  const Real scale = by_lane<float, W>(a.block, [&](std::uint32_t s) { return std::pow(std::cbrt(a.shells.rest_volume[s]), 2); });
  Real six_volumes(0.0f);
  const auto faces = a.topology.faces();
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const Triangle& t = faces[f];
    const auto x0 = a.x(t[0]);
    const auto face = FaceStencil<Real>::of(x0, a.x(t[1]), a.x(t[2]));
    const auto& n = face.twice_area_vector;
    const Real inverse_norm = Real(1.0f) / norm(n);
    six_volumes += dot(x0, n);
    for (const std::uint32_t node : t) add_vec3<float, W>(a.out.volume_gradient.data(), node, n * Real(1.0f / 6.0f));

    const Real weight = tension.stiffness_weight(load_scalar<float, W>(a.ws.contact_energy.data(), f));
    FaceRecord<W> record{n, inverse_norm, Real(0.5f) * a.dt * weight * inverse_norm * inverse_norm * inverse_norm, Real(0.0f)};
    if (has_shape) {
      const Real inverse_area = Real(2.0f) * inverse_norm, reference_area = unit_area[f] * scale;
      const Real inverse_quality = shape.inverse_quality(inverse_area, face.square_sum());
      record.isotropic = Real(2.0f) * a.dt * max(Real(0.0f), shape.square_sum_slope(inverse_quality, inverse_area, reference_area));
      add_shape_term(a, f, face, inverse_norm, inverse_quality, shape.gauss_newton_weight(reference_area), threshold);
    }
    record.store(a.ws.face, f);
  }
  for (int lane = 0; lane < W; ++lane) {
    const std::uint32_t shell = a.block.member[lane];
    const VolumePressure law{a.materials.of(a.shells, shell).bulk_modulus};
    const double volume = six_volumes[lane] / 6.0 - (a.held.empty() ? 0.0 : a.held[shell].volume);
    a.out.volume_stiffness[lane] = volume > 0.0 ? static_cast<float>(law.curvature_psd(volume)) * a.dt[lane] : 0.0f;
  }
}

/// A hinge resists its two opposite nodes with k_h (1/h₁² + 1/h₂²), and the stiffest mode of a net of hinges is twenty times as stiff; that of
/// the tension, which the matrix has, is 3.5 γ. Below γ/20 (kStiffHinge) the net adds less than γ to that and needs no term: a term that is left out
/// changes the path of the iteration, never the state it ends in.
constexpr float kStiffHinge = 0.05f;

/// Which edges of a block need a term of their own: beyond the onset of the barrier, or with a hinge that is stiff against the tension.
template <int W>
struct HingeChoice {
  using Real = Lane<float, W>;
  Real cos_onset, stiffness, threshold;

  static HingeChoice of(const Assembly<W>& a) noexcept {
    const auto cos_onset = by_lane<float, W>(a.block, [&](std::uint32_t shell) {
      const ShellParameters& p = a.materials.of(a.shells, shell);
      return p.barrier_stiffness > 0.0 ? std::cos(p.barrier_angle) : -2.0;
    });
    return {cos_onset, a.of_type(&ShellParameters::hinge_stiffness),
            max(Real(1e-30f), Real(kStiffHinge) * a.of_type(&ShellParameters::tension))};
  }
  [[nodiscard]] Real cos_margin(const FaceRecord<W>& left, const FaceRecord<W>& right) const noexcept {
    return dot(left.n, right.n) * left.inverse_norm * right.inverse_norm - cos_onset;
  }
  [[nodiscard]] Real stiff_margin(const FaceRecord<W>& left, const FaceRecord<W>& right, const Real& square_length) const noexcept {
    return threshold - stiffness * square_length * (left.inverse_norm * left.inverse_norm + right.inverse_norm * right.inverse_norm);
  }
};

/// Edge blocks; true when an edge of the block needs a hinge term.
template <int W>
bool assemble_edges(Assembly<W>& a, const ShellFriction::Block& friction, const HingeChoice<W>& choice) noexcept {
  using Real = Lane<float, W>;
  const EdgeSpring<Real> spring{a.of_type(&ShellParameters::spring_stiffness)};
  const EdgeDamper<Real> damper{to_float<W>(Lane<double, W>::load(friction.damping.data()))};
  const IsotropicDamper<Real> isotropic_damper{to_float<W>(Lane<double, W>::load(friction.isotropic_damping.data()))};
  Real margin(1.0f);
  const auto edges = a.topology.edges();
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const Edge& edge = edges[k];
    const auto xi = a.x(edge.i), xj = a.x(edge.j), xk = a.x(edge.k), xl = a.x(edge.l);
    const auto left = FaceRecord<W>::load(a.ws.face, edge.left), right = FaceRecord<W>::load(a.ws.face, edge.right);
    const auto e = xj - xi;
    const Real length = norm(e), rest_length = load_scalar<float, W>(a.ws.rest_length.data(), k);
    SymMat3<Real> m =
        damper.friction(normalized(load_vec3<float, W>(a.ws.start.data(), edge.j) - load_vec3<float, W>(a.ws.start.data(), edge.i)));
    // ½ cot of the angle opposite to the edge, times n nᵀ; 1/|N|³ is in the record
    SymMat3<Real> stiffness = a.dt * spring.stiffness_psd(e * (Real(1.0f) / length), length, rest_length);
    stiffness += outer(left.tension * dot(xi - xk, xj - xk), left.n);
    stiffness += outer(right.tension * dot(xi - xl, xj - xl), right.n);
    stiffness += isotropic(left.isotropic + right.isotropic);
    add_rotation(a, edge, stiffness);
    m += stiffness + isotropic(isotropic_damper.damping);
    margin = min(margin, min(choice.cos_margin(left, right), choice.stiff_margin(left, right, norm2(e))));
    float* p = a.out.edge.data() + k * 6 * W;
    m.xx.store(p), m.xy.store(p + W), m.xz.store(p + 2 * W), m.yy.store(p + 3 * W), m.yz.store(p + 4 * W), m.zz.store(p + 5 * W);
  }
  return any_lane<W>(margin < Real(0.0f));
}

template <int W>
void assemble_hinges(Assembly<W>& a, const HingeChoice<W>& choice) noexcept {
  using Real = Lane<float, W>;
  using Double = Lane<double, W>;
  const DihedralBarrier<Double> barrier{parameter<double, W>(a.block, a.shells, a.materials, &ShellParameters::barrier_stiffness),
                                        parameter<double, W>(a.block, a.shells, a.materials, &ShellParameters::barrier_angle)};
  const HingeBending<Real> hinge{choice.stiffness};
  const auto edges = a.topology.edges();
  for (std::uint32_t k = 0; k < edges.size(); ++k) {
    const Edge& edge = edges[k];
    const auto left = FaceRecord<W>::load(a.ws.face, edge.left), right = FaceRecord<W>::load(a.ws.face, edge.right);
    const auto stiff = choice.stiff_margin(left, right, norm2(a.x(edge.j) - a.x(edge.i))) < Real(0.0f);
    if (!any_lane<W>(stiff | (choice.cos_margin(left, right) < Real(0.0f)))) continue;
    const auto x = [&](std::uint32_t node) { return load_vec3<double, W>(a.ws.position.data(), node); };
    const auto normal = [&](std::uint32_t face) {
      const Triangle& t = a.topology.faces()[face];
      return cross(x(t[1]) - x(t[0]), x(t[2]) - x(t[0]));
    };
    const auto e = x(edge.j) - x(edge.i), n1 = normal(edge.left), n2 = normal(edge.right);
    const Double length = norm(e), inverse_length = Double(1.0) / length;
    const Double angle = hinge_angle(n1, n2, e * inverse_length);
    const auto g = HingeGradient<Double>::of(e, length, inverse_length, x(edge.k) - x(edge.i), x(edge.l) - x(edge.i), n1,
                                             Double(1.0) / norm2(n1), n2, Double(1.0) / norm2(n2));
    const Real curvature = to_float<W>(barrier.curvature_psd(angle)) + select(stiff, hinge.curvature_psd(), Real(0.0f));
    const Real root = sqrt(curvature * a.dt);
    const std::size_t place = a.out.hinge.size();
    a.out.hinge_edge.push_back(k);
    a.out.hinge.resize(place + 9 * W);
    store_vec3<float, W>(a.out.hinge.data() + place, 0, to_float<W>(g.j) * root);
    store_vec3<float, W>(a.out.hinge.data() + place, 1, to_float<W>(g.k) * root);
    store_vec3<float, W>(a.out.hinge.data() + place, 2, to_float<W>(g.l) * root);
  }
}

/// Bring positions (now and at the step's start, relative to node 0), rest lengths and contact energies of the block into lanes of float.
template <int W>
void load_inputs(Assembly<W>& a, std::span<const Vec3d> position, std::span<const Vec3d> start, const ShellBlocks& blocks,
                 std::span<const double> contact_energy) noexcept {
  const std::size_t nodes = a.topology.node_count(), edges = a.topology.edge_count(), faces = a.topology.face_count();
  const auto convert = [](const LaneVector<double>& in, std::size_t count, LaneVector<float>& out) {
    out.resize(std::max(out.size(), count));
    for (std::size_t i = 0; i < count; i += W) to_float<W>(Lane<double, W>::load(in.data() + i)).store(out.data() + i);
  };
  a.ws.position.resize(std::max(a.ws.position.size(), nodes * 3 * W));
  const auto relative = [&](std::span<const Vec3d> x, LaneVector<float>& out) {
    load_relative_positions<W>(a.block, lane_pointers<W>(&x.data()->x, a.block, a.shells.first_node, 3), a.ws.position.data());
    convert(a.ws.position, nodes * 3 * W, out);
  };
  relative(start, a.ws.start);
  relative(position, a.ws.local);
  a.ws.rest_length_double.resize(std::max(a.ws.rest_length_double.size(), edges * W));
  load_lanes<W, double>(lane_pointers<W>(a.shells.rest_length.data(), a.block, a.shells.first_edge), edges, a.ws.rest_length_double.data());
  convert(a.ws.rest_length_double, edges * W, a.ws.rest_length);
  if (contact_energy.empty()) {
    a.ws.contact_energy.assign(faces * W, 0.0f);
  } else {
    a.ws.contact_energy_double.resize(std::max(a.ws.contact_energy_double.size(), faces * W));
    load_lanes<W, double>(lane_pointers<W>(contact_energy.data(), a.block, blocks.first_face), faces, a.ws.contact_energy_double.data());
    convert(a.ws.contact_energy_double, faces * W, a.ws.contact_energy);
  }
  a.ws.face.resize(std::max(a.ws.face.size(), faces * FaceRecord<W>::kSize * W));
}

template <int W>
void assemble_block(const ShellBlocks& blocks, const LaneBlock& block, const Shells& shells, const ShellMaterials& materials,
                    std::span<const Vec3d> position, const ShellFriction::Block& friction, std::span<const Vec3d> start,
                    std::span<const double> contact_energy, double time_step, const EdgeBlockSource& contacts,
                    std::span<const HeldVolume> held, ShellOperator::Block& out, OperatorWorkspace& ws) noexcept {
  const Topology& topology = *block.topology;
  const std::size_t nodes = topology.node_count();
  Assembly<W> a{block, shells, materials, topology, ws, out, Lane<float, W>(static_cast<float>(time_step)), held};
  load_inputs(a, position, start, blocks, contact_energy);
  const std::size_t edges = topology.edge_count();
  out.edge.resize(edges * 6 * W);
  out.volume_gradient.assign(nodes * 3 * W, 0.0f);
  out.rotation.assign(nodes * 9 * W, 0.0f);
  out.diagonal.resize(nodes * W);
  out.shape_face.clear(), out.shape.clear(), out.hinge_edge.clear(), out.hinge.clear();
  for (std::size_t i = 0; i < nodes; ++i) to_float<W>(load_scalar<double, W>(friction.medium.data(), i)).store(out.diagonal.data() + i * W);
  const auto any = [&](double ShellParameters::*strength) { return any_has<W>(block, shells, materials, strength); };
  const bool global_area = any(&ShellParameters::global_area_modulus);
  if (global_area || any(&ShellParameters::local_area_modulus)) add_area_tensions(a);
  assemble_faces(a);
  const auto choice = HingeChoice<W>::of(a);
  if (assemble_edges(a, friction, choice)) assemble_hinges(a, choice);
  out.membrane.clear(), out.area_gradient.clear(), out.bending_normal.clear(), out.bending_weight.clear();
  assemble_sheets(a);
  free_rotations(a);
  if (global_area) assemble_global_area(a);
  if (any(&ShellParameters::helfrich_rigidity)) assemble_bending(a);
  out.bulk_gradient.resize(friction.volume_gradient.size());
  for (std::size_t i = 0; i < out.bulk_gradient.size(); ++i) out.bulk_gradient[i] = static_cast<float>(friction.volume_gradient[i]);
  for (int lane = 0; lane < W; ++lane) out.bulk_friction[lane] = static_cast<float>(friction.bulk_friction[lane]);
  if (contacts) add_contact_edges<W>(block, contacts, ws, out.edge);
}

}  // namespace

void assemble_shell_operator(const ShellBlocks& blocks, const Shells& shells, const ShellMaterials& materials,
                             std::span<const Vec3d> position, const ShellFriction& friction, std::span<const double> face_contact_energy,
                             double time_step, const EdgeBlockSource& contacts, ShellOperator& out, std::span<const HeldVolume> held) {
  out.blocks.resize(blocks.blocks.size());
  for_each_block<OperatorWorkspace>(blocks, [&]<int W>(std::size_t b, const LaneBlock& block, OperatorWorkspace& ws) {
    assemble_block<W>(blocks, block, shells, materials, position, friction.blocks[b], friction.start, face_contact_energy, time_step,
                      contacts, held, out.blocks[b], ws);
  });
}

}  // namespace morula::dcm
