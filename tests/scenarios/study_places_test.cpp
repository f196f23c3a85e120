#include <gtest/gtest.h>

#include "tests/scenarios/study_fixture.h"

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
  EXPECT_TRUE(test::read(test::changed("[0 um, 0 um, 20 um]", "[0 um, 0 um, 16.5 um]", kStudy)).ok()) << "within twice the limit of 0.3 um";
  const std::string deep = test::changed("[0 um, 0 um, 20 um]", "[0 um, 0 um, 6.1 um]", kStudy);
  EXPECT_TRUE(test::read(test::changed("initial:", "numerics: {start_cap: 0.2 um}\ninitial:", deep)).ok()) << "half of the larger radius";
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

TEST(Places, OfSpheresMayBeAnywhere) {  // their law drives them apart from any distance
  const auto study = test::read(test::changed("[0 um, 0 um, 20 um]]}", "[0 um, 0 um, 1 um]], as: sphere}", kStudy));
  EXPECT_TRUE(study.ok()) << study.error().text();
}

}  // namespace
}  // namespace morula::scenarios
