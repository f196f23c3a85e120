#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/mesh/topology.h"

namespace morula {

struct PairBody;

// A surface against itself. Two sheets of one shell meet with their inner or with their outer sides, and from where they are alone nobody can say
// whether they have yet to touch or are already through: what is a gap for the one case is a depth for the other. So the law acts on the unsigned
// distance: the gap of the pair is |g| − d, with the distance d at which sheets of finite thickness touch, and the repulsion holds them apart before
// g = 0. Which side a point is on is that of the step's start, and a step in which it changes is refused (crossing.h). There is no adhesion.

/// How many edges away from a face another one must be to count as another part of the surface: so far along the surface that it is out of
/// reach where the surface is smooth. `face_count` faces make a ball of `radius` [µm], with edges of the length l = 4R √(π/(√3 F)); faces on
/// the way may be squeezed to half of that.
///
/// reach: gap below which points act, plus the distance of touch [µm].
inline int self_contact_rings(std::uint32_t face_count, double radius, double reach) {
  const double edge = 4.0 * radius * std::sqrt(std::numbers::pi / (std::numbers::sqrt3 * face_count));
  return std::max(1, static_cast<int>(std::ceil(reach / (0.5 * edge))));
}

/// Whether parts of a surface that are at least `rings` edges from each other along it may be nearer to each other than `reach` [µm]; a test that
/// is quick, and says yes where it does not know. A surface that is seen whole from its middle, at distances up to R, and whose faces lie in
/// planes at least h from there: two of its points that are e < h apart are seen at an angle of at most 2 asin(e/2h), and a way along the surface between
/// the directions is no longer than R²/h times that; each edge on the way costs the height of a face.
bool may_meet_itself(const PairBody& body, double reach, int rings);

/// Marks the nodes that are less than `rings` edges from a node of a face.
class NodesAround {
 public:
  explicit NodesAround(const Topology& topology) : topology_(topology) {}

  void find(std::uint32_t face, int rings) {
    near_.resize(topology_.node_count(), 0);
    for (const std::uint32_t node : nodes_) near_[node] = 0;
    nodes_.assign(topology_.faces()[face].begin(), topology_.faces()[face].end());
    for (const std::uint32_t node : nodes_) near_[node] = 1;
    std::size_t begin = 0;
    for (int ring = 1; ring < rings; ++ring) {
      const std::size_t end = nodes_.size();
      for (; begin < end; ++begin)
        for (const std::uint32_t f : topology_.faces_of_node(nodes_[begin]))
          for (const std::uint32_t node : topology_.faces()[f]) {
            if (near_[node]) continue;
            near_[node] = 1;
            nodes_.push_back(node);
          }
    }
  }
  /// Whether a node of the face is among them.
  [[nodiscard]] bool touch(std::uint32_t face) const {
    const Triangle& t = topology_.faces()[face];
    return near_[t[0]] || near_[t[1]] || near_[t[2]];
  }

 private:
  const Topology& topology_;
  std::vector<char> near_;
  std::vector<std::uint32_t> nodes_;
};

}  // namespace morula
