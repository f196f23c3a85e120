#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace morula {

/// Sides of the faces of any triangle mesh, however broken, gathered by edge. Faces that name a node twice have no sides.
class MeshSides {
 public:
  struct Side {
    std::uint32_t face;
    bool forward;  ///< the face walks from the lower to the higher node
  };
  struct Edge {
    std::uint32_t low, high;
    std::span<const Side> sides;  ///< by increasing face
  };
  struct Border {
    std::vector<std::uint32_t> nodes, faces;  ///< in increasing order
    std::size_t edge_count = 0;
  };
  struct PinchedNode {
    std::uint32_t node;
    std::vector<std::uint32_t> faces;
  };

  explicit MeshSides(std::span<const Triangle> faces);
  MeshSides(const MeshSides&) = delete;
  MeshSides& operator=(const MeshSides&) = delete;

  /// By increasing (low, high).
  [[nodiscard]] std::span<const Edge> edges() const { return edges_; }
  /// Edges with one face, gathered where they have nodes in common.
  [[nodiscard]] std::vector<Border> borders(std::uint32_t node_count) const;
  /// Nodes whose faces are not connected with each other through the edges at that node.
  [[nodiscard]] std::vector<PinchedNode> pinched_nodes(std::uint32_t node_count) const;

 private:
  std::vector<Side> sides_;
  std::vector<Edge> edges_;
  std::size_t face_count_ = 0;
};

/// The connected parts of a mesh, and which faces run against the majority of their part.
struct OrientedParts {
  std::uint32_t count = 0;
  std::vector<std::uint32_t> part;                          ///< by face
  std::vector<char> flipped;                                ///< by face
  std::vector<char> closed;                                 ///< by part: every edge has two faces, and it can be oriented
  std::vector<std::vector<std::uint32_t>> flipped_patches;  ///< connected flipped faces, in increasing order
  std::vector<std::pair<std::uint32_t, std::uint32_t>>
      contradictions;  ///< one pair of neighbouring faces for each part that cannot be oriented
};

/// Walks over edges with exactly two faces. Where both directions have equally many faces, those of the part's first face count as right.
OrientedParts orient_parts(const MeshSides& sides, std::span<const Triangle> faces);

}  // namespace morula
