#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/cell_id.h"
#include "core/vec3.h"

namespace morula {

/// The Philox 4x32-10 counter-based generator: four words from a counter and a key, no state.
/// Salmon et al. 2011, doi:10.1145/2063384.2063405.
constexpr std::array<std::uint32_t, 4> philox4x32_10(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t product0 = std::uint64_t{0xD2511F53} * counter[0];
    const std::uint64_t product1 = std::uint64_t{0xCD9E8D57} * counter[2];
    counter = {static_cast<std::uint32_t>(product1 >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(product1),
               static_cast<std::uint32_t>(product0 >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(product0)};
    key[0] += 0x9E3779B9;
    key[1] += 0xBB67AE85;
  }
  return counter;
}

/// What a random number is for. Each purpose has its own stream; an index is never shared between purposes.
enum class RandomStream : std::uint32_t {
  kInitialPosition = 1,
  kInitialPhase,
  kCellVariability,
  kDivisionAxis,
  kDivisionDuration,
  kDeath,
  kMigration,
  kOrientation,
  kSeparation,  ///< direction in which coincident cells are moved apart
  kFluctuationOfNodes,
  kFluctuationOfEdges,
  kFluctuationOfContacts,
  kPolarity,
  kDivisionTilt,   ///< of the axis away from that of its rule
  kDivisionShare,  ///< of the mother's volume that the first daughter gets
  kDivisionSize,   ///< of a cell's division volume
  kPhaseDuration,
  kTension,  ///< of a cell's own factors, in the order of Trait
  kStiffness,
  kAdhesion,
  kFate,  ///< what types the daughters of a division have
};

/// A pair of independent numbers.
struct RandomPair {
  double first, second;
};

/// Random numbers that depend only on (seed, stream, cell, index): no state, the same on any rank, thread or restart.
///
/// `index` is the draw's number within (stream, cell): the step for noise, the event count for rare draws. One index gives one pair.
class Random {
 public:
  constexpr Random(std::uint32_t seed, RandomStream stream) : key_{seed, static_cast<std::uint32_t>(stream)} {}

  [[nodiscard]] constexpr std::array<std::uint32_t, 4> words(CellId cell, std::uint64_t index) const {
    return philox4x32_10({static_cast<std::uint32_t>(cell.bits()), static_cast<std::uint32_t>(cell.bits() >> 32),
                          static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32)},
                         key_);
  }

  /// Two uniform numbers strictly inside (0, 1).
  [[nodiscard]] constexpr RandomPair uniform(CellId cell, std::uint64_t index) const {
    const auto w = words(cell, index);
    return {to_unit(w[0], w[1]), to_unit(w[2], w[3])};
  }

  /// Two independent standard normal numbers (Box–Muller).
  [[nodiscard]] RandomPair normal(CellId cell, std::uint64_t index) const {
    const RandomPair u = uniform(cell, index);
    const double radius = std::sqrt(-2.0 * std::log(u.first));
    const double angle = 2.0 * std::numbers::pi * u.second;
    return {radius * std::cos(angle), radius * std::sin(angle)};
  }

  /// A direction, uniform on the unit sphere.
  [[nodiscard]] Vec3d direction(CellId cell, std::uint64_t index) const {
    const RandomPair u = uniform(cell, index);
    const double z = 2.0 * u.first - 1.0;
    const double rho = std::sqrt(1.0 - z * z);
    const double angle = 2.0 * std::numbers::pi * u.second;
    return {rho * std::cos(angle), rho * std::sin(angle), z};
  }

  /// The uniform number in (0, 1) of two words: (((high·2³² + low) >> 12) + ½)·2⁻⁵², exact.
  static constexpr double to_unit(std::uint32_t low, std::uint32_t high) {
    const std::uint64_t bits = (static_cast<std::uint64_t>(high) << 32) | low;
    return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52;
  }

 private:
  std::array<std::uint32_t, 2> key_;
};

}  // namespace morula
