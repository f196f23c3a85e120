// What a body cannot do yet, or only outside the range of its law, is told by `check`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <tuple>

#include "cbm/sphere_range.h"
#include "dcm/drops.h"
#include "results/series_reader.h"
#include "scenarios/run/driver.h"
#include "scenarios/run/used_laws.h"
#include "tests/results/results_support.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kStudy = R"(schema: 1
study: bodies
time: {end: 10 h}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  cell:
    radius: 6 um
    dcm:
      nodes: 162
initial:
  - {type: cell, count: 10, fill: sphere, radius: 40 um}
)";

std::string with(const std::string& key, const std::string& text = kStudy) {
  return test::changed("    dcm:", "    " + key + "\n    dcm:", text);
}
/// One cell in the middle, of a type with these keys; `more`: other sections.
std::string one_cell(const std::string& type, const std::string& more) {
  return "schema: 1\nstudy: one\ntime: {end: 1 h}\ndomain: {size: [200 um, 200 um, 200 um]}\ncell_types: {cell: {" + type +
         "}}\ninitial: [{type: cell, at: [[0 um, 0 um, 0 um]]}]\n" + more;
}
const std::string kAsShell = "radius: 40 um, as: shell}";

TEST(Bodies, SmallSpheresThatMayGoFarInAStepAreTold) {
  const auto told = [](const std::string& text) {
    const auto study = test::read(text);
    EXPECT_TRUE(study.ok()) << study.error().text();
    return study.ok() ? study->warnings.text() : std::string();
  };
  EXPECT_THAT(told(kStudy), Not(HasSubstr("E648")));
  const std::string small = test::changed("radius: 6 um", "radius: 1 um", kStudy);
  EXPECT_THAT(told(small), AllOf(HasSubstr("E648"), HasSubstr("0.9 um in one step"), HasSubstr("max_displacement: 0.2")));
  EXPECT_THAT(told(test::changed("domain:", "numerics: {max_displacement: 0.15}\ndomain:", small)), Not(HasSubstr("E648")));
}

TEST(Bodies, WhateverIsInsideAShellMayFluctuate) {
  const std::string shells = test::changed("radius: 40 um}", kAsShell, with("fluctuations: {energy: 4e-18 J}"));
  for (const char* inside :
       {"nucleus: {kind: rigid, radius: 3 um}", "nucleus: {kind: shell, radius: 3 um, lamina: {young: 1 kPa}, bulk_modulus: 5 kPa}",
        "cytoskeleton: {cortex_links: {number: 40, stiffness: 0.01 mN/m}}"})
    EXPECT_TRUE(test::read(test::changed("nodes: 162", std::string("nodes: 162\n      ") + inside, shells)).ok()) << inside;
}

TEST(Bodies, ShellsThatWaitAreToldWhereverTheyComeFrom) {
  const std::string cycle = with("cycle: {duration: 18 h, shells: wait}");
  EXPECT_THAT(test::warnings_of(cycle), Not(HasSubstr("E646")));
  const std::string by_entry = test::warnings_of(test::changed("radius: 40 um}", kAsShell, cycle));
  EXPECT_THAT(by_entry, HasSubstr("[E646]"));
  EXPECT_THAT(by_entry, HasSubstr("study.yaml:8:37"));
  const std::string coupling = "coupling:\n  ";
  EXPECT_THAT(test::warnings_of(cycle + coupling + "regions: [{name: core, shape: sphere, radius: 10 um, as: shell}]\n"),
              HasSubstr("[E646]"));
  EXPECT_THAT(test::warnings_of(cycle + coupling + "triggers: [{promote: pressure > 1 kPa, demote: pressure < 500 Pa}]\n"),
              HasSubstr("[E646]"));
  EXPECT_THAT(test::warnings_of(test::changed("radius: 6 um", "radius: 6 um\n    body: shell", cycle)), HasSubstr("[E646]"));
}

