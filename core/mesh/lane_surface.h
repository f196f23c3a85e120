#pragma once
#include <array>
#include <cstddef>

#include "core/mesh/lane_blocks.h"
#include "core/simd/transpose.h"
#include "core/vec3.h"

namespace morula {

/// Views of lane workspaces: vectors at [index][component][lane], scalars at [index][lane].
template <class T, int W>
Vec3<Lane<T, W>> load_vec3(const T* array, std::size_t index) noexcept {
  const T* p = array + index * 3 * W;
  return {Lane<T, W>::load(p), Lane<T, W>::load(p + W), Lane<T, W>::load(p + 2 * W)};
}
template <class T, int W>
void store_vec3(T* array, std::size_t index, const Vec3<Lane<T, W>>& v) noexcept {
  T* p = array + index * 3 * W;
  v.x.store(p);
  v.y.store(p + W);
  v.z.store(p + 2 * W);
}
template <class T, int W>
void add_vec3(T* array, std::size_t index, const Vec3<Lane<T, W>>& v) noexcept {
  store_vec3<T, W>(array, index, load_vec3<T, W>(array, index) + v);
}
template <class T, int W>
Lane<T, W> load_scalar(const T* array, std::size_t index) noexcept {
  return Lane<T, W>::load(array + index * W);
}

template <class T, int W>
SymMat3<Lane<T, W>> load_sym_mat3(const T* array, std::size_t index) noexcept {
  using Real = Lane<T, W>;
  const T* p = array + index * 6 * W;
  return {Real::load(p), Real::load(p + W), Real::load(p + 2 * W), Real::load(p + 3 * W), Real::load(p + 4 * W), Real::load(p + 5 * W)};
}

/// Where an array of a block's surfaces starts, by lane: `array` plus the surface's first element times `stride`.
template <int W, class T, class Offsets>
std::array<T*, W> lane_pointers(T* array, const LaneBlock& block, const Offsets& first, std::size_t stride = 1) noexcept {
  std::array<T*, W> pointers;
  for (int lane = 0; lane < W; ++lane) pointers[lane] = array + first[block.member[lane]] * stride;
  return pointers;
}

/// Positions of a block's nodes relative to node 0 of each surface, so that nothing is lost to cancellation far from the origin.
template <int W>
void load_relative_positions(const LaneBlock& block, const std::array<const double*, W>& node, double* out) noexcept {
  const std::size_t count = block.topology->node_count();
  load_lanes<W, double>(node, 3 * count, out);
  const auto origin = load_vec3<double, W>(out, 0);
  for (std::size_t i = 0; i < count; ++i) store_vec3<double, W>(out, i, load_vec3<double, W>(out, i) - origin);
}

}  // namespace morula
