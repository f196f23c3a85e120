// Keys that a study gives and nothing in it reads.
#include <gmock/gmock.h>

#include "scenarios/run/used_laws.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string study_of(const std::string& types, const std::string& more = "",
                     const std::string& cells = "{type: a, at: [[0 um, 0 um, 0 um]]}") {
  return R"(schema: 1
study: unused
time: {end: 1 h, output: 1 h, checkpoint: 1 h}
domain: {size: [100 um, 100 um, 100 um]}
cell_types: )" +
         types + R"(
initial:
  - )" + cells +
         "\n" + more;
}

/// What is told of a study whose cells come from this table.
std::string told_of_table(const std::string& table, const std::string& types, const std::string& more = "", const std::string& keys = "") {
  const Folder folder;
  folder.write("cells.csv", table);
  const auto study = read(study_of(types, more, "{csv: cells.csv" + keys + "}"), {}, folder.path());
  return study.ok() ? study->warnings.text() : study.error().text();
}

std::string warnings(const std::string& types, const std::string& more = "") { return warnings_of(study_of(types, more)); }

TEST(UnusedKeys, OfShellsWhereNobodyMakesOne) {
  EXPECT_THAT(warnings("{a: {dcm: {cortex: {tension: 0.2 mN/m, young: 1.5 kPa}}}}"),
              AllOf(HasSubstr("(and 1 more) is of shells, and cells of 'a' are always spheres: it has no effect"), HasSubstr("warning"),
                    HasSubstr("[E515]")));
  EXPECT_EQ(warnings("{a: {body: sphere, dcm: {cortex: {tension: 0.2 mN/m}}}}"), "");
  EXPECT_EQ(warnings("{a: {body: shell, dcm: {cortex: {tension: 0.2 mN/m}}}}"), "");
  EXPECT_THAT(warnings("{a: {dcm: {cortex: {tension: 0.2 mN/m}}}}",
                       "coupling: {regions: [{name: r, shape: sphere, center: [0 um, 0 um, 0 um], radius: 20 um}]}\n"),
              Not(HasSubstr("no effect")));
}

TEST(UnusedKeys, OfAnEndAtRestThatNeverComes) {
  const auto told = [](const std::string& type) {
    return warnings_of(changed("time: {end: 1 h,", "time: {rest: 1e-3 um/s, end: 1 h,", study_of("{a: " + type + "}")));
  };
  EXPECT_THAT(told("{body: sphere, migration: {speed: 20 um/h}}"),
              AllOf(HasSubstr("the run never comes to rest, for cells of 'a' crawl: it has no effect"), HasSubstr("[E515]")));
  EXPECT_EQ(told("{body: sphere}"), "");
}

/// The modulus of spheres and their packing are those of shells where nothing else is said.
TEST(UnusedKeys, DoNotCountTheBulkModulus) {
  EXPECT_EQ(warnings("{a: {dcm: {bulk_modulus: 4 kPa}}}"), "");
  EXPECT_THAT(warnings("{a: {dcm: {bulk_modulus: 4 kPa, nodes: 642}}}"), HasSubstr("`dcm.nodes` is of shells"));
}

TEST(UnusedKeys, OfShellsThatATableMakes) {
  const auto told = [](const std::string& body) {
    return told_of_table("x [um],y [um],z [um],type,model\n0,0,0,a," + body + "\n", "{a: {dcm: {cortex: {tension: 0.2 mN/m}}}}",
                         "contact: {repulsion: 50 kPa/um}\n");
  };
  EXPECT_THAT(told("sphere"), AllOf(HasSubstr("always spheres"), HasSubstr("'repulsion' is of surfaces")));
  EXPECT_THAT(told("shell"), Not(HasSubstr("no effect")));
}