TEST(Bodies, RulesThatNobodyMeetsAreToldWithWhere) {
  const auto of_trigger = [](const std::string& promote, const std::string& demote) {
    return test::warnings_of(std::string(kStudy) + "coupling: {triggers: [{promote: " + promote + ", demote: " + demote + "}]}\n");
  };
  EXPECT_THAT(of_trigger("contact_share > 2", "contact_share < 1"),
              AllOf(HasSubstr("no cell ever has `contact_share > 2`"), HasSubstr("[E694]")));
  EXPECT_THAT(of_trigger("age < 0 h", "age > 1 h"), HasSubstr("[E694]"));
  EXPECT_THAT(of_trigger("age > -1 h", "age < -2 h"), HasSubstr("every cell has `age > -1 h`"));
  EXPECT_THAT(of_trigger("packing < 0 %", "packing > 10 %"), HasSubstr("[E694]"));
  EXPECT_THAT(of_trigger("age > 2 h", "age < 0 h"), Not(HasSubstr("E694"))) << "a cell that stays a shell";
  EXPECT_THAT(of_trigger("pressure < -1 kPa", "pressure > 0 kPa"), Not(HasSubstr("E694")));
  const auto of_region = [](const std::string& from) {
    return test::warnings_of(std::string(kStudy) + "coupling: {regions: [{name: late, shape: everything, as: shell, from: " + from +
                             "}]}\n");
  };
  EXPECT_THAT(of_region("1000 h"), AllOf(HasSubstr("region 'late' begins at 1000 h, and the run ends at"), HasSubstr("[E694]")));
  EXPECT_THAT(of_region("0 h"), Not(HasSubstr("E694")));
}

TEST(Bodies, ShellsThatDivideAreNotWarnedOf) {
  EXPECT_EQ(test::warnings_of(test::changed("radius: 40 um}", kAsShell, with("cycle: {duration: 18 h}"))), "");
}

TEST(Bodies, AMeshThatIsTooCoarseToDivideIsToldWithOneThatIsNot) {
  const std::string divides = test::changed("radius: 40 um}", kAsShell, with("cycle: {duration: 18 h}"));
  const std::string told = test::warnings_of(test::changed("nodes: 162", "nodes: 42", divides));
  EXPECT_THAT(told, HasSubstr("[E650]"));
  EXPECT_THAT(told, HasSubstr("nodes: 162"));
  const std::string waits = test::changed("radius: 40 um}", kAsShell, with("cycle: {duration: 18 h, shells: wait}"));
  EXPECT_THAT(test::warnings_of(test::changed("nodes: 162", "nodes: 42", waits)), Not(HasSubstr("E650")));
}

TEST(Bodies, ALawWhoseRangeDivisionsLeaveIsToldWithOneThatHolds) {
  const std::string divides = test::changed("radius: 40 um}", kAsShell, with("cycle: {duration: 18 h}"));
  const auto with_law = [&](const std::string& law, const std::string& study) {
    return test::warnings_of(test::changed("nodes: 162", "nodes: 162\n      cortex: {elastic: " + law + "}", study));
  };
  EXPECT_THAT(with_law("stvk", divides),
              AllOf(HasSubstr("beyond the range of st_venant_kirchhoff"), HasSubstr("neo_hooke"), HasSubstr("[E696]")));
  EXPECT_THAT(with_law("neo_hooke", divides), Not(HasSubstr("E696")));
  const std::string waits = test::changed("radius: 40 um}", kAsShell, with("cycle: {duration: 18 h, shells: wait}"));
  EXPECT_THAT(with_law("stvk, young: 50 kPa", waits), Not(HasSubstr("E696")));
  const std::string pulled = with_law("stvk, young: 1 kPa, thickness: 200 nm, tension: 0.2 mN/m", waits);
  EXPECT_THAT(pulled, AllOf(HasSubstr("is 1 of E h"), HasSubstr("a `young` of 7 kPa"), HasSubstr("[E696]")));
  EXPECT_THAT(with_law("stvk, young: 7 kPa, thickness: 200 nm, tension: 0.2 mN/m", waits), Not(HasSubstr("E696")))
      << "what the help says helps";
}

