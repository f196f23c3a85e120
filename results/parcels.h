#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "core/parallel/comm.h"

namespace morula::scenarios {

/// Pieces of bytes, each with a key, that are sorted over all ranks before they are written.
class Parcels {
 public:
  void add(std::uint64_t key, std::span<const std::byte> bytes) {
    key_.push_back(key);
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    begin_.push_back(bytes_.size());
  }
  [[nodiscard]] std::size_t size() const { return key_.size(); }
  [[nodiscard]] std::uint64_t key(std::size_t i) const { return key_[i]; }
  [[nodiscard]] std::span<const std::byte> bytes(std::size_t i) const {
    return std::span(bytes_).subspan(begin_[i], begin_[i + 1] - begin_[i]);
  }

 private:
  std::vector<std::uint64_t> key_;
  std::vector<std::size_t> begin_{0};
  std::vector<std::byte> bytes_;
};

/// Collective. All parcels in increasing order of (key, rank they came from, place there): rank r has the r-th stretch, and equal keys are on one rank.
/// A sample sort: no rank holds everything.
Parcels sort_over_ranks(const Parcels& local, const Comm& comm);

/// Bytes of plain values, one after the other.
class ByteWriter {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    put_all(std::span(&value, 1));
  }
  template <class T, std::size_t N>
  void put_all(std::span<T, N> values) {
    const std::size_t old = bytes_.size();
    bytes_.resize(old + values.size_bytes());
    if (!values.empty()) std::memcpy(bytes_.data() + old, values.data(), values.size_bytes());
  }
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  void clear() { bytes_.clear(); }

 private:
  std::vector<std::byte> bytes_;
};

/// Takes plain values from bytes in the order they were put. Only for bytes this program made itself.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  T get() {
    T value;
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_ = bytes_.subspan(sizeof(T));
    return value;
  }
  /// Appends `count` values to `out`.
  template <class T>
  void get_all(std::size_t count, std::vector<T>& out) {
    const std::size_t old = out.size();
    out.resize(old + count);
    if (count != 0) std::memcpy(out.data() + old, bytes_.data(), count * sizeof(T));
    bytes_ = bytes_.subspan(count * sizeof(T));
  }
  [[nodiscard]] bool empty() const { return bytes_.empty(); }
  [[nodiscard]] std::size_t rest() const { return bytes_.size(); }  ///< bytes left

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace morula::scenarios
