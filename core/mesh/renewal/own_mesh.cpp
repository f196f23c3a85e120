#include "core/mesh/renewal/own_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/mesh/node_order.h"
#include "core/mesh/remesh.h"
#include "core/mesh/renewal/area_return.h"
#include "core/mesh/renewal/local_changes.h"
#include "core/mesh/renewal/wanted_edges.h"

namespace morula {
namespace {

constexpr double kOfMostNodes = 0.9;  // part of the allowed nodes that the wanted edges are to need
constexpr int kRounds = 6;
constexpr int kSweepsOfSliding = 3;      // in a round
constexpr double kLong = 4.0 / 3.0;      // of the wanted edge: split
constexpr double kShort = 4.0 / 5.0;     // of the wanted edge: drawn together
constexpr double kSlender = 0.5;         // quality of a face whose shortest edge is drawn together even if it is no shorter than that
constexpr double kStep = 0.5;            // of the way to the middle of the neighbours
constexpr double kLeastStep = 0.02;      // of the wanted edge
constexpr double kLeastGain = 0.01;      // of Σ f², for a flip or a slide to be worth it
constexpr double kMostBendOfFlip = 0.7;  // of an edge that is turned [rad]
constexpr double kJudgedSpacing = 0.8;   // of the mean edge, between samples of both surfaces
constexpr double kReturned = 0.3;        // of the area that a pass may change: not worth it below
constexpr double kWorstShape = 1e-6;     // quality below which f does not grow any more

class Pass {
 public:
  Pass(const AskedSurface& surface, std::span<const AskedSurface* const> walls, const OwnMeshLimits& limits)
      : surface_(surface),
        limits_(limits),
        edge_(edge_of_nodes(surface.area(), limits.nodes)),
        mesh_(surface.view()),
        volume_(enclosed_volume(surface.faces(), surface.view().position, volume_centroid(surface.faces(), surface.view().position))),
        wanted_(wanted_edges(surface.view(), limits.nodes, kOfMostNodes * limits.most_nodes * limits.nodes, limits.finest)),
        guard_(surface, walls, {.edge = edge_, .off_surface = limits.off_surface, .area_change = limits.area_change}) {}

  void run() {
    for (int round = 0; round < kRounds; ++round) {
      const std::uint32_t before = report.changes();
      report.refused = {};
      collapse_short_edges();
      return_area();
      split_long_edges();
      return_area();
      flip_edges();
      for (int sweep = 0; sweep < kSweepsOfSliding; ++sweep) {
        return_area();
        slide_nodes();
      }
      return_area();
      if (report.changes() == before) return;
    }
  }
  [[nodiscard]] TriangleMesh mesh() const { return mesh_.mesh(); }

  OwnMeshReport report;

 private:
  /// Takes the change of area back by moving nodes along their normals, as far as the surface may be left.
  void return_area() {
    const double change = guard_.area_change();
    if (std::abs(change) < kReturned * limits_.area_change * surface_.area()) return;
    TriangleMesh now = mesh_.mesh();
    double area = 0.0;
    for (const auto& [a, b, c] : now.faces) area += 0.5 * norm(cross(now.position[b] - now.position[a], now.position[c] - now.position[a]));
    const double most = limits_.off_surface * edge_ - returned_;
    const double way = give_area_back(now.faces, area - change, volume_, most, now.position);
    if (way < 0.0) return;
    returned_ += way;
    mesh_.place_all(now.position);
    guard_.area_returned(0.0);
  }

  using Ends = std::pair<std::uint32_t, std::uint32_t>;

  [[nodiscard]] double length(const Ends& e) const { return norm(mesh_.position(e.second) - mesh_.position(e.first)); }
  [[nodiscard]] double wanted(const Ends& e) const { return 0.5 * (wanted_[e.first] + wanted_[e.second]); }

  /// Make a change if nothing is against it.
  bool make(const MeshChange& change, std::uint32_t& count) {
    const ChangeRefusal why = guard_.judge(mesh_, change);
    if (why != ChangeRefusal::kNone) {
      ++report.refused[static_cast<std::size_t>(why)];
      return false;
    }
    guard_.made();
    mesh_.apply(change);
    ++count;
    return true;
  }

  /// Edges for which `chosen` gives a number below zero, that with the least first.
  template <class Chosen>
  std::vector<Ends> edges_by(const Chosen& chosen) const {
    std::vector<std::pair<double, Ends>> out;
    for (const Ends& e : mesh_.edges())
      if (const double rank = chosen(e); rank < 0.0) out.emplace_back(rank, e);
    std::ranges::sort(out);
    std::vector<Ends> ends;
    for (const auto& [rank, e] : out) ends.push_back(e);
    return ends;
  }