TEST(Bodies, ShellsThatOnlyGrowAreNotWarnedOf) {
  const std::string grows =
      test::changed("radius: 40 um}", "radius: 40 um, as: shell, age: birth}", with("cycle: {duration: 18 h, shells: wait}"));
  EXPECT_THAT(test::warnings_of(grows), Not(HasSubstr("E646")));
  EXPECT_THAT(test::warnings_of(test::changed("10 h", "20 h", grows)), HasSubstr("E646"));
}

/// cbm.md §2, reference pair: R 5 µm, E 450 Pa, ν 0.4, W 0.1 nN/µm: a_0 = 3.207104, δ_0 = 1.371402 µm.
TEST(Bodies, ARestingContactIsThatOfTheReferencePair) {
  const cbm::SphereParameters sphere{.young = 0.45, .poisson = 0.4};
  const cbm::RestingContact rest = cbm::resting_contact(sphere, 5.0, sphere, 5.0, 0.1);
  EXPECT_NEAR(rest.radius_ratio, 3.207104 / 5.0, 1e-7);
  EXPECT_NEAR(rest.overlap_ratio, 1.371402 / 10.0, 1e-7);
  EXPECT_NEAR(rest.covered, 12.0 * 32.31290 / (4.0 * std::numbers::pi * 25.0), 1e-6);
  const cbm::RestingContact unequal = cbm::resting_contact({.young = 0.45, .poisson = 0.4}, 5.0, {.young = 1.0, .poisson = 0.3}, 6.5, 0.05);
  EXPECT_NEAR(unequal.radius_ratio, 2.502701533 / 5.0, 1e-9);
  EXPECT_NEAR(unequal.overlap_ratio, 0.738773560 / 11.5, 1e-9);
}

TEST(Bodies, DefaultsLieWithinTheRangeOfJkr) {
  EXPECT_EQ(test::warnings_of(test::changed("radius: 40 um}", "radius: 40 um, as: sphere}", kStudy)), "");
  const CellType type = test::read(kStudy)->model.types[0];
  const cbm::RestingContact rest = cbm::resting_contact(type.sphere, 6.0, type.sphere, 6.0, test::read(kStudy)->model.pair(0, 0).adhesion);
  EXPECT_NEAR(rest.radius_ratio, 0.40, 0.005);
  EXPECT_LT(rest.overlap_ratio, 0.06);
  EXPECT_LT(rest.covered, 0.5);
  EXPECT_NEAR(type.sphere.young / (3.0 * (1.0 - 2.0 * type.sphere.poisson)), type.shell.bulk_modulus, 1e-12) << "one material";
}

