#include "core/mesh/remesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/mesh/isotropic_remeshing.h"
#include "core/mesh/mesh_check.h"
#include "core/mesh/node_order.h"
#include "core/mesh/topology.h"

namespace morula {
namespace {

constexpr int kIterations = 5;           // of splitting, drawing together, turning and evening out
constexpr int kTries = 6;                // for the number of nodes
constexpr double kNodeTolerance = 0.02;  // relative
constexpr double kMostLost = 0.10;       // of the volume
constexpr double kMostPieces =
    10.0;  // into which edges are cut, over the number of nodes that are wanted: three of a surface that is all too coarse
constexpr double kMostNodes = 1e6;

Error too_coarse(const std::string& what) {
  return {ErrorKind::kInput, "it cannot be remeshed: " + what, "ask for more nodes, or shorter edges"};
}

double volume_of(const TriangleMesh& mesh) {
  return enclosed_volume(mesh.faces, mesh.position, volume_centroid(mesh.faces, mesh.position));
}

/// Into how many pieces of a length edges are cut that are longer.
double pieces_of(const TriangleMesh& mesh, double length) {
  double out = 0.0;  // every edge of a closed surface comes twice
  for (const Triangle& face : mesh.faces)
    for (std::size_t c = 0; c < 3; ++c)
      out += 0.5 * std::max(0.0, norm(mesh.position[face[(c + 1) % 3]] - mesh.position[face[c]]) / length - 1.0);
  return out;
}

std::string percent(double part) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g %%", 100.0 * part);
  return text;
}

/// By node: how far it stands out of the mean of its neighbours, along its normal.
std::vector<Vec3d> bulges(const TriangleMesh& mesh) {
  const std::size_t n = mesh.position.size();
  std::vector<Vec3d> normal(n), sum(n);
  std::vector<double> neighbours(n, 0.0);
  for (const Triangle& face : mesh.faces) {
    const Vec3d area = cross(mesh.position[face[1]] - mesh.position[face[0]], mesh.position[face[2]] - mesh.position[face[0]]);
    for (std::size_t c = 0; c < 3; ++c) {
      normal[face[c]] += area;
      sum[face[c]] += mesh.position[face[(c + 1) % 3]];  // the next corner: in a closed surface each neighbour comes once
      neighbours[face[c]] += 1.0;
    }
  }
  std::vector<Vec3d> out(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double length = norm(normal[i]);
    if (!(length > 0.0)) continue;
    const Vec3d unit = normal[i] / length;
    out[i] = unit * dot(mesh.position[i] - sum[i] / neighbours[i], unit);
  }
  return out;
}

}  // namespace

double surface_area(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Triangle& face : mesh.faces)
    area += 0.5 * norm(cross(mesh.position[face[1]] - mesh.position[face[0]], mesh.position[face[2]] - mesh.position[face[0]]));
  return area;
}

double edge_of_nodes(double area, std::uint32_t nodes) {
  return std::sqrt(4.0 * area / (std::numbers::sqrt3 * (2.0 * static_cast<double>(nodes) - 4.0)));
}

double nodes_of_edge(double area, double edge) { return 2.0 + 2.0 * area / (std::numbers::sqrt3 * edge * edge); }

double mean_edge_length(const TriangleMesh& mesh) {
  double sum = 0.0;  // every edge of a closed surface comes twice
  for (const Triangle& face : mesh.faces)
    for (std::size_t c = 0; c < 3; ++c) sum += norm(mesh.position[face[(c + 1) % 3]] - mesh.position[face[c]]);
  return sum / (3.0 * static_cast<double>(mesh.faces.size()));
}

