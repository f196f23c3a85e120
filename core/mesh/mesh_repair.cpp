#include "core/mesh/mesh_repair.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <numeric>

#include "core/mesh/mesh_sides.h"
#include "core/mesh/self_intersection.h"
#include "core/mesh/topology.h"
#include "core/mesh/weld_nodes.h"
#include "core/space/space.h"

namespace morula {
namespace {

constexpr double kSamePlace = 1e-6;  // of the diagonal: single precision and text with six digits round by less
constexpr double kThinnest = 1e-10;  // twice the area over the square of the longest side: as check_mesh() judges it

std::string at(const Vec3d& p) {
  char buffer[96];
  std::snprintf(buffer, sizeof buffer, "(%.6g, %.6g, %.6g)", p.x, p.y, p.z);
  return buffer;
}

std::string counted(std::size_t n, const char* one, const char* many) {
  return n == 1 ? std::string("one ") + one : std::to_string(n) + " " + many;
}

std::string face_list(const std::vector<std::uint32_t>& faces) {
  constexpr std::size_t kShown = 8;
  std::string out = faces.size() == 1 ? "face " : "faces ";
  for (std::size_t n = 0; n < faces.size() && n < kShown; ++n) out += (n > 0 ? ", " : "") + std::to_string(faces[n]);
  if (faces.size() > kShown) out += " and " + std::to_string(faces.size() - kShown) + " more";
  return out;
}

class Mender {
 public:
  explicit Mender(const TriangleMesh& mesh) {
    out_.mesh = mesh;
    out_.face.resize(mesh.faces.size());
    std::iota(out_.face.begin(), out_.face.end(), 0u);
  }

  MeshRepair run() {
    unite_points();
    drop_useless_faces();
    // Each pass mends the faces without area that do not touch each other; a row of them takes some passes.
    for (int pass = 0; pass < 100 && mend_thin_faces(); ++pass) drop_useless_faces();
    turn_patches();
    drop_free_points();
    return std::move(out_);
  }

 private:
  [[nodiscard]] const Vec3d& corner(std::uint32_t face, std::size_t c) const { return out_.mesh.position[out_.mesh.faces[face][c]]; }
  [[nodiscard]] Vec3d center(std::uint32_t face) const { return (corner(face, 0) + corner(face, 1) + corner(face, 2)) / 3.0; }
  [[nodiscard]] bool is_thin(std::uint32_t face) const;
  void unite_points();
  void drop_faces(const std::vector<char>& drop);
  void drop_useless_faces();
  bool mend_thin_faces();
  void turn_patches();
  void turn_inside_out(const OrientedParts& parts);
  void drop_free_points();

