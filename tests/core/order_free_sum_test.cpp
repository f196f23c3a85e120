#include "core/parallel/order_free_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

namespace morula {
namespace {

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Wide;  // 113 bits
#else
using Wide = long double;
#endif

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

double sum(std::span<const double> terms) {
  OrderFreeSum out;
  for (const double term : terms) out.add(term);
  return out.value();
}
double sum(std::initializer_list<double> terms) { return sum(std::span(terms.begin(), terms.size())); }

constexpr double kMax = std::numeric_limits<double>::max();
constexpr double kTiny = std::numeric_limits<double>::denorm_min();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// Numbers of both signs over a range of exponents.
std::vector<double> random_terms(std::mt19937_64& random, int count, int low_exponent, int high_exponent) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) {
    const double mantissa = 1.0 + std::ldexp(static_cast<double>(random() >> 12), -52);
    const int range = high_exponent - low_exponent + 1;
    const int exponent = low_exponent + static_cast<int>(random() % static_cast<unsigned>(range));
    out.push_back(std::ldexp((random() & 1) ? mantissa : -mantissa, exponent));
  }
  return out;
}

TEST(OrderFreeSum, OneTermComesBackUnchanged) {
  for (const double x : {1.0, -1.0, 0.1, 1e-300, kMax, -kMax, kTiny, -kTiny, 0x1p-1022, 0x1.fffffffffffffp-1023, 3e-310, 12345.678})
    EXPECT_EQ(bits(sum({x})), bits(x)) << x;
}

TEST(OrderFreeSum, EveryPowerOfTwoComesBackUnchanged) {
  for (int exponent = -1074; exponent <= 1023; ++exponent) {
    EXPECT_EQ(sum({std::ldexp(1.0, exponent)}), std::ldexp(1.0, exponent));
    if (exponent <= -1023) continue;
    const double full = std::ldexp(0x1.fffffffffffffp0, exponent);
    EXPECT_EQ(sum({-full}), -full);
  }
}

TEST(OrderFreeSum, CancelsExactly) {
  EXPECT_EQ(sum({1e100, 1.0, -1e100}), 1.0);
  EXPECT_EQ(sum({1e16, 1.0, -1e16, 1e-20}), 1.0 + 1e-20);
  EXPECT_EQ(sum({kMax, kMax, -kMax, -kMax, kTiny}), kTiny);
  EXPECT_EQ(bits(sum({1.5, -1.5})), bits(0.0));
  EXPECT_EQ(bits(sum({-0.0, -0.0})), bits(0.0));
  EXPECT_EQ(bits(OrderFreeSum{}.value()), bits(0.0));
  EXPECT_EQ(sum({0.1, 0.2, -0.3}), 0x1p-55);  // of the three doubles, exactly
}

TEST(OrderFreeSum, RoundsToNearestTiesToEven) {
  EXPECT_EQ(sum({0x1p53, 1.0}), 0x1p53);
  EXPECT_EQ(sum({0x1p53, 1.0, kTiny}), 0x1p53 + 2.0);
  EXPECT_EQ(sum({0x1p53, 1.0, -kTiny}), 0x1p53);
  EXPECT_EQ(sum({0x1p53, 2.0, 1.0}), 0x1p53 + 4.0);
  EXPECT_EQ(sum({0x1p53, 2.0, 1.0, -0x1p-500}), 0x1p53 + 2.0);
  EXPECT_EQ(sum({-0x1p53, -1.0}), -0x1p53);
  EXPECT_EQ(sum({-0x1p53, -1.0, -kTiny}), -0x1p53 - 2.0);
  EXPECT_EQ(sum({0x1.fffffffffffffp0, 0x1p-53}), 2.0);  // carries into the next power of two
}

TEST(OrderFreeSum, IsExactAmongDenormals) {
  EXPECT_EQ(sum({kTiny, kTiny, kTiny}), 3 * kTiny);
  EXPECT_EQ(sum({0x1p-1022, -kTiny}), 0x1p-1022 - kTiny);
  EXPECT_EQ(sum({0x1.fffffffffffffp-1022, kTiny}), 0x1p-1021);
  EXPECT_EQ(sum({0x1.fffffffffffffp-1022, kTiny, 0x1p-1021, kTiny}), 0x1p-1020);  // tie to even
}

