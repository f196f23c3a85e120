#include "report/pictures/smooth.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

namespace morula::scenarios {
namespace {

/// A node of the finer mesh: its face in the coarse one, and the barycentric coordinates there in units of 1/level.
struct Place {
  std::uint32_t face;
  std::array<int, 3> weight;
};

struct FineTopology {
  std::vector<Triangle> faces;
  std::vector<Place> added;  ///< nodes after those of the coarse mesh
};

/// The node with these weights of a face: a coarse node, one on an edge that two faces share, or one within the face.
class FineNodes {
 public:
  FineNodes(const std::vector<Triangle>& faces, std::uint32_t coarse, int level, std::vector<Place>& added)
      : faces_(faces), coarse_(coarse), level_(level), added_(added) {}

  std::uint32_t at(std::uint32_t face, const std::array<int, 3>& weight) {
    std::array<std::uint32_t, 2> ends{};
    std::array<int, 2> parts{};
    std::size_t count = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      if (weight[c] == level_) return faces_[face][c];
      if (weight[c] > 0 && count < 2) ends[count] = faces_[face][c], parts[count] = weight[c];
      count += weight[c] > 0;
    }
    if (count == 3) {
      const auto [found, is_new] =
          within_.try_emplace({face, static_cast<std::uint32_t>(weight[0]), static_cast<std::uint32_t>(weight[1])}, 0);
      if (is_new) found->second = add({face, weight});
      return found->second;
    }
    if (ends[0] > ends[1]) std::swap(ends[0], ends[1]), std::swap(parts[0], parts[1]);
    const auto [found, is_new] = on_edge_.try_emplace({ends[0], ends[1], static_cast<std::uint32_t>(parts[0])}, 0);
    if (is_new) found->second = add({face, weight});
    return found->second;
  }

 private:
  std::uint32_t add(const Place& place) {
    added_.push_back(place);
    return coarse_ + static_cast<std::uint32_t>(added_.size()) - 1;
  }
  const std::vector<Triangle>& faces_;
  std::uint32_t coarse_;
  int level_;
  std::vector<Place>& added_;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> on_edge_, within_;
};

FineTopology refine(const std::vector<Triangle>& faces, std::uint32_t nodes, int level) {
  FineTopology out;
  FineNodes fine(faces, nodes, level, out.added);
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    for (int i = 0; i < level; ++i)
      for (int j = 0; j < level - i; ++j) {
        const auto at = [&](int a, int b) { return fine.at(f, {level - a - b, a, b}); };
        out.faces.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 < level) out.faces.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  return out;
}

/// Unit normals of nodes: of the faces around, weighted by their areas.
std::vector<Vec3d> normals_of(std::span<const Vec3d> x, const std::vector<Triangle>& faces) {
  std::vector<Vec3d> normals(x.size());
  for (const Triangle& face : faces) {
    const Vec3d n = cross(x[face[1]] - x[face[0]], x[face[2]] - x[face[0]]);
    for (const std::uint32_t corner : face) normals[corner] += n;
  }
  for (Vec3d& n : normals) {
    const double length = norm(n);
    if (length > 0.0) n = n / length;
  }
  return normals;
}

/// Point of the cubic patch over a face (Vlachos et al. 2001, eq. 1–3); u belongs to its first corner.
Vec3d on_patch(const std::array<Vec3d, 3>& p, const std::array<Vec3d, 3>& n, double u, double v, double w) {
  const auto near = [&](std::size_t i, std::size_t j) { return (p[i] * 2.0 + p[j] - n[i] * dot(p[j] - p[i], n[i])) / 3.0; };
  const Vec3d b210 = near(0, 1), b120 = near(1, 0), b021 = near(1, 2), b012 = near(2, 1), b102 = near(2, 0), b201 = near(0, 2);
  const Vec3d edges = (b210 + b120 + b021 + b012 + b102 + b201) / 6.0, corners = (p[0] + p[1] + p[2]) / 3.0;
  const Vec3d b111 = edges + (edges - corners) * 0.5;
  return p[0] * (u * u * u) + p[1] * (v * v * v) + p[2] * (w * w * w) + b210 * (3.0 * u * u * v) + b120 * (3.0 * u * v * v) +
         b201 * (3.0 * u * u * w) + b021 * (3.0 * v * v * w) + b102 * (3.0 * u * w * w) + b012 * (3.0 * v * w * w) +
         b111 * (6.0 * u * v * w);
}

/// One set of surfaces on finer meshes; `fine` by topology.
void refine_surfaces(const std::vector<std::vector<Triangle>>& coarse, const std::vector<FineTopology>& fine, int level,
                     std::vector<Snapshot::Shell>& shells, std::vector<Vec3d>& nodes) {
  std::vector<Vec3d> out;
  for (Snapshot::Shell& shell : shells) {
    const std::span<const Vec3d> x = std::span(nodes).subspan(shell.first_node, shell.node_count);
    const std::vector<Triangle>& faces = coarse[shell.topology];
    const std::vector<Vec3d> normal = normals_of(x, faces);
    const auto first = static_cast<std::uint32_t>(out.size());
    out.insert(out.end(), x.begin(), x.end());
    for (const Place& place : fine[shell.topology].added) {
      const Triangle& f = faces[place.face];
      out.push_back(on_patch({x[f[0]], x[f[1]], x[f[2]]}, {normal[f[0]], normal[f[1]], normal[f[2]]}, double(place.weight[0]) / level,
                             double(place.weight[1]) / level, double(place.weight[2]) / level));
    }
    shell.first_node = first;
    shell.node_count = static_cast<std::uint32_t>(out.size()) - first;
  }
  nodes = std::move(out);
}

}  // namespace

