#include "core/mesh/renewal/plane_cut.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace morula {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// Secant steps and halvings; some ten are the rule.
constexpr int kMostSteps = 200;

/// Where the segment from a (at signed height ha) to b (at hb, of the other sign) meets the plane.
Vec3d crossing(const Vec3d& a, const Vec3d& b, double ha, double hb) { return a + (b - a) * (ha / (ha - hb)); }

double six_volumes(const Vec3d& a, const Vec3d& b, const Vec3d& c) { return dot(a, cross(b, c)); }

/// Volume below height d. Positions are relative to a point inside; `height` are their components along the normal.
double volume_below(std::span<const Triangle> faces, std::span<const Vec3d> x, std::span<const double> height, const Vec3d& normal,
                    double d) {
  const Vec3d apex = normal * d;
  double sum = 0.0;
  for (const Triangle& face : faces) {
    const int below = (height[face[0]] < d) + (height[face[1]] < d) + (height[face[2]] < d);
    if (below == 0) continue;
    if (below == 3) {
      sum += six_volumes(x[face[0]] - apex, x[face[1]] - apex, x[face[2]] - apex);
      continue;
    }
    // Turned so that the first corner is alone on its side.
    std::size_t first = 0;
    while ((height[face[first]] < d) != (below == 1)) ++first;
    const std::uint32_t i = face[first], j = face[(first + 1) % 3], k = face[(first + 2) % 3];
    const Vec3d a = x[i] - apex, b = x[j] - apex, c = x[k] - apex;
    const Vec3d ab = crossing(a, b, height[i] - d, height[j] - d), ca = crossing(a, c, height[i] - d, height[k] - d);
    const double corner = six_volumes(a, ab, ca);
    sum += below == 1 ? corner : six_volumes(a, b, c) - corner;
  }
  return sum / 6.0;
}

/// Height of the plane below which lies `wanted` of the volume: secant steps, each kept within the bracket (Illinois).
double find_height(std::span<const Triangle> faces, std::span<const Vec3d> x, std::span<const double> height, const Vec3d& normal,
                   double wanted, double volume) {
  const auto [low_at, high_at] = std::ranges::minmax_element(height);
  double low = *low_at, high = *high_at, f_low = -wanted, f_high = volume - wanted;
  int same_side = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    double d = step % 8 == 7 ? 0.5 * (low + high) : (low * f_high - high * f_low) / (f_high - f_low);
    if (!(d > low && d < high)) d = 0.5 * (low + high);
    if (!(d > low && d < high)) return low;
    const double f = volume_below(faces, x, height, normal, d) - wanted;
    if (std::abs(f) <= 1e-14 * volume) return d;
    if (f < 0.0) {
      low = d;
      f_low = f;
      if (same_side < 0) f_high *= 0.5;
      same_side = -1;
    } else {
      high = d;
      f_high = f;
      if (same_side > 0) f_low *= 0.5;
      same_side = 1;
    }
  }
  return 0.5 * (low + high);
}

/// Edges that the plane cuts, and the order in which the rim visits them.
struct CutEdges {
  std::vector<std::uint32_t> rim_place;  ///< by edge: its place in the rim, or kNone
  std::vector<std::uint32_t> order;      ///< edges in the order of the rim
  std::size_t crossed = 0;               ///< edges that cross the plane, in whatever loop
};

/// Walk along the cut from edge to edge. In each cut face the rim runs from where the face's boundary comes down through the plane to where
/// it goes up again: counter-clockwise about the normal.
CutEdges chain_edges(const Topology& topology, std::span<const double> s) {
  CutEdges out;
  out.rim_place.assign(topology.edge_count(), kNone);
  const auto crosses = [&](std::uint32_t e) { return (s[topology.edges()[e].i] < 0.0) != (s[topology.edges()[e].j] < 0.0); };
  std::uint32_t start = kNone;
  for (std::uint32_t e = 0; e < topology.edge_count(); ++e)
    if (crosses(e)) {
      ++out.crossed;
      if (start == kNone) start = e;
    }
  for (std::uint32_t e = start; e != kNone && out.rim_place[e] == kNone;) {
    out.rim_place[e] = static_cast<std::uint32_t>(out.order.size());
    out.order.push_back(e);
    const Edge& edge = topology.edges()[e];
    // The one of its two faces whose boundary comes down along this edge.
    const std::uint32_t face = s[edge.i] < 0.0 ? edge.right : edge.left;
    std::uint32_t next = kNone;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t other = topology.face_edges()[face][c];
      if (other != e && crosses(other)) next = other;
    }
    e = next;
  }
  return out;
}

