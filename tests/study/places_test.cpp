#include <gtest/gtest.h>

#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

constexpr const char* kStudy = R"(schema: 1
study: places
time: {end: 1 h}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  small: {radius: 5 um, body: shell}
  large: {radius: 12 um, body: shell}
geometry:
  stone: {box: {center: [0 um, 0 um, -40 um], size: [10 um, 10 um, 10 um]}}
  dish: {sphere: {radius: 48 um}, side: inside}
initial:
  - {type: small, at: [[0 um, 0 um, 20 um]]}
  - {type: large, at: [[0 um, 0 um, 0 um]]}
)";

std::string errors(const std::string& from, const std::string& to) { return test::errors_of(test::changed(from, to, kStudy)); }

TEST(Places, OfShellsThatTouchOrOverlapALittleAreFine) {
  const auto study = test::read(kStudy);
  EXPECT_TRUE(study.ok()) << study.error().text();
  EXPECT_TRUE(test::read(test::changed("[0 um, 0 um, 20 um]", "[0 um, 0 um, 16.9 um]", kStudy)).ok()) << "within the limit of 0.3 um";
  const std::string deep = test::changed("[0 um, 0 um, 20 um]", "[0 um, 0 um, 6.1 um]", kStudy);
  const auto capped = test::read(test::changed("initial:", "numerics: {start_cap: auto}\ninitial:", deep));
  ASSERT_TRUE(capped.ok()) << "half of the larger radius";
  EXPECT_NE(capped->warnings.text().find("the check INV.4 counts the start, too, and will fail"), std::string::npos);
  EXPECT_NE(capped->warnings.text().find("`limits: {overlap: "), std::string::npos);
}

/// The deviation of a cell is a variable that comes after those of the fields, of which the judge has none.
TEST(Places, OfCellsThatDifferAreJudgedBesideFields) {
  std::string varied = test::changed("small: {radius: 5 um, body: shell}", "small: {radius: 5 um, body: shell, variation: {tension: 10 %}}",
                                     test::changed("[0 um, 0 um, 20 um]", "[0 um, 0 um, 16.9 um]", kStudy));
  for (int fields = 1; fields <= 6; ++fields) {
    varied += fields == 1 ? "fields:\n" : "";
    varied += "  f" + std::to_string(fields) + ": {diffusion: 50 um^2/s, initial: 1 mM}\n";
    const auto study = test::read(varied);
    EXPECT_TRUE(study.ok()) << fields << ": " << study.error().text();
  }
}

TEST(Places, SpheresHaveNoMeshToTurn) {
  const std::string spheres = test::changed("small: {radius: 5 um, body: shell}", "small: {radius: 5 um}", kStudy);
  EXPECT_NE(test::errors_of(test::changed("20 um]]}", "20 um]], orientation: aligned}", spheres))
                .find("'orientation' has no meaning for cells that begin as spheres [E111]"),
            std::string::npos);
  const auto both = test::read(spheres);
  ASSERT_TRUE(both.ok()) << both.error().text();
  EXPECT_TRUE(test::read(both->resolved_text).ok()) << "a resolved study is a study";
  EXPECT_TRUE(test::read(test::changed("20 um]]}", "20 um]], as: shell, orientation: aligned}", spheres)).ok());
  EXPECT_TRUE(test::read(test::changed("20 um]]}", "20 um]], orientation: aligned}", kStudy)).ok());
}

TEST(Places, OfShellsThatWouldStopTheRunAreRefused) {
  EXPECT_NE(errors("[0 um, 0 um, 20 um]", "[0 um, 0 um, 15 um]").find("overlap by 2 um: the run would stop at its limit [E597]"),
            std::string::npos);
}

TEST(Places, OfShellsWithinOthersAreRefused) {
  EXPECT_NE(
      errors("[0 um, 0 um, 20 um]", "[0 um, 0 um, 0 um]").find("lies within another one: its centre is 0 um from [0, 0, 0] um [E596]"),
      std::string::npos);
  EXPECT_NE(errors("[0 um, 0 um, 20 um]", "[0 um, -3 um, 5 um]").find("[E596]"), std::string::npos);
  EXPECT_NE(errors("[[0 um, 0 um, 20 um]]", "[[0 um, 0 um, 30 um], [1 um, 0 um, 30 um]]").find("its centre is 1 um from"),
            std::string::npos);
}

