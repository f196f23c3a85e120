#include "core/contact/packed_points.h"

#include <gtest/gtest.h>

namespace morula {
namespace {

/// Lists of `sources` faces with three points each against `targets` faces whose numbers begin at `first_target`.
PointsAgainstBody some_lists(std::uint32_t sources, std::uint32_t targets, std::uint32_t first_target) {
  PointsAgainstBody lists;
  lists.clear();
  for (std::uint32_t m = 0; m < targets; ++m) lists.target_face.push_back(first_target + 3 * m);
  for (std::uint32_t k = 0; k < sources; ++k) {
    lists.source_face.push_back(2 * k + 1);
    for (std::uint32_t m = k % 7; m < targets; m += 5) lists.candidate.push_back(static_cast<std::uint16_t>(m));
    lists.first_candidate.push_back(static_cast<std::uint32_t>(lists.candidate.size()));
    for (std::uint32_t q = 0; q < 3; ++q) {
      const std::uint32_t place = (k + q) % (targets + 1);
      const std::uint16_t known = place == targets ? kNoFace : static_cast<std::uint16_t>(place);
      lists.nearest.push_back(static_cast<std::uint16_t>(q == 2 ? known | kAsleep : known));
      lists.good_until.push_back(0.001f * static_cast<float>(k) + 0.1f * static_cast<float>(q));
    }
  }
  return lists;
}

struct Size {
  std::uint32_t sources, targets, first_target;
  std::size_t bytes_per_candidate;
};

class EverySize : public testing::TestWithParam<Size> {};

TEST_P(EverySize, ComesBackAsItWasAndNothingIsSureForLonger) {
  const Size size = GetParam();
  const PointsAgainstBody lists = some_lists(size.sources, size.targets, size.first_target);
  PackedPoints packed;
  packed.pack(lists);
  EXPECT_EQ(packed.source_count(), size.sources);
  EXPECT_GE(packed.memory(), lists.candidate.size() * size.bytes_per_candidate);
  EXPECT_LE(packed.memory(),
            lists.candidate.size() * size.bytes_per_candidate + size.sources * std::size_t{22} + size.targets * std::size_t{4} + 4);
  PointsAgainstBody back;
  packed.unpack(back);
  packed.unpack_candidates(back);
  EXPECT_EQ(back.source_face, lists.source_face);
  EXPECT_EQ(back.target_face, lists.target_face);
  EXPECT_EQ(back.first_candidate, lists.first_candidate);
  EXPECT_EQ(back.candidate, lists.candidate);
  EXPECT_EQ(back.nearest, lists.nearest);
  for (std::size_t i = 0; i < lists.good_until.size(); ++i) {
    EXPECT_LE(back.good_until[i], lists.good_until[i]);
    EXPECT_GE(back.good_until[i], lists.good_until[i] - 1.01f / 4096.0f);
  }
}

INSTANTIATE_TEST_SUITE_P(PackedPoints, EverySize,
                         testing::Values(Size{30, 50, 0, 1}, Size{30, 127, 200, 1}, Size{30, 128, 0, 2}, Size{200, 300, 70000, 2}));

TEST(PackedPoints, TakesOverWhatAnEvaluationHasFound) {
  PointsAgainstBody lists = some_lists(20, 40, 0);
  PackedPoints packed;
  packed.pack(lists);
  lists.nearest[4] = 17;
  lists.nearest[5] = kNoFace | kAsleep;
  lists.good_until[4] = 1e9f;  // as far as can be noted
  lists.good_until[5] = -3.0f;
  packed.update(lists);
  PointsAgainstBody back;
  packed.unpack(back);
  EXPECT_EQ(back.nearest, lists.nearest);
  EXPECT_NEAR(back.good_until[4], 16.0f, 0.001f);
  EXPECT_EQ(back.good_until[5], 0.0f);
}

TEST(PackedPoints, OfNothingTakeNoMemory) {
  PackedPoints packed;
  packed.pack(some_lists(20, 40, 0));
  PointsAgainstBody nothing;
  nothing.clear();
  packed.pack(nothing);
  EXPECT_TRUE(packed.empty());
  EXPECT_EQ(packed.memory(), 0u);
  PointsAgainstBody back = some_lists(3, 4, 0);
  packed.unpack(back);
  EXPECT_TRUE(back.source_face.empty());
  EXPECT_TRUE(back.nearest.empty());
}

}  // namespace
}  // namespace morula
