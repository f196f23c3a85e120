#include "coupling/behaviours/builtin.h"

#include <gtest/gtest.h>

#include <set>

namespace morula {
namespace {

TEST(BehaviourLaws, AreDescribedInFullWithFallbacksInRange) {
  std::set<std::string> names;
  for (const LawInfo& law : behaviour_laws()) {
    EXPECT_TRUE(names.insert(law.name).second) << law.name;
    EXPECT_FALSE(law.title.empty() || law.equation.empty() || law.source.empty()) << law.name;
    for (const LawParameter& parameter : law.parameters) {
      EXPECT_FALSE(parameter.name.empty() || parameter.quantity.empty() || parameter.unit.empty() || parameter.doc.empty()) << law.name;
      ASSERT_TRUE(parameter.fallback.has_value());
      EXPECT_GE(*parameter.fallback, parameter.minimum) << parameter.name;
      EXPECT_LE(*parameter.fallback, parameter.maximum) << parameter.name;
    }
  }
  EXPECT_TRUE(names.contains("osmosis"));
}

}  // namespace
}  // namespace morula
