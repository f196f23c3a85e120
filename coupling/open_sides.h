#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "core/vec3.h"

namespace morula {

/// Directions, of 192 spread evenly, in which a cell has no other beside it: those with none of the cells that it touches within 65°. In a close packing there
/// is one within 45° of any direction, at a flat surface none within 90° of the normal; after the empty cones of Marrone et al. 2010,
/// doi:10.1016/j.jcp.2010.01.019.
class OpenSides {
 public:
  static constexpr std::size_t kWords = 3, kDirections = 64 * kWords;

  OpenSides() = default;
  /// `neighbours`: from the cell's centre to those of the cells that it touches, any length; none: open all around.
  explicit OpenSides(std::span<const Vec3d> neighbours);

  [[nodiscard]] bool any() const { return (words[0] | words[1] | words[2]) != 0; }
  [[nodiscard]] bool has(std::size_t direction) const { return (words[direction / 64] >> (direction % 64) & 1) != 0; }
  void set(std::size_t direction, bool open);

  /// Without those that are but a gap within the tissue: a direction remains where at least half of the neighbours aside (less than 110° from it) are open
  /// in it, too. `of_neighbours`: their open sides, in the order of `neighbours`.
  [[nodiscard]] OpenSides outward(std::span<const Vec3d> neighbours, std::span<const OpenSides> of_neighbours) const;

  /// The middle of the directions, of length 1; of two opposite groups, as in a layer, one of them. Zero where there are none, or none stands out.
  [[nodiscard]] Vec3d middle() const;

  std::array<std::uint64_t, kWords> words{};
};

}  // namespace morula