/// A table knows of each type which bodies its cells have: what is of shells only counts where they are, and nobody else is told of them.
TEST(UnusedKeys, OfTypesOfWhichATableMakesNoShell) {
  const std::string table = "x [um],y [um],z [um],type,model\n0,0,0,a,sphere\n30,0,0,b,\n-30,0,0,b,shell\n";
  const std::string told = told_of_table(table, "{a: {dcm: {cortex: {tension: 0.2 mN/m}}}, b: {dcm: {cortex: {tension: 0.2 mN/m}}}}");
  EXPECT_THAT(told, HasSubstr("`dcm.cortex.tension` is of shells, and cells of 'a' are always spheres"));
  EXPECT_THAT(told, Not(HasSubstr("cells of 'b' are always spheres")));
  EXPECT_THAT(told, HasSubstr("two spheres of 'b' rest"));
  EXPECT_THAT(told, Not(HasSubstr("two spheres of 'a' rest")));
  const Folder folder;
  folder.write("cells.csv", table);
  const auto study = read(study_of("{a: {}, b: {}}", "", "{csv: cells.csv}"), {}, folder.path());
  ASSERT_TRUE(study.ok()) << study.error().text();
  std::string methods;
  for (const UsedLaw& one : used_laws(*study)) methods += one.purpose + "\n";
  EXPECT_THAT(methods, HasSubstr("shell of b"));
  EXPECT_THAT(methods, Not(HasSubstr("shell of a")));
  // A cortex that would spread on its like is of those that have one.
  const std::string soft = "cortex: {elastic: none, tension: 0.1 mN/m}}}";
  EXPECT_THAT(told_of_table(table, "{a: {adhesion: {a: 3e-4 J/m^2}, dcm: {" + soft + ", b: {}}"), Not(HasSubstr("[E509]")));
  EXPECT_THAT(told_of_table(table, "{a: {}, b: {adhesion: {b: 3e-4 J/m^2}, dcm: {" + soft + "}"), HasSubstr("[E509]"));
}

TEST(UnusedKeys, SpreadOfTheTensionOfSpheres) {
  const std::string types = "{a: {variation: {tension: 10 %}}}", header = "x [um],y [um],z [um],type,model\n";
  EXPECT_THAT(told_of_table(header + "0,0,0,a,sphere\n", types), HasSubstr("cells of 'a' are always spheres, which have no tension"));
  EXPECT_EQ(told_of_table(header + "0,0,0,a,shell\n", types), "");
}

TEST(UnusedKeys, OfDivisionsOfShellsWhereNobodyMakesOne) {
  EXPECT_THAT(warnings("{a: {cycle: {shells: wait}}}"), HasSubstr("`cycle.shells` is of shells, and cells of 'a' are always spheres"));
  EXPECT_THAT(warnings("{a: {cycle: {new_surface: 1 min}}}"), HasSubstr("`cycle.new_surface` is of shells"));
  EXPECT_THAT(warnings("{a: {body: shell, cycle: {new_surface: 1 min}}}"), Not(HasSubstr("is of shells")));
}

TEST(UnusedKeys, OfGrowthAndAgeWhereNobodyGrows) {
  EXPECT_THAT(warnings("{a: {inhibit_growth: {pressure_above: 800 Pa}}}"),
              HasSubstr("'inhibit_growth' is of cells that grow, and those of 'a' have no cycle: it has no effect"));
  EXPECT_THAT(warnings("{a: {cycle: {}, inhibit_growth: {pressure_above: 800 Pa}}}"), Not(HasSubstr("'inhibit_growth'")));
  const auto of_age = [](const std::string& types) {
    return warnings_of(study_of(types, "", "{type: a, at: [[0 um, 0 um, 0 um]], age: birth}"));
  };
  EXPECT_THAT(of_age("{a: {}}"), HasSubstr("'age' is of cells with a cycle, and none of these has one"));
  EXPECT_THAT(of_age("{a: {}, b: {cycle: {}}}"), HasSubstr("'age' is of cells")) << "which are not among them";
  EXPECT_THAT(of_age("{a: {cycle: {}}}"), Not(HasSubstr("'age'")));
}

/// Daughters that become another body are exchanges, too.
TEST(UnusedKeys, OfExchangeByFates) {
  const std::string types = "{a: {cycle: {duration: 10 min, daughters: {fates: [{share: 100 %, types: [a, b]}]}}}, b: {body: shell}}";
  EXPECT_THAT(warnings(types, "coupling: {max_shells: 1}\n"), Not(HasSubstr("is of rules by which")));
}

