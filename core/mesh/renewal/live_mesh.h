#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/mesh/renewal/surface_view.h"
#include "core/mesh/triangle_mesh.h"

namespace morula {

/// A node and where it is to be [µm].
struct PlacedNode {
  std::uint32_t node = 0;
  Vec3d place;
};

/// A local change of a mesh: some faces go, others come in their place, and nodes are placed anew. All faces around a node that moves are among those
/// that go, so that what the change does to volume, area and shape can be read off its faces alone.
struct MeshChange {
  std::vector<std::uint32_t> gone;         ///< slots of faces, increasing
  std::vector<Triangle> fresh;             ///< the faces in their place; they have the border of those that go
  std::vector<PlacedNode> placed{};        ///< nodes that move; one that the mesh does not have yet comes with the change
  std::optional<std::uint32_t> removed{};  ///< a node that no face has afterwards
};

/// A closed triangle mesh whose connectivity changes. Faces and nodes keep their slots until mesh() tidies up.
class LiveMesh {
 public:
  explicit LiveMesh(const SurfaceView& surface);

  /// Number of the node that the next split brings.
  [[nodiscard]] std::uint32_t next_node() const { return static_cast<std::uint32_t>(position_.size()); }
  [[nodiscard]] std::uint32_t node_count() const { return nodes_; }
  [[nodiscard]] std::uint32_t slots() const { return static_cast<std::uint32_t>(faces_.size()); }
  [[nodiscard]] bool has_face(std::uint32_t slot) const { return alive_[slot] != 0; }
  [[nodiscard]] bool has_node(std::uint32_t node) const { return node < around_.size() && !around_[node].empty(); }
  [[nodiscard]] const Triangle& face(std::uint32_t slot) const { return faces_[slot]; }
  [[nodiscard]] const Vec3d& position(std::uint32_t node) const { return position_[node]; }
  /// Slots of the faces around a node, increasing.
  [[nodiscard]] std::span<const std::uint32_t> faces_of(std::uint32_t node) const { return around_[node]; }
  /// The nodes that have an edge with this one, increasing.
  [[nodiscard]] std::vector<std::uint32_t> neighbours_of(std::uint32_t node) const;
  /// The slot of the face that has the edge from a to b in this direction.
  [[nodiscard]] std::optional<std::uint32_t> face_with(std::uint32_t a, std::uint32_t b) const;
  /// All edges with the lower node first, in increasing order.
  [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> edges() const;

  void apply(const MeshChange& change);

  /// The mesh without empty slots; nodes keep their order.
  [[nodiscard]] TriangleMesh mesh() const;
  /// The nodes go to these places [µm], in the order of mesh().
  void place_all(std::span<const Vec3d> places);

 private:
  void take_face(std::uint32_t slot);
  void put_face(std::uint32_t slot, const Triangle& face);

  std::vector<Vec3d> position_;
  std::vector<Triangle> faces_;
  std::vector<char> alive_;
  std::vector<std::vector<std::uint32_t>> around_;  ///< by node: slots of its faces
  std::uint32_t nodes_ = 0;
};

/// Where a node is after a change.
[[nodiscard]] inline const Vec3d& place_after(const LiveMesh& mesh, const MeshChange& change, std::uint32_t node) {
  for (const PlacedNode& one : change.placed)
    if (one.node == node) return one.place;
  return mesh.position(node);
}

/// The corner of a face that is neither a nor b.
[[nodiscard]] inline std::uint32_t third_corner(const Triangle& face, std::uint32_t a, std::uint32_t b) {
  for (const std::uint32_t node : face)
    if (node != a && node != b) return node;
  return face[0];
}

}  // namespace morula