TEST(OrderFreeSum, OverflowsOnlyInTheEnd) {
  EXPECT_EQ(sum({kMax, kMax}), kInf);
  EXPECT_EQ(sum({-kMax, -kMax}), -kInf);
  EXPECT_EQ(sum({kMax, 0x1p969}), kMax);  // less than half a unit in the last place
  EXPECT_EQ(sum({kMax, 0x1p970}), kInf);  // half: ties to even, which is beyond
  EXPECT_EQ(sum({kMax, 0x1p970, -kTiny}), kMax);
}

TEST(OrderFreeSum, NotANumberAndInfinityPoisonTheSum) {
  EXPECT_TRUE(std::isnan(sum({1.0, std::nan("")})));
  EXPECT_TRUE(std::isnan(sum({kInf, 1.0})));
  EXPECT_TRUE(std::isnan(sum({kInf, -kInf})));
  OrderFreeSum poisoned, total;
  poisoned.add(kInf);
  total.add(1.0);
  total += poisoned;
  EXPECT_TRUE(std::isnan(total.value()));
  EXPECT_TRUE(std::isnan(OrderFreeSum::from_words(total.words()).value()));
}

TEST(OrderFreeSum, AgreesWithASumInQuadruplePrecision) {
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 2000; ++trial) {
    // 53 bits + 40 exponents + 64 terms need 100 bits: the wide sum is exact, and its conversion the only rounding
    const int low = static_cast<int>(random() % 200) - 100;
    const auto terms = random_terms(random, 1 + static_cast<int>(random() % 64), low, low + (sizeof(Wide) == 16 ? 40 : 4));
    Wide wide = 0;
    for (const double term : terms) wide += term;
    ASSERT_EQ(bits(sum(terms)), bits(static_cast<double>(wide))) << trial;
  }
}

TEST(OrderFreeSum, DoesNotDependOnTheOrderNorOnTheSplit) {
  std::mt19937_64 random(3);
  auto terms = random_terms(random, 1000, -600, 600);
  const auto more = random_terms(random, 1000, -4, 4);
  terms.insert(terms.end(), more.begin(), more.end());
  for (std::size_t i = 0; i < 500; ++i) terms.push_back(-terms[i]);
  const double expected = sum(terms);
  for (int trial = 0; trial < 20; ++trial) {
    std::shuffle(terms.begin(), terms.end(), random);
    ASSERT_EQ(bits(sum(terms)), bits(expected));
    std::vector<OrderFreeSum> parts(1 + random() % 7);
    for (const double term : terms) parts[random() % parts.size()].add(term);
    OrderFreeSum added;
    std::array<std::int64_t, OrderFreeSum::kWords> words{};
    for (OrderFreeSum& part : parts) {
      const auto other = part.words();
      for (std::size_t i = 0; i < words.size(); ++i) words[i] += other[i];  // what MPI_SUM does
      if (random() & 1) part.carry();
      added += part;
    }
    ASSERT_EQ(bits(added.value()), bits(expected));
    ASSERT_EQ(bits(OrderFreeSum::from_words(words).value()), bits(expected));
  }
}

TEST(OrderFreeSum, WordsComeBackAsTheSameSum) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 50; ++trial) {
    OrderFreeSum one;
    for (const double term : random_terms(random, 50, -1000, 1000)) one.add(term);
    OrderFreeSum two = OrderFreeSum::from_words(one.words());
    EXPECT_EQ(bits(one.value()), bits(two.value()));
    EXPECT_EQ(one.words(), two.words());
    one.add(0.3);
    two.add(0.3);
    EXPECT_EQ(bits(one.value()), bits(two.value()));
  }
}

TEST(OrderFreeSum, ManyLikeTermsAreExact) {
  OrderFreeSum sum_of_tenths;
  constexpr int kCount = 1 << 20;
  for (int i = 0; i < kCount; ++i) sum_of_tenths.add(-0.1);
  EXPECT_EQ(sum_of_tenths.value(), -0.1 * kCount);  // a power of two times: exact
}

}  // namespace
}  // namespace morula
