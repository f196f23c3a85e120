#include "core/simd/lane.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/vec3.h"

namespace morula {
namespace {

/// Something of every operation, as a law would be written; the area-weighted angle of two edges, with a branch.
template <class Real>
Real some_law(Real x, Real y, Real z) {
  const Vec3<Real> a{x, y, z};
  const Vec3<Real> b{y, -z, x};
  const Vec3<Real> c = cross(a, b) * Real(0.5) - a / (norm2(b) + Real(1.0));
  const Real area = sqrt(norm2(c));
  const Real gap = max(min(x, y), -z) + abs(z);
  Real out = select(gap > area, gap * area, dot(a, c));
  out += select(x <= Real(0.0), Real(1.0) / (Real(2.0) + abs(x)), x);
  out -= y;
  out *= Real(1.25);
  return out;
}

template <class T>
std::vector<T> numbers(int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<T> out;
  for (int i = 0; i < count; ++i) out.push_back(static_cast<T>(std::ldexp(static_cast<double>(random() >> 11), -53) * 8.0 - 4.0));
  out[0] = T(0);
  out[1] = -T(0);
  out[2] = std::numeric_limits<T>::denorm_min();
  out[3] = std::numeric_limits<T>::max();
  return out;
}

template <class T, int W>
std::vector<T> in_lanes(const std::vector<T>& x, const std::vector<T>& y, const std::vector<T>& z) {
  std::vector<T> out(x.size());
  for (std::size_t i = 0; i < x.size(); i += W)
    some_law(Lane<T, W>::load(&x[i]), Lane<T, W>::load(&y[i]), Lane<T, W>::load(&z[i])).store(&out[i]);
  return out;
}

/// Bits, but all NaNs alike: which payload survives is not specified.
template <class T>
void expect_same(const std::vector<T>& a, const std::vector<T>& b) {
  using Bits = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) && std::isnan(b[i])) continue;
    ASSERT_EQ(std::bit_cast<Bits>(a[i]), std::bit_cast<Bits>(b[i])) << "element " << i;
  }
}

TEST(Lane, OneFourEightAndSixteenLanesGiveTheBitsOfPlainDoubles) {
  const auto x = numbers<double>(512, 1), y = numbers<double>(512, 2), z = numbers<double>(512, 3);
  std::vector<double> plain(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) plain[i] = some_law(x[i], y[i], z[i]);
  expect_same(in_lanes<double, 1>(x, y, z), plain);
  expect_same(in_lanes<double, 4>(x, y, z), plain);
  expect_same(in_lanes<double, 8>(x, y, z), plain);
  expect_same(in_lanes<double, 16>(x, y, z), plain);
}

TEST(Lane, FloatsGiveTheSameBitsOnAnyWidth) {
  const auto x = numbers<float>(512, 4), y = numbers<float>(512, 5), z = numbers<float>(512, 6);
  const auto one = in_lanes<float, 1>(x, y, z);
  expect_same(in_lanes<float, 4>(x, y, z), one);
  expect_same(in_lanes<float, 8>(x, y, z), one);
  expect_same(in_lanes<float, 16>(x, y, z), one);
}

TEST(Lane, SquareRootIsCorrectlyRoundedInEachLane) {
  const auto x = numbers<double>(64, 7);
  for (std::size_t i = 0; i < x.size(); i += 8) {
    const auto root = sqrt(abs(Lane<double, 8>::load(&x[i])));
    for (int lane = 0; lane < 8; ++lane) EXPECT_EQ(root[lane], std::sqrt(std::abs(x[i + static_cast<std::size_t>(lane)])));
  }
  EXPECT_TRUE(std::isnan(sqrt(Lane<double, 4>(-1.0))[2]));
}

TEST(Lane, SelectTakesEachLaneForItself) {
  Lane<double, 4> a(1.0), b(2.0), key(0.0);
  key.set(1, 5.0);
  key.set(3, 6.0);
  const auto chosen = select(key > Lane<double, 4>(3.0), a, b);
  EXPECT_EQ(chosen[0], 2.0);
  EXPECT_EQ(chosen[1], 1.0);
  EXPECT_EQ(chosen[2], 2.0);
  EXPECT_EQ(chosen[3], 1.0);
  EXPECT_EQ(select(true, 1.0, 2.0), 1.0);
}

TEST(Lane, NotANumberInOneLaneStaysThere) {
  Lane<double, 8> a(4.0);
  a.set(5, std::nan(""));
  const auto out = sqrt(a) * a + a;
  for (int lane = 0; lane < 8; ++lane) EXPECT_EQ(std::isnan(out[lane]), lane == 5);
}

TEST(Lane, ANumberIsALaneOfEqualNumbersSignIncluded) {
  const Lane<double, 8> negative_zero(-0.0);
  for (int lane = 0; lane < 8; ++lane) EXPECT_TRUE(std::signbit(negative_zero[lane]));
}

}  // namespace
}  // namespace morula