/// The default of before: a_0/R = 0.604, 12.1 % of overlap, 3·0.604² = 1.09 of the surface.
TEST(Bodies, AdhesionBeyondJkrIsToldWithItsNumbers) {
  const std::string soft = test::warnings_of(with("cbm: {young: 450 Pa}"));
  EXPECT_THAT(soft, HasSubstr("[E647]"));
  EXPECT_THAT(soft, HasSubstr("study.yaml:8:18"));
  EXPECT_THAT(soft, HasSubstr("0.6 R"));
  EXPECT_THAT(soft, HasSubstr("12 %"));
  EXPECT_THAT(soft, HasSubstr("109 %"));
  EXPECT_THAT(soft, HasSubstr("1.6 kPa"));
  EXPECT_THAT(test::warnings_of(with("cbm: {young: 1.6 kPa}")), Not(HasSubstr("E647"))) << "what the help says helps";
  EXPECT_THAT(test::warnings_of(with("adhesion: {cell: 2e-4 J/m^2}")), HasSubstr("[E647]"));
  const auto unlike = [](const char* stiff, const char* soft_one) {  // that adhere to each other alone
    return test::changed(
        "  cell:\n",
        std::string("  other: {radius: 4 um, adhesion: {cell: 1e-4 J/m^2, other: 0 J/m^2}, cbm: {young: ") + soft_one + "}}\n  cell:\n",
        test::changed("  - {type: cell,", "  - {type: other, at: [[60 um, 0 um, 0 um]]}\n  - {type: cell,",
                      with(std::string("adhesion: {cell: 0 J/m^2}\n    cbm: {young: ") + stiff + "}")));
  };
  EXPECT_THAT(test::warnings_of(unlike("1.5 kPa", "0.7 kPa")), AllOf(HasSubstr("[E647]"), HasSubstr("`cbm.young` of 3.4 kPa for both")));
  EXPECT_THAT(test::warnings_of(unlike("3.4 kPa", "3.4 kPa")), Not(HasSubstr("E647"))) << "what the help says helps";
  EXPECT_THAT(test::warnings_of(with("cbm: {young: 450 Pa, law: hertz}")), Not(HasSubstr("E647")));
  EXPECT_THAT(test::warnings_of(test::changed("radius: 40 um}", kAsShell, with("cbm: {young: 450 Pa}"))), Not(HasSubstr("E647")));
}

/// A ball by Hertz's law lets a plane through its middle at 4/3 E/(1 − ν²) R²: 86 nN of the default 6 µm and 1.5 kPa.
TEST(Bodies, ForcesThatGoThroughSpheresAreWarnedOf) {
  const auto with_force = [](const std::string& force, const std::string& body) {
    return test::warnings_of(
        one_cell("radius: 6 um, body: " + body, "loads: {push: {type: cell, body_force: [0 nN, " + force +
                                                    ", 0 nN], course: [{time: 0 s, factor: 0}, {time: 1 min, factor: -2}]}}\n"));
  };
  EXPECT_THAT(with_force("30 nN", "sphere"),
              AllOf(HasSubstr("a force of 60 nN on a sphere of 'cell'"), HasSubstr("at 85.7 nN it passes"), HasSubstr("[E707]")));
  EXPECT_THAT(with_force("20 nN", "sphere"), Not(HasSubstr("E707")));
  EXPECT_THAT(with_force("30 nN", "shell"), Not(HasSubstr("E707")));
}

/// 0.4 of the default modulus of 2.5 kPa; 500 Pa are 0.2 of it.
TEST(Bodies, GrowthOfSpheresInMouldsIsWarnedOfWhereItGoesOnForLong) {
  const auto with_growth = [](const std::string& type, const std::string& more = "") {
    return test::warnings_of(test::changed(
        "end: 1 h", "end: 72 h",
        one_cell("radius: 5 um, cycle: {duration: 18 h}" + type, "geometry: {mould: {sphere: {radius: 25 um}, side: inside}}\n" + more)));
  };
  const std::string stop = ", inhibit_growth: {pressure_above: 500 Pa}";
  EXPECT_THAT(with_growth(""), AllOf(HasSubstr("spheres of 'cell' grow until they bear 1 kPa, and in a full mould ('mould')"),
                                     HasSubstr("[E708]"), HasSubstr("pressure_above: 500 Pa")));
  EXPECT_THAT(with_growth(stop), Not(HasSubstr("E708")));
  EXPECT_THAT(with_growth(", body: shell"), Not(HasSubstr("E708")));
  EXPECT_THAT(with_growth("", "coupling: {triggers: [{outside_law: 1}]}\n"), Not(HasSubstr("E708")));
}

