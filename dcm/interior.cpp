#include "dcm/interior.h"

#include <algorithm>
#include <cmath>

#include "core/ball.h"
#include "core/mesh/face_quadrature.h"
#include "dcm/laws/nucleus_repulsion.h"

namespace morula::dcm {
namespace {

/// A link at the present positions.
struct Stretched {
  Vec3d direction;  ///< from the far end (nucleus, node j) to node i
  double length = 0.0;
};
Stretched stretched(const Vec3d& node, const Vec3d& far_end) {
  const Vec3d d = node - far_end;
  const double length = norm(d);
  return {length > 0.0 ? d * (1.0 / length) : Vec3d{}, length};
}

/// `visit(face, point, weights, position, area of the point)` for the quadrature points of the cortex that lie inside the nucleus.
template <class Visit>
void for_each_touching_point(const InteriorView& cell, double radius, const Visit& visit) {
  const FaceQuadrature& rule = FaceQuadrature::with_points(cell.points_per_face);
  const Vec3d& center = *cell.nucleus;
  const auto faces = cell.topology->faces();
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const Vec3d x[3] = {cell.node[faces[f][0]] - center, cell.node[faces[f][1]] - center, cell.node[faces[f][2]] - center};
    for (int q = 0; q < rule.count; ++q) {
      const double* beta = rule.weight[q];
      const Vec3d away = x[0] * beta[0] + x[1] * beta[1] + x[2] * beta[2];
      const double distance2 = norm2(away);
      if (distance2 < radius * radius) visit(f, beta, away, std::sqrt(distance2), 1.0 / rule.count);
    }
  }
}

/// ∂A/∂x of the corners: ½ n × e.
void add_area_gradient(std::span<const Vec3d> node, const Triangle& t, double factor, std::span<Vec3d> out) {
  const Vec3d e0 = node[t[2]] - node[t[1]], e1 = node[t[0]] - node[t[2]], e2 = node[t[1]] - node[t[0]];
  const Vec3d n = normalized(cross(e2, -e1)) * (0.5 * factor);
  out[t[0]] += cross(n, e0);
  out[t[1]] += cross(n, e1);
  out[t[2]] += cross(n, e2);
}

double face_area(std::span<const Vec3d> node, const Triangle& t) {
  return 0.5 * norm(cross(node[t[1]] - node[t[0]], node[t[2]] - node[t[0]]));
}

void add_contact_forces(const InteriorView& cell, std::span<Vec3d> force, Vec3d& nucleus_force, InteriorEnergy& out) {
  const double radius = nucleus_radius(*cell.parameters, cell.rest_volume);
  const NucleusRepulsion law{cell.repulsion};
  for_each_touching_point(cell, radius, [&](std::uint32_t f, const double* beta, const Vec3d& away, double distance, double weight) {
    const Triangle& t = cell.topology->faces()[f];
    const double gap = distance - radius, area = face_area(cell.node, t) * weight;
    const Vec3d push = away * (-area * law.slope(gap) / std::max(distance, 1e-12 * radius));
    for (int k = 0; k < 3; ++k) force[t[static_cast<std::size_t>(k)]] += push * beta[k];
    nucleus_force -= push;
    add_area_gradient(cell.node, t, -weight * law.energy(gap), force);
    out.energy += area * law.energy(gap);
    out.overlap = std::max(out.overlap, -gap);
    out.contact_area += area;
    out.push += norm(push);
  });
}

/// Node order by a hash of the number (the finalizer of SplitMix64; Steele, Lea & Flood 2014, doi:10.1145/2660193.2660195).
std::vector<std::uint32_t> scattered_nodes(std::size_t count) {
  const auto hash = [](std::uint64_t z) {
    z += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  };
  std::vector<std::uint32_t> out(count);
  for (std::uint32_t i = 0; i < count; ++i) out[i] = i;
  std::sort(out.begin(), out.end(), [&](std::uint32_t a, std::uint32_t b) { return hash(a) < hash(b); });
  return out;
}

/// The node whose direction from the centroid is most nearly opposite; ties to the lowest number.
std::uint32_t opposite_node(std::span<const Vec3d> position, const Vec3d& centroid, std::uint32_t node) {
  const Vec3d there = normalized(position[node] - centroid);
  std::uint32_t best = node;
  double most = 2.0;
  for (std::uint32_t k = 0; k < position.size(); ++k) {
    const double cosine = dot(there, normalized(position[k] - centroid));
    if (cosine < most - 1e-9) most = cosine, best = k;
  }
  return best;
}

Vec3<float> vector_of(const Float4& v) { return {v.x, v.y, v.z}; }
void add(Float4& out, const Vec3<float>& v) { out.x += v.x, out.y += v.y, out.z += v.z; }

}  // namespace

double nucleus_radius(const InteriorParameters& parameters, double rest_volume) {
  return ball_radius(parameters.nucleus_fraction * rest_volume);
}

