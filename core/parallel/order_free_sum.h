#pragma once
#include <array>
#include <bit>
#include <cstdint>

namespace morula {

/// A sum of doubles that does not depend on the order of its terms: exact, then rounded once.
///
/// The terms are added as integers into 32-bit digits at fixed binary places over the whole range of double (a superaccumulator,
/// Kulisch), so that any order, any number of threads and any number of ranks give the same bits. Not a number and infinities poison
/// the sum: value() is then NaN. Up to 2^29 terms, those of added sums included, between two calls of carry().
class OrderFreeSum {
 public:
  /// 32-bit places: the lowest bit of a double is 2^-1074, the highest 2^1023.
  static constexpr int kDigits = 68;

  void add(double term) noexcept {
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(term);
    const int exponent_bits = static_cast<int>((bits >> 52) & 0x7FF);
    if (exponent_bits == 0x7FF) {
      poisoned_ = 1;
      return;
    }
    std::uint64_t mantissa = bits & ((std::uint64_t{1} << 52) - 1);
    if (exponent_bits != 0) mantissa |= std::uint64_t{1} << 52;
    const int place = exponent_bits == 0 ? 0 : exponent_bits - 1;  // in bits above 2^-1074
    const int digit = place >> 5;
    const int shift = place & 31;
    const std::uint64_t low = (mantissa & 0xFFFFFFFFu) << shift;
    const std::uint64_t high = (mantissa >> 32) << shift;
    const std::int64_t sign = (bits >> 63) ? -1 : 1;
    digits_[digit] += sign * static_cast<std::int64_t>(low & 0xFFFFFFFFu);
    digits_[digit + 1] += sign * static_cast<std::int64_t>((low >> 32) + (high & 0xFFFFFFFFu));
    digits_[digit + 2] += sign * static_cast<std::int64_t>(high >> 32);
  }

  OrderFreeSum& operator+=(const OrderFreeSum& other) noexcept {
    for (int i = 0; i < kDigits; ++i) digits_[i] += other.digits_[i];
    poisoned_ |= other.poisoned_;
    return *this;
  }

  /// Bring every digit but the last into [0, 2^32); the sum is unchanged, and there is room for 2^29 more terms.
  void carry() noexcept;

  /// The exact sum, rounded to the nearest double, ties to even; infinite beyond the largest double, +0 where nothing remains.
  [[nodiscard]] double value() const noexcept;

  /// The digits and the poison flag as one array of integers that may be added element by element (MPI_SUM) after carry().
  static constexpr int kWords = kDigits + 1;
  [[nodiscard]] std::array<std::int64_t, kWords> words() const noexcept;
  static OrderFreeSum from_words(const std::array<std::int64_t, kWords>& words) noexcept;

 private:
  std::array<std::int64_t, kDigits> digits_{};
  std::int64_t poisoned_ = 0;
};

}  // namespace morula
