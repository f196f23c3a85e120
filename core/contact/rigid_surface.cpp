#include "core/contact/rigid_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/mesh/pseudonormal.h"

namespace morula {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr double kTie = 1e-12;  // relative, of squared distances from one point that lies on two faces

std::unique_ptr<TriangleTree> tree_of(const RigidSurface& surface, std::span<const std::uint32_t> part) {
  std::vector<std::uint32_t> nodes;
  for (const std::uint32_t face : part)
    for (const std::uint32_t node : surface.topology->faces()[face]) nodes.push_back(node);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::vector<Vec3d> position;
  for (const std::uint32_t node : nodes) position.push_back(surface.position[node]);
  std::vector<Triangle> faces;
  for (const std::uint32_t face : part) {
    Triangle& own = faces.emplace_back();
    for (std::size_t c = 0; c < 3; ++c)
      own[c] = static_cast<std::uint32_t>(std::lower_bound(nodes.begin(), nodes.end(), surface.topology->faces()[face][c]) - nodes.begin());
  }
  return std::make_unique<TriangleTree>(position, faces);
}

std::optional<NearestFace> nearest_on_part(const RigidSurface& surface, std::uint32_t number, const Vec3d& p, double cutoff) {
  const SmoothPart& part = surface.parts[number];
  auto near = (part.tree ? *part.tree : *surface.tree).nearest(p, cutoff);
  if (near && part.tree) near->face = part.face[near->face];
  return near;
}

/// Faces that share the feature of a face that the nearest point lies on, that face among them.
std::vector<std::uint32_t> faces_at(const Topology& topology, const NearestFace& near) {
  const auto feature = static_cast<int>(near.closest.feature);
  if (near.closest.feature == TriangleFeature::kFace) return {};
  if (feature >= static_cast<int>(TriangleFeature::kVertex0)) {
    const auto corner = static_cast<std::size_t>(feature - static_cast<int>(TriangleFeature::kVertex0));
    const auto around = topology.faces_of_node(topology.faces()[near.face][corner]);
    return {around.begin(), around.end()};
  }
  const auto side = static_cast<std::size_t>(feature - static_cast<int>(TriangleFeature::kEdge0));
  const Edge& edge = topology.edges()[topology.face_edges()[near.face][side]];
  return {edge.left, edge.right};
}

/// Whether a ball around p that touches the part at its nearest point rests there, as far as the other parts around this point go.
bool rests(const RigidSurface& surface, std::uint32_t part, const NearestFace& near, const Vec3d& p) {
  const double here = near.closest.distance2;
  for (const std::uint32_t face : faces_at(*surface.topology, near)) {
    const std::uint32_t other = surface.part_of_face[face];
    if (other == part) continue;
    const auto& [a, b, c] = surface.topology->faces()[face];
    if (closest_point_on_triangle(p, surface.position[a], surface.position[b], surface.position[c]).distance2 < here * (1.0 - kTie))
      return false;
    if (other > part) continue;
    const auto its = nearest_on_part(surface, other, p, std::sqrt(here) * (1.0 + kTie));
    if (its && its->closest.distance2 >= here * (1.0 - kTie)) return false;  // the point is that part's, too, and it comes first
  }
  return true;
}

}  // namespace

void find_smooth_parts(RigidSurface& surface) {
  const Topology& topology = *surface.topology;
  const double least = std::cos(kSharpTurn);
  std::vector<Vec3d> normal;
  for (const Triangle& t : topology.faces()) normal.push_back(unit_face_normal(t, surface.position));
  surface.part_of_face.assign(topology.face_count(), kNone);
  surface.parts.clear();
  std::vector<std::uint32_t> waiting;
  for (std::uint32_t first = 0; first < topology.face_count(); ++first) {
    if (surface.part_of_face[first] != kNone) continue;
    const auto number = static_cast<std::uint32_t>(surface.parts.size());
    SmoothPart& part = surface.parts.emplace_back();
    surface.part_of_face[first] = number;
    waiting = {first};
    while (!waiting.empty()) {
      const std::uint32_t face = waiting.back();
      waiting.pop_back();
      part.face.push_back(face);
      for (const std::uint32_t e : topology.face_edges()[face]) {
        const Edge& edge = topology.edges()[e];
        const std::uint32_t next = edge.left == face ? edge.right : edge.left;
        if (surface.part_of_face[next] != kNone || dot(normal[face], normal[next]) < least) continue;
        surface.part_of_face[next] = number;
        waiting.push_back(next);
      }
    }
    std::sort(part.face.begin(), part.face.end());
  }
  surface.curvature = curvature_of_parts(topology, surface.position, surface.geometry, surface.part_of_face);
  surface.corner_normal = normals_of_parts(topology, surface.position, surface.geometry, surface.part_of_face);
  if (surface.parts.size() == 1) return;
  for (SmoothPart& part : surface.parts) part.tree = tree_of(surface, part.face);
}