/// The faces of one side, with what the plane leaves of the cut ones.
OpenHalf side_of(const SurfaceView& surface, std::span<const double> s, const CutEdges& cut, std::span<const Vec3d> rim, bool above) {
  const Topology& topology = *surface.topology;
  OpenHalf out;
  std::vector<std::uint32_t> number(topology.node_count(), kNone);
  for (std::uint32_t n = 0; n < topology.node_count(); ++n) {
    if ((s[n] >= 0.0) != above) continue;
    number[n] = static_cast<std::uint32_t>(out.mesh.position.size());
    out.mesh.position.push_back(surface.position[n]);
  }
  out.first_rim_node = static_cast<std::uint32_t>(out.mesh.position.size());
  out.mesh.position.insert(out.mesh.position.end(), rim.begin(), rim.end());
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t source) {
    out.mesh.faces.push_back({a, b, c});
    out.source_face.push_back(source);
  };
  for (std::uint32_t f = 0; f < topology.face_count(); ++f) {
    const Triangle& face = topology.faces()[f];
    std::array<bool, 3> here{};
    for (std::size_t c = 0; c < 3; ++c) here[c] = (s[face[c]] >= 0.0) == above;
    const int count = here[0] + here[1] + here[2];
    if (count == 0) continue;
    if (count == 3) {
      add(number[face[0]], number[face[1]], number[face[2]], f);
      continue;
    }
    std::size_t alone = 0;
    while (here[alone] != (count == 1)) ++alone;
    const std::size_t second = (alone + 1) % 3, third = (alone + 2) % 3;
    // Entry c of face_edges() is the edge opposite to corner c.
    const std::uint32_t p = out.first_rim_node + cut.rim_place[topology.face_edges()[f][third]];
    const std::uint32_t q = out.first_rim_node + cut.rim_place[topology.face_edges()[f][second]];
    if (count == 1) {
      add(number[face[alone]], p, q, f);
      continue;
    }
    const std::uint32_t b = number[face[second]], c = number[face[third]];
    const auto& x = out.mesh.position;
    if (norm2(x[b] - x[q]) <= norm2(x[c] - x[p])) {
      add(p, b, q, f);
      add(b, c, q, f);
    } else {
      add(p, b, c, f);
      add(p, c, q, f);
    }
  }
  return out;
}

Error bad(std::string message, std::string help) { return {ErrorKind::kInput, std::move(message), std::move(help)}; }

}  // namespace

Result<PlaneCut> cut_by_plane(const SurfaceView& surface, const Vec3d& normal, double share) {
  const double length = norm(normal);
  if (!(length > 0.0) || !std::isfinite(length)) return bad("the normal of the cut has no direction", "give a vector that is not zero");
  if (!(share >= 0.1 && share <= 0.9))
    return bad("a daughter cannot have " + std::to_string(share) + " of the volume", "choose 0.1 to 0.9");
  for (const Vec3d& p : surface.position)
    if (!std::isfinite(p.x + p.y + p.z)) return bad("the surface has a node that is nowhere", "all coordinates must be finite");
  const auto faces = surface.topology->faces();
  PlaneCut out;
  out.normal = normal / length;

  const Vec3d center = volume_centroid(faces, surface.position);
  const double volume = enclosed_volume(faces, surface.position, center);
  if (!(volume > 0.0) || !std::isfinite(norm(center)))
    return bad("the surface encloses no volume", "it must be closed, with its faces outwards");
  std::vector<Vec3d> x(surface.position.begin(), surface.position.end());
  std::vector<double> height(x.size());
  for (std::size_t n = 0; n < x.size(); ++n) {
    x[n] = x[n] - center;
    height[n] = dot(x[n], out.normal);
  }
  const double d = find_height(faces, x, height, out.normal, (1.0 - share) * volume, volume);
  out.offset = d + dot(center, out.normal);

  double edges = 0.0;
  for (const Edge& edge : surface.topology->edges()) edges += norm(x[edge.j] - x[edge.i]);
  const double near = 1e-6 * edges / static_cast<double>(surface.topology->edge_count());
  for (double& h : height) h = std::abs(h - d) < near ? near : h - d;

  const CutEdges cut = chain_edges(*surface.topology, height);
  if (cut.order.size() != cut.crossed)
    return Error{ErrorKind::kPhysics, "the plane cuts the surface in more than one closed line", "take a plane with another normal"};
  for (const std::uint32_t e : cut.order) {
    const Edge& edge = surface.topology->edges()[e];
    out.rim.push_back(crossing(surface.position[edge.i], surface.position[edge.j], height[edge.i], height[edge.j]));
  }
  out.above = side_of(surface, height, cut, out.rim, true);
  out.below = side_of(surface, height, cut, out.rim, false);
  return out;
}

}  // namespace morula
