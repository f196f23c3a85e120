// Checks at the end of a run: what fails is told with exit code 5, what finds nothing to judge has failed, and what was not checked is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/system/morula_command.h"
#include "tests/system/studies.h"

namespace morula::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A run of the library's study `spreading`, ended long before its cells have spread.
class CutShort : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(run_morula({"new", "spreading", "study"}, folder_.path()).exit_code, 0); }
  [[nodiscard]] Outcome run(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"run", "study/study.yaml", "--out", "run", "time.end=4 s", "time.output=2 s", "time.checkpoint=2 s"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_morula(arguments, folder_.path());
  }
  [[nodiscard]] json verdict() const { return json::parse(read_text(folder_ / "run/verdict.json"), nullptr, false); }
  [[nodiscard]] json criterion(const std::string& id) const {
    const json all = verdict();
    for (const json& one : all["criteria"])
      if (one["id"] == id) return one;
    return {};
  }
  TestFolder folder_;
};

TEST_F(CutShort, FailsItsChecksWithExitCode5AndFailedForScriptsAndSoDoesResume) {
  const Outcome outcome = run({"output.report=false"});
  EXPECT_EQ(outcome.exit_code, 5) << outcome.all();
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("done   "), HasSubstr("checks FAILED"), HasSubstr("check S4.1 failed")));
  EXPECT_FALSE(verdict()["passed"].get<bool>());
  EXPECT_FALSE(fs::exists(folder_ / "run/DONE"));
  EXPECT_THAT(read_text(folder_ / "run/FAILED"), HasSubstr("checks failed: S4.1"));
  const json record = json::parse(read_text(folder_ / "run/run.json"));
  EXPECT_EQ(record["state"], "done");
  EXPECT_EQ(record["exit_code"], 5);
  const Outcome again = run_morula({"resume", "run"}, folder_.path());
  EXPECT_EQ(again.exit_code, 5) << again.all();
}

TEST_F(CutShort, FailsACriterionThatFindsNothingToJudge) {
  // One cell is no pair.
  const std::string criteria =
      "criteria=[{id: S4.2, measure: pressure_inside(fluid_050), above: 0 Pa}, {id: T8.1, measure: cap.angle(fluid_050), below: 90 deg}]";
  EXPECT_EQ(run({"output.report=false", criteria}).exit_code, 5);
  const json missing = criterion("T8.1");
  ASSERT_TRUE(missing.is_object()) << verdict();
  EXPECT_FALSE(missing["passed"].get<bool>());
  EXPECT_TRUE(missing["value"].is_null());
  EXPECT_TRUE(criterion("S4.2").is_object());
}

TEST_F(CutShort, IsRefusedWhereACriterionIsAnIdAlone) {
  const Outcome outcome = run_morula({"check", "study/study.yaml", "criteria=[{id: S4.1}]"}, folder_.path());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.all(), AllOf(HasSubstr("'measure'"), HasSubstr("E103")));
}

TEST(UsersStudy, IsJudgedOnItsOwnCriteriaAndSaysSoByItsExitCode) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study() +
                                 "criteria:\n  - {id: MINE, measure: cell_count, above: 20}\n"
                                 "plots:\n  - {name: mine, y: volume(round), title: Volumes of mine}\n");
  const auto run = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"run", "study.yaml", "time.end=20 min"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_morula(arguments, folder.path());
  };
  EXPECT_EQ(run({"--out", "good", "output.report=true"}).exit_code, 0);
  EXPECT_THAT(read_text(folder / "good/report.html"), AllOf(HasSubstr("Volumes of mine"), HasSubstr("MINE")));
  const Outcome failed = run({"--out", "bad", "criteria.0.above=2000"});
  EXPECT_EQ(failed.exit_code, 5) << failed.all();
  EXPECT_THAT(failed.err, HasSubstr("check MINE failed"));
  EXPECT_EQ(json::parse(read_text(folder / "bad/run.json"))["exit_code"], 5);
  const Outcome nothing = run({"--out", "nothing", "criteria.0={id: MINE, measure: shortest_hold, below: 1 h}"});
  EXPECT_EQ(nothing.exit_code, 5) << nothing.all();
  const Outcome wrong = run_morula({"check", "study.yaml", "criteria.0.measure=cell_conut"}, folder.path());
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.all(), AllOf(HasSubstr("did you mean `cell_count`?"), HasSubstr("E410")));
  const Outcome plotted = run_morula({"plot", "good", "--only", "mine"}, folder.path());
  EXPECT_THAT(plotted.out, HasSubstr("mine.svg"));
}

