#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/vec3.h"

namespace morula {

/// Three node numbers, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// An edge i–j with its two faces. Seen from outside and walking from i to j, face (i, j, k) lies on the left and (j, i, l) on the right.
/// On a closed mesh every edge is a hinge, so that edges and hinges are one list.
struct Edge {
  std::uint32_t i, j;         ///< end nodes, i < j
  std::uint32_t k, l;         ///< opposite nodes of the left and the right face
  std::uint32_t left, right;  ///< the two faces
};

/// Immutable connectivity of a closed, oriented triangle mesh. Shared by all shells that have it.
class Topology {
 public:
  /// Build and check: every index valid, no degenerate or duplicate face, every edge has exactly two faces with opposite direction, every
  /// node's faces form one ring (manifold). Errors name the face, edge or node.
  static Result<std::shared_ptr<const Topology>> build(std::uint32_t node_count, std::vector<Triangle> faces);

  [[nodiscard]] std::uint32_t node_count() const { return node_count_; }
  [[nodiscard]] std::uint32_t face_count() const { return static_cast<std::uint32_t>(faces_.size()); }
  [[nodiscard]] std::uint32_t edge_count() const { return static_cast<std::uint32_t>(edges_.size()); }
  [[nodiscard]] std::span<const Triangle> faces() const { return faces_; }
  [[nodiscard]] std::span<const Edge> edges() const { return edges_; }
  /// Edge numbers of a face; entry c is the edge opposite to corner c.
  [[nodiscard]] std::span<const std::array<std::uint32_t, 3>> face_edges() const { return face_edges_; }
  /// Faces around a node, in increasing order.
  [[nodiscard]] std::span<const std::uint32_t> faces_of_node(std::uint32_t node) const {
    return std::span(node_faces_).subspan(node_face_begin_[node], node_face_begin_[node + 1] - node_face_begin_[node]);
  }
  /// Hash of the connectivity; equal for equal face lists.
  [[nodiscard]] std::uint64_t hash() const { return hash_; }

 private:
  Topology() = default;
  std::uint32_t node_count_ = 0;
  std::uint64_t hash_ = 0;
  std::vector<Triangle> faces_;
  std::vector<Edge> edges_;
  std::vector<std::array<std::uint32_t, 3>> face_edges_;
  std::vector<std::uint32_t> node_face_begin_, node_faces_;
};

/// A stress-free shape of unit mesh volume: where rest lengths and rest angles come from. A shell of rest volume V has rest lengths
/// V^(1/3) × edge_length. A shape that a renewed mesh has carried along (coupling/new_mesh.h) has the positions of the moment at which it was made, while
/// lengths, areas and angles are those of the stress-free surface.
struct ReferenceShape {
  std::shared_ptr<const Topology> topology;
  std::vector<Vec3d> position;        ///< by node; volume centroid at the origin, enclosed volume 1
  std::vector<double> edge_length;    ///< by edge
  std::vector<double> face_area;      ///< by face
  std::vector<double> hinge_angle;    ///< by edge: dihedral turning angle, 0 flat, > 0 convex [rad]
  std::uint32_t icosphere_nodes = 0;  ///< of the library's icosphere that this is; 0: a shape of its own
};

/// Reference shape from any positions (they are centred and scaled); null when they enclose no positive volume.
std::shared_ptr<const ReferenceShape> make_reference_shape(std::shared_ptr<const Topology> topology, std::vector<Vec3d> position);

/// Shapes that shells share: subdivided icosahedra with 42, 162, 642 and 2562 nodes, built once, and shapes of cells that came from elsewhere.
class ShapeLibrary {
 public:
  /// The icosphere with this number of nodes, or an error that lists the allowed numbers.
  Result<std::shared_ptr<const ReferenceShape>> icosphere(std::uint32_t nodes);

  /// The known shape that equals this one bit for bit, else the shape itself, known from now on as long as somebody has it. A shape whose faces
  /// are known gets their Topology, so that shells of both are computed in the same lanes.
  std::shared_ptr<const ReferenceShape> adopt(std::shared_ptr<const ReferenceShape> shape);
  /// A known shape with these faces (by the hash of their Topology) for which `same` holds; null when there is none.
  template <class Same>
  std::shared_ptr<const ReferenceShape> find(std::uint64_t topology_hash, const Same& same) {
    const auto [begin, end] = own_.equal_range(topology_hash);
    for (auto at = begin; at != end; ++at)
      if (auto shape = at->second.lock(); shape && same(*shape)) return shape;
    return nullptr;
  }

 private:
  std::array<std::shared_ptr<const ReferenceShape>, 4> icospheres_{};
  std::multimap<std::uint64_t, std::weak_ptr<const ReferenceShape>> own_;  ///< by hash of the topology
};

/// Signed volume enclosed by a closed mesh; relative to `origin` to avoid cancellation.
double enclosed_volume(std::span<const Triangle> faces, std::span<const Vec3d> position, const Vec3d& origin);
/// Σ A (x − x̄)(x − x̄)ᵀ [µm⁴] over the faces, each with its area A at its middle x; x̄ is the mean of the middles by area. Only nodes of faces count.
SymMat3<double> second_moments(std::span<const Vec3d> position, std::span<const Triangle> faces);
/// Volume centroid of the enclosed solid.
Vec3d volume_centroid(std::span<const Triangle> faces, std::span<const Vec3d> position);

}  // namespace morula