void parts_near(const RigidSurface& surface, const Vec3d& p, double reach, std::vector<std::uint32_t>& parts) {
  surface.tree->faces_in(Box{p, p}.inflated(reach), parts);
  for (std::uint32_t& face : parts) face = surface.part_of_face[face];
  std::ranges::sort(parts);
  const auto repeated = std::ranges::unique(parts);
  parts.erase(repeated.begin(), repeated.end());
}

namespace {

/// From the foot on a face to that on the smooth surface with the normals of its corners: where p is right above, p − x = d n.
void find_smooth_foot(const RigidSurface& surface, const NearestFace& near, const Vec3d& p, Foot& out) {
  constexpr double kSingular = 1e-3;  // p is the centre of the curvature, and all points are as near
  const auto& [n0, n1, n2] = surface.corner_normal[near.face];
  const Triangle& corner = surface.topology->faces()[near.face];
  const auto& x = surface.position;
  const auto& w = near.closest.barycentric;
  const Vec3d normal = normalized(n0 * w[0] + n1 * w[1] + n2 * w[2]), from = p - near.closest.point;
  const Vec3d e1 = x[corner[1]] - x[corner[0]], e2 = x[corner[2]] - x[corner[0]], turn1 = n1 - n0, turn2 = n2 - n0;
  // An arc over a chord e between normals that differ by dn is ½ w₁ w₂ dn·e high; in a triangle those of its edges add up (a paraboloid).
  const double bulge = 0.5 * (w[0] * w[1] * dot(turn1, e1) + w[0] * w[2] * dot(turn2, e2) + w[1] * w[2] * dot(turn2 - turn1, e2 - e1));
  const double height = dot(from, normal) - bulge;
  const Vec3d aside = from - normal * dot(from, normal);
  // One step of Newton's method along the surface, s e₁ + t e₂, on the way of which the normal turns: aside = s (e₁ + d dn₁) + t (e₂ + d dn₂).
  const Vec3d a1 = e1 + turn1 * height, a2 = e2 + turn2 * height;
  const double m11 = dot(a1, e1), m12 = dot(a2, e1), m21 = dot(a1, e2), m22 = dot(a2, e2), r1 = dot(aside, e1), r2 = dot(aside, e2);
  const double det = m11 * m22 - m12 * m21;
  out.normal = normal;
  out.bulge = out.distance - height;
  if (!(det > kSingular * norm2(cross(e1, e2)))) return;
  const Vec3d turned = turn1 * ((r1 * m22 - r2 * m12) / det) + turn2 * ((r2 * m11 - r1 * m21) / det);
  out.normal = normalized(normal + turned);
  out.bulge -= 0.5 * dot(aside, turned);
}

}  // namespace

std::optional<Foot> foot_on_part(const RigidSurface& surface, std::uint32_t part, const Vec3d& p, double cutoff) {
  const auto near = nearest_on_part(surface, part, p, cutoff);
  if (!near) return std::nullopt;
  const double distance = signed_distance(*surface.topology, surface.position, p, near->face, near->closest);
  if (surface.parts.size() > 1) {
    if (!rests(surface, part, *near, p)) return std::nullopt;
    if (distance < 0.0) {
      const auto first = surface.tree->nearest(p, cutoff);
      if (first && surface.part_of_face[first->face] != part) return std::nullopt;
    }
  }
  const auto& at_corner = surface.curvature[near->face];
  const auto& weight = near->closest.barycentric;
  Foot out{near->closest.point, distance, near->face, {}, {}};
  for (std::size_t c = 0; c < 3; ++c) {
    out.curvature.mean += weight[c] * at_corner[c].mean;
    out.curvature.gaussian += weight[c] * at_corner[c].gaussian;
  }
  if (out.curvature.mean < 0.0) find_smooth_foot(surface, *near, p, out);
  return out;
}

}  // namespace morula