/// What a run writes out reads without a warning that the study itself has not.
TEST(UnusedKeys, OfAResolvedStudyAreThoseOfTheStudy) {
  const auto study =
      read(study_of("{a: {body: shell}}",
                    "geometry: {floor: {plane: {center: [0 um, 0 um, -6 um], normal: [0, 0, 1], size: 100 um}}}\n"
                    "marks: {wet: {types: [a], touched_by: floor}, apical: {types: [a], cone: {axis: [0, 0, 1], angle: 60 deg}}}\n"
                    "lumens: {gap: {center: [0 um, 0 um, 9 um], pressure: 5 Pa, faces: apical}}\n"));
  ASSERT_TRUE(study.ok()) << study.error().text();
  const auto again = read(study->resolved_text);
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_THAT(again->warnings.text(), Not(HasSubstr("[E515]")));
  const auto spheres = read(study_of("{a: {}}"));
  ASSERT_TRUE(spheres.ok());
  EXPECT_EQ(warnings_of(spheres->resolved_text), "");
}

TEST(UnusedKeys, OfATypeThatOthersAreLikeAreThoseOfTheOthers) {
  const std::string base = "base: {dcm: {cortex: {tension: 0.2 mN/m}}}";
  EXPECT_EQ(warnings("{" + base + ", a: {like: base, body: shell}}"), "");
  const std::string twice = warnings("{" + base + ", a: {like: base}}");
  EXPECT_THAT(twice, HasSubstr("cells of 'base' are always spheres"));
  EXPECT_THAT(twice, Not(HasSubstr("cells of 'a' are always spheres")));
}

TEST(UnusedKeys, OfExchangeWithoutARule) {
  EXPECT_THAT(warnings("{a: {}}", "coupling: {hold: 20 min, max_shells: 5}\n"),
              AllOf(HasSubstr("'hold' is of rules"), HasSubstr("'max_shells' is of rules")));
  EXPECT_THAT(warnings("{a: {}}", "coupling: {hold: 20 min, triggers: [{outside_law: 1.0}]}\n"),
              HasSubstr("is of regions, and there is none"));
  EXPECT_THAT(warnings("{a: {}}", "coupling: {hold: 20 min, regions: [{name: r, shape: everything}]}\n"), Not(HasSubstr("no effect")));
}

TEST(UnusedKeys, CellsThatAreNamedBeyondTheNumberOfShells) {
  const std::string rule = "coupling: {max_shells: 2, regions: [{name: chosen, shape: cells, as: shell, ids: [";
  const std::string three = "{a: {}}";
  const auto told = [&](const std::string& ids) {
    return warnings_of(changed("[[0 um, 0 um, 0 um]]", "[[0 um, 0 um, 0 um], [20 um, 0 um, 0 um], [40 um, 0 um, 0 um]]",
                               study_of(three, rule + ids + "]}]}\n")));
  };
  EXPECT_THAT(told("1, 2, 3"), HasSubstr("region 'chosen' names 3 cells, and `max_shells` allows 2 shells: the others stay spheres"));
  EXPECT_THAT(told("1, 2"), Not(HasSubstr("the others stay spheres")));
  EXPECT_THAT(told("1, 2, 2"), Not(HasSubstr("the others stay spheres"))) << "one of them twice";
}

TEST(UnusedKeys, OfSurfacesWhereAllAreSpheres) {
  EXPECT_THAT(warnings("{a: {}}", "contact: {points: 4, repulsion: 50 kPa/um}\n"),
              AllOf(HasSubstr("'points' is of surfaces"), HasSubstr("'repulsion' is of surfaces")));
  EXPECT_EQ(warnings("{a: {body: shell}}", "contact: {points: 4, repulsion: 50 kPa/um}\n"), "");
}

