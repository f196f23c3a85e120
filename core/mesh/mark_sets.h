#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace morula {

/// Bytes that a face has for its set of marks where a study has so many of them.
constexpr std::size_t mark_bytes(std::size_t marks) { return std::max<std::size_t>(1, (marks + 7) / 8); }

/// The marks of one face: bit k % 8 of byte k / 8 is its k-th mark. None at all where there are no bytes.
using MarkSet = std::span<const std::uint8_t>;

inline bool has_mark(MarkSet set, int mark) {
  const auto byte = static_cast<std::size_t>(mark) / 8;
  return mark >= 0 && byte < set.size() && (set[byte] >> (mark % 8) & 1) != 0;
}

/// Sets of marks of the faces of a surface, those of a face one after the other.
class MarkSets {
 public:
  MarkSets() = default;
  MarkSets(std::span<const std::uint8_t> bytes, std::size_t faces) : bytes_(bytes), width_(faces == 0 ? 0 : bytes.size() / faces) {}

  [[nodiscard]] bool empty() const { return width_ == 0; }
  /// How many faces there are sets of.
  [[nodiscard]] std::size_t size() const { return width_ == 0 ? 0 : bytes_.size() / width_; }
  /// Bytes of a face.
  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] MarkSet operator[](std::size_t face) const { return width_ == 0 ? MarkSet() : bytes_.subspan(face * width_, width_); }
  [[nodiscard]] bool has(std::size_t face, int mark) const { return has_mark((*this)[face], mark); }
  [[nodiscard]] bool any_has(int mark) const {
    for (std::size_t face = 0; face < size(); ++face)
      if (has(face, mark)) return true;
    return false;
  }
  /// Those of `count` faces from this one on.
  [[nodiscard]] MarkSets faces(std::size_t first, std::size_t count) const {
    return width_ == 0 ? MarkSets() : MarkSets(bytes_.subspan(first * width_, count * width_), count);
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t width_ = 0;
};

/// Give a face a mark, or take it away; `width`: bytes of a face.
inline void set_mark(std::span<std::uint8_t> bytes, std::size_t width, std::size_t face, int mark, bool on) {
  std::uint8_t& byte = bytes[face * width + static_cast<std::size_t>(mark) / 8];
  const auto bit = static_cast<std::uint8_t>(1u << (mark % 8));
  byte = static_cast<std::uint8_t>(on ? byte | bit : byte & ~bit);
}

}  // namespace morula