TEST(UsersStudy, GetsNumericalChecksAndIsToldWhatWasNotChecked) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  const Outcome outcome = run_morula({"run", "study.yaml", "--out", "run", "time.end=20 min", "output.report=true"}, folder.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
  EXPECT_THAT(read_text(folder / "run/report.html"),
              AllOf(HasSubstr("<h2>Numerical checks</h2>"), HasSubstr("<h2>Not checked</h2>"), Not(HasSubstr("<h2>Verdict</h2>"))));
  std::vector<std::string> ids;
  const json said = json::parse(read_text(folder / "run/verdict.json"));
  for (const json& one : said["not_checked"]) {
    EXPECT_FALSE(one["why"].get<std::string>().empty());
    ids.push_back(one["id"]);
  }
  // Spheres have no surface that penetrates, and growth drives the energy.
  for (const char* id : {"INV.1", "INV.4", "INV.7"}) EXPECT_THAT(ids, testing::Contains(id));
}

TEST(UsersStudy, IsNotPassedOnATissueThatHasDied) {
  const TestFolder folder;
  folder.write("study.yaml", R"(schema: 1
study: dead
time: {end: 4 h, output: 1 h, checkpoint: 4 h}
domain: {size: [120 um, 120 um, 120 um]}
cell_types: {a: {radius: 6 um, death: {food_below: 1 mM, rate: 1 1/s, shrink_time: 10 min, removed_below: 50 %}}}
initial:
  - {type: a, at: [[0 um, 0 um, 0 um], [11 um, 0 um, 0 um]]}
fields:
  food: {diffusion: 1e-9 m^2/s, initial: 0.1 mM, boundary: {all: 0.1 mM}}
criteria:
  - {id: PRESSURE, measure: mean_pressure, below: 1 kPa}
  - {id: RADIUS, measure: spheroid_radius, below: 100 um}
  - {id: GONE, measure: cell_count, below: 0.5}
output: {report: false}
)");
  const Outcome outcome = run_morula({"run", "study.yaml", "--out", "run"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 5) << outcome.all();
  const json said = json::parse(read_text(folder / "run/verdict.json"));
  std::map<std::string, bool> passed;
  for (const json& one : said["criteria"]) passed[one["id"]] = one["passed"];
  EXPECT_TRUE(passed.at("GONE"));
  EXPECT_FALSE(passed.at("PRESSURE"));
  EXPECT_FALSE(passed.at("RADIUS"));
}

/// What a run judges does not depend on the columns that the user wants to see; what is measured of no nucleus is said.
TEST(UsersStudy, IsJudgedOnItsNucleiWhateverItsSeries) {
  const TestFolder folder;
  folder.write("study.yaml", R"(schema: 1
study: nuclei
time: {end: 2 min, output: 1 min}
domain: {size: [120 um, 120 um, 120 um]}
cell_types: {a: {radius: 6 um, body: shell, dcm: {nodes: 162, nucleus: {kind: shell, radius: 3 um, nodes: 42}}}}
initial:
  - {type: a, at: [[0 um, 0 um, 0 um]]}
output: {report: false, series: [cell_count]}
)");
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "shell"}, folder.path()).exit_code, 0);
  EXPECT_THAT(read_text(folder / "shell/verdict.json"), HasSubstr("how far a node of a nucleus is outside its cortex"));
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "rigid", "cell_types.a.dcm.nucleus={radius: 3 um}"}, folder.path()).exit_code, 0);
  EXPECT_THAT(read_text(folder / "rigid/verdict.json"), HasSubstr("how far rigid nuclei are outside their cortex"));
}

