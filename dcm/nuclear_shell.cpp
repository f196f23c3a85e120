#include "dcm/nuclear_shell.h"

#include <algorithm>
#include <cmath>

#include "core/ball.h"
#include "core/mesh/closest_point.h"
#include "core/mesh/face_quadrature.h"
#include "core/mesh/pseudonormal.h"
#include "dcm/growth.h"
#include "dcm/laws/nucleus_repulsion.h"
#include "dcm/laws/volume_pressure.h"

namespace morula::dcm {
namespace {

/// A link at the present positions.
struct Stretched {
  Vec3d direction;  ///< from the nucleus to the cortex
  double length = 0.0;
};
Stretched stretched(const NucleusView& view, const InteriorLink& link) {
  const Vec3d d = view.cell[link.i] - view.nucleus[link.j];
  const double length = norm(d);
  return {length > 0.0 ? d * (1.0 / length) : Vec3d{}, length};
}

/// ∂V/∂x of a closed surface: a sixth of the doubled area vectors around each node.
void volume_gradient(const Topology& topology, std::span<const Vec3d> node, std::vector<Vec3d>& out) {
  out.assign(node.size(), {});
  for (const Triangle& t : topology.faces()) {
    const Vec3d sixth = cross(node[t[1]] - node[t[0]], node[t[2]] - node[t[0]]) * (1.0 / 6.0);
    for (const std::uint32_t corner : t) out[corner] += sixth;
  }
}

/// Σ w (r² I − r rᵀ).
SymMat3<double> inertia_of(std::span<const double> weight, std::span<const Vec3d> arm) {
  SymMat3<double> out;
  for (std::size_t k = 0; k < arm.size(); ++k) out += isotropic(weight[k] * norm2(arm[k])) + outer(-weight[k], arm[k]);
  return out;
}

/// v̄ + ω̄ × r.
struct RigidMotion {
  Vec3d shift, turn;

