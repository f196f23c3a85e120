#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/closest_point.h"
#include "core/mesh/triangle_mesh.h"
#include "core/space/space.h"

namespace morula {

/// A face and the point on it that is nearest to some point.
struct NearestFace {
  std::uint32_t face = 0;
  ClosestPoint closest;
};

/// A static tree of boxes over the triangles of a rigid surface. Build O(n log n), queries O(log n + answers).
///
/// Answers are those of a loop over all faces: they depend on positions and faces, not on how the tree was built.
class TriangleTree {
 public:
  /// Copies what it is given. Precondition: indices valid, coordinates finite. Faces may be degenerate; none at all is fine too.
  TriangleTree(std::span<const Vec3d> position, std::span<const Triangle> faces);

  /// All faces whose own box overlaps `box` (touching counts), in increasing order.
  [[nodiscard]] std::vector<std::uint32_t> faces_in(const Box& box) const;
  /// The same into a vector that is reused.
  void faces_in(const Box& box, std::vector<std::uint32_t>& found) const;

  /// The face nearest to p among those not farther than `cutoff` [µm]; of equally near ones that with the lowest number.
  [[nodiscard]] std::optional<NearestFace> nearest(const Vec3d& p, double cutoff = 1e150) const;

  /// Box around all faces; empty when there are none.
  [[nodiscard]] Box bounds() const { return nodes_.empty() ? Box{} : nodes_[0].box; }
  [[nodiscard]] std::size_t face_count() const { return faces_.size(); }

 private:
  struct Node {
    Box box;
    std::uint32_t begin = 0;  ///< leaf: first place in order_; else number of the second child (the first one follows its parent)
    std::uint32_t count = 0;  ///< faces of a leaf; 0 for a branch
  };

  void build(std::uint32_t begin, std::uint32_t end, std::span<const Vec3d> centers);
  [[nodiscard]] Box box_of(std::uint32_t face) const;

  std::vector<Vec3d> position_;
  std::vector<Triangle> faces_;
  std::vector<std::uint32_t> order_;  ///< faces, leaf by leaf
  std::vector<Node> nodes_;           ///< in depth-first order
  double rounding_ = 0.0;             ///< bound on the rounding error of a nearest point [µm]
};

}  // namespace morula
