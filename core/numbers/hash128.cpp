#include "core/numbers/hash128.h"

#include <array>
#include <bit>
#include <cstring>

namespace morula {
namespace {

constexpr std::uint64_t kFirst = 0x87c37b91114253d5u, kSecond = 0x4cf5ad432745937fu;

std::uint64_t scrambled_first(std::uint64_t k) { return std::rotl(k * kFirst, 31) * kSecond; }
std::uint64_t scrambled_second(std::uint64_t k) { return std::rotl(k * kSecond, 33) * kFirst; }

/// Every bit of the input reaches every bit of the output.
std::uint64_t avalanche(std::uint64_t k) {
  k = (k ^ (k >> 33)) * 0xff51afd7ed558ccdu;
  k = (k ^ (k >> 33)) * 0xc4ceb9fe1a85ec53u;
  return k ^ (k >> 33);
}

}  // namespace

Hash128 hash128(std::span<const std::byte> bytes, std::uint64_t seed) {
  std::uint64_t a = seed, b = seed;
  const std::size_t blocks = bytes.size() / 16;
  for (std::size_t i = 0; i < blocks; ++i) {
    std::array<std::uint64_t, 2> word;
    std::memcpy(word.data(), bytes.data() + 16 * i, 16);
    a = std::rotl(a ^ scrambled_first(word[0]), 27) + b;
    a = a * 5 + 0x52dce729;
    b = std::rotl(b ^ scrambled_second(word[1]), 31) + a;
    b = b * 5 + 0x38495ab5;
  }
  std::array<std::uint64_t, 2> rest{};
  if (bytes.size() % 16 != 0) std::memcpy(rest.data(), bytes.data() + 16 * blocks, bytes.size() % 16);
  b ^= scrambled_second(rest[1]);
  a ^= scrambled_first(rest[0]);
  a ^= bytes.size();
  b ^= bytes.size();
  a += b;
  b += a;
  a = avalanche(a);
  b = avalanche(b);
  a += b;
  b += a;
  return {a, b};
}

Hash128 table_checksum(std::span<const std::byte> bytes, std::size_t row_size, std::uint64_t first_row) {
  Hash128 sum;
  if (row_size == 0) return sum;
  for (std::size_t row = 0; row < bytes.size() / row_size; ++row)
    sum += hash128(bytes.subspan(row * row_size, row_size), first_row + row + 1);
  return sum;
}

std::string Hash128::hex() const {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string out(32, '0');
  for (std::size_t i = 0; i < 16; ++i) {
    out[15 - i] = kDigits[(high >> (4 * i)) & 15];
    out[31 - i] = kDigits[(low >> (4 * i)) & 15];
  }
  return out;
}

}  // namespace morula
