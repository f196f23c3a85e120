#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "coupling/loads/loads.h"
#include "scenarios/run/used_laws.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

constexpr const char* kStudy = R"(schema: 1
study: regions
time: {end: 1 h}
domain: {size: [200 um, 200 um, 200 um]}
contact: {range: 0.5 um}
cell_types:
  wall:
    radius: 6 um
    body: shell
    adhesion: {wall: 2e-4 J/m^2, ball: 0 J/m^2}
    friction: {medium: 3e8 N s/m^3, medium_tangential: 6e7 N s/m^3, cell_cell: 4e10 N s/m^3, cell_cell_tangential: 2e10 N s/m^3, obstacle_tangential: 0 N s/m^3}
    polarity: {start: [0, 2, 0], turning: 0.5 1/h, follow_velocity: 20 min}
    protrusion: {force: 1 nN, angle: 30 deg, reaction: cell, substrate: floor, contact_area: 20 um^2}
    fluctuations: {energy: 4e-18 J, resolve: 100 s}
    migration: {speed: 2 um/h, substrate: floor}
    dcm:
      cortex:
        tension: 0.3 mN/m
        lateral_easing: 30 s
        regions:
          apical: {tension: 0.5 mN/m, course: [{time: 10 min, factor: 1}, {time: 20 min, factor: 2}], amplitude: 20 %, period: 80 s, phase: 90 deg}
          lateral: {tension: 0.2 mN/m}
          whole: {tension: 0.4 mN/m}
  ball: {radius: 6 um, body: sphere, adhesion: {ball: 0 J/m^2}}
geometry:
  floor: {plane: {center: [0 um, 0 um, -60 um], normal: [0, 0, 1], size: 150 um}}
initial:
  - {type: wall, at: [[20 um, 0 um, 0 um], [-20 um, 0 um, 0 um]]}
  - {type: ball, at: [[0 um, 40 um, 0 um]]}
marks:
  apical: {types: [wall], cone: {toward: [0 um, 0 um, 0 um], angle: 60 deg}}
  ring: {types: [wall], band: {axis: [0, 0, 2], half_width: 1 um}, when: always}
  stuck: {types: [wall], touched_by: floor}
lumens:
  gap: {center: [0 um, 0 um, 0 um], pressure: 20 Pa, solute: kept, from: 5 min, course: [{time: 6 min, factor: 0}, {time: 7 min, factor: 1}]}
  inner: {center: [0 um, 0 um, 0 um], faces: apical, pressure: -5 Pa}
apical:
  hold: {mark: apical, stiffness: 10 Pa/um, friction: 1e8 N s/m^3}
)";

std::string errors(const std::string& from, const std::string& to) { return test::errors_of(test::changed(from, to, kStudy)); }

TEST(Regions, NeedTheirTypesNamed) {
  EXPECT_NE(errors("apical: {types: [wall], cone", "apical: {cone").find("key 'types' is missing in `marks.apical` [E103]"),
            std::string::npos);
}

TEST(Regions, AreReadInInternalUnits) {
  const auto study = test::read(kStudy);
  ASSERT_TRUE(study.ok()) << study.error().text();
  const Model& m = study->model;
  EXPECT_EQ(m.mark_names, (std::vector<std::string>{"apical", "ring", "stuck", "gap"}));
  ASSERT_EQ(m.marks.size(), 3u);
  EXPECT_EQ(m.marks[0].axis_from, FaceMark::Axis::kTowardPoint);
  EXPECT_DOUBLE_EQ(m.marks[0].angle, std::numbers::pi / 3.0);
  EXPECT_EQ(m.marks[1].axis, (Vec3d{0, 0, 1}));
  EXPECT_TRUE(m.marks[1].always);
  EXPECT_EQ(m.marks[2].material, 2) << "obstacles come after the types";
  const CellType& wall = m.types[0];
  ASSERT_EQ(wall.regional_tension.regions.size(), 3u);
  EXPECT_EQ(wall.regional_tension.easing, 30.0);
  EXPECT_NEAR(wall.regional_tension.regions[0].at(1200.0), 0.5 * 2.0 * 1.2, 1e-12);  // 15 periods, at a quarter
  EXPECT_EQ(wall.regional_tension.regions[1].mark, TensionRegion::kLateral);
  EXPECT_DOUBLE_EQ(m.step.max_step, 4.0) << "a twentieth of the period";
  ASSERT_EQ(m.lumens.size(), 2u);
  EXPECT_EQ(m.lumens[0].mark, 3);
  EXPECT_DOUBLE_EQ(m.lumens[0].pressure, 0.02);
  EXPECT_TRUE(m.lumens[0].keeps_solute);
  EXPECT_FALSE(m.lumens[1].by_sight);
  EXPECT_EQ(m.lumens[1].mark, 0);
  EXPECT_DOUBLE_EQ(m.apical_springs[0].stiffness, 0.01);
  EXPECT_DOUBLE_EQ(m.apical_springs[0].friction, 0.1);
  EXPECT_EQ(next_corner(m, 0.0), 300.0);
  EXPECT_EQ(next_corner(m, 400.0), 420.0);
  EXPECT_EQ(next_corner(m, 500.0), 600.0);
}

