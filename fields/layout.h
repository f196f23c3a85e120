#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fields/field.h"

namespace morula::fields {

/// Where a concentration meets cells: all cells of one type that overlap one voxel.
struct Sink {
  std::int32_t brick = 0;  ///< on this rank
  std::int32_t voxel = 0;  ///< in the brick, x fastest
  std::uint16_t type = 0;  ///< of the cells
  double cells = 0.0;      ///< Σ w_iv: how many cells' worth of reactions happens here
};

/// With fewer bricks, starting threads costs more than it saves; and where other programs are at work, too, what is as short as this waits for them: 27,000
/// voxels (64 bricks) took five times as long on two threads as on one beside two other programs.
inline constexpr std::size_t kBricksWorthThreads = 256;

/// The unknowns of this rank, one after the other: the concentrations of each brick, then the amounts that the time integration
/// must add up with its own weights: per brick the inflow through the six faces of the domain and what reactions in the volume took, then what each sink took.
struct Layout {
  /// Amounts per brick: inflow through x low, x high, y low, ... z high, then decayed.
  static constexpr std::size_t kAmountsPerBrick = 7;
  static constexpr std::size_t kDecayed = 6;

  std::vector<std::array<std::int32_t, 3>> extent;  ///< of each brick of this rank
  std::vector<std::size_t> offset;                  ///< of each brick's first voxel; one more for the end
  std::vector<Sink> sinks;                          ///< sorted by (brick, voxel, type)
  std::vector<std::size_t> first_sink;              ///< of each brick; one more for the end
  std::int64_t global_voxels = 0;
  bool sinks_anywhere = false;  ///< on any rank

  [[nodiscard]] std::size_t bricks() const { return extent.size(); }
  [[nodiscard]] std::size_t concentrations() const { return offset.back(); }
  [[nodiscard]] std::size_t amounts_at(std::size_t brick) const { return concentrations() + kAmountsPerBrick * brick; }
  [[nodiscard]] std::size_t sinks_at() const { return amounts_at(bricks()); }
  [[nodiscard]] std::size_t unknowns() const { return sinks_at() + sinks.size(); }
};

/// The layout of a field's bricks on this rank. `sinks` must be sorted by (brick, voxel, type).
Layout layout_of(const Field& field, std::vector<Sink> sinks);

}  // namespace morula::fields
