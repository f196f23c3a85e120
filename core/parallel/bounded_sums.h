#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/parallel/comm.h"
#include "core/parallel/threads.h"

namespace morula {

/// Sums of doubles that do not depend on the order of their terms, at a tenth of the price of an OrderFreeSum, where it is known how large a term can
/// be: terms are added as whole numbers of 2⁻³⁶ of that. Up to 2²⁷ terms.
template <std::size_t kTerms>
class BoundedSums {
 public:
  using Terms = std::array<double, kTerms>;

  /// No term is larger than `most`, which is the same on all ranks. A sum whose bound is not a finite number above 0 is 0.
  explicit BoundedSums(const Terms& most) {
    for (std::size_t k = 0; k < kTerms; ++k)
      per_unit_[k] = most[k] > 0.0 && std::isfinite(most[k]) ? std::exp2(35 - std::ilogb(most[k])) : 0.0;
  }
  void add(const Terms& terms) {
    for (std::size_t k = 0; k < kTerms; ++k) sum_[k] += std::llrint(terms[k] * per_unit_[k]);
  }
  BoundedSums& operator+=(const BoundedSums& other) {
    for (std::size_t k = 0; k < kTerms; ++k) sum_[k] += other.sum_[k];
    return *this;
  }
  /// Sums in the same units with nothing in them.
  [[nodiscard]] BoundedSums empty() const {
    BoundedSums out = *this;
    out.sum_ = {};
    return out;
  }
  /// Those of all ranks. Collective.
  [[nodiscard]] Terms totals(const Comm& comm) const {
    std::array<std::int64_t, kTerms> all = sum_;
    comm.sum(all);
    Terms out{};
    for (std::size_t k = 0; k < kTerms; ++k)
      if (per_unit_[k] > 0.0) out[k] = static_cast<double>(all[k]) / per_unit_[k];
    return out;
  }

 private:
  Terms per_unit_;
  std::array<std::int64_t, kTerms> sum_{};
};

/// The totals over all ranks of terms_of(k), 0 <= k < count, and of what `sums` has already. Collective.
template <std::size_t kTerms, class TermsOf>
std::array<double, kTerms> totals_of(const BoundedSums<kTerms>& sums, int threads, std::size_t count, TermsOf&& terms_of,
                                     const Comm& comm) {
  const auto parts = static_cast<std::size_t>(std::max(1, threads));
  std::vector<BoundedSums<kTerms>> of_part(parts, sums.empty());
  on_each_thread(threads, [&](std::size_t t) {
    BoundedSums<kTerms> sum = of_part[t];
    for (std::size_t k = count * t / parts; k < count * (t + 1) / parts; ++k) sum.add(terms_of(k));
    of_part[t] = sum;
  });
  BoundedSums<kTerms> all = sums;
  for (const auto& part : of_part) all += part;
  return all.totals(comm);
}

}  // namespace morula