  Vec3d at(const Vec3d& arm) const { return shift + cross(turn, arm); }
};
/// The nearest one to these motions; weights add up to one, and arms by weight to nothing.
RigidMotion nearest_rigid_motion(std::span<const double> weight, std::span<const Vec3d> arm, const SymMat3<double>& inverse_inertia,
                                 std::span<const Vec3d> motion) {
  Vec3d shift, moment;
  for (std::size_t k = 0; k < motion.size(); ++k) {
    shift += motion[k] * weight[k];
    moment += cross(arm[k], motion[k]) * weight[k];
  }
  return {shift, inverse_inertia * moment};
}

/// Friction of the drag on motions `way`, added to `result`; gives way·result.
double add_drag(const NuclearFriction& friction, std::span<const Vec3d> cell_way, std::span<const Vec3d> nucleus_way,
                std::span<Vec3d> cell_result, std::span<Vec3d> nucleus_result) {
  const RigidMotion cytoplasm = nearest_rigid_motion(friction.share, friction.arm, friction.inverse_inertia, cell_way);
  Vec3d force, torque;
  double quadratic = 0.0;
  for (std::size_t i = 0; i < nucleus_way.size(); ++i) {
    const Vec3d relative = nucleus_way[i] - cytoplasm.at(friction.nucleus_arm[i]), drag = relative * friction.friction[i];
    nucleus_result[i] += drag;
    force += drag;
    torque += cross(friction.nucleus_arm[i], drag);
    quadratic += dot(relative, drag);
  }
  const Vec3d twist = friction.inverse_inertia * torque;
  for (std::size_t k = 0; k < cell_way.size(); ++k) cell_result[k] -= (force + cross(twist, friction.arm[k])) * friction.share[k];
  return quadratic;
}

/// Vectors of the solver as doubles.
std::vector<Vec3d> in_double(std::span<const Float4> v) {
  std::vector<Vec3d> out(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) out[i] = {v[i].x, v[i].y, v[i].z};
  return out;
}
void add_in_float(std::span<const Vec3d> v, std::span<Float4> out) {
  for (std::size_t i = 0; i < v.size(); ++i) {
    out[i].x += static_cast<float>(v[i].x);
    out[i].y += static_cast<float>(v[i].y);
    out[i].z += static_cast<float>(v[i].z);
  }
}
void add_in_float(const SymMat3<double>& m, SymMat3<float>& out) { out += to_float(m); }

/// Rounding of g_c and of the stiffness in the cell's own operator shall not make the sum of both indefinite.
constexpr double kCoupled = 0.999;

}  // namespace

std::size_t NuclearShells::of_shell(std::size_t shell) const {
  const auto at = std::lower_bound(owner.begin(), owner.end(), shell);
  return at != owner.end() && *at == shell ? static_cast<std::size_t>(at - owner.begin()) : size();
}

double nucleus_reference_volume(double nucleus_volume, double cell_volume, const ShellParameters& nucleus, double cell_tension) {
  const double cytosol = 2.0 * cell_tension / ball_radius(cell_volume);
  return pressure_free_reference(nucleus_volume, nucleus.tension, nucleus.bulk_modulus) * std::exp(cytosol / nucleus.bulk_modulus);
}

void set_nucleus_target(Shells& nuclei, std::size_t nucleus, const InteriorParameters& interior, double cell_tension,
                        double cell_target_volume) {
  const double volume = interior.nucleus_fraction * cell_target_volume;
  if (nuclei.rest_volume[nucleus] != volume) set_rest_volume(nuclei, nucleus, volume);
  nuclei.reference_volume[nucleus] = nucleus_reference_volume(volume, cell_target_volume, interior.nucleus_shell, cell_tension);
}

std::vector<InteriorLink> choose_nuclear_links(const ReferenceShape& cell, const ReferenceShape& nucleus,
                                               const InteriorParameters& parameters) {
  std::vector<InteriorLink> out = choose_links(cell, parameters).nucleus;
  const Vec3d middle = volume_centroid(cell.topology->faces(), cell.position);
  const double size = std::cbrt(parameters.nucleus_fraction);
  for (InteriorLink& link : out) {
    const Vec3d there = normalized(cell.position[link.i] - middle);
    double most = -2.0;
    for (std::uint32_t j = 0; j < nucleus.position.size(); ++j) {
      const double cosine = dot(there, normalized(nucleus.position[j]));
      if (cosine > most + 1e-9) most = cosine, link.j = j;  // ties to the lowest number
    }
    link.rest = norm(cell.position[link.i] - middle - nucleus.position[link.j] * size);
  }
  return out;
}

double add_nuclear_link_forces(const NucleusView& view, NucleusVectors force) {
  const double size = std::cbrt(view.rest_volume);
  const CytoskeletonLink law = view.parameters->nucleus_links.law();
  double energy = 0.0;
  for (const InteriorLink& link : view.links) {
    const Stretched now = stretched(view, link);
    const Vec3d pull = now.direction * law.pull(now.length, link.rest * size);
    force.cell[link.i] -= pull;
    force.nucleus[link.j] += pull;
    energy += law.energy(now.length, link.rest * size);
  }
  return energy;
}

void add_cytosol_pressure(const NucleusView& view, double pressure, std::span<Vec3d> nucleus_force) {
  for (const Triangle& t : view.nucleus_topology->faces()) {
    const Vec3d push = cross(view.nucleus[t[1]] - view.nucleus[t[0]], view.nucleus[t[2]] - view.nucleus[t[0]]) * (pressure * (1.0 / 6.0));
    for (const std::uint32_t corner : t) nucleus_force[corner] -= push;
  }
}

void find_nuclear_friction(const NucleusView& view, std::span<const double> cell_node_area, std::span<const double> nucleus_node_area,
                           NuclearFriction& out) {
  double area = 0.0;
  for (const double a : cell_node_area) area += a;
  out.share.clear(), out.arm.clear(), out.friction.clear(), out.nucleus_arm.clear(), out.direction.clear();
  out.center = {};
  for (std::size_t k = 0; k < view.cell.size(); ++k) {
    out.share.push_back(cell_node_area[k] / area);
    out.center += view.cell[k] * out.share[k];
  }
  for (const Vec3d& x : view.cell) out.arm.push_back(x - out.center);
  out.inverse_inertia = inverse(inertia_of(out.share, out.arm));
  double nucleus_area = 0.0;
  for (const double a : nucleus_node_area) nucleus_area += a;
  const double drag = CytoplasmDrag{view.parameters->cytoplasm_viscosity}.coefficient(nucleus_radius(*view.parameters, view.rest_volume));
  for (std::size_t i = 0; i < view.nucleus.size(); ++i) {
    out.friction.push_back(drag * (nucleus_node_area[i] / nucleus_area));
    out.nucleus_arm.push_back(view.nucleus[i] - out.center);
  }
  for (const InteriorLink& link : view.links) out.direction.push_back(stretched(view, link).direction);
}

void move_with_cell(const NuclearFriction& friction, std::span<const Vec3d> cell_velocity, std::span<Vec3d> nucleus_velocity) {
  const RigidMotion cell = nearest_rigid_motion(friction.share, friction.arm, friction.inverse_inertia, cell_velocity);
  double all = 0.0;
  for (const double f : friction.friction) all += f;
  std::vector<double> weight;
  std::vector<Vec3d> arm = friction.nucleus_arm;
  Vec3d center;
  for (std::size_t i = 0; i < arm.size(); ++i) {
    weight.push_back(friction.friction[i] / all);
    center += arm[i] * weight[i];
  }
  for (Vec3d& r : arm) r -= center;
  const RigidMotion own = nearest_rigid_motion(weight, arm, inverse(inertia_of(weight, arm)), nucleus_velocity);
  for (std::size_t i = 0; i < arm.size(); ++i) nucleus_velocity[i] += cell.at(friction.nucleus_arm[i]) - own.at(arm[i]);
}

double add_nuclear_friction(const NucleusView& view, const NuclearFriction& friction, NucleusVectors way, NucleusVectors result) {
  double quadratic = add_drag(friction, way.cell, way.nucleus, result.cell, result.nucleus);
  const double damping = view.parameters->nucleus_links.damping;
  for (std::size_t k = 0; k < view.links.size(); ++k) {
    const InteriorLink& link = view.links[k];
    const Vec3d& t = friction.direction[k];
    const double rate = dot(t, way.cell[link.i] - way.nucleus[link.j]);
    const Vec3d pull = t * (damping * rate);
    result.cell[link.i] += pull;
    result.nucleus[link.j] -= pull;
    quadratic += damping * rate * rate;
  }
  return quadratic;
}

void assemble_nuclear_operator(const NucleusView& view, const NuclearFriction& friction, double bulk_modulus, double time_step,
                               NuclearOperator& out) {
  out.friction = &friction;
  out.link.clear();
  out.contact.clear();
  const double size = std::cbrt(view.rest_volume);
  const CytoskeletonLink law = view.parameters->nucleus_links.law();
  for (std::size_t k = 0; k < view.links.size(); ++k) {
    const Stretched now = stretched(view, view.links[k]);
    out.link.push_back(outer(law.damping, friction.direction[k]) +
                       time_step * law.stiffness_psd(now.direction, now.length, view.links[k].rest * size));
  }
  volume_gradient(*view.cell_topology, view.cell, out.cell_gradient);
  volume_gradient(*view.nucleus_topology, view.nucleus, out.nucleus_gradient);
  const double cytosol = enclosed_volume(view.cell_topology->faces(), view.cell, view.cell[0]) -
                         enclosed_volume(view.nucleus_topology->faces(), view.nucleus, view.nucleus[0]);
  out.cytosol_stiffness = cytosol > 0.0 ? time_step * VolumePressure{bulk_modulus}.curvature_psd(cytosol) : 0.0;
}

void add_nuclear_contacts(std::span<const ContactElement> elements, const Topology& source, const Topology& target, bool of_cell,
                          int points_per_face, double time_step, NuclearOperator& out) {
  const FaceQuadrature& rule = FaceQuadrature::with_points(points_per_face);
  for (const ContactElement& element : elements) {
    if (!(element.stiffness() > 0.0f)) continue;
    NuclearOperator::Contact& contact = out.contact.emplace_back();
    const Triangle& s = source.faces()[element.source_face()];
    const Triangle& t = target.faces()[element.target()];
    element.weights(contact.mu);
    for (std::size_t k = 0; k < 3; ++k) {
      contact.source[k] = s[k];
      contact.target[k] = t[k];
      contact.beta[k] = rule.weight[element.point()][k];
    }
    contact.normal = element.normal<double>();
    contact.stiffness = time_step * static_cast<double>(element.stiffness());
    contact.of_cell = of_cell;
  }
}

void add_nuclear_product(const NucleusView& view, const NuclearOperator& matrix, std::span<const Float4> cell_p,
                         std::span<const Float4> nucleus_p, std::span<Float4> cell_q, std::span<Float4> nucleus_q) {
  const std::vector<Vec3d> pc = in_double(cell_p), pn = in_double(nucleus_p);
  std::vector<Vec3d> qc(pc.size()), qn(pn.size());
  (void)add_drag(*matrix.friction, pc, pn, qc, qn);
  for (std::size_t k = 0; k < view.links.size(); ++k) {
    const InteriorLink& link = view.links[k];
    const Vec3d force = matrix.link[k] * (pc[link.i] - pn[link.j]);
    qc[link.i] += force;
    qn[link.j] -= force;
  }
  for (const NuclearOperator::Contact& c : matrix.contact) {
    const auto& from = c.of_cell ? pc : pn;
    const auto& to = c.of_cell ? pn : pc;
    double rate = 0.0;
    for (std::size_t k = 0; k < 3; ++k) rate += dot(c.normal, from[c.source[k]] * c.beta[k] - to[c.target[k]] * c.mu[k]);
    const Vec3d force = c.normal * (c.stiffness * rate);
    auto& from_q = c.of_cell ? qc : qn;
    auto& to_q = c.of_cell ? qn : qc;
    for (std::size_t k = 0; k < 3; ++k) {
      from_q[c.source[k]] += force * c.beta[k];
      to_q[c.target[k]] -= force * c.mu[k];
    }
  }
  double cell_rate = 0.0, nucleus_rate = 0.0;
  for (std::size_t k = 0; k < pc.size(); ++k) cell_rate += dot(matrix.cell_gradient[k], pc[k]);
  for (std::size_t i = 0; i < pn.size(); ++i) nucleus_rate += dot(matrix.nucleus_gradient[i], pn[i]);
  const double on_cell = -kCoupled * matrix.cytosol_stiffness * nucleus_rate;
  const double on_nucleus = matrix.cytosol_stiffness * (nucleus_rate - kCoupled * cell_rate);
  for (std::size_t k = 0; k < qc.size(); ++k) qc[k] += matrix.cell_gradient[k] * on_cell;
  for (std::size_t i = 0; i < qn.size(); ++i) qn[i] += matrix.nucleus_gradient[i] * on_nucleus;
  add_in_float(qc, cell_q);
  add_in_float(qn, nucleus_q);
}

void add_nuclear_diagonal(const NucleusView& view, const NuclearOperator& matrix, std::span<SymMat3<float>> cell,
                          std::span<SymMat3<float>> nucleus) {
  // What the drag does to a single node of the cortex is (a/A)² of it, and the volume is left out as in the cells' own operator.
  for (std::size_t i = 0; i < nucleus.size(); ++i) add_in_float(isotropic(matrix.friction->friction[i]), nucleus[i]);
  for (std::size_t k = 0; k < view.links.size(); ++k) {
    add_in_float(matrix.link[k], cell[view.links[k].i]);
    add_in_float(matrix.link[k], nucleus[view.links[k].j]);
  }
  for (const NuclearOperator::Contact& c : matrix.contact)
    for (std::size_t k = 0; k < 3; ++k) {
      add_in_float(outer(c.stiffness * c.beta[k] * c.beta[k], c.normal), c.of_cell ? cell[c.source[k]] : nucleus[c.source[k]]);
      add_in_float(outer(c.stiffness * c.mu[k] * c.mu[k], c.normal), c.of_cell ? nucleus[c.target[k]] : cell[c.target[k]]);
    }
}

double nucleus_clearance(const NucleusView& view) {
  const auto faces = view.cell_topology->faces();
  struct Ball {
    Vec3d center;
    double radius;
  };
  std::vector<Ball> ball;
  for (const Triangle& t : faces) {
    const Vec3d center = (view.cell[t[0]] + view.cell[t[1]] + view.cell[t[2]]) * (1.0 / 3.0);
    double radius2 = 0.0;
    for (const std::uint32_t node : t) radius2 = std::max(radius2, norm2(view.cell[node] - center));
    ball.push_back({center, std::sqrt(radius2)});
  }
  double least = 1e300;
  for (const Vec3d& p : view.nucleus) {
    double nearest = 1e300;
    ClosestPoint foot;
    std::uint32_t face = 0;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      const double far = nearest + ball[f].radius;
      if (norm2(ball[f].center - p) > far * far) continue;
      const ClosestPoint here = closest_point_on_triangle(p, view.cell[faces[f][0]], view.cell[faces[f][1]], view.cell[faces[f][2]]);
      if (!(here.distance2 < nearest * nearest)) continue;
      nearest = std::sqrt(here.distance2), foot = here, face = f;
    }
    least = std::min(least, -signed_distance(*view.cell_topology, view.cell, p, face, foot));
  }
  return least;
}

}  // namespace morula::dcm