  void split_long_edges() {
    for (const Ends& e : edges_by([&](const Ends& one) { return kLong - length(one) / wanted(one); })) {
      if (mesh_.node_count() + 1 > limits_.most_nodes * limits_.nodes) return;
      const double between = wanted(e);
      if (make(split_edge(mesh_, e.first, e.second), report.splits)) wanted_.push_back(between);
    }
  }

  /// Short edges, and the shortest edges of slender faces.
  void collapse_short_edges() {
    const auto is_slender = [&](const Ends& e) {
      for (const auto slot : {mesh_.face_with(e.first, e.second), mesh_.face_with(e.second, e.first)}) {
        const auto& [a, b, c] = mesh_.face(*slot);
        const double mine = length(e);
        if (quality({a, b, c}) < kSlender && mine <= length({a, b}) && mine <= length({b, c}) && mine <= length({c, a})) return true;
      }
      return false;
    };
    const auto chosen = edges_by([&](const Ends& one) {
      const double part = length(one) / wanted(one);
      return part < kShort || (part < kLong && is_slender(one)) ? part - kLong : 0.0;
    });
    for (const Ends& e : chosen) {
      if (mesh_.node_count() - 1 < limits_.least_nodes * limits_.nodes) return;
      if (!mesh_.has_node(e.first) || !mesh_.has_node(e.second) || !mesh_.face_with(e.first, e.second)) continue;  // drawn together already
      if (!(length(e) < kShort * wanted(e) || is_slender(e))) continue;
      collapse(e);
    }
  }

  void collapse(const Ends& e) {
    const Vec3d a = mesh_.position(e.first), b = mesh_.position(e.second);
    for (const Vec3d& place : {(a + b) * 0.5, a, b}) {
      const auto change = collapse_edge(mesh_, e.first, e.second, place);
      if (!change) return;
      if (longest_after(*change, e.first) <= kLong && make(*change, report.collapses)) return;
    }
  }
  /// Of the edges of a node, over what is wanted.
  [[nodiscard]] double longest_after(const MeshChange& change, std::uint32_t node) const {
    double longest = 0.0;
    const Vec3d at = place_after(mesh_, change, node);
    for (const Triangle& face : change.fresh)
      for (const std::uint32_t other : face)
        if (other != node) longest = std::max(longest, norm(mesh_.position(other) - at) / wanted({node, other}));
    return longest;
  }

  [[nodiscard]] double quality(const Triangle& face) const {
    return triangle_quality(mesh_.position(face[0]), mesh_.position(face[1]), mesh_.position(face[2]));
  }
  /// f² of a face, see own_mesh.h.
  [[nodiscard]] double unevenness(const Triangle& t, const Vec3d& a, const Vec3d& b, const Vec3d& c) const {
    const double edge = (wanted_[t[0]] + wanted_[t[1]] + wanted_[t[2]]) / 3.0, asked = 0.25 * std::sqrt(3.0) * edge * edge;
    const double area = 0.5 * norm(cross(b - a, c - a)), ratio = std::max(area / asked, kWorstShape);
    const double f = 0.5 * (ratio + 1.0 / ratio) / std::max(triangle_quality(a, b, c), kWorstShape);
    return f * f;
  }
  /// Σ f² of the faces that go, and of those that come.
  [[nodiscard]] bool is_worth_it(const MeshChange& change) const {
    double before = 0.0, after = 0.0;
    for (const std::uint32_t slot : change.gone) {
      const Triangle& t = mesh_.face(slot);
      before += unevenness(t, mesh_.position(t[0]), mesh_.position(t[1]), mesh_.position(t[2]));
    }
    for (const Triangle& t : change.fresh)
      after += unevenness(t, place_after(mesh_, change, t[0]), place_after(mesh_, change, t[1]), place_after(mesh_, change, t[2]));
    return after < (1.0 - kLeastGain) * before;
  }

  [[nodiscard]] double bend(const Ends& e) const {
    const auto normal = [&](std::uint32_t a, std::uint32_t b) {
      const auto& [x, y, z] = mesh_.face(*mesh_.face_with(a, b));
      return cross(mesh_.position(y) - mesh_.position(x), mesh_.position(z) - mesh_.position(x));
    };
    const Vec3d left = normal(e.first, e.second), right = normal(e.second, e.first);
    return std::atan2(norm(cross(left, right)), dot(left, right));
  }

  /// Whether the two other faces between the same four nodes would be more even: tells most edges off at little cost.
  [[nodiscard]] bool may_gain_by_flip(const Ends& e) const {
    const auto [a, b] = e;
    const auto left = mesh_.face_with(a, b), right = mesh_.face_with(b, a);
    if (!left || !right) return false;
    const std::uint32_t k = third_corner(mesh_.face(*left), a, b), l = third_corner(mesh_.face(*right), a, b);
    const auto here = [&](const Triangle& t) { return unevenness(t, mesh_.position(t[0]), mesh_.position(t[1]), mesh_.position(t[2])); };
    return here({k, a, l}) + here({l, b, k}) < here({a, b, k}) + here({b, a, l});
  }

