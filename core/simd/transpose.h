#pragma once
#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "core/simd/lane.h"

namespace morula {

/// Memory that starts on a cache line, so that a lane never straddles two.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::size_t kAlignment = 64;

  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) noexcept {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), std::align_val_t(kAlignment))); }
  void deallocate(T* p, std::size_t) noexcept { ::operator delete(p, std::align_val_t(kAlignment)); }
  template <class U>
  bool operator==(const CacheLineAllocator<U>&) const noexcept {
    return true;
  }
};

/// A vector for lane workspaces.
template <class T>
using LaneVector = std::vector<T, CacheLineAllocator<T>>;

namespace detail {

template <class T, int W, int Step, std::size_t... J>
void exchange_blocks(typename Lane<T, W>::Vector& a, typename Lane<T, W>::Vector& b, std::index_sequence<J...>) noexcept {
  // __builtin_shufflevector, not __builtin_shuffle: both GCC and clang (clang-tidy, libFuzzer) know it
  const auto first = __builtin_shufflevector(a, b, (J & Step ? static_cast<int>(W + J) - Step : static_cast<int>(J))...);
  b = __builtin_shufflevector(a, b, (J & Step ? static_cast<int>(W + J) : static_cast<int>(J) + Step)...);
  a = first;
}

/// Transpose a W × W tile held in W vectors: log2(W) rounds of exchanging off-diagonal blocks.
template <class T, int W, int Step = W / 2>
void transpose_tile(std::array<typename Lane<T, W>::Vector, W>& row) noexcept {
  if constexpr (Step >= 1) {
#pragma GCC unroll 8
    for (int i = 0; i < W; ++i) {
      if ((i & Step) == 0) exchange_blocks<T, W, Step>(row[i], row[i + Step], std::make_index_sequence<W>{});
    }
    transpose_tile<T, W, Step / 2>(row);
  }
}

}  // namespace detail

/// out[i][lane] = source[lane][i] for i < count: W equally long arrays to one array of lanes.
template <int W, class T>
void load_lanes(const std::array<const T*, W>& source, std::size_t count, T* out) noexcept {
  std::size_t i = 0;
  if constexpr (W == 1) {
    if (count > 0) std::memcpy(out, source[0], count * sizeof(T));
    return;
  } else {
    std::array<typename Lane<T, W>::Vector, W> tile;
    for (; i + W <= count; i += W) {
      for (int lane = 0; lane < W; ++lane) tile[lane] = Lane<T, W>::load(source[lane] + i).v;
      detail::transpose_tile<T, W>(tile);
      for (int k = 0; k < W; ++k) Lane<T, W>::from(tile[k]).store(out + (i + k) * W);
    }
  }
  for (; i < count; ++i) {
    for (int lane = 0; lane < W; ++lane) out[i * W + lane] = source[lane][i];
  }
}

/// target[lane][i] = in[i][lane] for i < count. Lanes that share a target must hold equal numbers.
template <int W, class T>
void store_lanes(const T* in, std::size_t count, const std::array<T*, W>& target) noexcept {
  std::size_t i = 0;
  if constexpr (W == 1) {
    if (count > 0) std::memcpy(target[0], in, count * sizeof(T));
    return;
  } else {
    std::array<typename Lane<T, W>::Vector, W> tile;
    for (; i + W <= count; i += W) {
      for (int k = 0; k < W; ++k) tile[k] = Lane<T, W>::load(in + (i + k) * W).v;
      detail::transpose_tile<T, W>(tile);
      for (int lane = 0; lane < W; ++lane) Lane<T, W>::from(tile[lane]).store(target[lane] + i);
    }
  }
  for (; i < count; ++i) {
    for (int lane = 0; lane < W; ++lane) target[lane][i] = in[i * W + lane];
  }
}

/// True when a comparison holds in at least one lane.
template <int W, class Mask>
bool any_lane(Mask mask) noexcept {
  long long found = 0;
  for (int i = 0; i < W; ++i) found |= static_cast<long long>(mask[i]);
  return found != 0;
}

}  // namespace morula
