#include "scenarios/study/explain_law.h"

#include <gmock/gmock.h>

namespace morula::scenarios {
namespace {

TEST(ExplainLaw, KnowsEveryLawAndItsSource) {
  EXPECT_THAT(law_names(), testing::Contains("jkr"));
  for (const std::string& name : law_names()) EXPECT_THAT(explain_law(name).value_or(""), testing::HasSubstr("source: ")) << name;
  EXPECT_THAT(explain_law("jkr").value_or(""), testing::HasSubstr("Johnson"));
  EXPECT_FALSE(explain_law("no_such_law"));
}

}  // namespace
}  // namespace morula::scenarios