  MeshRepair out_;
};

void Mender::unite_points() {
  Box box;
  for (const Vec3d& p : out_.mesh.position) box.include(p);
  const std::size_t before = out_.mesh.position.size();
  std::vector<char> used(before, 0);
  for (const Triangle& face : out_.mesh.faces)
    for (const std::uint32_t node : face) used[node] = 1;
  const auto needed = static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
  out_.mesh = with_welded_nodes(out_.mesh, kSamePlace * norm(box.size()));
  if (needed < before)
    out_.repairs.push_back(counted(before - needed, "point that no face names", "points that no face names") + " left away");
  if (out_.mesh.position.size() < needed)
    out_.repairs.push_back(counted(needed - out_.mesh.position.size(), "point that lies on another one", "points that lie on other ones") +
                           " united with it");
}

void Mender::drop_faces(const std::vector<char>& drop) {
  std::size_t kept = 0;
  for (std::size_t f = 0; f < drop.size(); ++f) {
    if (drop[f]) continue;
    out_.mesh.faces[kept] = out_.mesh.faces[f];
    out_.face[kept++] = out_.face[f];
  }
  out_.mesh.faces.resize(kept);
  out_.face.resize(kept);
}

/// Faces with a repeated node; the second of two equal faces; both of two that lie back to back.
void Mender::drop_useless_faces() {
  const auto& faces = out_.mesh.faces;
  std::vector<char> drop(faces.size(), 0);
  std::vector<std::uint32_t> repeated, doubled;
  std::map<Triangle, std::uint32_t> seen;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    if (faces[f][0] == faces[f][1] || faces[f][1] == faces[f][2] || faces[f][2] == faces[f][0]) {
      drop[f] = 1;
      repeated.push_back(out_.face[f]);
      continue;
    }
    Triangle sorted = faces[f];
    std::ranges::sort(sorted);
    const auto [place, is_new] = seen.try_emplace(sorted, f);
    if (is_new) continue;
    const auto turned = [&](const Triangle& t) {
      const std::size_t low = static_cast<std::size_t>(std::ranges::min_element(t) - t.begin());
      return t[(low + 1) % 3] > t[(low + 2) % 3];
    };
    drop[f] = 1;
    doubled.push_back(out_.face[f]);
    if (turned(faces[f]) == turned(faces[place->second]) || drop[place->second]) continue;
    drop[place->second] = 1;
    doubled.push_back(out_.face[place->second]);
  }
  if (!repeated.empty()) out_.repairs.push_back("left away without a change of shape: " + face_list(repeated) + " with a repeated node");
  if (!doubled.empty()) {
    std::ranges::sort(doubled);
    out_.repairs.push_back("left away: " + face_list(doubled) + ", with the nodes of another face");
  }
  if (!repeated.empty() || !doubled.empty()) drop_faces(drop);
}

bool Mender::is_thin(std::uint32_t face) const {
  const Vec3d &a = corner(face, 0), &b = corner(face, 1), &c = corner(face, 2);
  const double longest2 = std::max({norm2(b - a), norm2(c - b), norm2(a - c)});
  return norm(cross(b - a, c - a)) <= kThinnest * longest2 || exactly_collinear(a, b, c);
}

bool Mender::mend_thin_faces() {
  constexpr double kNeedle = 1e-3;  // shortest over longest side: below, the short one is drawn together
  auto& faces = out_.mesh.faces;
  std::vector<std::uint32_t> thin;
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    if (is_thin(f)) thin.push_back(f);
  if (thin.empty()) return false;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> of_edge;
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    for (std::size_t c = 0; c < 3; ++c) of_edge[std::minmax(faces[f][c], faces[f][(c + 1) % 3])].push_back(f);
  std::vector<char> touched(out_.mesh.position.size(), 0);
  std::vector<std::uint32_t> moved_to(out_.mesh.position.size());
  std::iota(moved_to.begin(), moved_to.end(), 0u);
  bool any = false;
  for (const std::uint32_t f : thin) {
    const Triangle face = faces[f];
    if (touched[face[0]] || touched[face[1]] || touched[face[2]]) continue;
    std::size_t longest = 0, shortest = 0;  // the side from corner c to the next
    const auto length = [&](std::size_t c) { return norm(corner(f, (c + 1) % 3) - corner(f, c)); };
    for (std::size_t c = 1; c < 3; ++c) {
      if (length(c) > length(longest)) longest = c;
      if (length(c) < length(shortest)) shortest = c;
    }
    if (length(shortest) < kNeedle * length(longest)) {
      const auto [low, high] = std::minmax(face[shortest], face[(shortest + 1) % 3]);
      moved_to[high] = low;
      out_.repairs.push_back("face " + std::to_string(out_.face[f]) + " without area, at " + at(center(f)) +
                             ": its short edge drawn together");
    } else {
      const std::uint32_t a = face[longest], b = face[(longest + 1) % 3], tip = face[(longest + 2) % 3];
      const auto& both = of_edge[std::minmax(a, b)];
      if (both.size() != 2) continue;
      const std::uint32_t other = both[0] == f ? both[1] : both[0];
      const Triangle& across = faces[other];
      const std::size_t far = across[0] != a && across[0] != b ? 0 : across[1] != a && across[1] != b ? 1 : 2;
      const std::uint32_t opposite = across[far];
      if (touched[opposite] || opposite == tip || of_edge.contains(std::minmax(tip, opposite))) continue;
      touched[opposite] = 1;
      const bool forward = across[(far + 1) % 3] == b;  // the neighbour walks from b to a, as it should
      out_.repairs.push_back("face " + std::to_string(out_.face[f]) + " without area, at " + at(center(f)) + ": its long edge turned");
      faces[f] = {tip, a, opposite};
      faces[other] = forward ? Triangle{tip, opposite, b} : Triangle{opposite, tip, b};
    }
    for (const std::uint32_t node : face) touched[node] = 1;
    any = true;
  }
  for (Triangle& face : faces)
    for (std::uint32_t& node : face) node = moved_to[node];
  return any;
}

void Mender::turn_patches() {
  const MeshSides sides(out_.mesh.faces);
  const OrientedParts parts = orient_parts(sides, out_.mesh.faces);
  for (const std::vector<std::uint32_t>& patch : parts.flipped_patches) {
    Vec3d middle;
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t f : patch) {
      std::swap(out_.mesh.faces[f][1], out_.mesh.faces[f][2]);
      middle += center(f);
      numbers.push_back(out_.face[f]);
    }
    std::ranges::sort(numbers);
    out_.repairs.push_back("a patch of " + counted(patch.size(), "face", "faces") + " that ran against the rest, at " +
                           at(middle / static_cast<double>(patch.size())) + ", turned over: " + face_list(numbers));
  }
  turn_inside_out(parts);
}

void Mender::turn_inside_out(const OrientedParts& parts) {
  if (parts.count != 1 || !parts.closed[0]) return;
  if (enclosed_volume(out_.mesh.faces, out_.mesh.position, out_.mesh.position[out_.mesh.faces[0][0]]) >= 0.0) return;
  for (Triangle& face : out_.mesh.faces) std::swap(face[1], face[2]);
  out_.repairs.push_back("the whole surface was inside out: all " + std::to_string(out_.mesh.faces.size()) + " faces turned over");
}

void Mender::drop_free_points() { out_.mesh = with_welded_nodes(out_.mesh, 0.0); }

}  // namespace

MeshRepair repair_mesh(const TriangleMesh& mesh) { return Mender(mesh).run(); }

}  // namespace morula
