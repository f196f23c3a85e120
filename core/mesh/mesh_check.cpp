#include "core/mesh/mesh_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

#include "core/mesh/mesh_sides.h"
#include "core/mesh/self_intersection.h"

namespace morula {
namespace {

using Kind = MeshProblemKind;

std::string text(const Vec3d& p) {
  char buffer[96];
  std::snprintf(buffer, sizeof buffer, "(%.6g, %.6g, %.6g)", p.x, p.y, p.z);
  return buffer;
}

std::string face_list(std::span<const std::uint32_t> faces) {
  constexpr std::size_t kShown = 8;
  std::string out = faces.size() == 1 ? "face " : "faces ";
  for (std::size_t n = 0; n < faces.size() && n < kShown; ++n) out += (n > 0 ? ", " : "") + std::to_string(faces[n]);
  if (faces.size() > kShown) out += " and " + std::to_string(faces.size() - kShown) + " more";
  return out;
}

/// The parts of the check share the mesh and collect into one list.
class MeshChecker {
 public:
  MeshChecker(std::span<const Vec3d> position, std::span<const Triangle> faces, const MeshExpectation& expectation)
      : position_(position), faces_(faces), expectation_(expectation) {}

  std::vector<MeshProblem> run() {
    if (faces_.empty()) add(Kind::kEmpty, "the mesh has no faces", {}, {});
    check_numbers();
    if (!problems_.empty()) return finished();
    check_degenerate();
    check_duplicates();
    check_unused();
    sides_.emplace(faces_);
    check_edges_and_nodes();
    check_holes();
    check_orientation();
    if (expectation_.no_self_intersection) check_crossings();
    return finished();
  }

 private:
  void add(Kind kind, std::string message, std::vector<std::uint32_t> faces, const Vec3d& place) {
    problems_.push_back({kind, std::move(message), std::move(faces), place});
  }
  [[nodiscard]] Vec3d center(std::uint32_t face) const {
    return (position_[faces_[face][0]] + position_[faces_[face][1]] + position_[faces_[face][2]]) / 3.0;
  }
  [[nodiscard]] Vec3d center(std::span<const std::uint32_t> faces) const {
    Vec3d sum;
    for (const std::uint32_t f : faces) sum += center(f);
    return sum / static_cast<double>(faces.size());
  }

  void check_numbers();
  void check_degenerate();
  void check_duplicates();
  void check_unused();
  void check_edges_and_nodes();
  void check_holes();
  void check_orientation();
  void check_inside_out(const OrientedParts& parts);
  void check_crossings();
  std::vector<MeshProblem> finished();

  std::span<const Vec3d> position_;
  std::span<const Triangle> faces_;
  MeshExpectation expectation_;
  std::optional<MeshSides> sides_;
  std::vector<MeshProblem> problems_;
};

void MeshChecker::check_numbers() {
  for (std::uint32_t f = 0; f < faces_.size(); ++f)
    for (const std::uint32_t node : faces_[f]) {
      if (node < position_.size()) continue;
      add(Kind::kBadIndex,
          "face " + std::to_string(f) + " names node " + std::to_string(node) + ", but there are only " + std::to_string(position_.size()),
          {f}, {});
      break;
    }
  for (std::size_t node = 0; node < position_.size(); ++node) {
    const Vec3d& p = position_[node];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      add(Kind::kNotFinite, "node " + std::to_string(node) + " is at " + text(p), {}, p);
  }
}

void MeshChecker::check_degenerate() {
  constexpr double kThinnest = 1e-10;
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    const auto& [ia, ib, ic] = faces_[f];
    if (ia == ib || ib == ic || ic == ia) {
      add(Kind::kDegenerateFace, "face " + std::to_string(f) + " names a node twice, at " + text(position_[ia]), {f}, center(f));
      continue;
    }
    const Vec3d &a = position_[ia], &b = position_[ib], &c = position_[ic];
    const double longest2 = std::max({norm2(b - a), norm2(c - b), norm2(a - c)});
    if (norm(cross(b - a, c - a)) > kThinnest * longest2 && !exactly_collinear(a, b, c)) continue;
    add(Kind::kDegenerateFace, "face " + std::to_string(f) + " has no area, at " + text(center(f)), {f}, center(f));
  }
}

void MeshChecker::check_duplicates() {
  std::vector<std::pair<Triangle, std::uint32_t>> by_nodes(faces_.size());
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    by_nodes[f] = {faces_[f], f};
    std::ranges::sort(by_nodes[f].first);
  }
  std::ranges::sort(by_nodes);
  for (std::size_t n = 1; n < by_nodes.size(); ++n) {
    if (by_nodes[n].first != by_nodes[n - 1].first) continue;
    const std::uint32_t a = by_nodes[n - 1].second, b = by_nodes[n].second;
    add(Kind::kDuplicateFace, "faces " + std::to_string(a) + " and " + std::to_string(b) + " have the same nodes, at " + text(center(a)),
        {a, b}, center(a));
  }
}

