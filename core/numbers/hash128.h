#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace morula {

/// A 128-bit hash; addition is modulo 2^128, so that hashes of parts can be combined in any order.
struct Hash128 {
  std::uint64_t low = 0, high = 0;

  Hash128& operator+=(const Hash128& other) {
    low += other.low;
    high += other.high + (low < other.low ? 1 : 0);
    return *this;
  }
  friend auto operator<=>(const Hash128&, const Hash128&) = default;

  /// 32 hexadecimal digits, the high word first.
  [[nodiscard]] std::string hex() const;
};

/// MurmurHash3 x64 128 of some bytes (Appleby 2011, the published algorithm in the public domain), with a 64-bit seed. `low` is its first word.
/// Against accidents, not against attackers: a change of any bit changes the hash with probability 1 − 2^-128.
Hash128 hash128(std::span<const std::byte> bytes, std::uint64_t seed = 0);

/// Order-free checksum of a table: the sum over rows of the hash of (row number, row). Slices of a table may be added in any order.
Hash128 table_checksum(std::span<const std::byte> bytes, std::size_t row_size, std::uint64_t first_row);

}  // namespace morula
