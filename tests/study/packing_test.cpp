#include <gtest/gtest.h>

#include "scenarios/run/used_laws.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

constexpr const char* kCbm = "cbm: {law: jkr, young: 450 Pa, poisson: 0.4}";

std::string with_packing(const std::string& packing) {
  return test::changed(kCbm, "cbm: {law: jkr, young: 450 Pa, poisson: 0.4, packing: " + packing + "}");
}

TEST(StudyPacking, IsOnByItselfFromTheTypesOwnModuli) {
  const auto study = test::read(test::kGoodStudy);
  ASSERT_TRUE(study.ok()) << study.error().text();
  EXPECT_NEAR(study->model.types[0].sphere.packing.onset(), 0.0829053, 5e-8);  // cbm.md §3, E 450 Pa, K_V 2.5 kPa
  const auto again = test::read(study->resolved_text);
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(again->model.types[0].sphere.packing.onset(), study->model.types[0].sphere.packing.onset());
}

TEST(StudyPacking, NoneSwitchesItOff) {
  for (const char* none : {"none", "{law: none}"}) {
    const auto study = test::read(with_packing(none));
    ASSERT_TRUE(study.ok()) << study.error().text();
    EXPECT_TRUE(study->model.types[0].sphere.packing.empty());
    const auto again = test::read(study->resolved_text);
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_TRUE(again->model.types[0].sphere.packing.empty());
  }
}

TEST(StudyPacking, SpheresAsStiffAsTheShellHaveNone) {
  const auto study = test::read(test::changed(kCbm, "cbm: {law: hertz, young: 50 kPa, poisson: 0.4}"));
  ASSERT_TRUE(study.ok()) << study.error().text();
  EXPECT_TRUE(study->model.types[0].sphere.packing.empty());
  EXPECT_EQ(study->warnings.text().find("E531"), std::string::npos) << study->warnings.text();
}

TEST(StudyPacking, IdealFilledCellTakesTheBulkModulusOfTheShellOrItsOwn) {
  const auto shell = test::read(with_packing("{law: ideal_filled_cell}"));
  ASSERT_TRUE(shell.ok()) << shell.error().text();
  EXPECT_NEAR(shell->model.types[0].sphere.packing.onset(), 0.0829053, 5e-8);  // cbm.md §3, K_V 2.5 kPa
  const auto own = test::read(with_packing("{bulk_modulus: 5 kPa}"));
  ASSERT_TRUE(own.ok()) << own.error().text();
  EXPECT_LT(own->model.types[0].sphere.packing.onset(), 0.0829);
  const auto again = test::read(own->resolved_text);
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(again->model.types[0].sphere.packing.onset(), own->model.types[0].sphere.packing.onset());
  bool named = false;
  for (const UsedLaw& law : used_laws(*own)) named = named || law.law.name == "packing";
  EXPECT_TRUE(named);  // in the methods of the report
}

TEST(StudyPacking, KnotsAreReadInInternalUnits) {
  const auto study = test::read(with_packing(
      "{law: knots, knots: [{packing: 2 %, pressure: 0 Pa}, {packing: 5 %, pressure: 100 Pa}, {packing: 20 %, pressure: 0.3 kPa}]}"));
  ASSERT_TRUE(study.ok()) << study.error().text();
  const auto& curve = study->model.types[0].sphere.packing;
  ASSERT_EQ(curve.knots().size(), 3u);
  EXPECT_DOUBLE_EQ(curve.knots()[1].packing, 0.05);
  EXPECT_DOUBLE_EQ(curve.at(0.05).pressure, 0.1);
  EXPECT_DOUBLE_EQ(curve.at(0.2).pressure, 0.3);
}

TEST(StudyPacking, CurvesThatAreNoneAreRefusedWithTheirPlace) {
  const auto message = [](const std::string& packing) { return test::errors_of(with_packing(packing)); };
  const std::string knots = "{law: knots, knots: [{packing: 2 %, pressure: 0 Pa}, {packing: 5 %, pressure: 100 Pa}, ";
  EXPECT_NE(message("{law: knots}").find("[E530]"), std::string::npos);
  EXPECT_NE(message("{law: knots, knots: [{packing: 2 %, pressure: 0 Pa}, {packing: 5 %, pressure: 1 Pa}]}").find("at least three knots"),
            std::string::npos);
  EXPECT_NE(message(knots + "{packing: 4 %, pressure: 200 Pa}]}").find("must increase"), std::string::npos);
  EXPECT_NE(message(knots + "{packing: 8 %, pressure: 20 Pa}]}").find("must not fall"), std::string::npos);
  EXPECT_NE(message("{law: knots, knots: [{packing: 2 %, pressure: 1 Pa}, {packing: 5 %, pressure: 2 Pa}, {packing: 6 %, pressure: 3 Pa}]}")
                .find("first knot must be 0"),
            std::string::npos);
  EXPECT_NE(message(knots + "{packing: 8 %}]}").find("pressure"), std::string::npos);
  EXPECT_NE(message(knots + "{packing: 8 %, pressure: -1 Pa}]}").find("pressure"), std::string::npos);
  EXPECT_NE(message("{bulk_modulus: 50 Pa}").find("[E531]"), std::string::npos);
  EXPECT_NE(message(knots + "{packing: 8 %, pressure: 1 kPa}], bulk_modulus: 2 kPa}").find("[E515]"), std::string::npos);
  EXPECT_NE(message("{law: ideal_filled_cell, knots: [{packing: 2 %, pressure: 0 Pa}]}").find("[E515]"), std::string::npos);
  EXPECT_NE(message("{law: sponge}").find("sponge"), std::string::npos);
}

TEST(StudyPacking, MakesTheExplicitLimitShorter) {
  const auto step_error = [](const std::string& packing) {
    std::string text = with_packing(packing);
    text = test::changed("time: {end: 96 h, step: auto,", "time: {end: 96 h, integrator: explicit_euler, step: 10 h,", text);
    return test::errors_of(text);
  };
  EXPECT_NE(step_error("none").find("[E507]"), std::string::npos);
  EXPECT_NE(step_error("{bulk_modulus: 2500 kPa}"), step_error("none"));  // the limit that the message names is another
}

}  // namespace
}  // namespace morula::scenarios
