#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "scenarios/run/used_laws.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

constexpr const char* kStudy = R"(schema: 1
study: loaded
time: {end: 1 h, rest: 1e-4 um/s}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  cell: {radius: 6 um}
geometry:
  plate:
    plane: {center: [0 um, 0 um, 20 um], normal: [0, 0, -1], size: 50 um}
    motion: {direction: [0, 0, -2], course: [{time: 0 s, distance: 0 um}, {time: 1 min, distance: 3 um}]}
initial:
  - {type: cell, at: [[0 um, 0 um, 0 um]], as: shell, orientation: aligned}
loads:
  beads:
    type: cell
    pull: {force: 193 pN, axis: [0, 3, 0], part: 2 %, ends: high}
    course: [{time: 0 s, factor: 0}, {time: 10 s, factor: 1}]
)";

TEST(Loads, AreReadInInternalUnits) {
  const auto study = test::read(kStudy);
  ASSERT_TRUE(study.ok()) << study.error().text();
  ASSERT_EQ(study->model.loads.size(), 1u);
  const CellLoad& load = study->model.loads[0];
  EXPECT_EQ(load.what, pull_load());
  EXPECT_DOUBLE_EQ(load.size, 0.193);
  EXPECT_DOUBLE_EQ(load.part, 0.02);
  EXPECT_EQ(load.end, LoadEnd::kHigh);
  EXPECT_DOUBLE_EQ(load.axis.y, 1.0);
  EXPECT_DOUBLE_EQ(load.course.at(5.0), 0.5);
  const ObstacleSpec& plate = study->model.obstacles[0];
  EXPECT_DOUBLE_EQ(plate.way(0.0, 30.0).z, -1.5);
  EXPECT_DOUBLE_EQ(study->time.rest, 1e-4);
  const auto again = test::read(study->resolved_text);
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(again->model.loads[0].axis, load.axis);
  EXPECT_EQ(again->model.obstacles[0].way(0.0, 50.0), plate.way(0.0, 50.0));
  EXPECT_EQ(again->initial[0].orientation, Orientation::kAligned);
  EXPECT_EQ(again->model.loads[0].course.time, load.course.time);
}

TEST(Loads, AreAmongTheLawsThatMethodsName) {
  const auto study = test::read(kStudy);
  ASSERT_TRUE(study.ok()) << study.error().text();
  const std::vector<UsedLaw> laws = used_laws(*study);
  const auto pull = std::ranges::find(laws, std::string("pull"), [](const UsedLaw& use) { return use.law.name; });
  ASSERT_NE(pull, laws.end());
  EXPECT_EQ(pull->purpose, "load beads on cell");
  for (const LawParameter& parameter : pull->law.parameters) EXPECT_NE(used_value(*pull, parameter), "not set") << parameter.name;
  EXPECT_EQ(used_value(*pull, pull->law.parameters[0]), "0.193");
}

TEST(Loads, ThatContradictTheStudyAreRefusedWithTheirPlace) {
  const auto message = [](const std::string& from, const std::string& to) { return test::errors_of(test::changed(from, to, kStudy)); };
  EXPECT_NE(message(", orientation: aligned", "").find("place them with `orientation: aligned`"), std::string::npos);
  EXPECT_NE(message("as: shell", "as: sphere").find("[E520]"), std::string::npos);
  const std::string two = test::changed("  cell: {radius: 6 um}\n", "  cell: {radius: 6 um}\n  other: {like: cell}\n", kStudy);
  const std::string mixed = test::changed("{type: cell, at: [[0 um, 0 um, 0 um]], as: shell, orientation: aligned}",
                                          "{types: {other: 50 %, cell: 50 %}, count: 4, fill: sphere, radius: 15 um, as: sphere}", two);
  EXPECT_NE(test::errors_of(mixed).find("but cells of that type are spheres"), std::string::npos) << "of a mixture, not its first type";
  EXPECT_NE(message("radius: 6 um}\ngeo", "radius: 6 um, cycle: {duration: 18 h}}\ngeo").find("would not keep"), std::string::npos);
  EXPECT_NE(message("type: cell\n", "type: cel\n").find("[E401]"), std::string::npos);
  EXPECT_NE(message("{time: 10 s, factor: 1}", "{time: 0 s, factor: 1}").find("must increase"), std::string::npos);
  EXPECT_NE(message(", {time: 10 s, factor: 1}", "").find("at least two points"), std::string::npos);
  EXPECT_NE(message("axis: [0, 3, 0]", "axis: [0, 0, 0]").find("has no direction"), std::string::npos);
  EXPECT_NE(message("    course: [{time: 0 s, f", "    pressure: {value: 1 Pa}\n    course: [{time: 0 s, f").find("more than one kind"),
            std::string::npos);
  EXPECT_NE(message("    pull: {force: 193 pN, axis: [0, 3, 0], part: 2 %, ends: high}\n", "").find("says nothing of a force"),
            std::string::npos);
  EXPECT_NE(message("force: 193 pN", "force: 193 Pa").find("[E203]"), std::string::npos);
}

