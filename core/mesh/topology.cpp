#include "core/mesh/topology.h"

#include <algorithm>

#include "core/numbers/joined.h"

namespace morula {
namespace {

std::string text(const Triangle& face) {
  return "(" + std::to_string(face[0]) + ", " + std::to_string(face[1]) + ", " + std::to_string(face[2]) + ")";
}

std::string named_face(std::size_t number, const Triangle& face) { return "face " + std::to_string(number) + " " + text(face); }

std::string named_edge(std::uint32_t a, std::uint32_t b) { return "edge " + std::to_string(a) + "-" + std::to_string(b); }

Error mesh_error(std::string message, std::string help) { return {ErrorKind::kInput, std::move(message), std::move(help)}; }

/// One side of a face: the edge between two nodes as this face walks along it.
struct FaceSide {
  std::uint32_t low, high;     ///< end nodes, low < high
  std::uint32_t face, corner;  ///< the side opposite to this corner of this face
  bool forward;                ///< the face walks from low to high

  friend bool operator<(const FaceSide& a, const FaceSide& b) {
    if (a.low != b.low) return a.low < b.low;
    if (a.high != b.high) return a.high < b.high;
    return a.face < b.face;
  }
};

Status check_faces(std::uint32_t node_count, std::span<const Triangle> faces) {
  if (faces.empty()) return mesh_error("the mesh has no faces", "a closed surface has at least four");
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& [a, b, c] = faces[f];
    if (a >= node_count || b >= node_count || c >= node_count)
      return mesh_error(named_face(f, faces[f]) + " names a node that does not exist",
                        "the mesh has nodes 0 to " + std::to_string(static_cast<std::int64_t>(node_count) - 1));
    if (a == b || b == c || c == a)
      return mesh_error(named_face(f, faces[f]) + " is degenerate: it names a node twice", "a face has three different nodes");
  }

  std::vector<std::pair<Triangle, std::uint32_t>> by_nodes(faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    by_nodes[f] = {faces[f], f};
    std::ranges::sort(by_nodes[f].first);
  }
  std::ranges::sort(by_nodes);
  for (std::size_t n = 1; n < by_nodes.size(); ++n)
    if (by_nodes[n].first == by_nodes[n - 1].first) {
      const std::uint32_t first = by_nodes[n - 1].second, second = by_nodes[n].second;
      return mesh_error(named_face(second, faces[second]) + " has the same nodes as " + named_face(first, faces[first]),
                        "remove the duplicate face");
    }
  return {};
}

std::vector<FaceSide> sorted_sides(std::span<const Triangle> faces) {
  std::vector<FaceSide> sides;
  sides.reserve(3 * faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t from = faces[f][(corner + 1) % 3], to = faces[f][(corner + 2) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), f, corner, from < to});
    }
  std::sort(sides.begin(), sides.end());
  return sides;
}

/// Exactly two faces along an edge, walking in opposite directions.
Status check_edge(std::span<const FaceSide> sides) {
  const std::string edge = named_edge(sides[0].low, sides[0].high);
  if (sides.size() == 1)
    return mesh_error(edge + " has one face only, face " + std::to_string(sides[0].face) + ": the surface is open",
                      "every edge of a closed surface has two faces");
  if (sides.size() > 2)
    return mesh_error(edge + " has " + std::to_string(sides.size()) +
                          " faces: " + joined(sides, [](const FaceSide& side) { return std::to_string(side.face); }),
                      "every edge of a closed surface has two faces");
  if (sides[0].forward == sides[1].forward)
    return mesh_error("faces " + std::to_string(sides[0].face) + " and " + std::to_string(sides[1].face) + " walk along " + edge +
                          " in the same direction: one of them is flipped",
                      "all faces must be counter-clockwise seen from outside");
  return {};
}

/// The hash must not depend on the machine: integer steps only (splitmix64's finalizer, Steele et al. 2014, doi:10.1145/2660193.2660195).
std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  std::uint64_t z = (hash ^ value) + 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

std::uint64_t connectivity_hash(std::uint32_t node_count, std::span<const Triangle> faces) {
  std::uint64_t hash = mixed(node_count, faces.size());
  for (const auto& [a, b, c] : faces) hash = mixed(mixed(hash, (std::uint64_t{a} << 32) | b), c);
  return hash;
}

/// Number of faces met when walking around a node from face to neighbouring face.
std::size_t ring_length(const Topology& topology, std::uint32_t node) {
  const std::uint32_t start = topology.faces_of_node(node)[0];
  std::uint32_t face = start;
  std::size_t length = 0;
  do {
    const Triangle& nodes = topology.faces()[face];
    const std::size_t corner = nodes[0] == node ? 0 : nodes[1] == node ? 1 : 2;
    // The side from the face's third node back to this node lies opposite to the next corner.
    const Edge& side = topology.edges()[topology.face_edges()[face][(corner + 1) % 3]];
    face = side.left == face ? side.right : side.left;
    ++length;
  } while (face != start);
  return length;
}

}  // namespace

Result<std::shared_ptr<const Topology>> Topology::build(std::uint32_t node_count, std::vector<Triangle> faces) {
  MORULA_TRY(check_faces(node_count, faces));
  std::shared_ptr<Topology> topology(new Topology());
  topology->node_count_ = node_count;
  topology->hash_ = connectivity_hash(node_count, faces);
  topology->faces_ = std::move(faces);

  const std::vector<FaceSide> sides = sorted_sides(topology->faces_);
  topology->edges_.reserve(sides.size() / 2);
  topology->face_edges_.resize(topology->faces_.size());
  for (std::size_t begin = 0; begin < sides.size();) {
    std::size_t end = begin + 1;
    while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high) ++end;
    MORULA_TRY(check_edge(std::span(sides).subspan(begin, end - begin)));
    const FaceSide& left = sides[begin].forward ? sides[begin] : sides[begin + 1];
    const FaceSide& right = sides[begin].forward ? sides[begin + 1] : sides[begin];
    const auto number = static_cast<std::uint32_t>(topology->edges_.size());
    topology->face_edges_[left.face][left.corner] = number;
    topology->face_edges_[right.face][right.corner] = number;
    topology->edges_.push_back(
        {left.low, left.high, topology->faces_[left.face][left.corner], topology->faces_[right.face][right.corner], left.face, right.face});
    begin = end;
  }

  topology->node_face_begin_.assign(std::size_t{node_count} + 1, 0);
  for (const Triangle& face : topology->faces_)
    for (const std::uint32_t node : face) ++topology->node_face_begin_[node + 1];
  for (std::uint32_t node = 0; node < node_count; ++node) {
    if (topology->node_face_begin_[node + 1] == 0)
      return mesh_error("node " + std::to_string(node) + " belongs to no face", "remove the node or add its faces");
    topology->node_face_begin_[node + 1] += topology->node_face_begin_[node];
  }
  topology->node_faces_.resize(3 * topology->faces_.size());
  std::vector<std::uint32_t> next(topology->node_face_begin_.begin(), topology->node_face_begin_.end() - 1);
  for (std::uint32_t f = 0; f < topology->faces_.size(); ++f)
    for (const std::uint32_t node : topology->faces_[f]) topology->node_faces_[next[node]++] = f;

  for (std::uint32_t node = 0; node < node_count; ++node)
    if (ring_length(*topology, node) != topology->faces_of_node(node).size())
      return mesh_error("the faces around node " + std::to_string(node) + " form more than one ring: the surface touches itself there",
                        "give each sheet its own node");
  return std::shared_ptr<const Topology>(std::move(topology));
}

}  // namespace morula
