#pragma once
#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "core/parallel/comm.h"

namespace morula {

/// Plain data as bytes of a message, and back.
template <class T>
std::vector<std::byte> pack(const std::vector<T>& items) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<std::byte> out(items.size() * sizeof(T));
  if (!items.empty()) std::memcpy(out.data(), static_cast<const void*>(items.data()), out.size());
  return out;
}
template <class T>
std::vector<T> unpack(std::span<const std::byte> bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<T> out(bytes.size() / sizeof(T));
  if (!out.empty()) std::memcpy(static_cast<void*>(out.data()), bytes.data(), out.size() * sizeof(T));
  return out;
}

/// The items of all ranks, rank by rank. Collective.
template <class T>
std::vector<T> items_of_all_ranks(const std::vector<T>& mine, const Comm& comm) {
  return comm.size() == 1 ? mine : unpack<T>(comm.gather_to_all(pack(mine)));
}

}  // namespace morula
