#include "core/contact/rigid_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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

/// ∫H dA of a face is a quarter of Σ length × angle over its edges: half of an edge's share, which is half of that (Steiner's formula of polyhedra). At a node H is
/// that of the faces of its part around it, which evens out how the mesh is laid, and K what the angles around it lack of 2π, over its Voronoi area (Meyer, Desbrun, Schröder & Barr 2003, doi:10.1007/978-3-662-05105-4_2). At the rim of a
/// part angles say nothing: it is taken to be bent in one direction there.
class CurvatureOfParts {
 public:
  CurvatureOfParts(const RigidSurface& surface, std::span<const Vec3d> normal)
      : surface_(surface), topology_(*surface.topology), turned_(topology_.face_count(), 0.0), area_(topology_.face_count()) {
    constexpr double kFlat = 1e-6;  // turn of a surface that is rounding [rad]
    for (std::uint32_t f = 0; f < topology_.face_count(); ++f) area_[f] = 0.5 * norm(cross(side(f, 0, 1), side(f, 0, 2)));
    for (const Edge& edge : topology_.edges()) {
      if (surface_.part_of_face[edge.left] != surface_.part_of_face[edge.right]) continue;
      const Vec3d along = surface_.position[edge.j] - surface_.position[edge.i];
      const double length = norm(along), sine = dot(cross(normal[edge.left], normal[edge.right]), along) / length;
      const double angle = std::atan2(sine, dot(normal[edge.left], normal[edge.right]));
      if (std::abs(angle) < kFlat) continue;
      for (const std::uint32_t face : {edge.left, edge.right}) turned_[face] += 0.25 * length * angle;
    }
  }

  [[nodiscard]] SurfaceCurvature at_corner(std::uint32_t face, std::size_t corner) const {
    const std::uint32_t node = topology_.faces()[face][corner];
    double turned = 0.0, area = 0.0, angles = 0.0, voronoi = 0.0;
    bool rim = false;
    for (const std::uint32_t other : topology_.faces_of_node(node)) {
      if (surface_.part_of_face[other] != surface_.part_of_face[face]) {
        rim = true;
        continue;
      }
      turned += turned_[other];
      area += area_[other];
      const Triangle& t = topology_.faces()[other];
      const std::size_t here = t[0] == node ? 0 : t[1] == node ? 1 : 2;
      const Vec3d a = side(other, here, (here + 1) % 3), b = side(other, here, (here + 2) % 3);
      angles += std::atan2(norm(cross(a, b)), dot(a, b));
      voronoi += voronoi_part(a, b, area_[other]);
    }
    if (turned == 0.0) return {};
    return {turned / area, rim ? 0.0 : (2.0 * std::numbers::pi - angles) / voronoi};
  }

 private:
  /// Of a triangle with the sides a and b what is nearest to the corner between them; of an obtuse one a half or a quarter.
  static double voronoi_part(const Vec3d& a, const Vec3d& b, double area) {
    const Vec3d c = b - a;
    const double here = dot(a, b), at_a = -dot(a, c), at_b = dot(b, c);
    if (here < 0.0) return 0.5 * area;
    if (at_a < 0.0 || at_b < 0.0) return 0.25 * area;
    return (norm2(a) * at_b + norm2(b) * at_a) / (16.0 * area);  // ⅛(|a|² cot B + |b|² cot A), cot = dot/2A
  }
  [[nodiscard]] Vec3d side(std::uint32_t face, std::size_t from, std::size_t to) const {
    const Triangle& t = topology_.faces()[face];
    return surface_.position[t[to]] - surface_.position[t[from]];
  }
  const RigidSurface& surface_;
  const Topology& topology_;
  std::vector<double> turned_;  ///< ∫H dA by face [µm]
  std::vector<double> area_;    ///< by face [µm²]
};

void find_curvature(RigidSurface& surface, std::span<const Vec3d> normal) {
  const CurvatureOfParts of_parts(surface, normal);
  surface.curvature.resize(surface.topology->face_count());
  for (std::uint32_t f = 0; f < surface.topology->face_count(); ++f)
    for (std::size_t corner = 0; corner < 3; ++corner) surface.curvature[f][corner] = of_parts.at_corner(f, corner);
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
  find_curvature(surface, normal);
  if (surface.parts.size() == 1) return;
  for (SmoothPart& part : surface.parts) part.tree = tree_of(surface, part.face);
}

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
  Foot out{near->closest.point, distance, near->face, {}};
  for (std::size_t c = 0; c < 3; ++c) {
    out.curvature.mean += weight[c] * at_corner[c].mean;
    out.curvature.gaussian += weight[c] * at_corner[c].gaussian;
  }
  return out;
}

}  // namespace morula
