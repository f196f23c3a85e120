#include "results/exchanges.h"

#include <gtest/gtest.h>

namespace morula::scenarios {
namespace {

EventLine at(double time, const char* kind, const char* cell) {
  EventLine out;
  out.time = time, out.kind = kind, out.cell = cell;
  return out;
}

TEST(Exchanges, OfACellFollowEachOther) {
  const std::vector<EventLine> events{at(10, "promotion", "1"), at(20, "promotion", "2"), at(30, "division", "1"),
                                      at(70, "demotion", "1"),  at(90, "warning", "2"),   at(95, "promotion", "1")};
  const std::vector<EventLine> exchanges = exchanges_of(events);
  ASSERT_EQ(exchanges.size(), 4u);
  EXPECT_EQ(exchanges[2].kind, "demotion");
  EXPECT_EQ(times_between_exchanges(exchanges), (std::vector<double>{60.0, 25.0}));
  EXPECT_TRUE(times_between_exchanges(std::span(exchanges).first(2)).empty());
}

}  // namespace
}  // namespace morula::scenarios