void restore_volume(TriangleMesh& mesh, double volume) {
  constexpr double kMostBulge = 1.0;  // of what a node stands out by: more would sharpen the surface
  const std::vector<Vec3d> direction = bulges(mesh);
  const std::vector<Vec3d> start = mesh.position;
  const auto at = [&](double t) {
    for (std::size_t i = 0; i < start.size(); ++i) mesh.position[i] = start[i] + direction[i] * t;
    return volume_of(mesh) - volume;
  };
  // Secant steps on V(t), which is nearly linear.
  double t0 = 0.0, f0 = at(0.0), t1 = f0 < 0.0 ? 0.1 : -0.1, f1 = at(t1);
  for (int step = 0; step < 8 && f1 != f0 && std::abs(f1) > 1e-13 * volume; ++step) {
    const double t2 = std::clamp(t1 - f1 * (t1 - t0) / (f1 - f0), -kMostBulge, kMostBulge);
    t0 = t1;
    f0 = f1;
    t1 = t2;
    f1 = at(t1);
  }
  const Vec3d center = volume_centroid(mesh.faces, mesh.position);
  const double scale = std::cbrt(volume / volume_of(mesh));
  for (Vec3d& p : mesh.position) p = center + (p - center) * scale;
}

bool has_remesher() { return has_isotropic_remeshing(); }

Result<Remeshed> remesh_surface(const TriangleMesh& mesh, const RemeshTarget& target) {
  if (!has_remesher())
    return Error{ErrorKind::kInput, "it cannot be remeshed: this program was built without CGAL's mesh processing, which is under the GPL",
                 "keep the nodes of the file, or build with MORULA_WITH_GPL=ON"};
  const auto closed = Topology::build(static_cast<std::uint32_t>(mesh.position.size()), mesh.faces);
  if (!closed.ok()) return Error{ErrorKind::kInput, "it cannot be remeshed: " + closed.error().message, closed.error().help};
  const double volume = volume_of(mesh);
  if (!(volume > 0.0)) return Error{ErrorKind::kInput, "it cannot be remeshed: it encloses no volume", "turn it inside out"};

  const double area = surface_area(mesh), wanted = target.nodes > 0 ? target.nodes : nodes_of_edge(area, target.edge);
  double edge = target.nodes > 0 ? edge_of_nodes(area, target.nodes) : target.edge;
  // A spike has hardly any area for its length: its edges would be cut into millions of pieces, and what is far too fine into more.
  if (!(pieces_of(mesh, edge) <= kMostPieces * wanted && wanted <= kMostNodes))
    return Error{ErrorKind::kInput, "it cannot be remeshed: its edges would be cut into too many pieces",
                 "look for nodes far away from all others, or ask for longer edges"};
  std::optional<TriangleMesh> best;
  double best_miss = 1e300;
  const int tries = target.nodes > 0 ? kTries : 1;
  for (int i = 0; i < tries && best_miss > kNodeTolerance; ++i) {
    auto made = isotropic_remeshing(mesh, edge, kIterations);
    if (!made || made->faces.empty()) return too_coarse("the remesher gives up at edges of this length");
    const double miss = target.nodes > 0 ? static_cast<double>(made->position.size()) / target.nodes - 1.0 : 0.0;
    if (std::abs(miss) < best_miss) {
      best_miss = std::abs(miss);
      best = std::move(made);
    }
    edge *= std::sqrt(1.0 + miss);
  }
  Remeshed out;
  out.mesh = with_near_neighbour_order(*best);
  const auto still_closed = Topology::build(static_cast<std::uint32_t>(out.mesh.position.size()), out.mesh.faces);
  if (!still_closed.ok()) return too_coarse(still_closed.error().message);
  out.volume_error = volume_of(out.mesh) / volume - 1.0;
  if (!(std::abs(out.volume_error) < kMostLost)) return too_coarse("its volume would change by " + percent(out.volume_error));
  restore_volume(out.mesh, volume);
  MeshExpectation expectation;
  expectation.most_of_a_kind = 1;
  if (const auto problems = check_mesh(out.mesh.position, out.mesh.faces, expectation); !problems.empty())
    return too_coarse(problems.front().message);
  out.mean_edge = mean_edge_length(out.mesh);
  return out;
}

}  // namespace morula
