#include "cbm/crowded_area.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace morula::cbm {
namespace {

TEST(CrowdedArea, IsStraightBetweenItsKnotsAndKeepsTheirRatiosBeyond) {
  const std::vector<CrowdedKnot> knots{{0.1, 0.1}, {0.5, 0.8}, {0.7, 0.7}};
  const auto curve = CrowdedArea::through(knots);
  ASSERT_TRUE(curve.ok());
  EXPECT_EQ(curve->at(0.0), 0.0);
  EXPECT_DOUBLE_EQ(curve->at(0.05), 0.05);
  EXPECT_DOUBLE_EQ(curve->at(0.1), 0.1);
  EXPECT_DOUBLE_EQ(curve->at(0.3), 0.45);
  EXPECT_DOUBLE_EQ(curve->at(0.5), 0.8);
  EXPECT_DOUBLE_EQ(curve->at(0.65), 0.725);
  EXPECT_DOUBLE_EQ(curve->at(1.4), 1.4);
  const auto one = CrowdedArea::through(std::vector<CrowdedKnot>{{0.5, 0.6}});
  ASSERT_TRUE(one.ok());
  EXPECT_DOUBLE_EQ(one->at(0.25), 0.3);
  EXPECT_DOUBLE_EQ(one->at(1.0), 1.2);
}

TEST(CrowdedArea, WithoutKnotsIsThatOfPairs) {
  EXPECT_TRUE(CrowdedArea().empty());
  EXPECT_EQ(CrowdedArea().at(0.37), 0.37);
}

TEST(CrowdedArea, SaysWhatKnotsItCannotTake) {
  const auto message = [](const std::vector<CrowdedKnot>& knots) {
    const auto curve = CrowdedArea::through(knots);
    return curve.ok() ? std::string() : curve.error().message;
  };
  constexpr double kNot = std::numeric_limits<double>::quiet_NaN(), kInfinite = std::numeric_limits<double>::infinity();
  EXPECT_NE(message({}).find("at least one knot"), std::string::npos);
  EXPECT_NE(message({{0.0, 0.1}}).find("must be above 0 and increase"), std::string::npos);
  EXPECT_NE(message({{0.2, 0.2}, {0.2, 0.3}}).find("from 0.2 to 0.2"), std::string::npos);
  EXPECT_NE(message({{0.2, -0.1}}).find("must not be negative"), std::string::npos);
  for (const double wrong : {kNot, kInfinite}) {
    EXPECT_FALSE(message({{wrong, 0.2}}).empty()) << wrong;
    EXPECT_FALSE(message({{0.1, wrong}}).empty()) << wrong;
  }
}

}  // namespace
}  // namespace morula::cbm
