#include <sys/stat.h>

#include <sys/mount.h>

#include <cmath>

#include "results/file_io.h"
#include "results/run_folder.h"
#include "tests/results/results_support.h"

namespace morula::scenarios {
namespace {

using namespace testing_support;
namespace fs = std::filesystem;
using ::testing::Test;

struct RunFolders : Test {
  Comm comm{MPI_COMM_WORLD};
  Folder folder{comm};
  RunFolder make() {
    auto made = RunFolder::create(folder / "runs", {}, "spheroid", comm);
    EXPECT_TRUE(made.ok());
    return *made;
  }
};

// FIPS 180-4 example: SHA-256 of "abc"; and of the empty message.
TEST_F(RunFolders, Sha256GivesTheKnownAnswers) {
  EXPECT_EQ(sha256_of_text("abc").value(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  if (comm.is_root()) spit(folder / "empty", "");
  comm.barrier();
  EXPECT_EQ(sha256_of_file(folder / "empty").value(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_of_file(folder / "none").error().kind, ErrorKind::kFile);
}

TEST_F(RunFolders, AreNumberedUpwardsAndNeverReused) {
  EXPECT_EQ(make().path().filename(), "spheroid-0001");
  EXPECT_EQ(make().path().filename(), "spheroid-0002");
  comm.barrier();
  if (comm.is_root()) {
    std::filesystem::remove(folder / "runs/spheroid-0001");
    std::filesystem::create_directory(folder / "runs/spheroid-0041");
    std::filesystem::create_directory(folder / "runs/spheroid-big");
    std::filesystem::create_directory(folder / "runs/spheroid_other-0100");
  }
  comm.barrier();
  EXPECT_EQ(make().path().filename(), "spheroid-0042");
}

TEST_F(RunFolders, GivenByNameMustNotExist) {
  const auto first = RunFolder::create("", folder / "a/b", "spheroid", comm);
  ASSERT_TRUE(first.ok());
  EXPECT_EQ(first->path(), folder / "a/b");
  comm.barrier();
  const auto second = RunFolder::create("", folder / "a/b", "spheroid", comm);
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.error().kind, ErrorKind::kFile);
  EXPECT_NE(second.error().message.find("exists"), std::string::npos);
}

TEST_F(RunFolders, InAReadOnlyPlaceAreAClearError) {
  const auto place = folder / "readonly";
  bool ready = false;
  if (comm.is_root()) {
    std::filesystem::create_directory(place);
    ready = ::geteuid() != 0 ? ::chmod(place.c_str(), 0555) == 0 : ::mount("none", place.c_str(), "tmpfs", MS_RDONLY, "") == 0;
  }
  if (!comm.any(ready)) GTEST_SKIP() << "no right to mount here";
  const auto made = RunFolder::create(place, {}, "spheroid", comm);
  const auto named = RunFolder::create({}, place / "x/y", "spheroid", comm);
  comm.barrier();
  if (comm.is_root()) ::umount2(place.c_str(), MNT_DETACH);
  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.error().kind, ErrorKind::kFile);
  EXPECT_NE(made.error().message.find("readonly"), std::string::npos);
  EXPECT_NE(made.error().help.find("--out"), std::string::npos);
  EXPECT_FALSE(named.ok());
}

TEST_F(RunFolders, HoldTheStudyAndItsInputsWithTheirHashes) {
  const RunFolder run = make();
  if (!comm.is_root()) return;
  std::filesystem::create_directory(folder / "other");
  spit(folder / "cells.csv", "abc");
  spit(folder / "other/cells.csv", "");
  Study study;
  study.source_path = "study.yaml";
  study.source_text = "schema: 1\n";
  study.resolved_text = "schema: 1\nseed: 1\n";
  study.input_files = {{folder / "cells.csv", "inputs/cells.csv"}, {folder / "other/cells.csv", "inputs/2_cells.csv"}};
  RunRecord record;
  const Status written = run.write_study(study, record);
  ASSERT_TRUE(written.ok()) << written.error().message;
  EXPECT_EQ(slurp(run.path() / "study.yaml"), study.source_text);
  EXPECT_EQ(slurp(run.path() / "study.resolved.yaml"), study.resolved_text);
  ASSERT_EQ(record.inputs.size(), 3u);
  EXPECT_EQ(record.inputs[1].sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(slurp(run.path() / record.inputs[1].copy), "abc");
  EXPECT_EQ(slurp(run.path() / record.inputs[2].copy), "");
  EXPECT_EQ(record.inputs[2].copy, "inputs/2_cells.csv");
}

TEST_F(RunFolders, RecordComesBackAndMarksTheEnd) {
  const RunFolder run = make();
  if (!comm.is_root()) return;
  RunRecord record;
  record.study = "spheroid \"quoted\" \xff";
  record.seed = 20261121;
  record.ranks = 4;
  record.command = "morula run study.yaml";
  record.inputs = {{"a.csv", "inputs/a.csv", "00"}};
  complete_record(record);
  ASSERT_TRUE(run.write_record(record).ok());
  EXPECT_FALSE(std::filesystem::exists(run.path() / "DONE"));
  record.state = RunState::kFailed;
  record.exit_code = 4;
  ASSERT_TRUE(run.write_record(record).ok());
  EXPECT_TRUE(std::filesystem::exists(run.path() / "FAILED"));
  record.state = RunState::kDone;
  record.exit_code = 0;
  record.final_state = FinalState{3600.0, 5, 3, 2, "00ff"};
  ASSERT_TRUE(run.write_record(record).ok());
  EXPECT_TRUE(std::filesystem::exists(run.path() / "DONE"));
  EXPECT_FALSE(std::filesystem::exists(run.path() / "FAILED"));
  const auto read = read_run_record(run.record());
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->state, RunState::kDone);
  EXPECT_EQ(read->seed, 20261121u);
  EXPECT_EQ(read->ranks, 4);
  EXPECT_EQ(read->inputs[0].copy, "inputs/a.csv");
  ASSERT_TRUE(read->final_state.has_value());
  EXPECT_EQ(read->final_state->shells, 2u);
  EXPECT_EQ(read->final_state->state_hash, "00ff");
  EXPECT_FALSE(read->version.empty() || read->git_hash.empty() || read->compiler.empty() || read->host.empty() || read->libraries.empty());
  EXPECT_TRUE(RunFolder::open(run.path(), Comm(MPI_COMM_SELF)).ok());
}

TEST_F(RunFolders, DamagedRecordsAreAnErrorAndNotACrash) {
  if (!comm.is_root()) return;
  for (const char* text : {"", "{", "[]", "{}", "{\"state\": 3}", "{\"state\": \"dancing\"}", "\xff\xfe"}) {
    spit(folder / "run.json", text);
    EXPECT_EQ(read_run_record(folder / "run.json").error().kind, ErrorKind::kFile) << text;
  }
  spit(folder / "run.json", R"({"state": "done", "seed": "many", "inputs": 3, "final": []})");
  EXPECT_TRUE(read_run_record(folder / "run.json").ok());
}

TEST_F(RunFolders, StatusComesBack) {
  const RunFolder run = make();
  if (!comm.is_root()) return;
  RunStatus status;
  status.time = 1800.5;
  status.end = 3600.0;
  status.cells = 77;
  status.left_low = 10.0;
  status.left_high = 20.0;
  ASSERT_TRUE(run.write_status(status).ok());
  const auto read = read_run_status(run.status());
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->time, 1800.5);
  EXPECT_EQ(read->cells, 77u);
  EXPECT_EQ(read->left_high, 20.0);
  EXPECT_FALSE(read->updated.empty());
}

TEST_F(RunFolders, SeriesAndEventsAreCutBackToTheCheckpoint) {
  const RunFolder run = make();
  if (!comm.is_root()) return;
  const std::vector<SeriesHeader> columns{{"cell_count", "1"}, {"pressure", "kPa"}};
  ASSERT_TRUE(run.begin_series(columns).ok());
  std::vector<ToldEvent> events;
  for (int i = 0; i < 5; ++i) {
    const double time = 0.1 * i;
    ASSERT_TRUE(run.add_to_series(time, std::vector<double>{double(i), 1.0 / 3.0}).ok());
    events.push_back(
        {{time, EventKind::kDivision, CellId::founder(7), CellId::founder(7).daughter(0), CellId::founder(7).daughter(1), {}}, "grown"});
  }
  ASSERT_TRUE(run.add_events(events).ok());
  ASSERT_TRUE(append_to_text(run.events(), "{\"time_s\": 0.1, \"ki").ok());  // the process was killed here
  ASSERT_TRUE(append_to_text(run.series(), "0.2").ok());
  ASSERT_TRUE(run.cut_back(0.1 * 2, {}).ok());
  EXPECT_EQ(slurp(run.series()),
            "time [s],cell_count [1],pressure [kPa]\n0,0,0.3333333333333333\n0.1,1,0.3333333333333333\n0.2,2,0.3333333333333333\n");
  // A row that is no row any more goes alone, and a file without anything is begun anew.
  spit(run.series(), "time [s],cell_count [1],pressure [kPa]\n0,0,0.3\n0.1,\x81,0.3\n0.15,1\n0.2,2,\n");
  ASSERT_TRUE(run.cut_back(0.1 * 2, {}).ok());
  EXPECT_EQ(slurp(run.series()), "time [s],cell_count [1],pressure [kPa]\n0,0,0.3\n0.2,2,\n");
  spit(run.series(), "");
  EXPECT_TRUE(run.begin_series(columns).ok());
  EXPECT_EQ(slurp(run.series()), "time [s],cell_count [1],pressure [kPa]\n");
  const std::string lines = slurp(run.events());
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 3);
  EXPECT_EQ(lines.substr(0, lines.find('\n')), R"({"time_s":0.0,"kind":"division","cell":"7","daughters":["7.0","7.1"],"text":"grown"})");
  EXPECT_TRUE(run.begin_series(columns).ok());
  EXPECT_EQ(run.begin_series(std::vector<SeriesHeader>{{"other", "1"}}).error().kind, ErrorKind::kInput);
}

TEST_F(RunFolders, WhatCameAfterACheckpointIsCutWhateverItsTime) {
  const RunFolder run = make();
  if (!comm.is_root()) return;
  const auto event = [](double time, const char* text) { return ToldEvent{{time, EventKind::kWarning, {}, {}, {}, {}}, text}; };
  ASSERT_TRUE(run.begin_series(std::vector<SeriesHeader>{{"cell_count", "1"}}).ok());
  ASSERT_TRUE(run.add_events(std::vector<ToldEvent>{event(1.0, "first"), event(2.0, "second")}).ok());
  ASSERT_TRUE(run.add_to_log("before").ok());
  const auto lengths = run.sync_texts();
  ASSERT_TRUE(lengths.ok());
  EXPECT_EQ(lengths->events, slurp(run.events()).size());
  // After the checkpoint at 2 s: an event of a moment before it (a division that was late), one of that very moment, and a line of the log.
  ASSERT_TRUE(run.add_events(std::vector<ToldEvent>{event(1.9, "late"), event(2.0, "failed")}).ok());
  ASSERT_TRUE(run.add_to_log("after").ok());
  const auto lost = run.cut_back(2.0, *lengths);
  ASSERT_TRUE(lost.ok());
  EXPECT_FALSE(*lost);
  const std::string events = slurp(run.events());
  EXPECT_EQ(std::count(events.begin(), events.end(), '\n'), 2) << events;
  EXPECT_NE(events.find("second"), std::string::npos);
  EXPECT_EQ(slurp(run.log()), "before\n");
}

TEST_F(RunFolders, NothingIsWrittenThroughALink) {
  const RunFolder run = make();
  if (!comm.is_root()) return;
  const fs::path precious = folder / "precious";
  spit(precious, "data");
  const auto refused = [&](const Status& status) {
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().kind, ErrorKind::kFile);
    EXPECT_NE(status.error().message.find("symbolic link"), std::string::npos) << status.error().message;
  };
  for (const fs::path& file : {run.log(), run.events(), run.series()}) fs::create_symlink(precious, file);
  refused(run.add_to_log("a line"));
  refused(run.add_events(std::vector<ToldEvent>(1)));
  refused(run.add_to_series(0.0, {}));
  fs::path aside = run.status();
  aside += ".tmp";
  fs::create_symlink(precious, aside);
  refused(run.write_status(RunStatus{}));
  EXPECT_TRUE(run.write_status(RunStatus{}).ok()) << "what was written aside, the link, is gone";
  EXPECT_EQ(slurp(precious), "data");
  ASSERT_EQ(::mkfifo((run.path() / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(append_to_text(run.path() / "pipe", "text").error().kind, ErrorKind::kFile) << "and it does not wait for a reader";
}

TEST_F(RunFolders, VerdictSaysWhetherAllPassed) {
  const RunFolder run = make();
  if (!comm.is_root()) return;
  const Judgement judgement{{{"S18.1", "overlap", 0.2, "<= 0.3 um", true},
                             {"S18.2", "volume error", 0.05, "<= 2 %", false},
                             {"S18.3", "way", std::nan(""), "<= 5 um", false}},
                            {{"INV.7", "rise of the energy", "something drives the tissue"}}};
  ASSERT_TRUE(run.write_verdict(judgement).ok());
  EXPECT_EQ(judgement.failures(), "checks failed: S18.2, S18.3");
  EXPECT_EQ(value_text(judgement.verdicts[2]), "nothing to judge");
  const std::string text = slurp(run.path() / "verdict.json");
  EXPECT_NE(text.find("something drives the tissue"), std::string::npos);
  EXPECT_NE(text.find("\"passed\": false"), std::string::npos);
  EXPECT_NE(text.find("S18.2"), std::string::npos);
}

}  // namespace
}  // namespace morula::scenarios