TEST(Bodies, HollowsThatFitSpheresAreTold) {
  const auto notes_with = [](const std::string& radius) {
    return test::notes_of(one_cell(
        "radius: 6 um",
        "geometry: {tube: {cylinder: {from: [-50 um, 0 um, 0 um], to: [50 um, 0 um, 0 um], radius: " + radius + "}, side: inside}}\n"));
  };
  EXPECT_THAT(notes_with("10 um"), HasSubstr("'tube' is less than twice as wide as spheres of 'cell'"));
  EXPECT_THAT(notes_with("13 um"), Not(HasSubstr("tube")));
}

/// A trap of 10 nN/µm on a sphere of 10 µm and 2e8 N s/m³ has a relaxation time of 25 s.
TEST(Bodies, TrapsFasterThanStepsAreToldToCellsThatFluctuate) {
  const auto notes_with = [](const std::string& more) {
    return test::notes_of(one_cell("radius: 10 um, friction: {medium: 2e8 N s/m^3}, fluctuations: {energy: 4e-18 J" + more + "}",
                                   "loads: {tweezers: {type: cell, trap: {stiffness: 10 mN/m, center: [0 um, 0 um, 0 um]}}}\n"));
  };
  EXPECT_THAT(notes_with(""), HasSubstr("fluctuate in the trap 'tweezers' with a relaxation time of 25 s"));
  EXPECT_THAT(notes_with(", resolve: 25 s"), Not(HasSubstr("tweezers")));
}

/// Drops that wet each other wholly are two halves of one ball: of radius 2^(1/3) R, their centres 3/8 of it from the cut. Without adhesion they touch.
TEST(Bodies, DropsRestWhereTheirBallsAreCut) {
  EXPECT_NEAR(dcm::overlap_of_doublet(0.2, 0.1), 2.0 - 0.75 * std::cbrt(2.0), 1e-12);
  EXPECT_NEAR(dcm::overlap_of_doublet(0.0, 0.1), 0.0, 1e-12);
  EXPECT_EQ(dcm::overlap_of_doublet(0.1, 0.0), 0.0);
}

/// A hybrid whose two bodies rest elsewhere is told so with both distances; not where one body is all that cells have, nor where moduli go together as in decision 0009.
TEST(Bodies, ThatRestElsewhereAreWarnedOf) {
  const auto with = [](const std::string& type, const std::string& body) {
    return test::warnings_of(one_cell(
        type,
        "coupling: {regions: [{name: r, shape: sphere, center: [0 um, 0 um, 0 um], radius: 30 um, margin: 12 um, as: " + body + "}]}\n"));
  };
  const std::string plain = with("radius: 6 um", "shell");
  EXPECT_THAT(plain, HasSubstr("[E651]"));
  EXPECT_THAT(plain, HasSubstr("1.89 R apart"));
  EXPECT_THAT(plain, HasSubstr("1.32 R"));
  EXPECT_THAT(plain, HasSubstr("morula calibrate jkr cell"));
  EXPECT_THAT(with("radius: 6 um", "sphere"), Not(HasSubstr("E651")));
  EXPECT_THAT(with("radius: 11.8 um, cbm: {young: 177 Pa}, dcm: {cortex: {tension: 0.3 mN/m}}", "shell"), Not(HasSubstr("E651")));
}

/// Daughters of a type that is a sphere become one, though all cells of the study begin as shells.
TEST(Bodies, OfFatesThatRestElsewhereAreWarnedOf) {
  const auto with_body = [](const char* body) {
    return test::warnings_of(
        std::string("schema: 1\nstudy: fates\ntime: {end: 3 h}\ndomain: {size: [200 um, 200 um, 200 um]}\ncell_types:\n") +
        "  a: {radius: 6 um, body: shell, cycle: {duration: 2 h, daughters: {fates: [{share: 100 %, types: [a, b]}]}}}\n  b: {radius: 6 "
        "um, body: " +
        body + ", cycle: {model: none}}\ninitial: [{type: a, at: [[0 um, 0 um, 0 um]]}]\n");
  };
  EXPECT_THAT(with_body("sphere"), HasSubstr("two spheres of 'b' rest 1.89 R apart"));
  EXPECT_THAT(with_body("shell"), Not(HasSubstr("E651")));
}