void MeshChecker::check_unused() {
  std::vector<char> used(position_.size(), 0);
  for (const Triangle& face : faces_)
    for (const std::uint32_t node : face) used[node] = 1;
  for (std::size_t node = 0; node < used.size(); ++node)
    if (!used[node])
      add(Kind::kUnusedNode, "node " + std::to_string(node) + " at " + text(position_[node]) + " belongs to no face", {}, position_[node]);
}

void MeshChecker::check_edges_and_nodes() {
  for (const MeshSides::Edge& edge : sides_->edges()) {
    if (edge.sides.size() < 3) continue;
    std::vector<std::uint32_t> faces;
    for (const MeshSides::Side& side : edge.sides) faces.push_back(side.face);
    const Vec3d place = (position_[edge.low] + position_[edge.high]) * 0.5;
    add(Kind::kNonManifoldEdge,
        "the edge from " + text(position_[edge.low]) + " to " + text(position_[edge.high]) + " has " + std::to_string(faces.size()) +
            " faces: " + face_list(faces),
        faces, place);
  }
  for (const auto& [node, faces] : sides_->pinched_nodes(static_cast<std::uint32_t>(position_.size())))
    add(Kind::kNonManifoldNode,
        "the surface touches itself in node " + std::to_string(node) + " at " + text(position_[node]) + ", " + face_list(faces), faces,
        position_[node]);
}

void MeshChecker::check_holes() {
  if (!expectation_.closed) return;
  for (const MeshSides::Border& hole : sides_->borders(static_cast<std::uint32_t>(position_.size()))) {
    Vec3d middle;
    for (const std::uint32_t node : hole.nodes) middle += position_[node];
    middle = middle / static_cast<double>(hole.nodes.size());
    add(Kind::kHole,
        "the surface is open: a border of " + std::to_string(hole.edge_count) + " edges around " + text(middle) + ", at " +
            face_list(hole.faces),
        hole.faces, middle);
  }
}

void MeshChecker::check_orientation() {
  const OrientedParts parts = orient_parts(*sides_, faces_);
  for (const auto& [face, other] : parts.contradictions)
    add(Kind::kNotOrientable,
        "the surface has no inside: walking around it turns face " + std::to_string(face) + " over, at " + text(center(face)),
        {face, other}, center(face));
  for (const std::vector<std::uint32_t>& patch : parts.flipped_patches)
    add(Kind::kFlippedFaces,
        (patch.size() == 1 ? "one face runs" : std::to_string(patch.size()) + " faces run") +
            std::string(" against the faces around, at ") + text(center(patch)) + ": " + face_list(patch),
        patch, center(patch));
  if (expectation_.outward) check_inside_out(parts);
}

