#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace morula {

/// Points of one body (the source) against the other (the target): candidate lists, and what can be kept between evaluations.
///
/// Lists and caches only save work: the nearest face is the exact nearest one whatever they hold, so that results do not depend on when
/// they were built.
struct PointsAgainstBody {
  std::vector<std::uint32_t> source_face;      ///< faces of the source within reach of the target
  std::vector<std::uint32_t> target_face;      ///< faces of the target that are a candidate of any source face
  std::vector<std::uint32_t> first_candidate;  ///< by source face, one more at the end
  std::vector<std::uint16_t> candidate;        ///< places in target_face, increasing
  std::vector<std::uint16_t> nearest;          ///< by point: place of the nearest face in target_face; see kAsleep, kNoFace
  std::vector<float> good_until;  ///< by point: motion of the pair's nodes since the lists were built up to which `nearest` is sure [µm]

  void clear();
};
inline constexpr std::uint16_t kAsleep = 0x8000;  ///< flag: the point is out of range
inline constexpr std::uint16_t kNoFace = 0x7FFF;  ///< no face is known

/// The same as a tissue stores it, between evaluations: each list in as many bytes as its largest number needs, all in one piece of memory.
/// What is good until when is rounded down to 1/4096 µm.
class PackedPoints {
 public:
  [[nodiscard]] bool empty() const { return source_count_ == 0; }
  [[nodiscard]] std::size_t source_count() const { return source_count_; }
  [[nodiscard]] std::size_t memory() const { return data_.capacity(); }

  void pack(const PointsAgainstBody& lists);
  /// All but the candidates.
  void unpack(PointsAgainstBody& lists) const;
  void unpack_candidates(PointsAgainstBody& lists) const;
  void unpack_source_faces(std::vector<std::uint32_t>& faces) const;
  /// Take over what has changed since unpack(): `nearest` and `good_until`.
  void update(const PointsAgainstBody& lists);

 private:
  /// Where a list is, and how many bytes each of its numbers has (1, 2 or 4).
  struct Part {
    std::uint32_t begin;
    std::uint32_t width;
  };
  [[nodiscard]] Part source_face() const { return {0, width_[0]}; }
  [[nodiscard]] Part target_face() const { return {source_count_ * width_[0], width_[1]}; }
  [[nodiscard]] Part candidates_of_face() const { return {target_face().begin + target_count_ * width_[1], width_[2]}; }
  [[nodiscard]] Part candidate() const { return {candidates_of_face().begin + source_count_ * width_[2], width_[3]}; }
  [[nodiscard]] Part nearest() const { return {candidate().begin + candidate_count_ * width_[3], width_[3]}; }
  [[nodiscard]] Part good_until() const { return {nearest().begin + point_count_ * width_[3], 2}; }

  std::vector<std::uint8_t> data_;
  std::uint32_t source_count_ = 0, target_count_ = 0, candidate_count_ = 0, point_count_ = 0;
  std::uint8_t width_[4] = {1, 1, 1, 1};
};

}  // namespace morula
