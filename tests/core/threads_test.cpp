#include "core/parallel/threads.h"

#include <gtest/gtest.h>

#include <mutex>
#include <numeric>
#include <set>
#include <vector>

namespace morula {
namespace {

class Threads : public testing::TestWithParam<int> {};

TEST_P(Threads, GiveEachNumberToOneCall) {
  for (const std::size_t count : {0u, 1u, 2u, 1000u}) {
    std::vector<int> calls(count, 0);
    parallel_for(GetParam(), count, [&](std::size_t k) { ++calls[k]; });
    EXPECT_EQ(std::accumulate(calls.begin(), calls.end(), 0), static_cast<int>(count));
    for (const int n : calls) EXPECT_EQ(n, 1);
  }
}

TEST_P(Threads, ShareNoWorkspace) {
  struct Workspace {
    int in_use = 0;
  };
  std::vector<int> most(500, 0);
  parallel_for_with<Workspace>(GetParam(), most.size(), [&](std::size_t k, Workspace& workspace) {
    ++workspace.in_use;
    most[k] = workspace.in_use;
    --workspace.in_use;
  });
  for (const int n : most) EXPECT_EQ(n, 1);
}

TEST_P(Threads, AreCalledOnceEach) {
  std::mutex mutex;
  std::multiset<std::size_t> called;
  on_each_thread(GetParam(), [&](std::size_t t) {
    const std::lock_guard lock(mutex);
    called.insert(t);
  });
  EXPECT_EQ(called.size(), static_cast<std::size_t>(GetParam()));
  for (std::size_t t = 0; t < called.size(); ++t) EXPECT_EQ(called.count(t), 1u) << t;
}

TEST_P(Threads, EmptyAQueueWithoutRepeats) {
  std::vector<int> calls(103, 0);
  WorkQueue queue(calls.size(), 8);  // the last portion is not a whole one
  on_each_thread(GetParam(), [&](std::size_t) { queue.work_off([&](std::size_t k) { ++calls[k]; }); });
  for (const int n : calls) EXPECT_EQ(n, 1);
}

TEST_P(Threads, FindTheLargest) {
  const auto at = [](std::size_t k) { return k == 617 ? 5.0 : 1.0 / static_cast<double>(k + 1); };
  EXPECT_EQ(parallel_max(GetParam(), 1000, at), 5.0);
  EXPECT_EQ(parallel_max(GetParam(), 0, at), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Counts, Threads, testing::Values(1, 2, 5), testing::PrintToStringParamName());

}  // namespace
}  // namespace morula