TEST(Regions, ActivityAndFrictionAreReadInInternalUnits) {
  const auto study = test::read(kStudy);
  ASSERT_TRUE(study.ok()) << study.error().text();
  const CellType& wall = study->model.types[0];
  EXPECT_NEAR(wall.medium_friction, (0.3 + 2.0 * 0.06) / 3.0, 1e-15);
  EXPECT_DOUBLE_EQ(wall.shell.medium_friction, 0.06);
  EXPECT_DOUBLE_EQ(wall.medium_normal_extra, 0.24);
  EXPECT_EQ(wall.medium_tangent_extra, 0.0);
  EXPECT_DOUBLE_EQ(study->model.pair(0, 0).normal_friction, 40.0);
  EXPECT_DOUBLE_EQ(study->model.pair(0, 0).tangential_friction, 20.0);
  EXPECT_DOUBLE_EQ(study->model.pair(0, 1).tangential_friction, 35.0) << "the mean of 20 and 50";
  EXPECT_EQ(study->model.pair(0, 2).tangential_friction, 0.0);
  EXPECT_DOUBLE_EQ(study->model.pair(1, 2).tangential_friction, 100.0) << "`same`";
  EXPECT_EQ(wall.polarity.start, (Vec3d{0, 1, 0}));
  ASSERT_EQ(wall.polarity.rules.size(), 2u);
  EXPECT_DOUBLE_EQ(wall.polarity.rules[0].values("turning"), 0.5 / 3600.0);
  EXPECT_DOUBLE_EQ(wall.polarity.rules[1].values("follow_velocity"), 1200.0);
  EXPECT_TRUE(wall.protrusion.internal);
  EXPECT_EQ(wall.protrusion.substrate, 2);
  EXPECT_EQ(wall.migration.substrate, 2);
  EXPECT_DOUBLE_EQ(wall.fluctuations.energy, 4e-3);
  EXPECT_DOUBLE_EQ(wall.fluctuations.longest_step(), 6.0);
  EXPECT_EQ(study->model.step.first_tolerance, 1e-4);
  const auto slow = test::read(test::changed("period: 80 s", "period: 800 s", kStudy));
  EXPECT_DOUBLE_EQ(slow->model.step.max_step, 6.0);
}

TEST(Regions, AResolvedStudyIsTheSameStudy) {
  const auto study = test::read(kStudy);
  ASSERT_TRUE(study.ok()) << study.error().text();
  const auto again = test::read(study->resolved_text);
  ASSERT_TRUE(again.ok()) << again.error().text();
  std::string text = study->resolved_text;  // what was a default is written out now
  for (std::size_t at; (at = text.find("  # default")) != std::string::npos;) text.erase(at, text.find('\n', at) - at);
  EXPECT_EQ(again->resolved_text, text);
  EXPECT_EQ(again->model.step.first_tolerance, study->model.step.first_tolerance) << "a resumed run reads the resolved study";
  EXPECT_EQ(again->model.mark_names, study->model.mark_names);
  EXPECT_EQ(again->model.types[0].regional_tension.regions[0].at(700.0), study->model.types[0].regional_tension.regions[0].at(700.0));
  EXPECT_EQ(again->model.lumens[0].course.at(370.0), study->model.lumens[0].course.at(370.0));
}

TEST(Regions, AreAmongTheLawsThatMethodsName) {
  const auto study = test::read(kStudy);
  ASSERT_TRUE(study.ok()) << study.error().text();
  const std::vector<UsedLaw> laws = used_laws(*study);
  for (const char* name : {"regional_tension", "lumen_pressure", "apical_spring", "fluctuations", "protrusion", "rotational_diffusion",
                           "follow_velocity", "directed_medium_friction"}) {
    const auto found = std::ranges::find(laws, std::string(name), [](const UsedLaw& use) { return use.law.name; });
    ASSERT_NE(found, laws.end()) << name;
    for (const LawParameter& parameter : found->law.parameters)
      EXPECT_NE(used_value(*found, parameter), "not set") << name << parameter.name;
  }
}

