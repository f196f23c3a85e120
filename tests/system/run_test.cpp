// Runs from beginning to end, and what is in their folders.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "tests/system/morula_command.h"
#include "tests/system/run_info.h"
#include "tests/system/studies.h"

namespace morula::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(Run, MakesTheFolderThatThePagePromises) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  const Outcome outcome = run_morula({"run", "study.yaml", "output.report=true", "--timings"}, folder.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
  EXPECT_EQ(outcome.out, "runs/small-0001\n");
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("morula 0.1.0 · small · seed 7 · 1 rank × 1 thread · runs/small-0001"), HasSubstr("100 %"),
                                 HasSubstr("done   "), HasSubstr("checks passed")));
  EXPECT_EQ(outcome.err.find('\r'), std::string::npos) << "no live line where there is no terminal";
  const fs::path run = folder / "runs/small-0001";
  for (const char* name : {"study.yaml", "study.resolved.yaml", "run.json", "status.json", "log.txt", "events.jsonl", "series.csv",
                           "verdict.json", "results.h5", "checkpoints", "methods.md", "report.html", "DONE"})
    EXPECT_TRUE(fs::exists(run / name)) << name;
  EXPECT_FALSE(fs::exists(run / "FAILED"));

  const std::vector<std::string> series = lines_of(read_text(run / "series.csv"));
  EXPECT_EQ(series.size(), 1u + 13u) << "a header, time 0 and every 10 min of 2 h";
  EXPECT_THAT(series[0], testing::StartsWith("time [s],"));
  for (const std::string& line : lines_of(read_text(run / "events.jsonl"))) EXPECT_TRUE(json::parse(line).is_object());

  const json info = info_of(run);
  EXPECT_EQ(info["state"], "done");
  EXPECT_EQ(info["time"], 7200.0);
  EXPECT_EQ(info["cells"], info["spheres"].get<int>() + info["shells"].get<int>());
  EXPECT_GE(info["cells"].get<int>(), 20);
  EXPECT_EQ(info["state_hash"].get<std::string>().size(), 32u);
  EXPECT_EQ(json::parse(run_morula({"status", "runs/small-0001", "--json"}, folder.path()).out)["state"], "done");
  const json list = json::parse(run_morula({"list", "--json"}, folder.path()).out);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0]["study"], "small");
}

TEST(Run, AndResumeUseNoMemoryThatIsFreed) {  // HDF5 frees a driver of results.h5 before it calls its close
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  CommandOptions options;
  options.environment = {{"MALLOC_PERTURB_", "165"}};  // glibc fills what is freed with this byte
  const Outcome half = run_morula({"run", "study.yaml", "--out", "run", "--until", "30 min"}, folder.path(), options);
  ASSERT_EQ(half.exit_code, 0) << half.all();
  const Outcome whole = run_morula({"resume", "run", "--until", "1 h"}, folder.path(), options);
  EXPECT_EQ(whole.exit_code, 0) << whole.all();
}

TEST(Run, NeverWritesIntoAnExistingFolder) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  folder.write("here/mine.txt", "mine");
  const Outcome taken = run_morula({"run", "study.yaml", "--out", "here"}, folder.path());
  EXPECT_EQ(taken.exit_code, 3) << taken.all();
  EXPECT_THAT(taken.err, HasSubstr("here"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "here"), fs::directory_iterator()), 1);
  for (const char* run : {"runs/small-0001", "runs/small-0002"}) {
    const Outcome outcome = run_morula({"run", "study.yaml", "--until", "10 min"}, folder.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
    EXPECT_EQ(outcome.out, std::string(run) + "\n");
  }
}

TEST(Run, SaysWhenAFolderCannotBeWritten) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  folder.write("file", "");
  for (const char* out : {"file/run", "/proc/run"}) {
    const Outcome outcome = run_morula({"run", "study.yaml", "--out", out}, folder.path());
    EXPECT_EQ(outcome.exit_code, 3) << outcome.all();
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("error: "), HasSubstr(fs::path(out).parent_path().string())));
  }
  if (geteuid() == 0) return;  // root may write everywhere
  fs::create_directory(folder / "locked");
  fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  const Outcome outcome = run_morula({"run", "study.yaml", "--out", "locked/run"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 3) << outcome.all();
  EXPECT_THAT(outcome.err, HasSubstr("locked/run"));
}

TEST(Run, NeedsNoFolderThatOtherRunsShare) {
  // Under /proc nobody can make one, as when another run of the same user has just removed it.
  const TestFolder folder;
  CommandOptions options;
  options.environment = {{"TMPDIR", "/proc"}};
  const Outcome outcome = run_morula({"list"}, folder.path(), options);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
}