TEST(UnusedKeys, AdhesionOfSpheresWhoseLawHasNone) {
  EXPECT_THAT(warnings("{a: {cbm: {law: hertz}, adhesion: {a: 1e-4 J/m^2}}}"),
              HasSubstr("all cells are spheres with `law: hertz`: it has no effect"));
  EXPECT_EQ(warnings("{a: {cbm: {law: hertz}, adhesion: {a: 0 J/m^2}}}"), "");
  EXPECT_EQ(warnings("{a: {cbm: {law: hertz}, body: shell, adhesion: {a: 1e-4 J/m^2}}}"), "");
  EXPECT_EQ(warnings("{a: {adhesion: {a: 1e-4 J/m^2}}}"), "");
}

TEST(UnusedKeys, OfContactsWithWhatIsNotThere) {
  const std::string plane = "geometry: {floor: {plane: {center: [0 um, 0 um, -6 um], normal: [0, 0, 1], size: 100 um}}}\n";
  const std::string rubs = "friction: {obstacle_tangential: 1e10 N s/m^3}", stiff = "cbm: {with_shells: {stiffness: 0.5}}";
  EXPECT_THAT(warnings("{a: {" + rubs + "}}"), HasSubstr("'obstacle_tangential' is of contacts with obstacles, and there are none"));
  EXPECT_EQ(warnings("{a: {" + rubs + "}}", plane), "");
  EXPECT_THAT(warnings("{a: {" + stiff + "}}"), HasSubstr("'with_shells.stiffness' is of contacts with shells, and there are none"));
  EXPECT_EQ(warnings("{a: {" + stiff + ", body: shell}}"), "");
}

TEST(UnusedKeys, OfMarksAndCavities) {
  const std::string plane = "geometry: {floor: {plane: {center: [0 um, 0 um, -6 um], normal: [0, 0, 1], size: 100 um}}}\n";
  const std::string touched = "marks: {wet: {types: [a], touched_by: floor, when: ";
  EXPECT_THAT(warnings("{a: {body: shell}}", plane + touched + "start}}\n"), HasSubstr("whatever 'when' says: it has no effect"));
  EXPECT_EQ(warnings("{a: {body: shell}}", plane + touched + "always}}\n"), "");
  const std::string apical =
      "marks: {apical: {types: [a], cone: {axis: [0, 0, 1], angle: 60 deg}}}\nlumens: {gap: {center: [0 um, 0 um, 9 um], pressure: 5 Pa, ";
  EXPECT_THAT(warnings("{a: {body: shell}}", apical + "faces: apical, reach: 30 um}}\n"), HasSubstr("'reach' is of what is seen"));
  EXPECT_THAT(warnings("{a: {body: shell}}", apical + "reach: 30 um}}\n"), Not(HasSubstr("is of what is seen")));
}

TEST(UnusedKeys, OfCoursesThatBeginWhenTheRunHasEnded) {
  const auto load = [](const std::string& course) {
    return warnings("{a: {body: shell}}", "loads: {pull: {type: a, body_force: [1 nN, 0 nN, 0 nN], course: " + course + "}}\n");
  };
  EXPECT_THAT(load("[{time: 2 h, factor: 0}, {time: 3 h, factor: 1}]"), HasSubstr("this course begins at 2 h, and the run ends at 1 h"));
  EXPECT_EQ(load("[{time: 0 h, factor: 0}, {time: 3 h, factor: 1}]"), "");
}

TEST(UnusedKeys, CoursesWithoutAPointAreRefused) {
  const std::string load = "loads: {pull: {type: a, body_force: [1 nN, 0 nN, 0 nN], course: []}}\n";
  EXPECT_THAT(errors_of(study_of("{a: {}}", load)), AllOf(HasSubstr("'course' is empty"), HasSubstr("[E104]")));
}

TEST(UnusedKeys, AgesBesideThePhasesOfATable) {
  const auto told = [](const std::string& keys) {
    return told_of_table("x [um],y [um],z [um],type,phase\n0,0,0,a,0.5\n", "{a: {cycle: {}}}", "", keys);
  };
  EXPECT_THAT(told(", age: birth"), HasSubstr("'age' has no effect here: all rows of 'cells.csv' have a `phase`"));
  EXPECT_EQ(told(""), "");
}

}  // namespace
}  // namespace morula::scenarios::test
