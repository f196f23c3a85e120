#pragma once
#include <cstddef>

#include "core/simd/lane.h"

namespace morula::fields {

/// Σ f(i), i = 0 .. n−1, in one fixed order: eight interleaved partial sums, then the rest, then the eight in pairs.
/// f_lane(i) gives the eight terms from i on, f(i) one term. The order depends on n alone: the same bits on every machine.
template <class FLane, class F>
double block_sum(std::size_t n, FLane&& f_lane, F&& f) {
  using L = Lane<double, 8>;
  L sum(0.0);
  std::size_t i = 0;
  for (; i + 8 <= n; i += 8) sum += f_lane(i);
  double rest = 0.0;
  for (; i < n; ++i) rest += f(i);
  return (((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]))) + rest;
}

/// Σ x_i
inline double block_sum(const double* x, std::size_t n) {
  return block_sum(
      n, [x](std::size_t i) { return Lane<double, 8>::load(x + i); }, [x](std::size_t i) { return x[i]; });
}
/// Σ x_i y_i
inline double block_dot(const double* x, const double* y, std::size_t n) {
  using L = Lane<double, 8>;
  return block_sum(
      n, [x, y](std::size_t i) { return L::load(x + i) * L::load(y + i); }, [x, y](std::size_t i) { return x[i] * y[i]; });
}
/// Σ x_i² m_i
inline double block_triple(const double* x, const double* m, std::size_t n) {
  using L = Lane<double, 8>;
  return block_sum(
      n,
      [x, m](std::size_t i) {
        const L xi = L::load(x + i);
        return xi * (xi * L::load(m + i));
      },
      [x, m](std::size_t i) { return x[i] * (x[i] * m[i]); });
}
/// Σ (x_i w_i)²
inline double block_weighted_square(const double* x, const double* w, std::size_t n) {
  using L = Lane<double, 8>;
  return block_sum(
      n,
      [x, w](std::size_t i) {
        const L p = L::load(x + i) * L::load(w + i);
        return p * p;
      },
      [x, w](std::size_t i) {
        const double p = x[i] * w[i];
        return p * p;
      });
}

}  // namespace morula::fields