TEST(Run, DryRunWritesNothing) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  const Outcome outcome = run_morula({"run", "study.yaml", "--dry-run"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
  EXPECT_THAT(outcome.out, HasSubstr("20 at the start"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(Run, OverridesAndFlagsReachTheRun) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  const Outcome outcome =
      run_morula({"run", "study.yaml", "initial.0.count=5", "--seed", "99", "--until", "20 min", "--out", "short"}, folder.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
  const json info = info_of(folder / "short");
  EXPECT_EQ(info["cells"], 5);
  EXPECT_EQ(info["seed"], 99);
  EXPECT_EQ(info["time"], 1200.0);
  EXPECT_THAT(read_text(folder / "short/study.resolved.yaml"), HasSubstr("count: 5"));
}

TEST(Run, CellsThatAreNamedOnTheCommandLineAreShells) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  const Outcome outcome =
      run_morula({"run", "study.yaml", "--promote", "2", "--promote", "5", "--until", "10 min", "--out", "run"}, folder.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
  const std::string events = read_text(folder / "run/events.jsonl");
  std::size_t promotions = 0;
  for (std::size_t at = 0; (at = events.find("\"promotion\"", at)) != std::string::npos; ++at) ++promotions;
  EXPECT_EQ(promotions, 2u) << events;
  EXPECT_THAT(events, HasSubstr("promoted"));
  EXPECT_THAT(read_text(folder / "run/study.resolved.yaml"), HasSubstr("shape: cells"));
  const Outcome wrong = run_morula({"run", "study.yaml", "--promote", "2000"}, folder.path());
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.all(), HasSubstr("there is no cell 2000"));
  const Outcome no_id = run_morula({"run", "study.yaml", "--demote", "x"}, folder.path());
  EXPECT_EQ(no_id.exit_code, 2);
  EXPECT_THAT(no_id.all(), HasSubstr("'x' is not the id of a cell"));
}

TEST(Run, OtherSeedsGiveOtherTissues) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  run_morula({"run", "study.yaml", "--seed", "1", "--until", "10 min", "--out", "one"}, folder.path());
  run_morula({"run", "study.yaml", "--seed", "2", "--until", "10 min", "--out", "two"}, folder.path());
  EXPECT_NE(info_of(folder / "one")["state_hash"], info_of(folder / "two")["state_hash"]);
}

TEST(Run, StopsAtTheWallTimeAndGoesOnToTheSameEnd) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "whole"}, folder.path()).exit_code, 0);
  const Outcome stopped = run_morula({"run", "study.yaml", "--out", "parts", "--max-wall", "1 ms"}, folder.path());
  EXPECT_EQ(stopped.exit_code, 75) << stopped.all();
  EXPECT_THAT(stopped.err, HasSubstr("morula resume parts"));
  EXPECT_EQ(info_of(folder / "parts")["state"], "stopped");
  const Outcome resumed = run_morula({"resume", "parts"}, folder.path());
  EXPECT_EQ(resumed.exit_code, 0) << resumed.all();
  EXPECT_EQ(info_of(folder / "parts")["state_hash"], info_of(folder / "whole")["state_hash"]);
  EXPECT_EQ(read_text(folder / "parts/series.csv").size() > 100, true);
}

TEST(Resume, UntilALaterTimeEqualsARunToThatTime) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "long", "--until", "2 h"}, folder.path()).exit_code, 0);
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "parts", "--until", "1 h"}, folder.path()).exit_code, 0);
  const Outcome resumed = run_morula({"resume", "parts", "--until", "2 h"}, folder.path());
  EXPECT_EQ(resumed.exit_code, 0) << resumed.all();
  EXPECT_EQ(info_of(folder / "parts")["state_hash"], info_of(folder / "long")["state_hash"]);
}

TEST(Resume, WithAChangeMakesANewRunWithItsParent) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "runs/first", "--until", "30 min"}, folder.path()).exit_code, 0);
  const json before = info_of(folder / "runs/first");
  const Outcome changed_run = run_morula(
      {"resume", "runs/first", "--set", "time.end=1 h", "--set", "cell_types.round.adhesion={round: 2e-4 J/m^2}", "--out", "runs/second"},
      folder.path());
  ASSERT_EQ(changed_run.exit_code, 0) << changed_run.all();
  const json after = info_of(folder / "runs/second");
  EXPECT_THAT(after["parent"].get<std::string>(), testing::EndsWith("runs/first"));
  EXPECT_EQ(after["time"], 3600.0);
  EXPECT_EQ(info_of(folder / "runs/first")["state_hash"], before["state_hash"]);
  const Outcome wrong = run_morula({"resume", "runs/first", "--set", "time.end=soon"}, folder.path());
  EXPECT_EQ(wrong.exit_code, 2) << wrong.all();
}

