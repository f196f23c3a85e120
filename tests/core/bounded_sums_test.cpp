#include "core/parallel/bounded_sums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace morula {
namespace {

using Sums = BoundedSums<2>;

std::vector<Sums::Terms> terms() {
  std::mt19937 random(11);
  std::normal_distribution<double> any(0.0, 1.0);
  std::vector<Sums::Terms> out;
  for (int i = 0; i < 100000; ++i) out.push_back({std::clamp(any(random), -3.0, 3.0), 1e-7 * std::abs(std::clamp(any(random), -3.0, 3.0))});
  return out;
}

Sums::Terms sum_of(const std::vector<Sums::Terms>& terms, std::size_t parts) {
  std::vector<Sums> sums(parts, Sums({3.0, 3e-7}));
  for (std::size_t i = 0; i < terms.size(); ++i) sums[i % parts].add(terms[i]);
  for (std::size_t p = 1; p < parts; ++p) sums[0] += sums[p];
  return sums[0].totals(Comm());
}

TEST(BoundedSums, AreTheSameInAnyOrderAndInAnyParts) {
  std::vector<Sums::Terms> all = terms();
  const Sums::Terms expected = sum_of(all, 1);
  for (const std::size_t parts : {1u, 2u, 7u}) {
    std::shuffle(all.begin(), all.end(), std::mt19937(static_cast<unsigned>(parts)));
    EXPECT_EQ(sum_of(all, parts), expected);
  }
}

/// A term is off by half a unit at most, which is 2⁻³⁵ of the bound or less, to both sides alike.
TEST(BoundedSums, AreRightToAFewUnitsOfTheRootOfTheirNumber) {
  const std::vector<Sums::Terms> all = terms();
  long double first = 0.0, second = 0.0;
  for (const Sums::Terms& t : all) first += t[0], second += t[1];
  const Sums::Terms found = sum_of(all, 3);
  const double unit = std::exp2(-35) * std::sqrt(static_cast<double>(all.size()));
  EXPECT_NEAR(found[0], static_cast<double>(first), 3.0 * 3.0 * unit);
  EXPECT_NEAR(found[1], static_cast<double>(second), 3.0 * 3e-7 * unit);
}

TEST(BoundedSums, OfWhatHasNoBoundAreZero) {
  for (const double most : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    BoundedSums<1> sums({most});
    sums.add({most});
    EXPECT_EQ(sums.totals(Comm())[0], 0.0);
  }
}

TEST(BoundedSums, HoldAsManyOfTheLargestAsTheySay) {
  BoundedSums<1> sums({0.999});
  sums.add({0.999});
  for (int doubled = 0; doubled < 27; ++doubled) sums += sums;
  EXPECT_NEAR(sums.totals(Comm())[0], 0.999 * std::exp2(27), 0.01);
}

}  // namespace
}  // namespace morula