Snapshot smoothed(const Snapshot& snapshot, int level) {
  Snapshot out = snapshot;
  if (level <= 1) return out;
  std::vector<std::uint32_t> nodes(snapshot.topologies.size(), 0);
  for (const auto* shells : {&snapshot.shells, &snapshot.nuclear_shells})
    for (const Snapshot::Shell& shell : *shells) nodes[shell.topology] = shell.node_count;
  std::vector<FineTopology> fine;
  for (std::size_t t = 0; t < snapshot.topologies.size(); ++t) fine.push_back(refine(snapshot.topologies[t], nodes[t], level));
  refine_surfaces(snapshot.topologies, fine, level, out.shells, out.nodes);
  refine_surfaces(snapshot.topologies, fine, level, out.nuclear_shells, out.nuclear_nodes);
  for (std::size_t t = 0; t < fine.size(); ++t) out.topologies[t] = std::move(fine[t].faces);
  // The small faces of a face follow one another.
  out.face_marks.clear();
  const MarkSets marks = snapshot.marks();
  for (std::size_t face = 0; face < marks.size(); ++face)
    for (int part = 0; part < level * level; ++part) out.face_marks.insert(out.face_marks.end(), marks[face].begin(), marks[face].end());
  return out;
}

int smoothing_level(const Snapshot& snapshot, double pixels_per_um) {
  constexpr double kEdgePixels = 6.0, kMostFaces = 2e6;
  double faces = 0.0, longest = 0.0;
  for (const Snapshot::Shell& shell : snapshot.shells) {
    faces += static_cast<double>(snapshot.topologies[shell.topology].size());
    // A closed surface of F nearly equal triangles: area √3/4 l² F.
    const double area =
        snapshot.cells[shell.cell].area / static_cast<double>(std::max<std::size_t>(1, snapshot.topologies[shell.topology].size()));
    longest = std::max(longest, std::sqrt(4.0 / std::sqrt(3.0) * std::max(0.0, area)));
  }
  if (faces == 0.0 || !std::isfinite(longest)) return 1;
  const double wanted = std::ceil(longest * pixels_per_um / kEdgePixels), allowed = std::floor(std::sqrt(kMostFaces / faces));
  return static_cast<int>(std::clamp(std::min(wanted, allowed), 1.0, 8.0));
}

}  // namespace morula::scenarios