TEST(Run, RefusesAKeyThatIsGivenTwice) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  const auto told = [&](const std::vector<std::string>& arguments) {
    const Outcome outcome = run_morula(arguments, folder.path());
    EXPECT_EQ(outcome.exit_code, 2) << outcome.all();
    return outcome.all();
  };
  EXPECT_THAT(told({"run", "study.yaml", "time.end=1 h", "time.end=2 h"}),
              testing::HasSubstr("'time.end' is given twice on the command line"));
  EXPECT_THAT(told({"run", "study.yaml", "--seed", "5", "seed=6"}), testing::HasSubstr("'seed' is given twice"));
  EXPECT_THAT(told({"run", "study.yaml", "--out", ""}), testing::HasSubstr("it is empty"));
}

/// What the checkpoint knows by number or has on a grid cannot become something else.
TEST(Resume, RefusesChangesThatTheCheckpointCannotFollow) {
  const TestFolder folder;
  folder.write("study.yaml", changed(sphere_study(), "initial:",
                                     "fields:\n  o: {diffusion: 1e-9 m^2/s, initial: 1 mM, voxel: 20 um}\n  p: {diffusion: 1e-9 m^2/s, "
                                     "initial: 2 mM, voxel: 20 um}\ninitial:"));
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "first", "--until", "30 min"}, folder.path()).exit_code, 0);
  const auto refused = [&](const std::string& change, const std::string& why) {
    const Outcome outcome = run_morula({"resume", "first", "--set", change, "--out", "second"}, folder.path());
    EXPECT_EQ(outcome.exit_code, 2) << change << outcome.all();
    EXPECT_THAT(outcome.all(), testing::HasSubstr(why)) << change;
    EXPECT_FALSE(fs::exists(folder / "second")) << change;
  };
  refused("fields={p: {diffusion: 1e-9 m^2/s, initial: 2 mM, voxel: 20 um}, o: {diffusion: 1e-9 m^2/s, initial: 1 mM, voxel: 20 um}}",
          "other fields");
  refused("fields.o.voxel=25 um", "other voxels");
  refused("domain.size=[400 um, 400 um, 400 um]", "other bounds of the domain");
  refused("time.end=10 min", "later than `time.end`");
  refused("initial.0.count=2", "how a run begins");
  refused("fields.o.initial=3 mM", "`fields.o.initial` says how a run begins");
  refused("cell_types.round.cycle.model=phases", "other phases of the cycle of 'round'");
  refused("cell_types.round.dcm.nodes=642", "other nodes of the shells of 'round'");
}

TEST(Resume, IsToldWithTheEndThatWasAskedFor) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  const Outcome stopped = run_morula({"run", "study.yaml", "--out", "first", "--until", "30 min", "--max-wall", "1 ms"}, folder.path());
  ASSERT_EQ(stopped.exit_code, 75) << stopped.all();
  EXPECT_THAT(stopped.all(), testing::HasSubstr("morula resume first --until 1800s"));
  EXPECT_THAT(run_morula({"status", "first"}, folder.path()).all(), testing::HasSubstr("morula resume first --until 1800s"));
}

TEST(Resume, KnowsWhenItsInputsOrItsResultsAreNotWhatTheyWere) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "run", "--until", "30 min"}, folder.path()).exit_code, 0);
  std::string series = read_text(folder / "run/series.csv");
  const std::size_t second = series.find('\n', series.find('\n') + 1);
  folder.write("run/series.csv", series.substr(0, second + 1));  // its last row is gone
  const Outcome lost = run_morula({"resume", "run"}, folder.path());
  EXPECT_EQ(lost.exit_code, 0) << lost.all();
  EXPECT_THAT(lost.all(), testing::HasSubstr("some were lost"));
  series = read_text(folder / "run/series.csv");
  folder.write("run/series.csv", series.substr(0, series.rfind(',')) + "\n");  // a field of it
  const Outcome damaged = run_morula({"resume", "run"}, folder.path());
  EXPECT_EQ(damaged.exit_code, 0) << damaged.all();
  EXPECT_THAT(damaged.all(), testing::HasSubstr("series.csv has " + std::to_string(lines_of(series).size() - 2) + " rows"));
  for (const auto& file : fs::directory_iterator(folder / "run"))
    EXPECT_EQ(file.path().filename().string().find("damaged"), std::string::npos) << "results.h5 is whole";
}

