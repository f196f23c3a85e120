#include "core/random/philox.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace morula {
namespace {

using Words = std::array<std::uint32_t, 4>;

// Known answers of the authors' library Random123 (Salmon et al. 2011), and two of our own independent computation.
TEST(Philox, GivesTheKnownAnswers) {
  EXPECT_EQ(philox4x32_10({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox4x32_10({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
            (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32_10({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
  EXPECT_EQ(philox4x32_10({1, 0, 0, 0}, {0, 0}), (Words{0xf8e4cca4, 0x5cb200db, 0xb1a574eb, 0x097eff67}));
  EXPECT_EQ(philox4x32_10({0, 0, 0, 0}, {0x2a, 7}), (Words{0x64d43a77, 0xff08a6bf, 0xff050829, 0x1e30fa6b}));
}

TEST(Philox, RunsAtCompileTime) {
  static_assert(philox4x32_10({0, 0, 0, 0}, {0, 0})[0] == 0x6627e8d5);
  static_assert(Random(42, static_cast<RandomStream>(7)).words(CellId(0), 0)[3] == 0x1e30fa6b);
}

TEST(Random, GivesTheReferenceUniformAndNormalPair) {
  const Random random(0x2a, static_cast<RandomStream>(7));
  const RandomPair u = random.uniform(CellId(0), 0);
  EXPECT_EQ(u.first, 0.9962257592458891);  // exact by construction
  EXPECT_EQ(u.second, 0.11793484818101174);
  const RandomPair n = random.normal(CellId(0), 0);
  EXPECT_NEAR(n.first, 0.0641612332, 1e-10);  // given to ten digits
  EXPECT_NEAR(n.second, 0.0587034794, 1e-10);
}

TEST(Random, CellAndIndexFillTheWholeCounter) {
  const Random random(5, RandomStream::kMigration);
  const Words expected =
      philox4x32_10({0x89abcdef, 0x01234567, 0x76543210, 0xfedcba98}, {5, static_cast<std::uint32_t>(RandomStream::kMigration)});
  EXPECT_EQ(random.words(CellId(0x0123456789abcdef), 0xfedcba9876543210), expected);
}

TEST(Random, UniformNumbersNeverReachZeroOrOne) {
  EXPECT_EQ(Random::to_unit(0, 0), 0x1p-53);
  EXPECT_EQ(Random::to_unit(0xffffffff, 0xffffffff), 1.0 - 0x1p-53);
}

TEST(Random, EveryPurposeSeedCellAndIndexHasItsOwnNumbers) {
  std::set<Words> seen;
  for (std::uint32_t seed = 0; seed < 3; ++seed)
    for (std::uint32_t stream = 1; stream <= 9; ++stream)
      for (std::uint64_t cell = 1; cell <= 5; ++cell)
        for (std::uint64_t index = 0; index < 7; ++index)
          seen.insert(Random(seed, static_cast<RandomStream>(stream)).words(CellId::founder(cell), index));
  EXPECT_EQ(seen.size(), 3u * 9u * 5u * 7u);
}

// Sample moments of N numbers lie within five standard errors: a correct generator fails this for no fixed seed but once in 10^6.
TEST(Random, NormalNumbersHaveTheMomentsOfTheStandardNormal) {
  const Random random(1, RandomStream::kMigration);
  constexpr int kPairs = 50000;
  double mean = 0.0, square = 0.0, product = 0.0;
  for (int i = 0; i < kPairs; ++i) {
    const RandomPair n = random.normal(CellId::founder(3), static_cast<std::uint64_t>(i));
    mean += n.first + n.second;
    square += n.first * n.first + n.second * n.second;
    product += n.first * n.second;
  }
  EXPECT_NEAR(mean / (2 * kPairs), 0.0, 5.0 / std::sqrt(2.0 * kPairs));
  EXPECT_NEAR(square / (2 * kPairs), 1.0, 5.0 * std::sqrt(2.0 / (2.0 * kPairs)));
  EXPECT_NEAR(product / kPairs, 0.0, 5.0 / std::sqrt(1.0 * kPairs));
}

TEST(Random, DirectionsAreUnitVectorsWithoutPreference) {
  const Random random(1, RandomStream::kDivisionAxis);
  constexpr int kCount = 20000;
  Vec3d mean{};
  double zz = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const Vec3d d = random.direction(CellId::founder(1), static_cast<std::uint64_t>(i));
    ASSERT_NEAR(norm2(d), 1.0, 1e-14);
    mean += d;
    zz += d.z * d.z;
  }
  const double error = 5.0 / std::sqrt(3.0 * kCount);  // the variance of each component is 1/3
  EXPECT_NEAR(mean.x / kCount, 0.0, error);
  EXPECT_NEAR(mean.y / kCount, 0.0, error);
  EXPECT_NEAR(mean.z / kCount, 0.0, error);
  EXPECT_NEAR(zz / kCount, 1.0 / 3.0, 5.0 * std::sqrt(4.0 / 45.0 / kCount));
}

}  // namespace
}  // namespace morula