/// Two spheres that are put where they rest: by default a contact of 0.40 R, with 450 Pa one of 0.60 R.
TEST(Bodies, ARunTellsItsContactsBeyondTheRange) {
  const test::Folder folder;
  for (const auto& [young, distance, beyond] : {std::tuple{"1.5 kPa", "11.35", 0.0}, {"450 Pa", "10.54", 1.0}}) {
    const std::string at = std::string("at: [[0 um, 0 um, 0 um], [") + distance + " um, 0 um, 0 um]]}";
    const std::string text = test::changed("count: 10, fill: sphere, radius: 40 um}", at, with(std::string("cbm: {young: ") + young + "}"));
    const auto study = test::read(test::changed("{end: 10 h}", "{end: 10 min, output: 5 min}", text) + "output: {report: false}\n");
    ASSERT_TRUE(study.ok()) << study.error().text();
    RunRequest request;
    request.out = folder.path() / distance;
    request.command = "a test";
    const auto done = run(*study, request, Comm());
    ASSERT_TRUE(done.ok()) << done.error().message;
    EXPECT_EQ(read_series(request.out / "series.csv")->find("contacts_beyond_range")->values.back(), beyond) << young;
  }
}

TEST(Bodies, MethodsTellHowFarAStudyIsWithinJkr) {
  const auto study = test::read(kStudy);
  ASSERT_TRUE(study.ok());
  const std::vector<UsedLaw> laws = used_laws(*study);
  const auto found = std::ranges::find(laws, std::string("jkr_range"), [](const UsedLaw& use) { return use.law.name; });
  ASSERT_NE(found, laws.end());
  for (const LawParameter& parameter : found->law.parameters) EXPECT_NE(used_value(*found, parameter), "not set") << parameter.name;
}

TEST(Bodies, MethodsTellRulesOfPhasesAndTypes) {
  const std::string phases = with("cycle: {model: phases, phases: {G1: 10 h, M: 1 h}}");
  const auto study =
      test::read(phases + "coupling: {triggers: [{phase: M}, {type: cell}, {promote: pressure > 1 kPa, demote: pressure < 600 Pa}]}\n");
  ASSERT_TRUE(study.ok()) << study.error().text();
  std::string told;
  for (const UsedLaw& one : used_laws(*study))
    if (one.purpose.starts_with("exchange of bodies")) told += one.purpose + ": " + one.law.title + "\n";
  EXPECT_EQ(told,
            "exchange of bodies in phase M: Cells in a phase of their cycle are shells, others spheres\n"
            "exchange of bodies of cell: All cells of a type are shells\n"
            "exchange of bodies: Pressure of a cell, averaged over a minute\n");
}

TEST(Bodies, WaterOfTwoBodiesIsToldWhereATypeMayBeBoth) {
  const std::string water = with("osmosis: {permeability: 1e-13 m/s/Pa}");
  EXPECT_THAT(test::warnings_of(water), Not(HasSubstr("E704")));
  EXPECT_THAT(test::warnings_of(water + "coupling: {regions: [{name: core, shape: sphere, radius: 20 um}]}\n"), HasSubstr("E704"));
}

TEST(Bodies, ASphereIsNotMovedByAForceThatItBearsItself) {
  const std::string keys = "polarity: {start: [1, 0, 0]}\n    protrusion: {force: 1 nN, angle: 30 deg, reaction: cell}";
  EXPECT_THAT(test::errors_of(with(keys)), HasSubstr("`reaction: cell` has no effect"));
  EXPECT_TRUE(test::read(with(keys, test::changed("    radius: 6 um", "    body: shell\n    radius: 6 um", kStudy))).ok());
}

