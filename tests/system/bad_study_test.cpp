// Studies with one thing wrong, given to the real program: the message names the thing, the exit code is right, and nothing is written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/system/morula_command.h"
#include "tests/system/studies.h"

namespace morula::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Checks, then tries to run, a study.yaml in the folder: both must refuse alike, and leave nothing behind.
void expect_refused(const TestFolder& folder, int exit_code, const testing::Matcher<const std::string&>& message) {
  for (const char* verb : {"check", "run"}) {
    const Outcome outcome = run_morula({verb, "study.yaml"}, folder.path());
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.all();
    EXPECT_THAT(outcome.err, message) << verb;
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "runs")) << "a run folder was made for a wrong study";
}

void expect_refused(const std::string& study, int exit_code, const testing::Matcher<const std::string&>& message) {
  const TestFolder folder;
  folder.write("study.yaml", study);
  expect_refused(folder, exit_code, message);
}

std::string with_geometry(const std::string& text) {
  return changed(sphere_study(), "initial:", "geometry:\n  wall: " + text + "\ninitial:");
}
std::string with_csv() {
  return changed(sphere_study(), "{type: round, count: 20, fill: sphere, radius: 20 um, as: sphere}", "{csv: cells.csv}");
}

TEST(BadStudy, UnknownKeyIsNamedWithASuggestion) {
  expect_refused(changed(sphere_study(), "young: 450 Pa", "yuong: 450 Pa"), 2,
                 AllOf(HasSubstr("study.yaml:11:"), HasSubstr("'yuong'"), HasSubstr("[E101]"), HasSubstr("did you mean `young`?")));
}

TEST(BadStudy, DoubleKeyIsRefused) {
  expect_refused(changed(sphere_study(), "seed: 7", "seed: 7\nseed: 8"), 2, AllOf(HasSubstr("study.yaml:4:"), HasSubstr("[E102]")));
}

TEST(BadStudy, MissingUnitIsRefused) {
  expect_refused(changed(sphere_study(), "young: 450 Pa", "young: 450"), 2, AllOf(HasSubstr("[E201]"), HasSubstr("for example")));
}

TEST(BadStudy, WrongUnitIsNamedByItsQuantity) {
  expect_refused(changed(sphere_study(), "young: 450 Pa", "young: 450 mJ/m^2"), 2,
                 AllOf(HasSubstr("[E203]"), HasSubstr("is a pressure"), HasSubstr("surface energy")));
}

TEST(BadStudy, OutOfRangeIsRefused) { expect_refused(changed(sphere_study(), "poisson: 0.4", "poisson: 0.9"), 2, HasSubstr("[E302]")); }

TEST(BadStudy, NotANumberIsRefused) {
  expect_refused(changed(sphere_study(), "young: 450 Pa", "young: nan Pa"), 2, HasSubstr("[E301]"));
  expect_refused(changed(sphere_study(), "mean: 5 um", "mean: inf um"), 2, HasSubstr("[E301]"));
}

TEST(BadStudy, TabInTheIndentationIsRefused) {
  expect_refused(changed(sphere_study(), "    adhesion:", "\tadhesion:"), 2, AllOf(HasSubstr("study.yaml:10:"), HasSubstr("[E105]")));
}

TEST(BadStudy, EmptyFileIsRefused) {
  expect_refused("", 2, HasSubstr("[E107]"));
  expect_refused("# nothing but a comment\n", 2, HasSubstr("[E107]"));
}

TEST(BadStudy, BinaryFileIsRefused) {
  expect_refused(std::string("\x7f"
                             "ELF\0\0\1\2",
                             8),
                 2, HasSubstr("[E604]"));
}

TEST(BadStudy, TextThatIsNotUtf8IsRefused) {
  expect_refused(changed(sphere_study(), "study: small", "study: small\ntitle: caf\xe9"), 2, HasSubstr("[E605]"));
}

TEST(BadStudy, HundredMegabytesAreRefusedBeforeTheyAreRead) {
  const TestFolder folder;
  folder.write("study.yaml", "schema: 1\n");
  std::filesystem::resize_file(folder / "study.yaml", 100'000'000);
  CommandOptions options;
  options.timeout = std::chrono::seconds(10);
  const Outcome outcome = run_morula({"check", "study.yaml"}, folder.path(), options);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.all();
  EXPECT_THAT(outcome.err, HasSubstr("[E603]"));
}

TEST(BadStudy, AFolderInsteadOfAFileIsRefused) {
  const TestFolder folder;
  std::filesystem::create_directory(folder / "study.yaml");
  expect_refused(folder, 2, HasSubstr("[E602]"));
}

