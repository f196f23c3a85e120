#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "coupling/regions/outside_law.h"
#include "dcm/builtin.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {
namespace {

using testing::HasSubstr;
using testing::Not;

Study good(const std::string& text = kGoodStudy, const ReadOptions& options = {}) {
  auto study = read(text, options);
  EXPECT_TRUE(study.ok()) << study.error().text();
  return study.ok() ? std::move(study).value() : Study{};
}

TEST(StudyReader, ConvertsEveryValueToInternalUnits) {
  const Study s = good();
  EXPECT_EQ(s.name, "spheroid_core");
  EXPECT_EQ(s.model.seed, 20261121u);
  EXPECT_DOUBLE_EQ(s.time.end, 96 * 3600.0);
  EXPECT_EQ(s.model.space.box.low, (Vec3d{-200, -200, -200}));
  ASSERT_EQ(s.model.types.size(), 1u);
  const CellType& t = s.model.types[0];
  EXPECT_DOUBLE_EQ(t.radius.mean, 6.0);
  EXPECT_DOUBLE_EQ(t.radius.relative_spread, 0.1);
  EXPECT_TRUE(t.cycles);
  EXPECT_DOUBLE_EQ(t.cycle_duration.mean, 18 * 3600.0);
  EXPECT_DOUBLE_EQ(t.inhibit_pressure, 0.8);
  ASSERT_EQ(t.behaviours.size(), 1u);
  EXPECT_EQ(t.behaviours[0].what, starvation());
  EXPECT_EQ(t.behaviours[0].values.number("field"), 0);
  EXPECT_DOUBLE_EQ(t.behaviours[0].values("below"), 0.02);
  EXPECT_DOUBLE_EQ(t.behaviours[0].values("rate"), 0.05 / 3600.0);
  EXPECT_EQ(t.behaviours[0].reason, "oxygen is below what " + t.name + " needs");
  EXPECT_DOUBLE_EQ(t.migration.speed, 2.0 / 3600.0);
  EXPECT_DOUBLE_EQ(t.medium_friction, 0.1);
  EXPECT_DOUBLE_EQ(t.sphere.young, 0.45);
  EXPECT_EQ(t.sphere.law, cbm::jkr_law());
  EXPECT_DOUBLE_EQ(s.model.pair(0, 0).adhesion, 0.1);
  EXPECT_DOUBLE_EQ(s.model.pair(0, 0).normal_friction, 50.0);
  EXPECT_DOUBLE_EQ(s.model.pair(0, 1).adhesion, 1e-3);
  EXPECT_DOUBLE_EQ(s.model.pair(1, 0).adhesion, 1e-3);
  EXPECT_DOUBLE_EQ(s.model.pair(0, 1).tangential_friction, 100.0);
  EXPECT_DOUBLE_EQ(s.model.fields[0].diffusion, 2000.0);
  EXPECT_DOUBLE_EQ(s.model.fields[0].reactions.at(0).values("rate"), 40.0);
  EXPECT_DOUBLE_EQ(s.model.fields[0].boundary[2][1].value, 0.2);
  EXPECT_DOUBLE_EQ(s.model.swaps.triggers[0].demote, 0.6);
  EXPECT_DOUBLE_EQ(s.model.swaps.triggers[0].hold, 1800.0);
  EXPECT_EQ(s.model.swaps.max_shells, 120u);
  EXPECT_TRUE(s.model.obstacles[0].inside);
}

// Table 1: E = 1 kPa, h = 200 nm, nu = 1/2: k = 1.73e-4 N/m, D = 8.9e-19 J, hinge constant 1.03e-18 J.
TEST(StudyReader, ShellConstantsAreThoseOfTable1) {
  const dcm::ShellParameters p = good().model.types[0].shell;
  EXPECT_NEAR(p.spring_stiffness, 0.173205, 1e-6);
  EXPECT_NEAR(p.hinge_stiffness, 1.0264e-3, 1e-6);
  EXPECT_DOUBLE_EQ(p.edge_damping, 0.1);
  EXPECT_DOUBLE_EQ(p.tension, 0.2);
  EXPECT_DOUBLE_EQ(p.bulk_modulus, 2.5);
}

dcm::ShellParameters shell_with(const std::string& keys) {
  return good(changed("cortex: {young: 1 kPa, thickness: 200 nm, poisson: 0.5, tension: 0.2 mN/m}", keys)).model.types[0].shell;
}

/// Coefficients of the only sheet of this law: shear modulus and area ratio.
dcm::SheetCoefficients sheet_of(const dcm::ShellParameters& shell, const char* law) {
  dcm::SheetCoefficients out{};
  for (const dcm::Sheet& sheet : shell.sheets)
    if (sheet.law == dcm::shell_law(law).sheet) out = sheet.coefficient;
  return out;
}

// dcm.md §2: G = E h/3 = 0.066667, C = 1 for nu = 1/2; springs with area: k = 0.15396, K_a = 0.06667.
TEST(StudyReader, ElasticityOfTheCortexHonoursThicknessAndPoissonRatio) {
  const auto neo = shell_with("cortex: {elastic: neo_hooke, poisson: 0.5}");
  EXPECT_NEAR(sheet_of(neo, "neo_hooke")[0], 0.066667, 1e-6);
  EXPECT_DOUBLE_EQ(sheet_of(neo, "neo_hooke")[1], 1.0);
  EXPECT_EQ(neo.sheets.size(), 1u);
  EXPECT_EQ(neo.spring_stiffness, 0.0);
  const auto stvk = shell_with("cortex: {elastic: stvk, young: 2 kPa, thickness: 0.5 um, poisson: 0.25}");
  EXPECT_NEAR(sheet_of(stvk, "st_venant_kirchhoff")[0], 0.4, 1e-12);
  EXPECT_NEAR(sheet_of(stvk, "st_venant_kirchhoff")[1], 1.0 / 3.0, 1e-12);
  const auto red_cell = shell_with("cortex: {elastic: skalak, shear_modulus: 5.5 uN/m, area_ratio: 50}");
  EXPECT_DOUBLE_EQ(sheet_of(red_cell, "skalak")[0], 5.5e-3);
  EXPECT_DOUBLE_EQ(sheet_of(red_cell, "skalak")[1], 50.0);
  const auto net = shell_with("cortex: {elastic: springs_with_area}");
  EXPECT_NEAR(net.spring_stiffness, 0.15396, 1e-5);
  EXPECT_NEAR(net.local_area_modulus, 0.06667, 1e-5);
  const auto fluid = shell_with("cortex: {elastic: none}");
  EXPECT_EQ(fluid.spring_stiffness + fluid.local_area_modulus, 0.0);
  EXPECT_TRUE(fluid.sheets.empty());
  EXPECT_GT(fluid.hinge_stiffness, 0.0) << "bending is a law of its own";
}

// time_stepping.md §12.1: 0.3 of the tension; layers more elastic than tense: a tenth of E h.
TEST(StudyReader, ShapeStiffnessFollowsTheTensionUnlessGiven) {
  EXPECT_DOUBLE_EQ(shell_with("cortex: {elastic: none, tension: 0.1 mN/m}").shape_stiffness, 0.03);
  EXPECT_DOUBLE_EQ(shell_with("cortex: {elastic: none, tension: 0.5 mN/m}").shape_stiffness, 0.15);
  EXPECT_DOUBLE_EQ(shell_with("cortex: {young: 1 kPa, thickness: 200 nm, tension: 0.1 mN/m}").shape_stiffness, 0.03);
  EXPECT_DOUBLE_EQ(shell_with("cortex: {young: 1 kPa, thickness: 200 nm, tension: 0 mN/m}").shape_stiffness, 0.02);
  EXPECT_DOUBLE_EQ(shell_with("cortex: {young: 5 kPa, thickness: 200 nm, tension: 0.1 mN/m}").shape_stiffness, 0.1);
  EXPECT_DOUBLE_EQ(shell_with("cortex: {tension: 0.1 mN/m}\n      shape_stiffness: 0.2 mN/m").shape_stiffness, 0.2);
  EXPECT_DOUBLE_EQ(shell_with("cortex: {tension: 0.1 mN/m}\n      shape_stiffness: auto").shape_stiffness, 0.03);
}

TEST(StudyReader, BendingIsHingesOrHelfrich) {
  EXPECT_NEAR(shell_with("bending: 8.8889e-19 J").hinge_stiffness, 1.0264e-3, 1e-7);  // a bare value is the rigidity
  const auto p = shell_with("bending: {law: helfrich, rigidity: 2e-19 J, spontaneous_radius: 4 um}");
  EXPECT_EQ(p.hinge_stiffness, 0.0);
  EXPECT_DOUBLE_EQ(p.helfrich_rigidity, 2e-4);
  EXPECT_DOUBLE_EQ(p.spontaneous_curvature, 0.5);
  const auto plate = shell_with("bending: {law: helfrich}");
  EXPECT_NEAR(plate.helfrich_rigidity, 8.8889e-4, 1e-8);
  EXPECT_EQ(plate.spontaneous_curvature, 0.0);
  const auto none = shell_with("bending: {law: none}");
  EXPECT_EQ(none.hinge_stiffness + none.helfrich_rigidity, 0.0);
}

TEST(StudyReader, AMembraneAddsItsLawsToThoseOfTheCortex) {
  const std::string cortex = "cortex: {young: 1 kPa, thickness: 200 nm, poisson: 0.5, tension: 0.2 mN/m}\n      ";
  const auto both =
      shell_with(cortex + "membrane: {elastic: skalak, shear_modulus: 5.5 uN/m, area_ratio: 50, bending: helfrich, rigidity: 2e-19 J}");
  EXPECT_NEAR(both.spring_stiffness, 0.173205, 1e-6);
  EXPECT_DOUBLE_EQ(sheet_of(both, "skalak")[0], 5.5e-3);
  EXPECT_DOUBLE_EQ(sheet_of(both, "skalak")[1], 50.0);
  EXPECT_NEAR(both.hinge_stiffness, 1.0264e-3, 1e-6);
  EXPECT_DOUBLE_EQ(both.helfrich_rigidity, 2e-4);
  EXPECT_EQ(both.spontaneous_curvature, 0.0);
  // A triangular net of springs k has the shear modulus (√3/4) k: both nets have k = E h √3/2 when G is that of the cortex, (√3/4)(√3/2) E h.
  const auto nets = shell_with(cortex + "membrane: {elastic: springs, shear_modulus: 0.075 mN/m}");
  EXPECT_NEAR(nets.spring_stiffness, 2.0 * 0.173205, 1e-6);
  const auto sheets = shell_with(
      "cortex: {elastic: neo_hooke, poisson: 0.5}\n      membrane: {elastic: skalak, shear_modulus: 5 uN/m, area_ratio: 50}\n      area: "
      "{on_top: true}");
  EXPECT_NEAR(sheet_of(sheets, "neo_hooke")[0], 0.066667, 1e-6);
  EXPECT_DOUBLE_EQ(sheet_of(sheets, "neo_hooke")[1], 1.0);
  EXPECT_DOUBLE_EQ(sheet_of(sheets, "skalak")[0], 5e-3);
  EXPECT_DOUBLE_EQ(sheet_of(sheets, "skalak")[1], 50.0) << "each layer has its own";
  const auto study = good(changed("cortex: {young: 1 kPa, thickness: 200 nm, poisson: 0.5, tension: 0.2 mN/m}",
                                  cortex + "membrane: {bending: hinge, rigidity: 8.8889e-19 J}"));
  EXPECT_NEAR(study.model.types[0].shell.hinge_stiffness, 2.0 * 1.0264e-3, 1e-6);
  const auto again = read(study.resolved_text);
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(again->model.types[0].shell.hinge_stiffness, study.model.types[0].shell.hinge_stiffness);
}

TEST(StudyReader, AreaTurnoverAndViscosityAreOffUnlessGiven) {
  const auto p = good().model.types[0].shell;
  EXPECT_EQ(p.local_area_modulus + p.global_area_modulus + p.turnover_rate + p.bulk_viscosity + p.isotropic_damping, 0.0);
  const auto q = shell_with(
      "cortex: {elastic: neo_hooke, turnover: 10 min, isotropic_damping: 1e-5 N s/m}\n"
      "      area: {local: 0.07 mN/m, global: 2 mN/m, on_top: true}\n      bulk_viscosity: 100 Pa s");
  EXPECT_DOUBLE_EQ(q.turnover_rate, 1.0 / 600.0);
  EXPECT_DOUBLE_EQ(q.isotropic_damping, 0.01);
  EXPECT_DOUBLE_EQ(q.local_area_modulus, 0.07);
  EXPECT_DOUBLE_EQ(q.global_area_modulus, 2.0);
  EXPECT_DOUBLE_EQ(q.bulk_viscosity, 0.1);
}

TEST(StudyReader, MakesShorterStepsWhereACellCanBeAShell) {
  const auto longest = [](const char* type, const char* rest) {
    return good("schema: 1\nstudy: s\ntime: {end: 1 h}\ndomain: {size: [100 um, 100 um, 100 um]}\ncell_types: {a: " + std::string(type) +
                "}\ninitial: [{type: a, at: [[0 um, 0 um, 0 um]]}]\n" + rest)
        .model.step.max_step;
  };
  EXPECT_DOUBLE_EQ(longest("{}", ""), 120.0);
  EXPECT_DOUBLE_EQ(longest("{body: shell}", ""), 60.0);
  EXPECT_DOUBLE_EQ(longest("{}", "coupling: {triggers: [{promote: pressure > 1 kPa, demote: pressure < 0.5 kPa}]}\n"), 60.0);
}

TEST(StudyReader, ListsReachFurtherWhereNoCellCanBeAShell) {
  const auto skin = [](const char* type, const char* rest = "") {
    return good("schema: 1\nstudy: s\ntime: {end: 1 h}\ndomain: {size: [100 um, 100 um, 100 um]}\ncell_types: {a: " + std::string(type) +
                "}\ninitial: [{type: a, at: [[0 um, 0 um, 0 um]]}]\n" + rest)
        .model.contact.skin;
  };
  EXPECT_DOUBLE_EQ(skin("{radius: 5 um}"), 1.0);
  EXPECT_DOUBLE_EQ(skin("{radius: 3.5 um}"), 0.7);
  EXPECT_DOUBLE_EQ(skin("{radius: 1 um}"), 0.5);
  EXPECT_DOUBLE_EQ(skin("{body: shell}"), ContactNumerics().skin);
  EXPECT_DOUBLE_EQ(skin("{radius: 5 um}", "numerics: {skin: 0.3 um}\n"), 0.3);
}

TEST(StudyReader, DefaultsAreTheModelsDefaults) {
  const Study s = good(
      "schema: 1\nstudy: s\ntime: 1 h\ndomain: {size: [100 um, 100 um, 100 um]}\ncell_types: {a: {}}\ninitial: [{type: a, at: [[0 um, 0 "
      "um, 0 um]]}]\n"
      "",
      {.overrides = {"time={end: 1 h}"}});
  const CellType &t = s.model.types[0], d;
  EXPECT_FALSE(t.cycles);
  EXPECT_TRUE(t.behaviours.empty());
  EXPECT_DOUBLE_EQ(t.radius.mean, d.radius.mean);
  EXPECT_DOUBLE_EQ(t.shell.bulk_modulus, d.shell.bulk_modulus);
  EXPECT_DOUBLE_EQ(t.shell.shape_stiffness, d.shell.shape_stiffness);
  EXPECT_DOUBLE_EQ(t.shell.barrier_stiffness, d.shell.barrier_stiffness);
  EXPECT_DOUBLE_EQ(t.shell.barrier_angle, d.shell.barrier_angle);
  EXPECT_DOUBLE_EQ(t.medium_friction, d.medium_friction);
  EXPECT_DOUBLE_EQ(t.sphere.young, 3.0 * d.shell.bulk_modulus * (1.0 - 2.0 * t.sphere.poisson)) << "one material (decision 0027)";
  const StepControl step;
  EXPECT_DOUBLE_EQ(s.model.step.max_step, 2.0 * step.max_step) << "no cell can be a shell (decision 0063)";
  EXPECT_DOUBLE_EQ(s.model.step.max_displacement, step.max_displacement);
  EXPECT_EQ(s.model.step.max_newton, step.max_newton);
  EXPECT_DOUBLE_EQ(s.model.step.newton_stop, step.newton_stop);
  EXPECT_DOUBLE_EQ(s.model.step.first_tolerance, 2.0 * step.first_tolerance) << "nothing acts on them from outside";
  EXPECT_DOUBLE_EQ(s.model.step.later_tolerance, step.later_tolerance);
  const ContactNumerics contact;
  EXPECT_DOUBLE_EQ(s.model.contact.range, contact.range);
  EXPECT_DOUBLE_EQ(s.model.contact.repulsion, contact.repulsion);
  EXPECT_DOUBLE_EQ(s.model.contact.skin, 1.0) << "no cell can be a shell";
  EXPECT_DOUBLE_EQ(s.model.limits.volume_error, Limits{}.volume_error);
  EXPECT_DOUBLE_EQ(s.model.swaps.hold, Swaps{}.hold);
  EXPECT_EQ(s.model.swaps.max_shells, Swaps{}.max_shells);
  EXPECT_DOUBLE_EQ(s.model.pair(0, 0).adhesion, 0.1);
}

TEST(StudyReader, BothSpellingsOfABodyMeanTheSame) {
  EXPECT_EQ(good(changed("as: cbm", "as: sphere")).initial[0].body, good().initial[0].body);
  EXPECT_EQ(good(changed("as: dcm", "as: shell")).resolved_text, good().resolved_text);
}

TEST(StudyReader, HertzianSpheresDoNotAdhere) {
  EXPECT_EQ(good(changed("law: jkr", "law: hertz")).model.types[0].sphere.law, cbm::hertz_law());
}

TEST(StudyReader, TriggersOnFieldsAndTypesAreRead) {
  const Study oxygen =
      good(changed("promote: pressure > 1 kPa, demote: pressure < 600 Pa", "promote: oxygen < 0.05 mM, demote: oxygen > 0.1 mM"));
  EXPECT_EQ(oxygen.model.swaps.triggers[0].value, field_value());
  EXPECT_FALSE(oxygen.model.swaps.triggers[0].promote_above);
  EXPECT_DOUBLE_EQ(oxygen.model.swaps.triggers[0].promote, 0.05);
  const Study type = good(changed("promote: pressure > 1 kPa, demote: pressure < 600 Pa", "type: hepatocyte"));
  EXPECT_EQ(type.model.swaps.triggers[0].type, 0);
}

TEST(StudyReader, TriggersOnAgeAndContactAreRead) {
  const Study age = good(changed("promote: pressure > 1 kPa, demote: pressure < 600 Pa", "promote: age > 2 h, demote: age < 1 h"));
  EXPECT_EQ(age.model.swaps.triggers[0].value->info.name, std::string("age"));
  EXPECT_DOUBLE_EQ(age.model.swaps.triggers[0].promote, 7200.0);
  const Study border =
      good(changed("promote: pressure > 1 kPa, demote: pressure < 600 Pa", "promote: contact_share < 0.4, demote: contact_share > 0.7"));
  EXPECT_EQ(border.model.swaps.triggers[0].value->info.name, std::string("contact_share"));
  EXPECT_FALSE(border.model.swaps.triggers[0].promote_above);
}

TEST(StudyReader, ATriggerOnTheRangeOfTheLawsHasAShortForm) {
  const Study s = good(changed("promote: pressure > 1 kPa, demote: pressure < 600 Pa", "outside_law: 1.2"));
  EXPECT_EQ(s.model.swaps.triggers[0].value, outside_law_value());
  EXPECT_TRUE(s.model.swaps.triggers[0].promote_above);
  EXPECT_DOUBLE_EQ(s.model.swaps.triggers[0].promote, 1.2);
  EXPECT_DOUBLE_EQ(s.model.swaps.triggers[0].demote, 0.9 * 1.2);
  EXPECT_EQ(s.model.swaps.triggers[0].type, -1);
}

TEST(StudyReader, BoundariesByAxisAndFaceOverrideAll) {
  const Study s = good(changed("boundary: open", "boundary: {all: wall, x: periodic, z_high: open}"));
  EXPECT_TRUE(s.model.space.periodic(0));
  EXPECT_EQ(s.model.space.boundary[1][0], BoundaryKind::kWall);
  EXPECT_EQ(s.model.space.boundary[2][0], BoundaryKind::kWall);
  EXPECT_EQ(s.model.space.boundary[2][1], BoundaryKind::kOpen);
  const Study f = good(changed("boundary: {all: 0.2 mM}", "boundary: {z_low: no_flux, all: 0.2 mM}"));
  EXPECT_EQ(f.model.fields[0].boundary[2][0].kind, fields::FaceCondition::Kind::kNoFlux);
  EXPECT_EQ(f.model.fields[0].boundary[2][1].kind, fields::FaceCondition::Kind::kValue);
}

TEST(StudyReader, ExplicitStepAutoIsHalfTheStabilityLimit) {
  const Study s = good(changed("step: auto", "step: auto, integrator: explicit_euler"));
  EXPECT_EQ(s.model.step.integrator, Integrator::kExplicitEuler);
  // Measured with these parameters: 0.15 s is stable, 0.20 s is not (volume mode, 162 nodes).
  EXPECT_GT(2 * s.model.step.max_step, 0.13);
  EXPECT_LT(2 * s.model.step.max_step, 0.20);
}

// dcm.md §1: 0.0110 s for a tension of 0.5 mN/m at 2562 nodes; 2.87 s for Helfrich at 642 nodes and 8.9e-19 J, a hundredth for 8.9e-17 J.
TEST(StudyReader, ExplicitStepKnowsTensionAndBending) {
  const auto limit = [](const std::string& from, const std::string& to) {
    const std::string text = changed("limits: {", "contact: {range: 0.2 um}\nlimits: {", changed("nodes: 162", "nodes: 2562"));
    return 2.0 * good(changed(from, to, changed("step: auto", "step: auto, integrator: explicit_euler", text))).model.step.max_step;
  };
  EXPECT_NEAR(limit("tension: 0.2 mN/m", "tension: 0.5 mN/m"), 0.0110, 0.0011);
  EXPECT_NEAR(limit("bulk_modulus: 2.5 kPa", "bending: {law: helfrich, rigidity: 8.8889e-17 J}"), 0.00169, 0.0003);
}

TEST(StudyReader, AdhesionStrongerThanTheCortexIsAWarning) {
  EXPECT_THAT(warnings_of(changed("hepatocyte: 1e-4 J/m^2", "hepatocyte: 5e-4 J/m^2")), HasSubstr("[E509]"));
  EXPECT_THAT(warnings_of(kGoodStudy), Not(HasSubstr("[E509]")));
}

TEST(StudyReader, CoarseMeshForTheContactRangeIsAWarning) {
  EXPECT_THAT(warnings_of(changed("nodes: 162", "nodes: 42")), HasSubstr("less than a quarter of the mean edge"));
  EXPECT_THAT(warnings_of(kGoodStudy), Not(HasSubstr("mean edge")));
}

TEST(StudyReader, PairsGivenTwiceMustAgree) {
  std::string text = changed("geometry:", "  other:\n    adhesion: {hepatocyte: 3e-5 J/m^2}\ngeometry:");
  EXPECT_DOUBLE_EQ(good(text).model.pair(0, 1).adhesion, 0.03);
  text = changed("adhesion: {hepatocyte: 1e-4 J/m^2, capsule", "adhesion: {hepatocyte: 1e-4 J/m^2, other: 2e-5 J/m^2, capsule", text);
  EXPECT_THAT(errors_of(text), HasSubstr("the adhesion of 'other' and 'hepatocyte' is 3e-5 J/m^2 here, but 2e-5 J/m^2 in line 15 [E510]"));
}

TEST(StudyReader, ObservablesAndScenariosMustExist) {
  EXPECT_THAT(errors_of(changed("volume_error", "volume_eror")), HasSubstr("there is no observable 'volume_eror' [E403]"));
  ReadOptions options;
  options.scenario_names = {"hybrid_spheroid"};
  EXPECT_THAT(errors_of(changed("seed:", "scenario: hybrid\nseed:"), options), HasSubstr("there is no library study 'hybrid' [E403]"));
}

TEST(StudyOverrides, ActAsIfWrittenInTheFile) {
  ReadOptions options;
  options.overrides = {"seed=7",
                       "cell_types.hepatocyte.radius=7 um",
                       "initial.0.count=100",
                       "time.end=2h",
                       "contact.range=0.6 um",
                       "domain.size=[500 um, 500 um, 500 um]"};
  const Study s = good(kGoodStudy, options);
  EXPECT_EQ(s.model.seed, 7u);
  EXPECT_DOUBLE_EQ(s.model.types[0].radius.mean, 7.0);
  EXPECT_DOUBLE_EQ(s.model.types[0].radius.relative_spread, 0.0);
  EXPECT_EQ(s.initial[0].count, 100u);
  EXPECT_DOUBLE_EQ(s.time.end, 7200.0);
  EXPECT_DOUBLE_EQ(s.model.contact.range, 0.6);
  EXPECT_DOUBLE_EQ(s.model.space.box.high.x, 250.0);
  EXPECT_EQ(s.source_text, kGoodStudy);
}

TEST(StudyOverrides, ErrorsPointAtTheCommandLine) {
  const auto errors = [](const std::string& assignment) {
    ReadOptions options;
    options.overrides = {assignment};
    return errors_of(kGoodStudy, options);
  };
  EXPECT_THAT(
      errors("time.end=2 um"),
      HasSubstr("command line:1:10: error: 'end' is a time, but 'um' is a length [E203]\n    1 | time.end=2 um\n      |          ^~~~\n"));
  EXPECT_THAT(errors("time.ned=2 h"), HasSubstr("command line:1:6: error: unknown key 'ned' in `time` [E101]"));
  EXPECT_THAT(errors("seed"), HasSubstr("'seed' does not set a key [E110]"));
  EXPECT_THAT(errors("seed="), HasSubstr("[E110]"));
  EXPECT_THAT(errors("initial.7.count=3"), HasSubstr("'initial.7' is not a place in the study [E110]"));
  EXPECT_THAT(errors("seed.x=3"), HasSubstr("[E110]"));
  EXPECT_THAT(errors("time..end=3 h"), HasSubstr("[E110]"));
}

}  // namespace
}  // namespace morula::scenarios::test