  void flip_edges() {
    for (const Ends& e : mesh_.edges()) {
      if (!may_gain_by_flip(e) || bend(e) > kMostBendOfFlip) continue;
      const auto change = flip_edge(mesh_, e.first, e.second);
      if (change && is_worth_it(*change)) make(*change, report.flips);
    }
  }

  void slide_nodes() {
    for (std::uint32_t node = 0; node < mesh_.next_node(); ++node) {
      if (!mesh_.has_node(node)) continue;
      const Vec3d here = mesh_.position(node), way = (middle_of_neighbours(node) - here) * kStep;
      if (norm(way) < kLeastStep * wanted_[node]) continue;
      for (const double part : {1.0, 0.5}) {
        const MeshChange change = slide_node(mesh_, node, here + way * part);
        if (is_worth_it(change) && make(change, report.slides)) break;
      }
    }
  }
  /// Middle of the faces around a node, those counting more that are large for what is wanted.
  [[nodiscard]] Vec3d middle_of_neighbours(std::uint32_t node) const {
    Vec3d sum;
    double weights = 0.0;
    for (const std::uint32_t slot : mesh_.faces_of(node)) {
      const auto& [a, b, c] = mesh_.face(slot);
      const Vec3d &pa = mesh_.position(a), &pb = mesh_.position(b), &pc = mesh_.position(c);
      const double edge = (wanted_[a] + wanted_[b] + wanted_[c]) / 3.0, weight = norm(cross(pb - pa, pc - pa)) / (edge * edge);
      sum += (pa + pb + pc) * (weight / 3.0);
      weights += weight;
    }
    return sum / weights;
  }

  const AskedSurface& surface_;
  OwnMeshLimits limits_;
  double edge_;
  LiveMesh mesh_;
  double volume_;
  double returned_ = 0.0;       ///< how far nodes have gone at most where area was given back [µm]
  std::vector<double> wanted_;  ///< by node: how long its edges are to be [µm]
  ChangeGuard guard_;
};

/// Measures the new mesh against the old surface.
void measure(const AskedSurface& surface, OwnMesh& out) {
  OwnMeshReport& report = out.report;
  const AskedSurface mesh(SurfaceView{out.position, out.topology.get()});
  const auto faces = out.topology->faces();
  report.least_quality = least_quality(faces, out.position);
  report.least_angle = least_angle(faces, out.position);
  report.mean_edge = edge_of_nodes(mesh.area(), out.topology->node_count());
  report.area_change = mesh.area() / surface.area() - 1.0;
  const Vec3d center = volume_centroid(faces, out.position);
  report.volume_error =
      enclosed_volume(faces, out.position, center) / enclosed_volume(surface.faces(), surface.view().position, center) - 1.0;
  report.distance = surface_distance(surface, mesh, kJudgedSpacing * report.mean_edge);
  std::uint32_t near = 0;
  for (const Vec3d& x : out.position) {
    const NearestFace foot = surface.nearest(x, near);
    near = foot.face;
    report.off_surface = std::max(report.off_surface, std::sqrt(foot.closest.distance2));
  }
}

}  // namespace

std::uint32_t OwnMeshReport::skipped() const { return std::accumulate(refused.begin(), refused.end(), 0u); }

double least_angle(std::span<const Triangle> faces, std::span<const Vec3d> position) {
  double least = 3.0;
  for (const Triangle& face : faces)
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3d a = position[face[(c + 1) % 3]] - position[face[c]], b = position[face[(c + 2) % 3]] - position[face[c]];
      least = std::min(least, std::atan2(norm(cross(a, b)), dot(a, b)));
    }
  return least;
}

Result<OwnMesh> renew_connectivity(const SurfaceView& surface, std::span<const SurfaceView> neighbours, const OwnMeshLimits& limits) {
  MORULA_TRY_ASSIGN(const auto old, SurfaceAmongWalls::of(surface, neighbours));
  const auto walls = old.walls();
  Pass pass(old.surface, walls, limits);
  pass.run();
  if (pass.report.changes() == 0)
    return Error{ErrorKind::kPhysics, "no change of this mesh would make it more even within its limits", "more nodes may help"};
  TriangleMesh mesh = with_near_neighbour_order(pass.mesh());
  OwnMesh out;
  MORULA_TRY_ASSIGN(out.topology, Topology::build(static_cast<std::uint32_t>(mesh.position.size()), std::move(mesh.faces)));
  out.position = std::move(mesh.position);
  out.report = pass.report;
  measure(old.surface, out);
  return out;
}

}  // namespace morula