TEST(BadStudy, RegionOutsideTheDomainIsRefused) {
  expect_refused(changed(hybrid_study(), "center: [0 um, 0 um, 0 um]", "center: [500 um, 0 um, 0 um]"), 2,
                 AllOf(HasSubstr("[E502]"), HasSubstr("core")));
}

TEST(BadStudy, DemoteNotBelowPromoteIsRefused) {
  expect_refused(
      changed(hybrid_study(), "coupling:\n", "coupling:\n  triggers:\n    - {promote: pressure > 1 kPa, demote: pressure < 1.2 kPa}\n"), 2,
      AllOf(HasSubstr("[E501]"), HasSubstr("flip back and forth")));
}

TEST(BadStudy, AllMistakesAreShownAtOnce) {
  const std::string study =
      changed(changed(changed(sphere_study(), "young: 450 Pa", "yuong: 450 Pa"), "seed: 7", "seed: -7"), "2 h, output", "2, output");
  expect_refused(study, 2, AllOf(HasSubstr("[E101]"), HasSubstr("[E201]"), HasSubstr("study.yaml:3:"), HasSubstr("3 errors in")));
}

TEST(BadStudy, OverridesAreCheckedToo) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  const Outcome outcome = run_morula({"run", "study.yaml", "cell_types.round.cbm.young=12 um"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 2) << outcome.all();
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("[E203]"), HasSubstr("cell_types.round.cbm.young=12 um")));
  EXPECT_EQ(run_morula({"run", "study.yaml", "--until", "2 um"}, folder.path()).exit_code, 2);
  EXPECT_EQ(run_morula({"run", "study.yaml", "--max-wall", "soon"}, folder.path()).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "runs"));
}

TEST(BadStudy, UnknownObservableAndScenarioAreRefused) {
  expect_refused(changed(sphere_study(), "{report: false}", "{report: false, series: [cell_cuont]}"), 2,
                 AllOf(HasSubstr("[E403]"), HasSubstr("cell_count")));
  expect_refused(changed(sphere_study(), "seed: 7", "seed: 7\nscenario: tisue"), 2, AllOf(HasSubstr("[E403]"), HasSubstr("tissue")));
}

TEST(BadStudy, StrictTurnsWarningsIntoErrors) {
  const TestFolder folder;
  folder.write("study.yaml", changed(sphere_study(), "checkpoint: 30 min", "checkpoint: 30 h"));
  const Outcome loose = run_morula({"check", "study.yaml"}, folder.path());
  EXPECT_EQ(loose.exit_code, 0) << loose.all();
  EXPECT_THAT(loose.err, HasSubstr("warning"));
  EXPECT_EQ(run_morula({"check", "study.yaml", "--strict"}, folder.path()).exit_code, 2);
}

TEST(BadStudy, IsFoundInValuesOfTheCommandLineToo) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  EXPECT_EQ(run_morula({"check", "study.yaml", "seed=3"}, folder.path()).exit_code, 0);
  const Outcome estimated = run_morula({"check", "study.yaml", "initial.0.count=17", "--estimate"}, folder.path());
  EXPECT_EQ(estimated.exit_code, 0) << estimated.all();
  EXPECT_THAT(estimated.out, HasSubstr("17 at the start"));
  const Outcome wrong = run_morula({"check", "seed=-3", "study.yaml"}, folder.path());
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("seed"));
  const Outcome slip = run_morula({"check", "study.yaml", "cell_types.rond.radius=6um"}, folder.path());
  EXPECT_EQ(slip.exit_code, 2) << "a typing error makes no second cell type";
  EXPECT_THAT(slip.err, AllOf(HasSubstr("there is no 'rond' in `cell_types` [E110]"), HasSubstr("did you mean `round`?")));
  EXPECT_EQ(run_morula({"check", "seed=3"}, folder.path()).exit_code, 2) << "no study";
}

TEST(BadStudy, WithVeryManyMistakesIsToldByAHundredAndTheirNumber) {
  const TestFolder folder;
  const auto told = [&](int count) {
    std::string keys;
    for (int i = 0; i < count; ++i) keys += "k" + std::to_string(i) + ": 1\n";
    folder.write("study.yaml", sphere_study() + keys);
    const Outcome outcome = run_morula({"check", "study.yaml"}, folder.path());
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_LT(outcome.err.size(), 100000u);
    return outcome.err;
  };
  EXPECT_THAT(told(90000), AllOf(HasSubstr("and 89,900 more"), HasSubstr("90000 errors in 'study.yaml'")));
  // Beyond 200,000 keys and values the rest is not read, and so not counted: that takes seconds.
  EXPECT_THAT(told(400000), AllOf(HasSubstr("[E690]"), HasSubstr("are not read"), HasSubstr("and 99,")));
}