TEST(Loads, OnWholeSpheresAreFine) {
  const auto study =
      test::read(test::changed("pull: {force: 193 pN, axis: [0, 3, 0], part: 2 %, ends: high}", "body_force: [0 nN, 0 nN, -1 nN]",
                               test::changed("as: shell, orientation: aligned", "as: sphere", kStudy)));
  ASSERT_TRUE(study.ok()) << study.error().text();
  EXPECT_DOUBLE_EQ(study->model.loads[0].force.z, -1.0);
}

constexpr const char* kPull = "pull: {force: 193 pN, axis: [0, 3, 0], part: 2 %, ends: high}";

/// The study with another load, and a mark that the cell may carry.
std::string with_load(const std::string& load) {
  const std::string marked = "marks: {apical: {types: [cell], cone: {toward: [0 um, 0 um, 90 um], angle: 60 deg}}}\nloads:\n";
  return test::changed("loads:\n", marked, test::changed(kPull, load, kStudy));
}

TEST(Loads, APatchIsAForceOnASideOrOnMarkedFaces) {
  const auto study = test::read(with_load("patch: {force: [0 nN, 2 nN, 0 nN], toward: [0, 0, 5], part: 1 %}"));
  ASSERT_TRUE(study.ok()) << study.error().text();
  const CellLoad& load = study->model.loads[0];
  EXPECT_EQ(load.what, patch_load());
  EXPECT_EQ(load.force, (Vec3d{0, 2, 0}));
  EXPECT_EQ(load.axis, (Vec3d{0, 0, 1}));
  EXPECT_EQ(load.end, LoadEnd::kHigh);
  EXPECT_EQ(load.part, 0.01);
  EXPECT_EQ(load.mark, -1);

  const auto marked = test::read(with_load("patch: {force: [0 nN, 2 nN, 0 nN], marked: apical}"));
  ASSERT_TRUE(marked.ok()) << marked.error().text();
  EXPECT_EQ(marked->model.loads[0].mark, 0);
  const auto again = test::read(marked->resolved_text);
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(again->model.loads[0].mark, 0);
}

TEST(Loads, APressureMayChangeInSpaceAndActOnMarkedFaces) {
  const auto study =
      test::read(with_load("pressure: {value: 10 Pa, gradient: [0 Pa/um, 0 Pa/um, -2 Pa/um], origin: [1 um, 2 um, 3 um], marked: apical}"));
  ASSERT_TRUE(study.ok()) << study.error().text();
  const CellLoad& load = study->model.loads[0];
  EXPECT_DOUBLE_EQ(load.size, 0.01);
  EXPECT_DOUBLE_EQ(load.gradient.z, -0.002);
  EXPECT_EQ(load.origin, (Vec3d{1, 2, 3}));
  EXPECT_EQ(load.mark, 0);
  const auto again = test::read(study->resolved_text);
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(again->model.loads[0].gradient, load.gradient);
  EXPECT_EQ(again->model.loads[0].mark, 0);
}

