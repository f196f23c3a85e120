#pragma once
#include <bit>
#include <cassert>
#include <compare>
#include <cstdint>
#include <string>

namespace morula {

/// Name of a cell: 64 bits, never reused, and the whole lineage in itself.
///
/// The low 28 bits are the founder's number (1 .. 2^28−1). The high 36 bits are the path from the founder: 1 for the founder, and
/// 2·path (+1) for the first (second) daughter. An id therefore follows from the parent's id alone: no counter, no communication,
/// the same on every rank. A lineage may be 35 generations long.
///
/// Written as text: `17` for a founder, `17.01` for the second daughter of its first daughter.
class CellId {
 public:
  static constexpr int kFounderBits = 28;
  static constexpr int kMaxGenerations = 64 - kFounderBits - 1;

  constexpr CellId() = default;
  constexpr explicit CellId(std::uint64_t bits) : bits_(bits) {}

  /// The founder with this number, 1 .. 2^28−1.
  static constexpr CellId founder(std::uint64_t number) { return CellId((std::uint64_t{1} << kFounderBits) | number); }

  [[nodiscard]] constexpr std::uint64_t bits() const { return bits_; }
  [[nodiscard]] constexpr bool valid() const { return bits_ != 0; }
  [[nodiscard]] constexpr std::uint64_t founder_number() const { return bits_ & ((std::uint64_t{1} << kFounderBits) - 1); }
  [[nodiscard]] constexpr int generation() const { return std::bit_width(path()) - 1; }
  [[nodiscard]] constexpr bool can_divide() const { return generation() < kMaxGenerations; }

  /// Daughter 0 or 1. Precondition: can_divide().
  [[nodiscard]] constexpr CellId daughter(int which) const {
    assert(can_divide() && (which == 0 || which == 1));
    return CellId(((2 * path() + static_cast<std::uint64_t>(which)) << kFounderBits) | founder_number());
  }

  [[nodiscard]] std::string text() const {
    std::string out = std::to_string(founder_number());
    for (int bit = generation() - 1; bit >= 0; --bit) {
      if (bit == generation() - 1) out += '.';
      out += ((path() >> bit) & 1) ? '1' : '0';
    }
    return out;
  }

  friend constexpr auto operator<=>(CellId, CellId) = default;

 private:
  [[nodiscard]] constexpr std::uint64_t path() const { return bits_ >> kFounderBits; }

  std::uint64_t bits_ = 0;
};

}  // namespace morula
