#include <gtest/gtest.h>

#include "tests/system/calibrate_on_ranks.h"

namespace morula::test {
namespace {

/// Two pairs at two rates. With a packing, too: calibrate_slow_test.cpp.
TEST(CalibrateOnRanks, WritesTheSameFileOnRanksAndThreadsAndAfterASigkill) { expect_same_file_on_ranks("3 s"); }

}  // namespace
}  // namespace morula::test
