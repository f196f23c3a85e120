#include "core/mesh/renewal/wanted_edges.h"

#include <algorithm>
#include <cmath>

namespace morula {
namespace {

/// Of the radius of curvature.
constexpr double kPartOfRadius = 0.3;
/// Of a node in a mesh of equilateral triangles with sides of length one: √3/2.
constexpr double kAreaOfNode = 0.8660254037844386;

/// Bending of an edge: the angle between the normals of its faces [rad].
double bend_of(const SurfaceView& surface, const Edge& edge) {
  const auto normal = [&](std::uint32_t face) {
    const auto& [a, b, c] = surface.topology->faces()[face];
    return cross(surface.position[b] - surface.position[a], surface.position[c] - surface.position[a]);
  };
  const Vec3d left = normal(edge.left), right = normal(edge.right);
  return std::atan2(norm(cross(left, right)), dot(left, right));
}

}  // namespace

std::vector<double> wanted_edges(const SurfaceView& surface, double nodes, double most_nodes, double finest) {
  const Topology& topology = *surface.topology;
  double whole = 0.0;
  std::vector<double> bending(topology.node_count(), 0.0), area(topology.node_count(), 0.0);
  for (const auto& [a, b, c] : topology.faces()) {
    const double third = norm(cross(surface.position[b] - surface.position[a], surface.position[c] - surface.position[a])) / 6.0;
    for (const std::uint32_t node : {a, b, c}) area[node] += third;
    whole += 3.0 * third;
  }
  for (const Edge& e : topology.edges()) {
    const double part = 0.25 * norm(surface.position[e.j] - surface.position[e.i]) * bend_of(surface, e);
    bending[e.i] += part;
    bending[e.j] += part;
  }
  // Sums over the neighbourhood rather than means of quotients: small faces do not count more than large ones.
  std::vector<double> bending_near = bending, area_near = area;
  for (const Edge& e : topology.edges()) {
    bending_near[e.i] += bending[e.j], area_near[e.i] += area[e.j];
    bending_near[e.j] += bending[e.i], area_near[e.j] += area[e.i];
  }
  const double edge = std::sqrt(whole / (kAreaOfNode * (nodes - 2.0)));
  double needed = 2.0;
  std::vector<double> out(topology.node_count());
  for (std::size_t node = 0; node < out.size(); ++node) {
    out[node] = std::clamp(kPartOfRadius * area_near[node] / std::max(bending_near[node], 1e-300), finest * edge, edge);
    needed += area[node] / (kAreaOfNode * out[node] * out[node]);
  }
  if (const double factor = std::sqrt(needed / most_nodes); factor > 1.0)
    for (double& length : out) length *= factor;
  return out;
}

}  // namespace morula
