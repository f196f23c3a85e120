#pragma once
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace morula {

/// W numbers that are computed at once; one number of each cell of a lane batch.
///
/// A law is written once for a type `Real` that is `double`, `float` or a Lane of either. All operations are IEEE operations element
/// by element, so that a cell gets the same bits whatever W is and whoever its neighbours in the batch are. Comparisons give a mask
/// that `select` understands; there is no branch on a lane.
template <class T, int W>
struct Lane {
  using Scalar = T;
  using Vector [[gnu::vector_size(W * sizeof(T))]] = T;
  using Bits = std::conditional_t<sizeof(T) == 8, std::int64_t, std::int32_t>;
  using Mask [[gnu::vector_size(W * sizeof(T))]] = Bits;
  static constexpr int width = W;

  Vector v;

  Lane() = default;
  Lane(T scalar) : v(scalar - Vector{}) {}  // NOLINT: a number is a lane of equal numbers
  static Lane from(Vector vector) {
    Lane out;
    out.v = vector;
    return out;
  }
  static Lane load(const T* p) {
    Lane out;
    __builtin_memcpy(&out.v, p, sizeof(Vector));
    return out;
  }
  void store(T* p) const { __builtin_memcpy(p, &v, sizeof(Vector)); }

  T operator[](int i) const { return v[i]; }
  void set(int i, T value) { v[i] = value; }

  friend Lane operator+(Lane a, Lane b) { return from(a.v + b.v); }
  friend Lane operator-(Lane a, Lane b) { return from(a.v - b.v); }
  friend Lane operator*(Lane a, Lane b) { return from(a.v * b.v); }
  friend Lane operator/(Lane a, Lane b) { return from(a.v / b.v); }
  friend Lane operator-(Lane a) { return from(-a.v); }
  Lane& operator+=(Lane b) {
    v += b.v;
    return *this;
  }
  Lane& operator-=(Lane b) {
    v -= b.v;
    return *this;
  }
  Lane& operator*=(Lane b) {
    v *= b.v;
    return *this;
  }

  friend Mask operator<(Lane a, Lane b) { return a.v < b.v; }
  friend Mask operator<=(Lane a, Lane b) { return a.v <= b.v; }
  friend Mask operator>(Lane a, Lane b) { return a.v > b.v; }
  friend Mask operator>=(Lane a, Lane b) { return a.v >= b.v; }
};

template <class T, int W>
Lane<T, W> select(typename Lane<T, W>::Mask mask, Lane<T, W> a, Lane<T, W> b) {
  return Lane<T, W>::from(mask ? a.v : b.v);
}
inline double select(bool mask, double a, double b) { return mask ? a : b; }
inline float select(bool mask, float a, float b) { return mask ? a : b; }

template <class T, int W>
Lane<T, W> sqrt(Lane<T, W> a) {
  Lane<T, W> out;
  for (int i = 0; i < W; ++i) out.v[i] = __builtin_sqrt(a.v[i]);
  return out;
}
template <int W>
Lane<float, W> sqrt(Lane<float, W> a) {
  Lane<float, W> out;
  for (int i = 0; i < W; ++i) out.v[i] = __builtin_sqrtf(a.v[i]);
  return out;
}
template <class T, int W>
Lane<T, W> max(Lane<T, W> a, Lane<T, W> b) {
  return Lane<T, W>::from(a.v > b.v ? a.v : b.v);
}
template <class T, int W>
Lane<T, W> min(Lane<T, W> a, Lane<T, W> b) {
  return Lane<T, W>::from(a.v < b.v ? a.v : b.v);
}
template <class T, int W>
Lane<T, W> abs(Lane<T, W> a) {
  return Lane<T, W>::from(a.v < 0 ? -a.v : a.v);
}
inline double sqrt(double a) { return __builtin_sqrt(a); }
inline double max(double a, double b) { return a > b ? a : b; }
inline double min(double a, double b) { return a < b ? a : b; }
inline double abs(double a) { return a < 0 ? -a : a; }

}  // namespace morula
