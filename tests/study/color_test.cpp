// The colour of a cell type: read, kept in the resolved study, refused where it is none.
#include <gtest/gtest.h>

#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

std::string with_color(const std::string& text) {
  return test::changed("    radius: {mean: 6 um, spread: 10 %}\n", "    radius: {mean: 6 um, spread: 10 %}\n    color: " + text + "\n");
}

TEST(StudyColor, IsOfThePaletteOrSixDigitsAndSurvivesTheResolvedStudy) {
  for (const std::string color : {"vermilion", "#d55e00"}) {
    const auto study = test::read(with_color(color[0] == '#' ? '"' + color + '"' : color));
    ASSERT_TRUE(study.ok()) << study.error().text();
    EXPECT_EQ(study->type_colors, std::vector<std::string>{color});
    const auto again = test::read(study->resolved_text);
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_EQ(again->type_colors, study->type_colors);
  }
  const auto plain = test::read(test::kGoodStudy);
  ASSERT_TRUE(plain.ok());
  EXPECT_EQ(plain->type_colors, std::vector<std::string>{""}) << "of the palette";
}

TEST(StudyColor, WhatIsNoColourIsRefusedWithASuggestion) {
  const std::string near = test::errors_of(with_color("vermillion"));
  EXPECT_NE(near.find("E680"), std::string::npos) << near;
  EXPECT_NE(near.find("vermilion"), std::string::npos) << near;
  EXPECT_NE(test::errors_of(with_color("\"#12345\"")).find("E680"), std::string::npos);
}

}  // namespace
}  // namespace morula::scenarios
