// What shells of a mesh cannot follow is refused with its place and a way out.
#include <gtest/gtest.h>

#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

constexpr const char* kStudy = R"(schema: 1
study: strong
time: {end: 1 h}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  cell:
    radius: 6 um
    adhesion: {cell: 0.95 mJ/m^2}
    dcm:
      nodes: 642
      cortex: {tension: 0.5 mN/m}
      bulk_modulus: 2.5 kPa
contact: {range: 0.45 um}
initial:
  - {type: cell, at: [[0 um, 0 um, 0 um], [12 um, 0 um, 0 um], [6 um, 10.4 um, 0 um]], as: shell}
)";

TEST(Resolution, AdhesionThatAFineMeshStallsOnNamesTheNodesThatDoNot) {
  const std::string text = test::errors_of(kStudy);
  EXPECT_NE(text.find("[E571]"), std::string::npos) << text;
  EXPECT_NE(text.find("study.yaml:8:22"), std::string::npos) << text;
  EXPECT_NE(text.find("`nodes: 162`"), std::string::npos) << text;
}

TEST(Resolution, PairsAndCoarserMeshesAndWeakerAdhesionAreAccepted) {
  EXPECT_TRUE(test::read(test::changed(", [6 um, 10.4 um, 0 um]", "", kStudy)).ok());
  EXPECT_TRUE(test::read(test::changed("range: 0.45", "range: 0.5", test::changed("nodes: 642", "nodes: 162", kStudy))).ok());
  EXPECT_TRUE(test::read(test::changed("cell: 0.95", "cell: 0.9", kStudy)).ok());
}

TEST(Resolution, VolumeThatDoesNotBearTheTensionIsRefused) {  // 2 γ/(3 R) = 0.0556 kPa
  const std::string pair = test::changed(", [6 um, 10.4 um, 0 um]", "", kStudy);
  const std::string text = test::errors_of(test::changed("bulk_modulus: 2.5 kPa", "bulk_modulus: 0.05 kPa", pair));
  EXPECT_NE(text.find("[E572]"), std::string::npos) << text;
  EXPECT_NE(text.find("0.167 kPa"), std::string::npos) << text;
  EXPECT_TRUE(test::read(test::changed("bulk_modulus: 2.5 kPa", "bulk_modulus: 0.2 kPa", pair)).ok());
  EXPECT_NE(test::errors_of(test::changed("bulk_modulus: 2.5 kPa", "bulk_modulus: 0 kPa", pair)).find("[E535]"), std::string::npos);
}

TEST(Resolution, AShapeTermThatHoldsAFluidCortexIsTold) {  // from 0.6 of the tension of 0.5 mN/m
  const auto told = [](const std::string& elastic, const std::string& shape) {
    const std::string pair = test::changed(", [6 um, 10.4 um, 0 um]", "", kStudy);
    return test::warnings_of(test::changed("bulk_modulus", "shape_stiffness: " + shape + "\n      bulk_modulus",
                                           test::changed("{tension:", "{elastic: " + elastic + ", tension:", pair)));
  };
  const std::string text = told("none", "0.31 mN/m");
  EXPECT_NE(text.find("640"), std::string::npos) << text;
  EXPECT_NE(text.find("study.yaml:12:"), std::string::npos) << text;
  EXPECT_NE(text.find("0.62 times the tension"), std::string::npos) << text;
  EXPECT_EQ(told("none", "0.3 mN/m").find("640"), std::string::npos);
  EXPECT_EQ(told("none", "auto").find("640"), std::string::npos);
  EXPECT_EQ(told("springs", "0.31 mN/m").find("640"), std::string::npos);
}

TEST(Resolution, RangeLongerThanHalfTheMeanEdgeIsRefused) {
  const std::string pair = test::changed(", [6 um, 10.4 um, 0 um]", "", kStudy);
  EXPECT_NE(test::errors_of(test::changed("range: 0.45 um", "range: 0.6 um", pair)).find("[E503]"), std::string::npos);
}

/// Edges of 0.914 um bear 0.51 um; those of daughters that do not grow are shorter by 2^(-1/3) with each division.
TEST(Resolution, CleavageThatLeavesTheMeshBehindIsTold) {
  const std::string one = test::changed(", [12 um, 0 um, 0 um], [6 um, 10.4 um, 0 um]", "", kStudy);
  const auto told = [&](const std::string& growth, const std::string& range) {
    return test::warnings_of(
        test::changed("range: 0.45 um", "range: " + range,
                      test::changed("radius: 6 um", "radius: 6 um\n    cycle: {model: phases, " + growth + "phases: {I: 30 min}}", one)));
  };
  EXPECT_NE(told("growth: none, ", "0.45 um").find("up to 2 times: from the 1st division on"), std::string::npos)
      << told("growth: none, ", "0.45 um");
  EXPECT_NE(told("growth: none, ", "0.36 um").find("from the 2nd division on"), std::string::npos);
  EXPECT_EQ(told("growth: none, ", "0.3 um").find("division on"), std::string::npos);
  EXPECT_EQ(told("", "0.45 um").find("division on"), std::string::npos) << "they grow";
}

TEST(Resolution, MembraneLawsThatBothResistAreaAndImpossiblePoissonRatiosAreRefused) {
  const std::string pair = test::changed(", [6 um, 10.4 um, 0 um]", "", kStudy);
  EXPECT_NE(
      test::errors_of(test::changed("bulk_modulus", "area: {local: 0.1 mN/m, global: 1 mN/m}\n      bulk_modulus", pair)).find("[E513]"),
      std::string::npos);
  EXPECT_NE(test::errors_of(test::changed("{tension:", "{elastic: springs_with_area, poisson: 0.2, tension:", pair)).find("[E514]"),
            std::string::npos);
  EXPECT_NE(test::errors_of(test::changed("{tension:", "{poisson: 0.6, tension:", pair)).find("[E30"), std::string::npos);
  EXPECT_NE(test::errors_of(test::changed("tension: 0.5 mN/m", "tension: -0.5 mN/m", pair)).find("[E30"), std::string::npos);
}

}  // namespace
}  // namespace morula::scenarios
