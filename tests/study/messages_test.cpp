#include <gmock/gmock.h>

#include "study/error_codes.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {
namespace {

using testing::HasSubstr;
using testing::Not;

// Each of these stands in the user's guide: file, place, text, code, and help are a promise.
TEST(StudyMessages, UnknownKeyIsShownAsACompilerWould) {
  const std::string text = changed("young: 1 kPa, thickness: 200 nm, poisson: 0.5, tension: 0.2 mN/m", "yuong: 1 kPa, thickness: 200 nm");
  EXPECT_EQ(errors_of(text),
            "study.yaml:19:16: error: unknown key 'yuong' in `cell_types.hepatocyte.dcm.cortex` [E101]\n"
            "   19 |       cortex: {yuong: 1 kPa, thickness: 200 nm}\n"
            "      |                ^~~~~\n"
            "      = help: did you mean `young`?\n");
}

TEST(StudyMessages, UnitOfAnotherQuantityIsNamed) {
  const std::string message = errors_of(changed("bulk_modulus: 2.5 kPa", "bulk_modulus: 2.5 mJ/m^2"));
  EXPECT_THAT(message,
              HasSubstr("study.yaml:20:21: error: 'bulk_modulus' is a pressure, but 'mJ/m^2' is a surface energy or tension [E203]\n"));
  EXPECT_THAT(message, HasSubstr("      = help: for example `2.5 kPa`\n"));
}

TEST(StudyMessages, ThresholdsThatFlipAreRefused) {
  const std::string message = errors_of(changed("demote: pressure < 600 Pa", "demote: pressure < 1.2 kPa"));
  EXPECT_THAT(message,
              HasSubstr("study.yaml:32:43: error: cells would flip back and forth: the demote threshold (1.2 kPa) is not below the promote "
                        "threshold (1 kPa) [E501]\n"));
  EXPECT_THAT(message, HasSubstr("      = help: set demote below promote, for example `pressure < 600 Pa`\n"));
}

TEST(StudyMessages, AllErrorsComeAtOnceInTheOrderOfTheFile) {
  std::string text = changed("seed: 20261121", "sead: 20261121");
  text = changed("mean: 6 um", "mean: 6", text);
  text = changed("thickness: 200 nm", "thickness: -200 nm", text);
  text = changed("uptake: {hepatocyte", "uptake: {hepatocite", text);
  text = changed("600 Pa", "2 kPa", text);
  const auto study = read(text);
  ASSERT_FALSE(study.ok());
  std::vector<int> codes;
  for (const Diagnostic& d : study.error().list()) codes.push_back(d.code);
  EXPECT_THAT(codes, testing::ElementsAre(101, 201, 302, 401, 501)) << study.error().text();
}

TEST(StudyMessages, FarWordsGetTheListOfWhatIsAllowed) {
  const std::string message = errors_of(changed("law: jkr", "law: lennard_jones"));
  EXPECT_THAT(message, HasSubstr("'law' cannot be 'lennard_jones' [E108]"));
  EXPECT_THAT(message, HasSubstr("= help: allowed: jkr, hertz"));
}

TEST(StudyMessages, ColumnsCountCharactersNotBytes) {
  const std::string message =
      errors_of(changed("title: Spheroid of centre-based cells with a deformable core\nseed: 20261121", "title: {müß: 1, yy: 2}\nseed: 1"));
  EXPECT_THAT(message, HasSubstr("study.yaml:3:8: error: 'title' must be a single value, but here is a map [E104]"));
  const std::string unit = errors_of(changed("{mean: 6 um, spread: 10 %}", "{mean: 6 µm, spraed: 10 %}"));
  EXPECT_THAT(unit, HasSubstr("study.yaml:9:26: error: unknown key 'spraed'"));
  EXPECT_THAT(unit, HasSubstr("\n      |                          ^~~~~~\n"));
}

TEST(StudyMessages, ColourAppearsOnlyWhenAskedFor) {
  const auto study = read(changed("seed: 20261121", "sead: 1"));
  ASSERT_FALSE(study.ok());
  EXPECT_THAT(study.error().text(), Not(HasSubstr("\033")));
  EXPECT_THAT(study.error().text(true), HasSubstr("\033[1;31merror:\033[0m"));
}

TEST(StudyMessages, ControlCharactersOfTheFileDoNotReachTheTerminal) {
  const std::string message = errors_of(changed("title: Spheroid", "title2: \"\x1b[2J\" # Spheroid"));
  EXPECT_THAT(message, Not(HasSubstr("\x1b")));
}

TEST(StudyMessages, AMegabyteLongLineIsCutAroundThePlace) {
  const std::string message = errors_of(changed("title: Spheroid", "tittle: " + std::string(1000000, 'x') + " Spheroid"));
  EXPECT_LT(message.size(), 1000u);
  EXPECT_THAT(message, HasSubstr("unknown key 'tittle'"));
}

TEST(StudyMessages, EveryCodeThatIsUsedIsExplained) {
  int last = 0;
  for (const ErrorCode& code : error_codes()) {
    EXPECT_GT(code.code, last);
    EXPECT_GT(std::string(code.explanation).size(), 20u);
    last = code.code;
  }
  for (const char* broken : {"schema: [", "a: 1", "schema: 1\nschema: 1\n", "schema: 010\n", ""}) {
    const auto study = read(broken);
    ASSERT_FALSE(study.ok());
    for (const Diagnostic& d : study.error().list()) EXPECT_NE(find_error_code(d.code), nullptr) << d.code;
  }
}

TEST(StudyMessages, StrictMakesWarningsErrors) {
  const std::string text = changed("checkpoint: 6 h", "checkpoint: 600 h");
  EXPECT_THAT(warnings_of(text), HasSubstr("study.yaml:5:"));
  ReadOptions strict;
  strict.strict = true;
  EXPECT_THAT(errors_of(text, strict), HasSubstr("error: the checkpoint interval (600 h) is longer than the run (96 h) [E508]"));
}

/// The default of an interval, which the resolved study names, is nobody's mistake.
TEST(StudyMessages, AResolvedStudyThatIsShortHasNoWarningOfItsOwn) {
  const auto study = read(changed("{end: 96 h, step: auto, output: 1 h, checkpoint: 6 h}", "{end: 2 h}"));
  ASSERT_TRUE(study.ok()) << study.error().text();
  ReadOptions strict;
  strict.strict = true;
  const auto again = read(study->resolved_text, strict);
  EXPECT_TRUE(again.ok() || again.error().text().find("E508") == std::string::npos) << again.error().text();
}

TEST(EditDistance, CountsSwappedNeighboursAsOne) {
  EXPECT_EQ(edit_distance("yuong", "young"), 1u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);  // the textbook example
}

}  // namespace
}  // namespace morula::scenarios::test
