#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "tests/system/morula_command.h"
#include "tests/system/studies.h"

namespace morula::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const char* const kVerbs[] = {"new",     "check", "run",    "resume", "status",    "list",  "info",
                              "explain", "plot",  "export", "verify", "calibrate", "doctor"};

TEST(CommandLine, VersionIsOneLineAndTheLicenceAnotherOnStandardOutput) {
  const TestFolder folder;
  const Outcome outcome = run_morula({"--version"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
  EXPECT_THAT(outcome.out, StartsWith("morula 0."));
  const std::size_t end = outcome.out.find('\n');
  EXPECT_EQ(outcome.out.find('\n', end + 1), outcome.out.size() - 1);
  const char* const licence =
      kCanRemesh ? "licence: GPL-3.0-or-later as a whole (source: BSD-3-Clause;" : "licence: BSD-3-Clause (built without";
  EXPECT_THAT(outcome.out.substr(end + 1), StartsWith(licence));
  EXPECT_EQ(outcome.err, "");
}

TEST(CommandLine, EveryHelpEndsWithTwoExamplesThatNameTheVerb) {
  const TestFolder folder;
  for (const char* verb : kVerbs) {
    const Outcome outcome = run_morula({verb, "--help"}, folder.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
    const std::size_t examples = outcome.out.rfind("Examples:\n");
    ASSERT_NE(examples, std::string::npos) << outcome.all();
    int count = 0;
    for (std::size_t at = examples; (at = outcome.out.find(std::string("morula ") + verb, at + 1)) != std::string::npos;) ++count;
    EXPECT_EQ(count, 2) << outcome.out;
  }
  EXPECT_THAT(run_morula({"--help"}, folder.path()).out, HasSubstr("Examples:\n"));
}

TEST(CommandLine, VerifyPrintsTheReferenceNumbersAsJson) {
  const TestFolder folder;
  const Outcome outcome = run_morula({"verify", "--json", "--only", "T4.1", "--only", "T6.1"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
  const auto json = nlohmann::json::parse(outcome.out, nullptr, false);
  ASSERT_TRUE(json.is_object()) << outcome.out;
  EXPECT_EQ(json["suite"], "physics");
  std::set<std::string> ids;
  for (const auto& row : json["rows"]) {
    ids.insert(row["id"]);
    for (const char* key : {"id", "quantity", "reference", "value", "tolerance", "passed", "source"}) EXPECT_TRUE(row.contains(key)) << key;
    EXPECT_TRUE(row["passed"].get<bool>()) << row;
  }
  EXPECT_THAT(ids, ElementsAre("T4.1", "T6.1"));
  const Outcome unknown = run_morula({"verify", "--only", "oxygen"}, folder.path());
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.all(), HasSubstr("has no number 'oxygen'"));
  EXPECT_EQ(run_morula({"verify", "chemistry"}, folder.path()).exit_code, 2);
}

TEST(CommandLine, VerifyListsSuitesAndTheirReferences) {
  const TestFolder folder;
  const Outcome suites = run_morula({"verify", "--list"}, folder.path());
  EXPECT_EQ(suites.exit_code, 0) << suites.all();
  for (const char* name : {"physics  ", "life  ", "hybrid  "}) EXPECT_THAT(suites.out, HasSubstr(name));
  const Outcome physics = run_morula({"verify", "physics", "--list"}, folder.path());
  EXPECT_EQ(physics.exit_code, 0) << physics.all();
  for (const char* text : {"T4.1", "0.168954", "reference"}) EXPECT_THAT(physics.out, HasSubstr(text));
  const auto json = nlohmann::json::parse(run_morula({"verify", "life", "--list", "--json"}, folder.path()).out, nullptr, false);
  ASSERT_TRUE(json.is_object());
  EXPECT_EQ(json["suite"], "life");
  ASSERT_GT(json["rows"].size(), 25u);
  for (const auto& row : json["rows"]) {
    EXPECT_TRUE(row["reference"].is_number()) << row;
    EXPECT_TRUE(row["value"].is_null()) << row;
    EXPECT_TRUE(row["passed"].is_null()) << row;
  }
  const auto all = nlohmann::json::parse(run_morula({"verify", "--list", "--json"}, folder.path()).out, nullptr, false);
  ASSERT_TRUE(all.is_object());
  ASSERT_EQ(all["suites"].size(), 3u);
  EXPECT_EQ(all["suites"][0]["name"], "physics");
  EXPECT_EQ(run_morula({"verify", "life", "--studies"}, folder.path()).exit_code, 2);
  EXPECT_EQ(run_morula({"verify", "physics", "--list", "--studies"}, folder.path()).exit_code, 2);
}

TEST(CommandLine, AnUnknownVerbSuggestsTheNearOne) {
  const TestFolder folder;
  const Outcome outcome = run_morula({"chekc", "study.yaml"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("error: unknown verb 'chekc'"));
  EXPECT_THAT(outcome.err, HasSubstr("help: did you mean `check`?"));
  EXPECT_EQ(outcome.out, "");
}

TEST(CommandLine, AnUnknownFlagSuggestsTheNearOne) {
  const TestFolder folder;
  const Outcome outcome = run_morula({"run", "study.yaml", "--thread", "2"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("'--thread'"));
  EXPECT_THAT(outcome.err, HasSubstr("`--threads`"));
}

TEST(CommandLine, WrongUseIsExitTwo) {
  const TestFolder folder;
  const std::vector<std::vector<std::string>> wrong = {{},
                                                       {"run"},
                                                       {"check"},
                                                       {"explain"},
                                                       {"info"},
                                                       {"export", "run", "pdf"},
                                                       {"run", "study.yaml", "--threads", "0"},
                                                       {"run", "study.yaml", "--threads", "two"},
                                                       {"run", "study.yaml", "--seed", "-1"},
                                                       {"explain", "E999"},
                                                       {"new", "no_such_template"},
                                                       {"explain", "--markdown", "poems"}};
  for (const auto& arguments : wrong) {
    const Outcome outcome = run_morula(arguments, folder.path());
    EXPECT_EQ(outcome.exit_code, 2) << outcome.all();
    EXPECT_THAT(outcome.err, HasSubstr("error: ")) << outcome.all();
    EXPECT_THAT(outcome.err, HasSubstr("help: ")) << outcome.all();
  }
}

TEST(CommandLine, WhatIsMissingIsExitThree) {
  const TestFolder folder;
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{{"check", "missing.yaml"},
                                                                                         {"run", "missing.yaml"},
                                                                                         {"resume", "missing"},
                                                                                         {"status", "missing"},
                                                                                         {"list", "missing"},
                                                                                         {"info", "missing"},
                                                                                         {"plot", "missing"},
                                                                                         {"export", "missing", "csv"}}) {
    const Outcome outcome = run_morula(arguments, folder.path());
    EXPECT_EQ(outcome.exit_code, 3) << outcome.all();
    EXPECT_THAT(outcome.err, HasSubstr("missing")) << outcome.all();
    EXPECT_EQ(outcome.out, "");
  }
}

TEST(CommandLine, NoColourWhereThereIsNoTerminal) {
  const TestFolder folder;
  EXPECT_EQ(run_morula({"check", "missing.yaml"}, folder.path()).err.find('\033'), std::string::npos);
}

TEST(CommandLine, AFullStandardOutputIsNotSuccess) {
  const TestFolder folder;
  CommandOptions options;
  options.shell_before = "exec 1>/dev/full;";
  EXPECT_EQ(run_morula({"explain", "--markdown", "study"}, folder.path(), options).exit_code, 6);
}

TEST(CommandLine, OnSeveralRanksTheRootAloneSpeaksAndAllEndAlike) {
  const TestFolder folder;
  CommandOptions options;
  options.ranks = 2;
  const Outcome good = run_morula({"explain", "E203"}, folder.path(), options);
  EXPECT_EQ(good.exit_code, 0) << good.all();
  EXPECT_EQ(good.out.find("E203"), good.out.rfind("E203"));
  const Outcome bad = run_morula({"run", "missing.yaml"}, folder.path(), options);
  EXPECT_EQ(bad.exit_code, 3) << bad.all();
  EXPECT_EQ(bad.err.find("missing.yaml:"), bad.err.rfind("missing.yaml:")) << bad.err;
  EXPECT_FALSE(bad.timed_out);
}

TEST(Explain, KnowsKeysLawsAndCodes) {
  const TestFolder folder;
  EXPECT_THAT(run_morula({"explain", "E203"}, folder.path()).out, StartsWith("E203: "));
  EXPECT_THAT(run_morula({"explain", "INV.4"}, folder.path()).out, AllOf(StartsWith("INV.4: "), HasSubstr("limit: limits.overlap")));
  EXPECT_THAT(run_morula({"explain", "INV.44"}, folder.path()).err, HasSubstr("did you mean `INV.4`?"));
  EXPECT_THAT(run_morula({"explain", "cell_types.hepatocyte.dcm.cortex.tension"}, folder.path()).out, HasSubstr("example:"));
  EXPECT_THAT(run_morula({"explain", "jkr"}, folder.path()).out, HasSubstr("Johnson"));
  EXPECT_THAT(run_morula({"explain", "--markdown", "laws"}, folder.path()).out, HasSubstr("### `jkr`"));
  EXPECT_THAT(run_morula({"explain", "--markdown", "study"}, folder.path()).out, HasSubstr("## `cell_types.<name>`"));
  EXPECT_THAT(run_morula({"explain", "--markdown", "measures"}, folder.path()).out, HasSubstr("| `cap.angle` |"));
  EXPECT_THAT(run_morula({"explain", "measures"}, folder.path()).out, HasSubstr("contact_area"));
  EXPECT_THAT(run_morula({"explain", "theories"}, folder.path()).out, HasSubstr("youngs_law"));
  EXPECT_THAT(run_morula({"explain", "cap.angle"}, folder.path()).out, HasSubstr("theories: youngs_law"));
  const Outcome near = run_morula({"explain", "jrk"}, folder.path());
  EXPECT_EQ(near.exit_code, 2);
  EXPECT_THAT(near.err, HasSubstr("did you mean `jkr`?"));
  EXPECT_THAT(run_morula({"explain", "lumen"}, folder.path()).err, HasSubstr("did you mean `lumens`?"));
  EXPECT_THAT(run_morula({"help"}, folder.path()).out, HasSubstr("calibrate"));
}

TEST(Info, OfALawAndOfAStudyIsJson) {
  const TestFolder folder;
  const auto law = nlohmann::json::parse(run_morula({"info", "jkr", "--json"}, folder.path()).out);
  EXPECT_EQ(law["law"], "jkr");
  EXPECT_FALSE(law["parameters"].empty());
  folder.write("study.yaml", sphere_study());
  const auto study = nlohmann::json::parse(run_morula({"info", "study.yaml", "--json"}, folder.path()).out);
  EXPECT_EQ(study["study"], "small");
  EXPECT_EQ(study["cells"], 20);
  EXPECT_EQ(study["end"], 7200.0);
  const auto defaults = nlohmann::json::parse(run_morula({"info", "--defaults", "--json"}, folder.path()).out);
  const auto range = std::find_if(defaults.begin(), defaults.end(), [](const auto& row) { return row["key"] == "contact.range"; });
  ASSERT_NE(range, defaults.end());
  EXPECT_EQ((*range)["default"], "0.5 um");
  EXPECT_THAT(run_morula({"info", "study.yaml", "--defaults"}, folder.path()).out, HasSubstr("max_displacement"));
}

TEST(Check, PrintsTheSchemaAsJson) {
  const TestFolder folder;
  const Outcome outcome = run_morula({"check", "--schema"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
  const auto schema = nlohmann::json::parse(outcome.out);
  EXPECT_TRUE(schema["properties"].contains("cell_types"));
}

TEST(Check, GoesThroughAllFilesAndTellsTheWorst) {
  const TestFolder folder;
  folder.write("good.yaml", sphere_study());
  folder.write("bad.yaml", changed(sphere_study(), "seed: 7", "sede: 7"));
  const Outcome outcome = run_morula({"check", "missing.yaml", "bad.yaml", "good.yaml"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 2) << outcome.all();
  EXPECT_EQ(outcome.out, "good.yaml: ok (1 warning)\n");
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("missing.yaml"), HasSubstr("did you mean `seed`?")));
}

TEST(Doctor, FindsWhatARunNeeds) {
  const TestFolder folder;
  const Outcome outcome = run_morula({"doctor", "--json"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["good"], true);
  EXPECT_EQ(json["ranks"], 1);
  std::vector<std::string> names;
  for (const auto& finding : json["findings"]) names.push_back(finding["name"]);
  EXPECT_THAT(names, testing::IsSupersetOf({"mpi", "hdf5", "cores", "memory", "disk", "writing"}));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "the probe file was left behind";
}

TEST(List, OfNoRunsIsAnEmptyJsonList) {
  const TestFolder folder;
  EXPECT_EQ(nlohmann::json::parse(run_morula({"list", "--json"}, folder.path()).out), nlohmann::json::array());
}

TEST(New, ListsTheTemplatesAndEachPassesItsCheck) {
  const TestFolder folder;
  const Outcome list = run_morula({"new"}, folder.path());
  ASSERT_EQ(list.exit_code, 0) << list.all();
  std::istringstream lines(list.out);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const std::string name = line.substr(0, line.find(' '));
    const Outcome made = run_morula({"new", name}, folder.path());
    EXPECT_EQ(made.exit_code, 0) << made.all();
    EXPECT_TRUE(std::filesystem::exists(folder / name / "README.md")) << name;
    const Outcome checked = run_morula({"check", "study.yaml"}, folder / name);
    EXPECT_EQ(checked.exit_code, 0) << name << "\n" << checked.all();
  }
  const Outcome estimated = run_morula({"check", "study.yaml", "--estimate"}, folder / "cluster");
  EXPECT_EQ(estimated.exit_code, 0) << estimated.all();
  EXPECT_THAT(estimated.out, HasSubstr("memory")) << estimated.all();
  EXPECT_GE(count, 3);
}

/// The OpenMP runtime names its settings on standard error when it is loaded; how often a waiting thread looks is one of them.
CommandOptions naming_settings(const std::string& shell_before) {
  CommandOptions options;
  options.environment = {{"OMP_DISPLAY_ENV", "verbose"}};
  options.shell_before = shell_before;
  return options;
}

TEST(Threads, WaitBrieflyThenSleep) {
  const TestFolder folder;
  const Outcome outcome = run_morula({"list"}, folder.path(), naming_settings("unset OMP_WAIT_POLICY GOMP_SPINCOUNT;"));
  EXPECT_THAT(outcome.err, HasSubstr("GOMP_SPINCOUNT = '10000'"));
}

TEST(Threads, WaitAsTheUserSays) {
  const TestFolder folder;
  const Outcome outcome = run_morula({"list"}, folder.path(), naming_settings("unset GOMP_SPINCOUNT; export OMP_WAIT_POLICY=active;"));
  EXPECT_THAT(outcome.err, Not(HasSubstr("GOMP_SPINCOUNT = '10000'")));
}

TEST(New, LeavesAnExistingFolderAsItIs) {
  const TestFolder folder;
  folder.write("pair/mine.txt", "mine");
  const Outcome outcome = run_morula({"new", "pair"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 3) << outcome.all();
  EXPECT_THAT(outcome.err, HasSubstr("exists already"));
  EXPECT_EQ(read_text(folder / "pair/mine.txt"), "mine");
  EXPECT_FALSE(std::filesystem::exists(folder / "pair/study.yaml"));
}

TEST(New, SaysWhereAFolderCannotBeMade) {
  const TestFolder folder;
  folder.write("file", "not a folder");
  const Outcome outcome = run_morula({"new", "pair", "file/study"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 3) << outcome.all();
  EXPECT_THAT(outcome.err, HasSubstr("file"));
}

}  // namespace
}  // namespace morula::test