void MeshChecker::check_inside_out(const OrientedParts& parts) {
  // Each closed part with its faces turned the way most of them run.
  std::vector<std::vector<Triangle>> turned(parts.count);
  std::vector<std::vector<std::uint32_t>> numbers(parts.count);
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    Triangle face = faces_[f];
    if (parts.flipped[f]) std::swap(face[1], face[2]);
    turned[parts.part[f]].push_back(face);
    numbers[parts.part[f]].push_back(f);
  }
  for (std::uint32_t part = 0; part < parts.count; ++part) {
    if (!parts.closed[part]) continue;
    const Vec3d& on_it = position_[turned[part][0][0]];
    int around = 0;
    for (std::uint32_t other = 0; other < parts.count; ++other)
      if (other != part && parts.closed[other] && std::abs(winding_number(position_, turned[other], on_it)) > 0.5) ++around;
    const double volume = enclosed_volume(turned[part], position_, on_it);
    if (around % 2 == 0 ? volume > 0.0 : volume < 0.0) continue;
    const Vec3d place = center(numbers[part]);
    add(Kind::kInsideOut,
        (around % 2 == 0 ? "the closed surface of " : "the surface of a cavity, of ") + std::to_string(numbers[part].size()) +
            " faces around " + text(place) +
            (volume == 0.0     ? " encloses no volume: "
             : around % 2 == 0 ? " is inside out: "
                               : " faces away from it: ") +
            face_list(numbers[part]),
        numbers[part], place);
  }
}

void MeshChecker::check_crossings() {
  // One more than is listed, to know whether there are more; finding them all could take long in a tangled mesh.
  for (const auto& [a, b] : find_self_intersections(position_, faces_, expectation_.most_of_a_kind + 1)) {
    const Vec3d place = (center(a) + center(b)) * 0.5;
    add(Kind::kSelfIntersection, "faces " + std::to_string(a) + " and " + std::to_string(b) + " cross or touch, at " + text(place), {a, b},
        place);
  }
}

std::vector<MeshProblem> MeshChecker::finished() {
  std::stable_sort(problems_.begin(), problems_.end(), [](const MeshProblem& a, const MeshProblem& b) { return a.kind < b.kind; });
  std::vector<MeshProblem> out;
  const std::size_t most = std::max<std::size_t>(expectation_.most_of_a_kind, 1);
  for (std::size_t begin = 0; begin < problems_.size();) {
    std::size_t end = begin;
    while (end < problems_.size() && problems_[end].kind == problems_[begin].kind) ++end;
    const std::size_t shown = std::min(end - begin, most);
    for (std::size_t n = begin; n < begin + shown; ++n) out.push_back(std::move(problems_[n]));
    if (shown < end - begin)
      out.back().message += out.back().kind == Kind::kSelfIntersection
                                ? " (there are more like this)"
                                : " (and " + std::to_string(end - begin - shown) + " more like this)";
    begin = end;
  }
  return out;
}

}  // namespace

std::vector<MeshProblem> check_mesh(std::span<const Vec3d> position, std::span<const Triangle> faces, const MeshExpectation& expectation) {
  return MeshChecker(position, faces, expectation).run();
}

Status require_sound_mesh(const std::string& name, std::span<const Vec3d> position, std::span<const Triangle> faces,
                          const MeshExpectation& expectation) {
  const auto problems = check_mesh(position, faces, expectation);
  if (problems.empty()) return {};
  std::string message = "the mesh " + name + " cannot be used:";
  for (const MeshProblem& problem : problems) message += "\n  " + problem.message;
  return Error{ErrorKind::kInput, std::move(message),
               expectation.closed ? "a body needs a closed surface without self-intersections, faces counter-clockwise seen from outside; "
                                    "repair it in a mesh program"
                                  : "faces must agree in direction and must not cross; repair it in a mesh program"};
}

double winding_number(std::span<const Vec3d> position, std::span<const Triangle> faces, const Vec3d& point) {
  double half_angles = 0.0;
  for (const Triangle& face : faces) {
    const Vec3d a = position[face[0]] - point, b = position[face[1]] - point, c = position[face[2]] - point;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    half_angles += std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return half_angles / (2.0 * std::numbers::pi);
}

}  // namespace morula