TEST(Regions, WhatNoFaceCanCarryIsRefused) {
  EXPECT_NE(errors("{types: [wall], cone: {toward", "{types: [ball], cone: {toward").find("E555"), std::string::npos);
  EXPECT_NE(errors("  ring:", "  lateral:").find("E555"), std::string::npos);
  EXPECT_NE(errors("  ring:", "  gap:").find("E112"), std::string::npos);
  EXPECT_NE(errors("band: {axis: [0, 0, 2], half_width: 1 um}, ", "").find("E111"), std::string::npos);
  EXPECT_NE(errors("band: {axis", "ball: {center: [0 um, 0 um, 0 um], radius: 1 um}, band: {axis").find("E111"), std::string::npos);
  EXPECT_NE(errors("axis: [0, 0, 2]", "axis: [0, 0, 0]").find("E302"), std::string::npos);
  EXPECT_NE(errors("touched_by: floor", "touched_by: flor").find("E401"), std::string::npos);
  EXPECT_NE(errors("apical: {tension: 0.5", "apicl: {tension: 0.5").find("E401"), std::string::npos);
  EXPECT_NE(errors("{mark: apical", "{mark: apicl").find("E401"), std::string::npos);
  std::string many = kStudy;
  for (int k = 0; k < 6; ++k)
    many = test::changed("marks:\n", "marks:\n  m" + std::to_string(k) + ": {types: [wall], band: {half_width: 1 um}}\n", many);
  const auto study = test::read(many);
  ASSERT_TRUE(study.ok()) << "as many marks as one likes: " << study.error().text();
  EXPECT_GT(study->model.mark_names.size(), 8u);
}

TEST(Regions, PolarConeNeedsAPolarity) {
  const std::string polar = test::changed("toward: [0 um, 0 um, 0 um]", "polarity: true", kStudy);
  EXPECT_TRUE(test::read(polar).ok());
  const std::string without = test::changed("    polarity: {start: [0, 2, 0], turning: 0.5 1/h, follow_velocity: 20 min}\n", "", polar);
  const std::string text = test::errors_of(without);
  EXPECT_NE(text.find("E555"), std::string::npos);
  EXPECT_NE(text.find("E558"), std::string::npos) << "the protrusion needs it too";
}

TEST(Regions, TensionBelowHalfOfTheAdhesionIsWarnedOfAndRefusedInAFluid) {
  EXPECT_EQ(test::warnings_of(kStudy).find("W556"), std::string::npos);
  const std::string weak = test::changed("lateral: {tension: 0.2 mN/m}", "lateral: {tension: 0.1 mN/m}", kStudy);
  EXPECT_NE(test::warnings_of(weak).find("556"), std::string::npos);
  const std::string fluid = test::changed("        tension: 0.3 mN/m\n", "        elastic: none\n        tension: 0.3 mN/m\n", weak);
  EXPECT_NE(test::errors_of(fluid).find("E556"), std::string::npos);
}

TEST(Regions, SurfacesOfAFluidAdhereByWhatContactTakesFromTheirTension) {
  const std::string fluid = test::changed("        tension: 0.3 mN/m\n", "        elastic: none\n        tension: 0.3 mN/m\n", kStudy);
  EXPECT_EQ(test::warnings_of(kStudy).find("695"), std::string::npos) << "an elastic cortex";
  const std::string told = test::warnings_of(fluid);
  EXPECT_NE(told.find("differs from that of the free surface by 0.1 mN/m"), std::string::npos) << told;
  EXPECT_NE(told.find("no tension or adhesion by marks"), std::string::npos) << told;
  const std::string alike = test::changed("lateral: {tension: 0.2 mN/m}", "lateral: {tension: 0.3 mN/m}", fluid);
  EXPECT_EQ(test::warnings_of(alike).find("695"), std::string::npos);

  const std::string eased = test::changed(
      "          apical: {tension: 0.5 mN/m, course: [{time: 10 min, factor: 1}, {time: 20 min, factor: 2}], amplitude: 20 %, period: 80 "
      "s, phase: 90 "
      "deg}\n",
      "", fluid);
  EXPECT_NE(test::errors_of(eased).find("'lateral_easing' has no effect here"), std::string::npos) << "nothing is left to ease";
  const std::string whole = test::changed("        lateral_easing: 30 s\n", "", eased);
  EXPECT_EQ(test::warnings_of(whole).find("695"), std::string::npos);
  const auto study = test::read(whole);
  ASSERT_TRUE(study.ok()) << study.error().text();
  const CellType& wall = study->model.types[0];
  EXPECT_TRUE(wall.regional_tension.lateral_adheres);
  EXPECT_NEAR(wall.regional_tension.drop_in_contact(wall.shell.tension, 0.0), 0.4 - 0.2, 1e-12) << "of `whole`";
  const std::string tense = test::changed("lateral: {tension: 0.2 mN/m}", "lateral: {tension: 0.5 mN/m}", whole);
  EXPECT_NE(test::warnings_of(tense).find("do not stick to each other"), std::string::npos);
}