TEST(Resume, SaysWhenEventsAreLost) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "run", "--until", "1 h"}, folder.path()).exit_code, 0);
  const std::string events = read_text(folder / "run/events.jsonl");
  ASSERT_GT(lines_of(events).size(), 1u);
  const auto resumed = [&](const std::string& text) {
    fs::copy(folder / "run", folder / "copy", fs::copy_options::recursive);
    folder.write("copy/events.jsonl", text);
    const Outcome outcome = run_morula({"resume", "copy", "--until", "70 min"}, folder.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
    fs::remove_all(folder / "copy");
    return outcome.all();
  };
  EXPECT_THAT(resumed(events), Not(HasSubstr("events.jsonl is damaged")));
  EXPECT_THAT(resumed(events.substr(events.find('\n') + 1)), HasSubstr("events.jsonl is damaged"));
  EXPECT_THAT(resumed("?" + events.substr(1)), HasSubstr("events.jsonl is damaged"));
}

TEST(Resume, RefusesInputsAndCheckpointsOfAnotherRun) {
  const TestFolder folder;
  folder.write("places.csv", "x [um],y [um],z [um],type\n0,0,0,round\n12,0,0,round\n");
  folder.write("study.yaml",
               changed(sphere_study(), "{type: round, count: 20, fill: sphere, radius: 20 um, as: sphere}", "{csv: places.csv}"));
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "run", "--until", "10 min"}, folder.path()).exit_code, 0);
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "other", "--until", "10 min", "seed=8"}, folder.path()).exit_code, 0);
  std::string theirs;
  for (const auto& file : fs::directory_iterator(folder / "other/checkpoints")) theirs = fs::absolute(file.path()).string();
  const Outcome foreign = run_morula({"resume", "run", "--from", theirs, "--out", "new"}, folder.path());
  EXPECT_EQ(foreign.exit_code, 2) << foreign.all();
  EXPECT_THAT(foreign.all(), HasSubstr("belongs to another run"));
  EXPECT_FALSE(fs::exists(folder / "new"));
  for (const auto& file : fs::directory_iterator(folder / "run/inputs"))
    folder.write("run/inputs/" + file.path().filename().string(), "x [um],y [um],z [um],type\n0,0,0,round\n40,0,0,round\n");
  const Outcome exchanged = run_morula({"resume", "run"}, folder.path());
  EXPECT_EQ(exchanged.exit_code, 2) << exchanged.all();
  EXPECT_THAT(exchanged.all(), HasSubstr("is not what the run began with"));
}

TEST(Resume, FromAnOlderCheckpointMakesANewRunThatEndsInTheSameBits) {
  const std::string halfway = changed(sphere_study(), "checkpoint: 30 min", "checkpoint: 10 min");
  const std::string start = changed(hybrid_study(), "end: 40 min", "end: 10 min");  // its older checkpoint is that of time 0
  for (const std::string& text : {halfway, start}) {
    const TestFolder folder;
    folder.write("study.yaml", text);
    ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "first"}, folder.path()).exit_code, 0);
    std::vector<fs::path> checkpoints(fs::directory_iterator(folder / "first/checkpoints"), fs::directory_iterator{});
    const fs::path older = *std::min_element(checkpoints.begin(), checkpoints.end());
    const std::string before = read_text(folder / "first/series.csv");
    const Outcome again = run_morula({"resume", "first", "--from", older.stem().string(), "--out", "second"}, folder.path());
    ASSERT_EQ(again.exit_code, 0) << again.all();
    EXPECT_EQ(again.out, "second\n");
    EXPECT_EQ(read_text(folder / "first/series.csv"), before) << "what the first run has found stays";
    EXPECT_EQ(info_of(folder / "second")["state_hash"], info_of(folder / "first")["state_hash"]);
  }
}

TEST(Run, ThatCrossesALimitFailsWithExitFour) {
  const TestFolder folder;
  folder.write("study.yaml", hybrid_study());
  const Outcome outcome = run_morula({"run", "study.yaml", "--out", "run", "limits.overlap=1e-5 um"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 4) << outcome.all();
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("error: run: overlap"), HasSubstr("cell "), HasSubstr("help: ")));
  EXPECT_TRUE(fs::exists(folder / "run/FAILED"));
  EXPECT_FALSE(fs::exists(folder / "run/DONE"));
  const json info = info_of(folder / "run");
  EXPECT_EQ(info["state"], "failed");
  EXPECT_EQ(info["exit_code"], 4);
  EXPECT_FALSE(fs::is_empty(folder / "run/checkpoints")) << "there is a state to look at";
}