InteriorLinks choose_links(const ReferenceShape& shape, const InteriorParameters& parameters) {
  InteriorLinks out;
  const auto& x = shape.position;
  const Vec3d centroid = volume_centroid(shape.topology->faces(), x);
  const std::vector<std::uint32_t> order = scattered_nodes(x.size());
  if (parameters.has_nucleus() && parameters.nucleus_links.act())
    for (std::size_t k = 0; k < std::min<std::size_t>(parameters.nucleus_links.count, x.size()); ++k)
      out.nucleus.push_back({order[k], 0, norm(x[order[k]] - centroid)});
  if (!parameters.cortex_links.act()) return out;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> taken;
  for (const std::uint32_t i : order) {
    if (out.cortex.size() >= parameters.cortex_links.count) break;
    const std::uint32_t j = opposite_node(x, centroid, i);
    const std::pair key{std::min(i, j), std::max(i, j)};
    if (i == j || std::find(taken.begin(), taken.end(), key) != taken.end()) continue;
    taken.push_back(key);
    out.cortex.push_back({i, j, norm(x[i] - x[j])});
  }
  return out;
}

InteriorEnergy add_interior_forces(const InteriorView& cell, std::span<Vec3d> force, Vec3d* nucleus_force) {
  InteriorEnergy out;
  const double size = std::cbrt(cell.rest_volume);
  if (cell.nucleus != nullptr) {
    add_contact_forces(cell, force, *nucleus_force, out);
    const CytoskeletonLink law = cell.parameters->nucleus_links.law();
    for (const InteriorLink& link : cell.links->nucleus) {
      const Stretched now = stretched(cell.node[link.i], *cell.nucleus);
      const Vec3d pull = now.direction * law.pull(now.length, link.rest * size);
      force[link.i] -= pull;
      *nucleus_force += pull;
      out.energy += law.energy(now.length, link.rest * size);
    }
  }
  const CytoskeletonLink law = cell.parameters->cortex_links.law();
  for (const InteriorLink& link : cell.links->cortex) {
    const Stretched now = stretched(cell.node[link.i], cell.node[link.j]);
    const Vec3d pull = now.direction * law.pull(now.length, link.rest * size);
    force[link.i] -= pull;
    force[link.j] += pull;
    out.energy += law.energy(now.length, link.rest * size);
  }
  return out;
}

void find_interior_friction(const InteriorView& cell, std::span<const double> node_area, InteriorFriction& out) {
  out.drag = 0.0;
  out.share.clear();
  out.nucleus_direction.clear();
  out.cortex_direction.clear();
  if (cell.nucleus != nullptr) {
    out.drag = CytoplasmDrag{cell.parameters->cytoplasm_viscosity}.coefficient(nucleus_radius(*cell.parameters, cell.rest_volume));
    double area = 0.0;
    for (const double a : node_area) area += a;
    for (const double a : node_area) out.share.push_back(a / area);
    for (const InteriorLink& link : cell.links->nucleus)
      out.nucleus_direction.push_back(stretched(cell.node[link.i], *cell.nucleus).direction);
  }
  for (const InteriorLink& link : cell.links->cortex)
    out.cortex_direction.push_back(stretched(cell.node[link.i], cell.node[link.j]).direction);
}

double add_interior_friction(const InteriorView& cell, const InteriorFriction& friction, std::span<const Vec3d> node_way,
                             const Vec3d* nucleus_way, std::span<Vec3d> node_result, Vec3d* nucleus_result) {
  double quadratic = 0.0;
  if (cell.nucleus != nullptr) {
    Vec3d mean;
    for (std::size_t i = 0; i < node_way.size(); ++i) mean += node_way[i] * friction.share[i];
    const Vec3d relative = *nucleus_way - mean, drag = relative * friction.drag;
    *nucleus_result += drag;
    for (std::size_t i = 0; i < node_way.size(); ++i) node_result[i] -= drag * friction.share[i];
    quadratic += dot(relative, drag);
    const double damping = cell.parameters->nucleus_links.damping;
    for (std::size_t k = 0; k < cell.links->nucleus.size(); ++k) {
      const std::uint32_t i = cell.links->nucleus[k].i;
      const Vec3d& t = friction.nucleus_direction[k];
      const double rate = dot(t, node_way[i] - *nucleus_way);
      node_result[i] += t * (damping * rate);
      *nucleus_result -= t * (damping * rate);
      quadratic += damping * rate * rate;
    }
  }
  const double damping = cell.parameters->cortex_links.damping;
  for (std::size_t k = 0; k < cell.links->cortex.size(); ++k) {
    const InteriorLink& link = cell.links->cortex[k];
    const Vec3d& t = friction.cortex_direction[k];
    const double rate = dot(t, node_way[link.i] - node_way[link.j]);
    node_result[link.i] += t * (damping * rate);
    node_result[link.j] -= t * (damping * rate);
    quadratic += damping * rate * rate;
  }
  return quadratic;
}