TEST(BadStudy, OfTwoFillsInTheSamePlaceIsNoMistake) {
  const TestFolder folder;
  const std::string fill = "{type: round, count: 20, fill: sphere, radius: 20 um, as: sphere}";
  folder.write("study.yaml", changed(sphere_study(), fill,
                                     "{type: round, count: 9, fill: sphere, radius: 30 um, as: shell}\n  - " +
                                         changed(fill, "radius: 20 um", "radius: 30 um")));
  EXPECT_EQ(run_morula({"check", "study.yaml"}, folder.path()).exit_code, 0);
  const Outcome run = run_morula({"run", "study.yaml", "--until", "10 min"}, folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.all();
}

TEST(BadGeometry, MissingStlIsAMissingFile) {
  expect_refused(with_geometry("{stl: nowhere.stl}"), 3, AllOf(HasSubstr("[E601]"), HasSubstr("nowhere.stl")));
}

TEST(BadGeometry, OpenFlippedAndCrossingSurfacesAreRefused) {
  const TestFolder folder;
  folder.write("study.yaml", with_geometry("{stl: wall.stl, side: inside}"));
  folder.write("wall.stl", cube_stl(100.0, 11));
  expect_refused(folder, 2, AllOf(HasSubstr("[E621]"), HasSubstr("wall.stl")));
  folder.write("wall.stl", cube_stl(100.0, 12, true));
  expect_refused(folder, 2, AllOf(HasSubstr("[E622]"), HasSubstr("wall.stl")));
  folder.write("wall.stl", crossing_stl(100.0));
  expect_refused(folder, 2, AllOf(HasSubstr("[E623]"), HasSubstr("wall.stl")));
  folder.write("wall.stl", "solid nothing\nendsolid nothing\n");
  expect_refused(folder, 2, HasSubstr("[E620]"));
  folder.write("wall.stl", cube_stl(100.0));
  EXPECT_EQ(run_morula({"check", "study.yaml"}, folder.path()).exit_code, 0) << "the whole cube must be accepted";
}

TEST(BadCsv, EveryWrongRowIsNamedByItsLine) {
  const TestFolder folder;
  folder.write("study.yaml", with_csv());
  const auto expect_csv_refused = [&](const std::string& csv, const testing::Matcher<const std::string&>& message) {
    folder.write("cells.csv", csv);
    expect_refused(folder, 2, message);
  };
  expect_csv_refused("x [um],y [um],z [um],type\n0,0,0,round\n12,0,round\n", AllOf(HasSubstr("cells.csv:3:"), HasSubstr("[E611]")));
  expect_csv_refused("x [um],y [um],z [um],type\nNA,0,0,round\n", AllOf(HasSubstr("cells.csv:2:"), HasSubstr("[E612]"), HasSubstr("NA")));
  expect_csv_refused("x [um],y [um],z [um],type\n0,inf,0,round\n", AllOf(HasSubstr("cells.csv:2:"), HasSubstr("[E612]")));
  expect_csv_refused("x [um],y [um],z [um],type\n0,0,0,rund\n", AllOf(HasSubstr("cells.csv:2:"), HasSubstr("[E401]"), HasSubstr("round")));
  expect_csv_refused("x,y,type\n0,0,round\n", AllOf(HasSubstr("cells.csv:1:"), HasSubstr("[E610]")));
  expect_csv_refused("x [um],y [um],z [um],type\n", HasSubstr("[E613]"));
}

TEST(BadCsv, MissingFileIsExitThree) { expect_refused(with_csv(), 3, AllOf(HasSubstr("[E601]"), HasSubstr("cells.csv"))); }

TEST(BadCsv, CoincidentCellsAreNamedAndMovedApart) {
  const TestFolder folder;
  folder.write("study.yaml", with_csv());
  folder.write("cells.csv", "x [um],y [um],z [um],type\n0,0,0,round\n20,0,0,round\n0,0,0,round\n");
  const Outcome outcome = run_morula({"check", "study.yaml"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("2"), HasSubstr("4"), HasSubstr("moved"))) << "the lines of the two cells are named";
}

}  // namespace
}  // namespace morula::test