TEST(Run, OfACellAtRestPassesItsChecks) {  // what its energy still rises by is rounding
  const TestFolder folder;
  folder.write("study.yaml", lone_cell_study());
  const Outcome outcome = run_morula({"run", "study.yaml", "--out", "run"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
  EXPECT_THAT(outcome.all(), HasSubstr("checks passed"));
  EXPECT_THAT(read_text(folder / "run/verdict.json"), HasSubstr("INV.7"));
}

TEST(Run, SaysWhenNoFaceBearsALoad) {
  const TestFolder folder;
  const std::string marked =
      changed(lone_cell_study(), "output: {report", R"(marks: {top: {types: [a], cone: {axis: [0, 0, 1], angle: 40 deg}}}
loads: {wind: {type: a, patch: {force: [0 nN, 0.1 nN, 0 nN], marked: top}}}
output: {report)");
  folder.write("study.yaml", marked);
  folder.write("none.yaml", changed(marked, "40 deg", "0.1 deg"));
  EXPECT_THAT(run_morula({"run", "study.yaml", "--until", "20 s"}, folder.path()).all(), Not(HasSubstr("acts nowhere")));
  EXPECT_THAT(run_morula({"run", "none.yaml", "--until", "20 s"}, folder.path()).all(), HasSubstr("load 'wind' acts nowhere"));
}

TEST(Resume, UntilATimeThatHasPassedIsRefused) {
  const TestFolder folder;
  folder.write("study.yaml", lone_cell_study());
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "run", "--until", "1 min"}, folder.path()).exit_code, 0);
  const Outcome outcome = run_morula({"resume", "run", "--until", "40 s"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 2) << outcome.all();
  EXPECT_THAT(outcome.err, HasSubstr("later than --until"));
  const Outcome never = run_morula({"resume", "run", "--until", "1e30 h"}, folder.path());
  EXPECT_EQ(never.exit_code, 2) << never.all();
  EXPECT_THAT(never.err, HasSubstr("must be at most"));
  EXPECT_EQ(run_morula({"resume", "run", "--until", "80 s"}, folder.path()).exit_code, 0);
}

TEST(Check, NeverSaysOkWhereTheRunRefuses) {
  const TestFolder folder;  // just within and just beyond the limit of 0.3 um
  for (const char* apart : {"11.9 um", "11.75 um", "11.65 um", "11.45 um", "9 um"}) {
    folder.write("study.yaml",
                 changed(lone_cell_study(), "[[0 um, 0 um, 0 um]]", std::string("[[0 um, 0 um, 0 um], [") + apart + ", 0 um, 0 um]]"));
    const int checked = run_morula({"check", "study.yaml"}, folder.path()).exit_code;
    const Outcome run = run_morula({"run", "study.yaml", "--until", "2 s"}, folder.path());
    EXPECT_TRUE(checked == 0 || checked == 2);
    EXPECT_EQ(run.exit_code, checked) << apart << run.all();
  }
}

TEST(Resume, FromACheckpointThatIsNotThereListsThoseThatAre) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "run", "--until", "10 min"}, folder.path()).exit_code, 0);
  const Outcome outcome = run_morula({"resume", "run", "--from", "cp_999999"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 3) << outcome.all();
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("cp_999999"), HasSubstr("cp_00000")));
}

TEST(Results, AreExportedAndPlotted) {
  const TestFolder folder;
  folder.write("study.yaml", sphere_study());
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "run", "--until", "30 min"}, folder.path()).exit_code, 0);
  for (const char* format : {"vtk", "csv", "stl"}) {
    const Outcome outcome = run_morula({"export", "run", format, "--every", "2"}, folder.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
    EXPECT_FALSE(fs::is_empty(folder.path() / "run" / format)) << format;
    EXPECT_EQ(run_morula({"export", "run", format}, folder.path()).exit_code, 3) << "nothing is overwritten";
  }
  EXPECT_EQ(run_morula({"export", "run", "csv", "--from", "20 h", "--out", "none"}, folder.path()).exit_code, 2);
  EXPECT_FALSE(fs::exists(folder / "none")) << "what failed leaves nothing behind";
  const Outcome some = run_morula({"plot", "run", "--format", "svg"}, folder.path());
  EXPECT_EQ(some.exit_code, 0) << some.all();
  EXPECT_THAT(some.out, HasSubstr(".svg"));
  EXPECT_EQ(some.out.find(".png"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "run/report.html"));
  const Outcome all = run_morula({"plot", "run"}, folder.path());
  EXPECT_EQ(all.exit_code, 0) << all.all();
  EXPECT_THAT(read_text(folder / "run/report.html"), HasSubstr("<html"));
}

}  // namespace
}  // namespace morula::test
