#include "core/mesh/renewal/local_changes.h"

#include <algorithm>
#include <cmath>

namespace morula {
namespace {

/// The slots of all faces around these nodes, increasing.
std::vector<std::uint32_t> faces_around(const LiveMesh& mesh, std::span<const std::uint32_t> nodes) {
  std::vector<std::uint32_t> out;
  for (const std::uint32_t node : nodes) out.insert(out.end(), mesh.faces_of(node).begin(), mesh.faces_of(node).end());
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// ∂V/∂x of a node over the faces of a change that have it [µm²].
Vec3d volume_gradient_after(const LiveMesh& mesh, const MeshChange& change, std::uint32_t node) {
  const Vec3d at = place_after(mesh, change, node);
  Vec3d out;
  for (const Triangle& face : change.fresh)
    for (std::size_t c = 0; c < 3; ++c)
      if (face[c] == node)
        out += cross(place_after(mesh, change, face[(c + 1) % 3]) - at, place_after(mesh, change, face[(c + 2) % 3]) - at) * (1.0 / 6.0);
  return out;
}

/// Move the placed nodes along their ∂V/∂x until the volume is what it was.
bool give_volume_back(const LiveMesh& mesh, MeshChange& change) {
  constexpr int kMostSteps = 8;
  constexpr double kRounding = 1e-16;
  std::vector<Vec3d> along;
  double slope = 0.0, longest2 = 0.0;  // of the edges: the size of volumes in which rounding is told
  for (const PlacedNode& one : change.placed) along.push_back(volume_gradient_after(mesh, change, one.node));
  for (const Vec3d& g : along) slope += norm2(g);
  for (const auto& [a, b, c] : change.fresh)
    longest2 = std::max(longest2, norm2(place_after(mesh, change, b) - place_after(mesh, change, a)));
  if (!(slope > 0.0)) return false;
  double last = 1e300;
  for (int step = 0; step < kMostSteps; ++step) {
    const double missing = -volume_change(mesh, change);
    if (!(std::abs(missing) < 0.5 * last) || std::abs(missing) <= kRounding * longest2 * std::sqrt(longest2)) break;
    last = std::abs(missing);
    for (std::size_t k = 0; k < along.size(); ++k) change.placed[k].place += along[k] * (missing / slope);
  }
  return true;
}

}  // namespace

double volume_change(const LiveMesh& mesh, const MeshChange& change) {
  // Both sets of faces have the same border, so that any origin serves; one nearby keeps the numbers small.
  const Vec3d origin = mesh.position(mesh.face(change.gone[0])[0]);
  double six = 0.0;
  for (const std::uint32_t slot : change.gone) {
    const auto& [a, b, c] = mesh.face(slot);
    six -= dot(mesh.position(a) - origin, cross(mesh.position(b) - origin, mesh.position(c) - origin));
  }
  for (const auto& [a, b, c] : change.fresh) {
    const Vec3d pa = place_after(mesh, change, a), pb = place_after(mesh, change, b), pc = place_after(mesh, change, c);
    six += dot(pa - origin, cross(pb - origin, pc - origin));
  }
  return six / 6.0;
}

MeshChange split_edge(const LiveMesh& mesh, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t left = *mesh.face_with(a, b), right = *mesh.face_with(b, a), m = mesh.next_node();
  const std::uint32_t k = third_corner(mesh.face(left), a, b), l = third_corner(mesh.face(right), a, b);
  MeshChange out;
  out.gone = {std::min(left, right), std::max(left, right)};
  out.fresh = {{a, m, k}, {m, b, k}, {b, m, l}, {m, a, l}};
  out.placed = {{m, (mesh.position(a) + mesh.position(b)) * 0.5}};
  return out;
}

std::optional<MeshChange> flip_edge(const LiveMesh& mesh, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t left = *mesh.face_with(a, b), right = *mesh.face_with(b, a);
  const std::uint32_t k = third_corner(mesh.face(left), a, b), l = third_corner(mesh.face(right), a, b);
  if (k == l || mesh.face_with(k, l) || mesh.face_with(l, k)) return std::nullopt;
  if (mesh.faces_of(a).size() <= 3 || mesh.faces_of(b).size() <= 3) return std::nullopt;
  const std::array<std::uint32_t, 4> corners = {a, b, k, l};
  MeshChange out;
  out.gone = faces_around(mesh, corners);
  for (const std::uint32_t slot : out.gone)
    if (slot != left && slot != right) out.fresh.push_back(mesh.face(slot));
  out.fresh.push_back({k, a, l});
  out.fresh.push_back({l, b, k});
  for (const std::uint32_t node : corners) out.placed.push_back({node, mesh.position(node)});
  if (!give_volume_back(mesh, out)) return std::nullopt;
  return out;
}

std::optional<MeshChange> collapse_edge(const LiveMesh& mesh, std::uint32_t a, std::uint32_t b, const Vec3d& wanted) {
  const std::uint32_t left = *mesh.face_with(a, b), right = *mesh.face_with(b, a);
  const std::uint32_t k = third_corner(mesh.face(left), a, b), l = third_corner(mesh.face(right), a, b);
  const auto of_a = mesh.neighbours_of(a), of_b = mesh.neighbours_of(b);
  std::vector<std::uint32_t> common;
  std::ranges::set_intersection(of_a, of_b, std::back_inserter(common));
  if (k == l || common.size() != 2 || mesh.faces_of(k).size() <= 3 || mesh.faces_of(l).size() <= 3) return std::nullopt;
  if (mesh.faces_of(a).size() + mesh.faces_of(b).size() < 7) return std::nullopt;  // the one left would have fewer than three faces
  const std::array<std::uint32_t, 2> ends = {a, b};
  MeshChange out;
  out.gone = faces_around(mesh, ends);
  for (const std::uint32_t slot : out.gone) {
    if (slot == left || slot == right) continue;
    Triangle face = mesh.face(slot);
    for (std::uint32_t& node : face)
      if (node == b) node = a;
    out.fresh.push_back(face);
  }
  out.placed = {{a, wanted}};
  out.removed = b;
  if (!give_volume_back(mesh, out)) return std::nullopt;
  return out;
}

MeshChange slide_node(const LiveMesh& mesh, std::uint32_t node, const Vec3d& wanted) {
  MeshChange out;
  out.gone.assign(mesh.faces_of(node).begin(), mesh.faces_of(node).end());
  for (const std::uint32_t slot : out.gone) out.fresh.push_back(mesh.face(slot));
  out.placed = {{node, wanted}};
  give_volume_back(mesh, out);
  return out;
}

}  // namespace morula