TEST(Loads, OnMarkedFacesAreRefusedWhereTheyContradictThemselves) {
  const auto message = [](const std::string& load) { return test::errors_of(with_load(load)); };
  EXPECT_NE(message("patch: {force: [0 nN, 2 nN, 0 nN], toward: [0, 0, 1], marked: apical}").find("[E594]"), std::string::npos);
  EXPECT_NE(message("patch: {force: [0 nN, 2 nN, 0 nN], part: 3 %, marked: apical}").find("[E594]"), std::string::npos);
  EXPECT_NE(message("pressure: {value: 10 Pa, part: 3 %, marked: apical}").find("[E594]"), std::string::npos);
  const std::string unknown = message("pressure: {value: 10 Pa, marked: apicall, part: 100 %}");
  EXPECT_NE(unknown.find("did you mean `apical`"), std::string::npos) << unknown;
  EXPECT_EQ(unknown.find("orientation"), std::string::npos) << "where it acts is not known yet";
  EXPECT_NE(message("pressure: {value: 10 Pa, origin: [1 um, 0 um, 0 um]}").find("'origin' has no effect here [E515]"), std::string::npos);
  EXPECT_NE(message("pressure: {value: 10 Pa, ends: high}").find("'ends' has no effect here [E515]"), std::string::npos);
  EXPECT_NE(message("pressure: {value: 10 Pa, axis: [0, 1, 0]}").find("'axis' has no effect here [E515]"), std::string::npos);
  EXPECT_NE(message("patch: {toward: [0, 0, 1]}").find("force"), std::string::npos);
  const std::string other = test::changed("types: [cell]", "types: [other]", with_load("pressure: {value: 10 Pa, marked: apical}"));
  EXPECT_NE(
      test::errors_of(test::changed("  cell: {radius: 6 um}\n", "  cell: {radius: 6 um}\n  other: {radius: 6 um}\n", other)).find("[E580]"),
      std::string::npos);
  // Of a type that does not exist nothing else is said, and nothing is looked up.
  const std::string nobody = test::changed("type: cell\n", "type: cel\n", with_load("pressure: {value: 10 Pa, marked: apical}"));
  EXPECT_NE(test::errors_of(nobody).find("[E401]"), std::string::npos);
  EXPECT_EQ(test::errors_of(nobody).find("[E580]"), std::string::npos) << test::errors_of(nobody);
  const std::string periodic = with_load("pressure: {value: 10 Pa, gradient: [0 Pa/um, 0 Pa/um, 2 Pa/um]}");
  EXPECT_NE(test::errors_of(test::changed("size: [100 um, 100 um, 100 um]", "size: [100 um, 100 um, 100 um], boundary: periodic", periodic))
                .find("[E570]"),
            std::string::npos);
}

constexpr const char* kGrip =
    "grip: {stiffness: 5 mN/m, center: [0 um, 0 um, 1 um], axis: [0, 0, 2], ends: low, way: [{time: 1 s, distance: 0 um}, {time: 2 s, "
    "distance: 3 um}]}";

TEST(Loads, GripsAreReadAndHoldPlacesOfTheLaboratoryOnly) {
  const std::string text = test::changed("pull: {force: 193 pN, axis: [0, 3, 0], part: 2 %, ends: high}", kGrip, kStudy);
  const auto study = test::read(text);
  ASSERT_TRUE(study.ok()) << study.error().text();
  const CellLoad& load = study->model.loads[0];
  EXPECT_EQ(load.what, grip_load());
  EXPECT_DOUBLE_EQ(load.size, 5.0);
  EXPECT_DOUBLE_EQ(load.part, 0.1);
  EXPECT_DOUBLE_EQ(load.center.z, 1.0);
  EXPECT_DOUBLE_EQ(load.way.at(1.5), 1.5);
  const auto again = test::read(study->resolved_text);
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(again->model.loads[0].way.value, load.way.value);
  EXPECT_NE(test::errors_of(test::changed("size: [100 um, 100 um, 100 um]", "size: [100 um, 100 um, 100 um], boundary: periodic", text))
                .find("[E570]"),
            std::string::npos);
  EXPECT_NE(test::errors_of(test::changed(", orientation: aligned", "", text)).find("[E520]"), std::string::npos);
}

TEST(Loads, GripsAreForCellsThatStayAsTheyAre) {
  const std::string text = test::changed("pull: {force: 193 pN, axis: [0, 3, 0], part: 2 %, ends: high}", kGrip, kStudy);
  const auto with = [&](const std::string& triggers) { return text + "coupling: {triggers: [" + triggers + "]}\n"; };
  EXPECT_NE(test::errors_of(with("{promote: pressure > 1 kPa, demote: pressure < 0.5 kPa}")).find("a cell that changes its body"),
            std::string::npos);
  const auto others = test::read(test::changed("cell_types:\n", "cell_types:\n  other: {radius: 5 um}\n", with("{type: other}")));
  EXPECT_TRUE(others.ok()) << others.error().text() << "only cells of another type do";
}

TEST(Loads, SuctionActsWithinACylinder) {
  const std::string text =
      test::changed("pull: {force: 193 pN, axis: [0, 3, 0], part: 2 %, ends: high}",
                    "pressure: {value: -50 Pa, within: {from: [0 um, 0 um, 4 um], to: [0 um, 0 um, 9 um], radius: 2 um}}", kStudy);
  const auto study = test::read(text);
  ASSERT_TRUE(study.ok()) << study.error().text();
  EXPECT_TRUE(study->model.loads[0].within);
  EXPECT_DOUBLE_EQ(study->model.loads[0].size, -0.05);
  EXPECT_NE(test::errors_of(test::changed("to: [0 um, 0 um, 9 um]", "to: [0 um, 0 um, 4 um]", text)).find("same point"), std::string::npos);
}

