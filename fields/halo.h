#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel/comm.h"
#include "core/space/space.h"
#include "fields/field.h"
#include "fields/layout.h"

namespace morula::fields {

/// The six sides of a brick: x low, x high, y low, ... z high.
inline constexpr std::size_t kSides = 6;

/// Where the layer of voxels beyond a side of a brick comes from.
struct GhostSource {
  enum class Kind : std::uint8_t { kBoundary, kSameRank, kOtherRank } kind = Kind::kBoundary;
  std::size_t at = 0;  ///< kSameRank: the neighbour on this rank; kOtherRank: where the layer starts in the received values
};

/// Copies of the neighbours' outermost voxel layers: same rank read directly, other ranks by one message per neighbour rank.
/// Value: double or float.
template <class Value>
class Halo {
 public:
  /// Keeps a reference to `layout` and `comm`. Of `field` the bricks and their owners count; how many voxels they have stands in `layout`.
  Halo(const Field& field, const Layout& layout, const Space& space, const Comm& comm);
  Halo(const Halo&) = delete;
  Halo& operator=(const Halo&) = delete;

  /// Bring the other ranks' layers of this vector of unknowns here. Collective among neighbours.
  void exchange(const Value* unknowns);

  [[nodiscard]] const GhostSource& source(std::size_t brick, std::size_t side) const { return sources_[brick][side]; }
  [[nodiscard]] const Value* received() const { return received_.data(); }

 private:
  struct Layer {
    std::size_t brick = 0;  ///< on this rank
    std::size_t side = 0;
  };

  const Layout& layout_;
  const Comm& comm_;
  std::vector<std::array<GhostSource, kSides>> sources_;
  std::vector<Layer> sent_layers_;
  std::vector<Value> sent_, received_;
  std::vector<Sending> sendings_;      ///< in sent_
  std::vector<Receiving> receivings_;  ///< in received_
};

/// Voxels in the layer at a side of a brick of this extent.
std::size_t layer_size(const std::array<std::int32_t, 3>& extent, std::size_t side);

/// Call visit(index in the brick, index in the layer) for each voxel of the outermost layer at `side`, the lower axis fastest.
template <class Visit>
void for_each_in_layer(const std::array<std::int32_t, 3>& n, std::size_t side, Visit&& visit) {
  const std::size_t axis = side / 2;
  const std::array<std::size_t, 3> stride{1, static_cast<std::size_t>(n[0]),
                                          static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1])};
  const std::size_t u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
  const std::size_t start = (side % 2) ? static_cast<std::size_t>(n[axis] - 1) * stride[axis] : 0;
  std::size_t k = 0;
  for (std::size_t j = 0; j < static_cast<std::size_t>(n[v]); ++j)
    for (std::size_t i = 0; i < static_cast<std::size_t>(n[u]); ++i) visit(start + i * stride[u] + j * stride[v], k++);
}

}  // namespace morula::fields