TEST(Places, OfShellsInTheWrongPartOfAnObstacleAreRefused) {
  EXPECT_NE(
      errors("[0 um, 0 um, 20 um]", "[1 um, 0 um, -38 um]").find("a cell at [1, 0, -38] um has its centre inside obstacle 'stone' [E596]"),
      std::string::npos);
  EXPECT_NE(errors("[0 um, 0 um, 20 um]", "[0 um, 35 um, 35 um]").find("has its centre outside obstacle 'dish' [E596]"), std::string::npos);
}

TEST(Places, OfSpheresMayBeNearlyAnywhere) {  // their law drives them apart from any distance, but it was not made for that
  const std::string text = test::changed("[0 um, 0 um, 20 um]]}", "[0 um, 0 um, 1 um]], as: sphere}", kStudy);
  EXPECT_NE(test::warnings_of(text).find("deep in each other: they will be driven apart at once [E661]"), std::string::npos);
  EXPECT_NE(errors("[0 um, 0 um, 20 um]]}", "[0 um, 0 um, 0 um]], as: sphere}").find("[E596]"), std::string::npos) << "no way apart";
  EXPECT_NE(errors("[0 um, 0 um, 20 um]]}", "[1 um, 0 um, -38 um]], as: sphere}").find("inside obstacle 'stone' [E596]"),
            std::string::npos);
}

TEST(Places, OfShellsInObstaclesAndWallsAreJudgedByDepth) {
  EXPECT_NE(errors("[0 um, 0 um, 20 um]", "[0 um, 0 um, -32 um]").find("reaches 2 um deep into obstacle 'stone'"), std::string::npos);
  const std::string walls = test::changed("size: [100 um, 100 um, 100 um]", "size: [60 um, 60 um, 100 um], boundary: wall", kStudy);
  EXPECT_NE(test::errors_of(test::changed("[0 um, 0 um, 20 um]", "[27 um, 0 um, 15 um]", walls)).find("reaches 2 um deep into the wall"),
            std::string::npos);
}

TEST(Places, OfTwoFillsAreFoundBesideEachOther) {
  const auto study = test::read(test::changed(
      "{type: small, at: [[0 um, 0 um, 20 um]]}", "{type: small, count: 9, fill: sphere, radius: 30 um}",
      test::changed("{type: large, at: [[0 um, 0 um, 0 um]]}", "{type: small, count: 9, fill: sphere, radius: 30 um}", kStudy)));
  EXPECT_TRUE(study.ok()) << study.error().text();
}

TEST(Places, OfPointsWithinAFillAreRefused) {
  EXPECT_NE(errors("{type: small, at: [[0 um, 0 um, 20 um]]}", "{type: small, count: 9, fill: sphere, radius: 20 um}").find("[E59"),
            std::string::npos);
}

TEST(Places, FromACsvAreJudged) {
  const test::Folder folder;
  folder.write("cells.csv", "x [um],y [um],z [um],type\n0,0,14,small\n");
  const auto study = test::read(test::changed("{type: small, at: [[0 um, 0 um, 20 um]]}", "{csv: cells.csv}", kStudy), {}, folder.path());
  ASSERT_FALSE(study.ok());
  EXPECT_NE(study.error().text().find("study.yaml:13:23: error: cells at [0, 0, 14] um and [0, 0, 0] um overlap by 3 um"),
            std::string::npos)
      << study.error().text();
}

/// A check that says ok is a run that begins: at every distance from touching to half a radius.
TEST(Places, ThatAreAcceptedAreThoseThatARunAccepts) {
  int refused = 0, accepted = 0;
  for (int step = 0; step <= 10; ++step) {
    const std::string z = std::to_string(17.1 - 0.1 * step);
    (test::read(test::changed("[0 um, 0 um, 20 um]", "[0 um, 0 um, " + z + " um]", kStudy)).ok() ? accepted : refused) += 1;
  }
  EXPECT_GE(accepted, 3) << "touching, and less than the limit of 0.3 um";
  EXPECT_GE(refused, 3) << "0.6 um and more";
}

}  // namespace
}  // namespace morula::scenarios
