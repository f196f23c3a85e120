#include "core/simd/transpose.h"

#include <gtest/gtest.h>

#include <vector>

namespace morula {
namespace {

template <int W, class T>
void expect_lanes_hold_each_source(std::size_t count) {
  std::array<std::vector<T>, W> source;
  std::array<const T*, W> read{};
  std::array<T*, W> write{};
  for (std::size_t lane = 0; lane < W; ++lane) {
    for (std::size_t i = 0; i < count; ++i) source[lane].push_back(static_cast<T>(1000 * lane + i));
    read[lane] = source[lane].data();
  }
  LaneVector<T> lanes(W * count + W, T(-1));
  load_lanes<W, T>(read, count, lanes.data());
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t lane = 0; lane < W; ++lane) ASSERT_EQ(lanes[i * W + lane], static_cast<T>(1000 * lane + i)) << "W " << W << " i " << i;
  for (std::size_t i = W * count; i < lanes.size(); ++i) ASSERT_EQ(lanes[i], T(-1)) << "written beyond the end";

  std::array<std::vector<T>, W> target;
  for (std::size_t lane = 0; lane < W; ++lane) {
    target[lane].assign(count + 1, T(-1));
    write[lane] = target[lane].data();
  }
  store_lanes<W, T>(lanes.data(), count, write);
  for (std::size_t lane = 0; lane < W; ++lane) {
    ASSERT_EQ(target[lane].back(), T(-1)) << "written beyond the end";
    target[lane].pop_back();
    ASSERT_EQ(target[lane], source[lane]);
  }
}

TEST(Transpose, LanesHoldEachSourceAndComeBack) {
  for (const std::size_t count : {0u, 1u, 3u, 4u, 7u, 8u, 16u, 42u, 163u}) {
    expect_lanes_hold_each_source<1, double>(count);
    expect_lanes_hold_each_source<4, double>(count);
    expect_lanes_hold_each_source<8, double>(count);
    expect_lanes_hold_each_source<4, float>(count);
    expect_lanes_hold_each_source<8, float>(count);
    expect_lanes_hold_each_source<16, float>(count);
  }
}

}  // namespace
}  // namespace morula
