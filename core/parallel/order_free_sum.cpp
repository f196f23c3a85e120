#include "core/parallel/order_free_sum.h"

#include <cmath>
#include <limits>

namespace morula {

void OrderFreeSum::carry() noexcept {
  std::int64_t carried = 0;
  for (int i = 0; i + 1 < kDigits; ++i) {
    const std::int64_t digit = digits_[i] + carried;
    carried = digit >> 32;  // arithmetic shift: floor division
    digits_[i] = digit - (carried << 32);
  }
  digits_[kDigits - 1] += carried;
}

double OrderFreeSum::value() const noexcept {
  if (poisoned_ != 0) return std::numeric_limits<double>::quiet_NaN();
  OrderFreeSum magnitude = *this;
  magnitude.carry();
  const bool negative = magnitude.digits_[kDigits - 1] < 0;
  if (negative) {
    for (auto& digit : magnitude.digits_) digit = -digit;
    magnitude.carry();
  }
  int top = kDigits - 1;
  while (top > 0 && magnitude.digits_[top] == 0) --top;
  // The top digits hold at least 65 significant bits in three digits; what lies below only matters as a sticky bit for rounding.
  const auto digit = [&](int i) { return i >= 0 ? static_cast<std::uint64_t>(magnitude.digits_[i]) : 0u; };
  __extension__ using uint128 = unsigned __int128;
  uint128 window = (static_cast<uint128>(digit(top)) << 64) | (static_cast<uint128>(digit(top - 1)) << 32) | digit(top - 2);
  bool sticky = false;
  for (int i = 0; i < top - 2; ++i) sticky = sticky || magnitude.digits_[i] != 0;
  if (window == 0) return 0.0;
  // Reduce the window to 64 bits with a sticky lowest bit, then let the hardware round to nearest even in one conversion.
  int shift = 0;
  while ((window >> shift) > static_cast<uint128>(std::numeric_limits<std::uint64_t>::max() >> 1)) ++shift;
  const uint128 lost = window & ((static_cast<uint128>(1) << shift) - 1);
  std::uint64_t mantissa = static_cast<std::uint64_t>(window >> shift);
  if (lost != 0 || sticky) mantissa |= 1;
  const double rounded = static_cast<double>(mantissa);
  const double out = std::ldexp(rounded, 32 * (top - 2) + shift - 1074);
  return negative ? -out : out;
}

std::array<std::int64_t, OrderFreeSum::kWords> OrderFreeSum::words() const noexcept {
  OrderFreeSum carried = *this;
  carried.carry();
  std::array<std::int64_t, kWords> out{};
  for (int i = 0; i < kDigits; ++i) out[i] = carried.digits_[i];
  out[kDigits] = carried.poisoned_;
  return out;
}

OrderFreeSum OrderFreeSum::from_words(const std::array<std::int64_t, kWords>& words) noexcept {
  OrderFreeSum out;
  for (int i = 0; i < kDigits; ++i) out.digits_[i] = words[i];
  out.poisoned_ = words[kDigits];
  return out;
}

}  // namespace morula