TEST(Regions, MarksAndCavitiesThatAreNoneAreRefused) {
  const std::string box = "cone: {toward: [0 um, 0 um, 0 um], angle: 60 deg}";
  EXPECT_NE(errors(box, "box: {center: [0 um, 0 um, 6 um], size: [-20 um, 20 um, 20 um]}").find("E302"), std::string::npos);
  EXPECT_TRUE(test::read(test::changed(box, "box: {center: [0 um, 0 um, 6 um], size: [20 um, 20 um, 20 um]}", kStudy)).ok());
  const std::string within = errors("gap: {center: [0 um, 0 um, 0 um], pressure: 20 Pa, solute: kept, from: 5 min,",
                                    "gap: {center: [19 um, 1 um, 0 um], pressure: 20 Pa, solute: kept,");
  EXPECT_NE(within.find("the centre of the cavity 'gap' lies in a cell"), std::string::npos) << within;
  const std::string late = test::warnings_of(test::changed("solute: kept, from: 5 min,", "solute: kept, from: 2 h,", kStudy));
  EXPECT_NE(late.find("the cavity 'gap' begins when the run has ended (1 h)"), std::string::npos) << late;
}

TEST(Regions, TurnoverIsFollowedInTenStepsATime) {
  const auto step = [](const std::string& turnover) {
    const auto study =
        test::read(test::changed("        tension: 0.3 mN/m\n", "        turnover: " + turnover + "\n        tension: 0.3 mN/m\n", kStudy));
    EXPECT_TRUE(study.ok()) << study.error().text();
    return study.ok() ? study->model.step.max_step : 0.0;
  };
  EXPECT_DOUBLE_EQ(step("10 s"), 1.0);
  EXPECT_GT(step("never"), 1.0);
}

TEST(Regions, CavitiesBesideObstaclesAreWarnedOf) {
  EXPECT_NE(test::warnings_of(kStudy).find("the cavity 'inner' is bounded by the faces of a mark alone"), std::string::npos);
  EXPECT_EQ(test::warnings_of(kStudy).find("cavity 'gap'"), std::string::npos) << "it is seen";
}

TEST(Regions, ValuesOutOfRangeAndWithoutEffectAreRefused) {
  EXPECT_NE(errors("amplitude: 20 %, period: 80 s", "amplitude: 20 %").find("E515"), std::string::npos);
  EXPECT_NE(errors("amplitude: 20 %", "amplitude: 120 %").find("E302"), std::string::npos);
  EXPECT_NE(errors("angle: 60 deg", "angle: 190 deg").find("E302"), std::string::npos);
  EXPECT_NE(errors("{time: 20 min, factor: 2}", "{time: 5 min, factor: 2}").find("E510"), std::string::npos);
  EXPECT_NE(errors("pressure: 20 Pa, solute", "pressure: -20 Pa, solute").find("E557"), std::string::npos);
  EXPECT_NE(errors("gap: {center: [0 um, 0 um, 0 um]", "gap: {center: [0 um, 0 um, 120 um]").find("E502"), std::string::npos);
  EXPECT_NE(errors("size: [200 um, 200 um, 200 um]", "size: [200 um, 200 um, 200 um], boundary: periodic").find("E557"), std::string::npos);
  EXPECT_NE(errors("substrate: floor, contact_area", "substrate: ball, contact_area").find("E558"), std::string::npos);
  EXPECT_NE(errors("substrate: floor, contact_area", "contact_area").find("E515"), std::string::npos);
  EXPECT_NE(errors("{speed: 2 um/h, substrate: floor}", "{substrate: floor}").find("E515"), std::string::npos);
  EXPECT_NE(errors("start: [0, 2, 0]", "start: [0, 0, 0]").find("E302"), std::string::npos);
  EXPECT_NE(errors("energy: 4e-18 J", "energy: -4e-18 J").find("E302"), std::string::npos);
  EXPECT_NE(errors("stiffness: 10 Pa/um", "stiffness: 10 Pa").find("E203"), std::string::npos);
  EXPECT_NE(errors("medium_tangential: 6e7 N s/m^3", "medium_tangential: -6e7 N s/m^3").find("E302"), std::string::npos);
}

}  // namespace
}  // namespace morula::scenarios
