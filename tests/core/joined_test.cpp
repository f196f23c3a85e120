#include <gtest/gtest.h>

#include <ranges>
#include <string>
#include <vector>

#include "core/numbers/joined.h"

namespace morula {
namespace {

TEST(Joined, PutsCommasBetween) {
  EXPECT_EQ(joined(std::vector<std::string>{}), "");
  EXPECT_EQ(joined(std::vector<std::string>{"a"}), "a");
  EXPECT_EQ(joined(std::vector<std::string>{"", "b", ""}), ", b, ") << "empty texts count";
  struct Named {
    std::string name;
  };
  EXPECT_EQ(joined(std::vector<Named>{{"a"}, {"b"}}, &Named::name, "; "), "a; b");
  auto odd = std::vector<int>{1, 2, 3} | std::views::filter([](int i) { return i % 2 == 1; });
  EXPECT_EQ(joined(odd, [](int i) { return std::to_string(i); }), "1, 3");
}

}  // namespace
}  // namespace morula
