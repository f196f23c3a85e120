#include <gmock/gmock.h>

#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

ReadOptions with(const std::string& assignment) {
  ReadOptions options;
  options.overrides = {assignment};
  return options;
}

TEST(Override, SetsWhatIsThere) {
  const auto study = read(kGoodStudy, with("cell_types.hepatocyte.radius=7 um"));
  ASSERT_TRUE(study.ok()) << study.error().text();
  EXPECT_EQ(study->model.types[0].radius.mean, 7.0);
  EXPECT_EQ(read(kGoodStudy, with("initial.0.count=20"))->initial[0].count, 20u);
  EXPECT_EQ(read(kGoodStudy, with("contact.range=0.4 um"))->model.contact.range, 0.4) << "a section that the file leaves out";
}

/// YAML takes a `#` after a blank for a comment: what stands behind it would be lost without a word.
TEST(Override, IsNotCutAtAComment) {
  EXPECT_THAT(errors_of(kGoodStudy, with("title=a # b")),
              AllOf(HasSubstr("command line:1:9: error:"), HasSubstr("read as a comment [E110]")));
  EXPECT_THAT(errors_of(kGoodStudy, with("title=#1")), HasSubstr("[E110]"));
  EXPECT_EQ(read(kGoodStudy, with("title='a # b'"))->title, "a # b");
  EXPECT_EQ(read(kGoodStudy, with("title=\"it's # 1\""))->title, "it's # 1");
  EXPECT_EQ(read(kGoodStudy, with("title=a#b"))->title, "a#b");
}

TEST(Override, OpensABareValue) {
  const std::string text = changed("radius: {mean: 6 um, spread: 10 %}", "radius: 6.5 um");
  const auto study = read(text, with("cell_types.hepatocyte.radius.spread=4 %"));
  ASSERT_TRUE(study.ok()) << study.error().text();
  EXPECT_EQ(study->model.types[0].radius.mean, 6.5);
  EXPECT_EQ(study->model.types[0].radius.relative_spread, 0.04);
}

TEST(Override, NeverMakesANewThingByATypingError) {
  EXPECT_THAT(errors_of(kGoodStudy, with("cell_types.hepatocyt.radius=7 um")),
              AllOf(HasSubstr("command line:1:12: error: there is no 'hepatocyt' in `cell_types` [E110]"),
                    HasSubstr("did you mean `hepatocyte`?")));
  EXPECT_THAT(errors_of(kGoodStudy, with("cell_types.hepatocyt={radius: 7 um}")), HasSubstr("[E110]"));
  EXPECT_THAT(errors_of(kGoodStudy, with("fields.oxigen.decay=1 1/h")), HasSubstr("did you mean `oxygen`?"));
  EXPECT_THAT(errors_of(kGoodStudy, with("geometry.plate.side=inside")), HasSubstr("there is no 'plate' in `geometry` [E110]"));
  EXPECT_THAT(errors_of(kGoodStudy, with("loads.push.type=hepatocyte")), HasSubstr("give all of it: `loads.push={...}`"));
  EXPECT_THAT(errors_of(kGoodStudy, with("initial.1.count=20")), HasSubstr("[E110]"));
  EXPECT_THAT(errors_of(kGoodStudy, with("cell_types.hepatocyte.adhesion.capsul=1e-6 J/m^2")),
              AllOf(HasSubstr("[E401]"), HasSubstr("did you mean `capsule`?")));
  EXPECT_THAT(errors_of(kGoodStudy, with("tiem.end=2 h")), AllOf(HasSubstr("[E101]"), HasSubstr("did you mean `time`?")));
}

TEST(Override, PutsAnItemBeforeTheFirstOfAList) {
  const auto study = read(kGoodStudy, with("coupling.regions.+={name: mine, shape: cells, ids: [2, \"1.0\"]}"));
  ASSERT_TRUE(study.ok()) << study.error().text();
  ASSERT_EQ(study->model.swaps.regions.size(), 2u);
  EXPECT_EQ(study->model.swaps.regions[0].name, "mine");
  EXPECT_EQ(study->model.swaps.regions[1].name, "core");
  const std::string bare =
      "schema: 1\nstudy: s\ntime: {end: 1 h}\ndomain: {size: [100 um, 100 um, 100 um]}\ncell_types: {a: {}}\n"
      "initial: [{type: a, at: [[0 um, 0 um, 0 um]]}]\n";
  const auto first = read(bare, with("coupling.regions.+={name: mine, shape: cells, ids: 1}"));
  ASSERT_TRUE(first.ok()) << first.error().text();
  EXPECT_EQ(first->model.swaps.regions.size(), 1u);
  EXPECT_THAT(errors_of(kGoodStudy, with("cell_types.+={radius: 7 um}")), HasSubstr("'+' cannot be a name [E112]"));
  EXPECT_THAT(errors_of(kGoodStudy, with("coupling.hold.+=3")), HasSubstr("[E104]"));
}

TEST(Override, AddsAThingThatIsGivenWhole) {
  const auto study = read(kGoodStudy, with("fields.drug={diffusion: 1e-10 m^2/s, initial: 1 uM, boundary: 1 uM}"));
  ASSERT_TRUE(study.ok()) << study.error().text();
  EXPECT_EQ(study->model.fields.size(), 2u);
}

}  // namespace
}  // namespace morula::scenarios::test
