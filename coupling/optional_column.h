#pragma once
#include <cstddef>
#include <cstring>
#include <vector>

namespace morula {

/// A value by row that is the same for all cells of most tissues: it has no room until a row sets another value than this usual one.
///
/// Rows beyond the last that was set have the usual value. set() may make room, so that it is not for several threads at once, unless
/// make_room() was called before.
template <class T>
class OptionalColumn {
 public:
  OptionalColumn() = default;
  explicit OptionalColumn(const T& usual) : usual_(usual) {}

  [[nodiscard]] T operator[](std::size_t row) const { return row < values_.size() ? values_[row] : usual_; }

  /// `room`: for how many rows, where there is none for this one yet.
  void set(std::size_t row, const T& value, std::size_t room = 0) {
    if (row >= values_.size()) {
      if (is_usual(value)) return;
      if (row >= values_.capacity() && room > row) values_.reserve(room);
      values_.resize(row + 1, usual_);
    }
    values_[row] = value;
  }
  /// Room for this many rows.
  void make_room(std::size_t rows) {
    if (values_.size() < rows) {
      values_.reserve(rows);
      values_.resize(rows, usual_);
    }
  }
  /// All rows have the usual value, and there is no room for another.
  [[nodiscard]] bool empty() const { return values_.empty(); }
  [[nodiscard]] std::size_t memory() const { return values_.capacity() * sizeof(T); }

 private:
  /// Bit by bit: −0 is another value, for restarts and hashes.
  [[nodiscard]] bool is_usual(const T& value) const { return std::memcmp(&value, &usual_, sizeof(T)) == 0; }

  T usual_{};
  std::vector<T> values_;
};

}  // namespace morula