/// Before the run concentrations are those that fields begin with, and nothing is known of what presses cells.
TEST(Bodies, WhoBecomesAShellBeforeTheFirstStepIsFoundByWhatIsKnown) {
  const auto told = [](const std::string& rule) {
    const std::string packed = test::changed("count: 10, fill: sphere, radius: 40 um", "count: 40, fill: sphere, radius: 25 um", kStudy);
    return test::notes_of(packed + "fields:\n  o: {diffusion: 1e-9 m^2/s, initial: 1 mM}\ncoupling: {" + rule + "}\n");
  };
  EXPECT_THAT(told("triggers: [{promote: o > 0.6 mM, demote: o < 0.5 mM}]"), HasSubstr("40 cells become shells before the first step"));
  EXPECT_THAT(told("triggers: [{promote: o < 0.6 mM, demote: o > 0.7 mM}]"), Not(HasSubstr("before the first step")));
  EXPECT_THAT(told("regions: [{name: r, shape: level, field: o, level: 0.6 mM, side: below}]"), Not(HasSubstr("before the first step")));
  EXPECT_THAT(told("triggers: [{promote: contact_share < 0.9, demote: contact_share > 0.95}]"), Not(HasSubstr("before the first step")));
}

/// 100 nN s/um^3 at 25 nm/s are 2.5 kPa.
TEST(Bodies, FrictionOfAPlateThatComesNearIsToldSinceItsForceHasNone) {
  const auto told = [](const std::string& keys, const std::string& motion) {
    return test::notes_of(with(keys) + "geometry:\n  lid: {plane: {center: [0 um, 0 um, 45 um], size: 40 um, normal: [0, 0, -1]}" + motion +
                          "}\n");
  };
  const std::string moves = ", motion: {velocity: [0 um/h, 0 um/h, -90 um/h]}";
  EXPECT_THAT(told("", moves),
              AllOf(HasSubstr("'lid' moves by up to 25 nm/s"), HasSubstr("2.5 kPa, which `force_z_lid`"), HasSubstr("1.1e+09 N s/m^3")));
  EXPECT_THAT(told("friction: {obstacle: 1.1e9 N s/m^3}", moves), Not(HasSubstr("force_z_lid")));
  EXPECT_THAT(told("", ""), Not(HasSubstr("force_z_lid")));
}

TEST(Bodies, NoiseThatFoldsTheMeshIsRefused) {
  const auto noisy = [](const char* energy) {
    return test::changed("radius: 40 um}", kAsShell, with(std::string("fluctuations: {energy: ") + energy + "}"));
  };
  EXPECT_TRUE(test::read(noisy("0.15 fJ")).ok()) << "34 deg";
  EXPECT_THAT(test::errors_of(noisy("1 fJ")), AllOf(HasSubstr("[E705]"), HasSubstr("faces of shells"), HasSubstr("at most 0.17")));
  EXPECT_TRUE(test::read(with("fluctuations: {energy: 1 fJ}")).ok()) << "spheres have no mesh";
}

TEST(Bodies, DivideByTheLawOfTheirBody) {
  const auto laws_of = [](const std::string& text) {
    const auto study = test::read(text);
    EXPECT_TRUE(study.ok());
    std::string out;
    if (study.ok())
      for (const UsedLaw& one : used_laws(*study)) out += one.law.name + " ";
    return out;
  };
  const std::string cycle = with("cycle: {duration: 18 h}");
  EXPECT_THAT(laws_of(cycle), AllOf(HasSubstr("instant_division"), Not(HasSubstr("shell_division"))));
  const std::string shells = test::changed("radius: 6 um", "body: shell\n    radius: 6 um", cycle);
  EXPECT_THAT(laws_of(shells), AllOf(HasSubstr("shell_division"), Not(HasSubstr("instant_division"))));
}

}  // namespace
}  // namespace morula::scenarios