TEST(HybridReport, TellsWhatShellsCostAndWhatAllShellsWould) {
  const TestFolder folder;
  folder.write("study.yaml", R"(schema: 1
study: both
time: {end: 10 min, output: 5 min, checkpoint: 10 min}
domain: {size: [120 um, 120 um, 120 um]}
cell_types: {a: {radius: 6 um}}
initial:
  - {type: a, at: [[0 um, 0 um, 0 um]], as: shell}
  - {type: a, at: [[30 um, 0 um, 0 um], [0 um, 30 um, 0 um], [0 um, 0 um, 30 um]]}
)");
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "both"}, folder.path()).exit_code, 0);
  // One shell of 162 nodes, each worth three spheres, beside three spheres: 486 of 489.
  EXPECT_THAT(read_text(folder / "both/report.html"), AllOf(testing::ContainsRegex("time for its shells, by their load</dt><dd>99"),
                                                            HasSubstr("were all its cells shells, about")));
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "one", "cell_types.a.body=shell", "initial.1.as=shell"}, folder.path()).exit_code, 0);
  EXPECT_THAT(read_text(folder / "one/report.html"), Not(HasSubstr("were all its cells shells")));
}

TEST(Methods, SayWhichValuesTheStudyGaveAndWhereTheOthersComeFrom) {
  const TestFolder folder;
  folder.write("study.yaml", R"(schema: 1
study: lone
time: {end: 20 s, output: 20 s, checkpoint: 20 s}
domain: {size: [60 um, 60 um, 60 um]}
cell_types: {a: {radius: 6 um, body: shell, dcm: {cortex: {tension: 0.2 mN/m}}}}
initial:
  - {type: a, at: [[0 um, 0 um, 0 um]]}
output: {report: false}
)");
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "run"}, folder.path()).exit_code, 0);
  const std::string methods = read_text(folder / "run/methods.md");
  EXPECT_THAT(methods, AllOf(HasSubstr("| tension | 0.2 | nN/µm |"), HasSubstr("| spring_stiffness | 0.173205 |"),
                             Not(HasSubstr("not set")), Not(HasSubstr("the study |"))));
  EXPECT_THAT(methods, AllOf(HasSubstr("tension: 0.2 mN/m\n"), HasSubstr("young: 1 kPa  # default: Van Liedekerke et al., Table 1\n"),
                             HasSubstr("range: 0.5 um  # default: ")));
  // Laws have formulas and units; what a value is by default, and why, they tell as the key of the study does.
  const std::string laws = run_morula({"explain", "--markdown", "laws"}, folder.path()).out;
  EXPECT_THAT(laws, AllOf(HasSubstr("| parameter | unit | what |"), Not(HasSubstr("| the study |"))));
  std::vector<std::string> reference;
  std::istringstream pages(run_morula({"explain", "--markdown", "study"}, folder.path()).out);
  for (std::string line; std::getline(pages, line);) reference.push_back(line);
  int keys = 0;
  std::istringstream rows(laws);
  for (std::string line; std::getline(rows, line);) {
    if (!line.starts_with("| `dcm.")) continue;
    const std::size_t dot = line.find_last_of('.', line.find('`', 3)), end = line.find('`', dot);
    const std::string begin = "| `" + line.substr(dot + 1, end - dot) + " |", tail = line.substr(end + 2);
    const auto agrees = [&](const std::string& row) { return row.starts_with(begin) && row.ends_with(tail); };
    EXPECT_TRUE(std::any_of(reference.begin(), reference.end(), agrees)) << line;
    ++keys;
  }
  EXPECT_GT(keys, 20);
}

}  // namespace
}  // namespace morula::test