TEST(Loads, ThatCellsLoseAsSpheresAreTold) {
  const auto told = [](const std::string& load, const std::string& coupling) {
    const auto study = test::read(
        "schema: 1\nstudy: lost\ntime: {end: 1 h}\ndomain: {size: [80 um, 80 um, 80 um]}\n"
        "cell_types: {cell: {radius: 6 um, body: shell}}\ninitial: [{type: cell, at: [[0 um, 0 um, 0 um]]}]\n"
        "loads: {l: {type: cell, " +
        load + "}}\n" + coupling);
    return study.ok() ? study->warnings.text() : study.error().text();
  };
  const std::string region = "coupling: {regions: [{name: r, shape: everything, as: sphere, from: 20 min}]}\n";
  EXPECT_THAT(told("pressure: {value: 100 Pa}", region),
              testing::AllOf(testing::HasSubstr("while they are spheres they bear nothing of it"), testing::HasSubstr("[E520]")));
  EXPECT_THAT(told("pressure: {value: 100 Pa}", ""), testing::Not(testing::HasSubstr("E520")));
  EXPECT_THAT(told("body_force: [1 nN, 0 nN, 0 nN]", region), testing::Not(testing::HasSubstr("E520")));
}

TEST(Loads, SuctionHasNoImages) {
  const std::string within =
      "schema: 1\nstudy: images\ntime: {end: 1 h}\ndomain: {size: [80 um, 80 um, 80 um], boundary: {x: periodic}}\n"
      "cell_types: {cell: {radius: 6 um, body: shell}}\ninitial: [{type: cell, at: [[0 um, 0 um, 0 um]]}]\n"
      "loads: {l: {type: cell, pressure: {value: 1 Pa, within: {from: [0 um, 0 um, 0 um], to: [9 um, 0 um, 0 um], "
      "radius: 3 um}}}}\n";
  EXPECT_NE(test::errors_of(within).find("[E570]"), std::string::npos);
}

TEST(Obstacles, BeginWhereTheirShapeSays) {
  const std::string jumps = test::changed("course: [{time: 0 s, distance: 0 um}", "course: [{time: 0 s, distance: 2 um}", kStudy);
  EXPECT_NE(test::errors_of(jumps).find("this course has it 2 um from there at first"), std::string::npos);
}

TEST(Loads, SpringsWithANegativeFactorAreRefused) {
  for (const char* spring : {"trap: {stiffness: 1 mN/m, center: [0 um, 0 um, 0 um]}",
                             "grip: {stiffness: 1 mN/m, axis: [1, 0, 0], part: 5 %, center: [0 um, 0 um, 0 um]}"}) {
    const std::string text = test::changed("pull: {force: 193 pN, axis: [0, 3, 0], part: 2 %, ends: high}", spring, kStudy);
    EXPECT_TRUE(test::read(text).ok()) << test::errors_of(text);
    EXPECT_NE(test::errors_of(test::changed("factor: 1}", "factor: -1}", text)).find("has a factor below 0"), std::string::npos) << spring;
  }
}

TEST(Obstacles, ThatEndAtAPeriodicFaceAreWarnedOf) {
  const auto told = [](const std::string& size, const char* boundary) {
    return test::warnings_of(
        test::changed("size: [100 um, 100 um, 100 um]}", std::string("size: [100 um, 100 um, 100 um], boundary: {") + boundary + "}}",
                      test::changed("size: 50 um}", "size: " + size + "}",
                                    test::changed("loads:\n  beads:\n    type: cell\n    pull: {force: 193 pN, axis: [0, 3, 0], part: 2 %, "
                                                  "ends: high}\n    course: [{time: 0 s, factor: 0}, {time: 10 s, factor: 1}]\n",
                                                  "", kStudy))));
  };
  EXPECT_EQ(told("50 um", "x: periodic").find("E697"), std::string::npos) << "far from the faces";
  EXPECT_EQ(told("99 um", "x: periodic").find("E697"), std::string::npos) << "it has images";
  EXPECT_NE(told("100 um", "x: periodic").find("'plate' is as long as the domain and ends near a periodic face across x"),
            std::string::npos);
  EXPECT_NE(told("100 um", "x: periodic").find("let it reach 6 um beyond the domain"), std::string::npos);
  EXPECT_EQ(told("114 um", "x: periodic").find("E697"), std::string::npos) << "the same everywhere";
  EXPECT_EQ(told("100 um", "z: wall").find("E697"), std::string::npos);
}

}  // namespace
}  // namespace morula::scenarios