void assemble_interior(const InteriorView& cell, const InteriorFriction& friction, double time_step, InteriorOperator& out) {
  const double size = std::cbrt(cell.rest_volume);
  out.drag = static_cast<float>(friction.drag);
  out.share.assign(friction.share.begin(), friction.share.end());
  out.nucleus_block.clear();
  out.cortex_block.clear();
  out.contact.clear();
  const auto block = [&](const CytoskeletonLink& law, const Vec3d& direction, const Stretched& now, double rest) {
    return to_float(outer(law.damping, direction) + time_step * law.stiffness_psd(now.direction, now.length, rest));
  };
  for (std::size_t k = 0; cell.nucleus != nullptr && k < cell.links->nucleus.size(); ++k) {
    const InteriorLink& link = cell.links->nucleus[k];
    out.nucleus_block.push_back(block(cell.parameters->nucleus_links.law(), friction.nucleus_direction[k],
                                      stretched(cell.node[link.i], *cell.nucleus), link.rest * size));
  }
  for (std::size_t k = 0; k < cell.links->cortex.size(); ++k) {
    const InteriorLink& link = cell.links->cortex[k];
    out.cortex_block.push_back(block(cell.parameters->cortex_links.law(), friction.cortex_direction[k],
                                     stretched(cell.node[link.i], cell.node[link.j]), link.rest * size));
  }
  if (cell.nucleus == nullptr || time_step == 0.0) return;
  const double radius = nucleus_radius(*cell.parameters, cell.rest_volume);
  const NucleusRepulsion law{cell.repulsion};
  for_each_touching_point(cell, radius, [&](std::uint32_t f, const double* beta, const Vec3d& away, double distance, double weight) {
    const double area = face_area(cell.node, cell.topology->faces()[f]) * weight;
    InteriorOperator::Contact& point = out.contact.emplace_back();
    point.face = f;
    for (int k = 0; k < 3; ++k) point.beta[k] = static_cast<float>(beta[k]);
    point.normal = to_float(away * (1.0 / std::max(distance, 1e-12 * radius)));
    point.stiffness = static_cast<float>(time_step * area * law.curvature_psd(distance - radius));
  });
}

void add_interior_product(const InteriorView& cell, const InteriorOperator& matrix, std::span<const Float4> p, std::span<Float4> q,
                          const Float4* nucleus_p, Float4* nucleus_q) {
  if (nucleus_p != nullptr) {
    const Vec3<float> pn = vector_of(*nucleus_p);
    Vec3d mean;  // of the differences, so that rigid motion stays exact
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec3<float> d = pn - vector_of(p[i]);
      mean += Vec3d{d.x, d.y, d.z} * static_cast<double>(matrix.share[i]);
    }
    const Vec3<float> drag = to_float(mean * static_cast<double>(matrix.drag));
    add(*nucleus_q, drag);
    for (std::size_t i = 0; i < p.size(); ++i) add(q[i], drag * -matrix.share[i]);
    for (std::size_t k = 0; k < matrix.nucleus_block.size(); ++k) {
      const std::uint32_t i = cell.links->nucleus[k].i;
      const Vec3<float> force = matrix.nucleus_block[k] * (vector_of(p[i]) - pn);
      add(q[i], force);
      add(*nucleus_q, -force);
    }
    for (const InteriorOperator::Contact& point : matrix.contact) {
      const Triangle& t = cell.topology->faces()[point.face];
      float rate = 0.0f;
      for (std::size_t k = 0; k < 3; ++k) rate += point.beta[k] * dot(point.normal, vector_of(p[t[k]]) - pn);
      const Vec3<float> force = point.normal * (point.stiffness * rate);
      for (std::size_t k = 0; k < 3; ++k) add(q[t[k]], force * point.beta[k]);
      add(*nucleus_q, -force);
    }
  }
  for (std::size_t k = 0; k < matrix.cortex_block.size(); ++k) {
    const InteriorLink& link = cell.links->cortex[k];
    const Vec3<float> force = matrix.cortex_block[k] * (vector_of(p[link.i]) - vector_of(p[link.j]));
    add(q[link.i], force);
    add(q[link.j], -force);
  }
}

void add_interior_diagonal(const InteriorView& cell, const InteriorOperator& matrix, std::span<SymMat3<float>> diagonal,
                           SymMat3<float>* nucleus_diagonal) {
  if (nucleus_diagonal != nullptr) {
    *nucleus_diagonal += isotropic(matrix.drag);
    for (std::size_t i = 0; i < diagonal.size(); ++i) diagonal[i] += isotropic(matrix.drag * matrix.share[i] * matrix.share[i]);
    for (std::size_t k = 0; k < matrix.nucleus_block.size(); ++k) {
      diagonal[cell.links->nucleus[k].i] += matrix.nucleus_block[k];
      *nucleus_diagonal += matrix.nucleus_block[k];
    }
    for (const InteriorOperator::Contact& point : matrix.contact) {
      const Triangle& t = cell.topology->faces()[point.face];
      for (std::size_t k = 0; k < 3; ++k) diagonal[t[k]] += outer(point.stiffness * point.beta[k] * point.beta[k], point.normal);
      *nucleus_diagonal += outer(point.stiffness, point.normal);
    }
  }
  for (std::size_t k = 0; k < matrix.cortex_block.size(); ++k) {
    diagonal[cell.links->cortex[k].i] += matrix.cortex_block[k];
    diagonal[cell.links->cortex[k].j] += matrix.cortex_block[k];
  }
}

}  // namespace morula::dcm
