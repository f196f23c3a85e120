#include "core/contact/packed_points.h"

#include <algorithm>
#include <cstring>

namespace morula {
namespace {

constexpr float kUnitsOfGood = 4096.0f;  // per µm

std::uint8_t width_of(std::uint32_t largest) { return largest < 0x100 ? 1 : largest < 0x10000 ? 2 : 4; }

std::uint32_t largest_of(const std::vector<std::uint32_t>& numbers) {
  return numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end());
}

/// Numbers of `Packed` at `at`, one after the other without alignment.
template <class Packed, class Number, class Convert>
void write_as(std::uint8_t* at, const std::vector<Number>& numbers, const Convert& convert) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Packed packed = static_cast<Packed>(convert(numbers[i]));
    std::memcpy(at + i * sizeof packed, &packed, sizeof packed);
  }
}
template <class Packed, class Number, class Convert>
void read_as(const std::uint8_t* at, std::size_t count, std::vector<Number>& numbers, const Convert& convert) {
  numbers.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    Packed packed;
    std::memcpy(&packed, at + i * sizeof packed, sizeof packed);
    numbers[i] = static_cast<Number>(convert(packed));
  }
}

constexpr auto kAsIs = [](auto number) { return number; };

template <class Number>
void write(std::uint8_t* at, std::uint32_t width, const std::vector<Number>& numbers) {
  if (width == 1) return write_as<std::uint8_t>(at, numbers, kAsIs);
  if (width == 2) return write_as<std::uint16_t>(at, numbers, kAsIs);
  write_as<std::uint32_t>(at, numbers, kAsIs);
}
template <class Number>
void read(const std::uint8_t* at, std::uint32_t width, std::size_t count, std::vector<Number>& numbers) {
  if (width == 1) return read_as<std::uint8_t>(at, count, numbers, kAsIs);
  if (width == 2) return read_as<std::uint16_t>(at, count, numbers, kAsIs);
  read_as<std::uint32_t>(at, count, numbers, kAsIs);
}

/// Nearest faces in a byte: the flag and the mark of no face go along.
constexpr std::uint32_t kNoFaceInByte = 0x7F, kAsleepInByte = 0x80;
constexpr auto kToByte = [](std::uint16_t known) {
  return std::min<std::uint32_t>(known & kNoFace, kNoFaceInByte) | (known & kAsleep ? kAsleepInByte : 0u);
};
constexpr auto kFromByte = [](std::uint8_t known) {
  const std::uint32_t place = known & kNoFaceInByte;
  return (place == kNoFaceInByte ? kNoFace : place) | (known & kAsleepInByte ? kAsleep : 0u);
};
constexpr auto kRoundedDown = [](float until) {
  return std::min(65535.0f, std::max(0.0f, until * (kUnitsOfGood * (1.0f - 1e-6f))));  // truncated when it becomes an integer
};

}  // namespace

void PointsAgainstBody::clear() {
  source_face.clear(), target_face.clear(), first_candidate.assign(1, 0);
  candidate.clear(), nearest.clear(), good_until.clear();
}

void PackedPoints::pack(const PointsAgainstBody& lists) {
  source_count_ = static_cast<std::uint32_t>(lists.source_face.size());
  target_count_ = static_cast<std::uint32_t>(lists.target_face.size());
  candidate_count_ = static_cast<std::uint32_t>(lists.candidate.size());
  point_count_ = static_cast<std::uint32_t>(lists.nearest.size());
  width_[0] = width_of(largest_of(lists.source_face));
  width_[1] = width_of(largest_of(lists.target_face));
  std::vector<std::uint32_t> candidates(source_count_);
  for (std::uint32_t k = 0; k < source_count_; ++k) candidates[k] = lists.first_candidate[k + 1] - lists.first_candidate[k];
  width_[2] = width_of(largest_of(candidates));
  width_[3] = target_count_ <= kNoFaceInByte ? 1 : 2;
  const std::size_t size = source_count_ == 0 ? 0 : good_until().begin + std::size_t{2} * point_count_;
  if (data_.capacity() != size) data_ = std::vector<std::uint8_t>(size);  // no more room than needed: it lives long
  data_.resize(size);
  if (size == 0) return;
  write(data_.data() + source_face().begin, width_[0], lists.source_face);
  write(data_.data() + target_face().begin, width_[1], lists.target_face);
  write(data_.data() + candidates_of_face().begin, width_[2], candidates);
  write(data_.data() + candidate().begin, width_[3], lists.candidate);
  update(lists);
}

void PackedPoints::update(const PointsAgainstBody& lists) {
  if (empty()) return;
  if (width_[3] == 1)
    write_as<std::uint8_t>(data_.data() + nearest().begin, lists.nearest, kToByte);
  else
    write_as<std::uint16_t>(data_.data() + nearest().begin, lists.nearest, kAsIs);
  write_as<std::uint16_t>(data_.data() + good_until().begin, lists.good_until, kRoundedDown);
}

void PackedPoints::unpack(PointsAgainstBody& lists) const {
  if (empty()) return lists.clear();
  unpack_source_faces(lists.source_face);
  read(data_.data() + target_face().begin, width_[1], target_count_, lists.target_face);
  if (width_[3] == 1)
    read_as<std::uint8_t>(data_.data() + nearest().begin, point_count_, lists.nearest, kFromByte);
  else
    read_as<std::uint16_t>(data_.data() + nearest().begin, point_count_, lists.nearest, kAsIs);
  read_as<std::uint16_t>(data_.data() + good_until().begin, point_count_, lists.good_until,
                         [](std::uint16_t units) { return static_cast<float>(units) * (1.0f / kUnitsOfGood); });
}

void PackedPoints::unpack_candidates(PointsAgainstBody& lists) const {
  if (empty()) return;
  std::vector<std::uint32_t>& first = lists.first_candidate;
  read(data_.data() + candidates_of_face().begin, width_[2], source_count_, first);
  first.insert(first.begin(), 0);
  for (std::uint32_t k = 0; k < source_count_; ++k) first[k + 1] += first[k];
  read(data_.data() + candidate().begin, width_[3], candidate_count_, lists.candidate);
}

void PackedPoints::unpack_source_faces(std::vector<std::uint32_t>& faces) const {
  read(data_.data() + source_face().begin, width_[0], source_count_, faces);
}

}  // namespace morula
