// Disks that fill up and checkpoints that are not what they were.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
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

std::vector<fs::path> checkpoints_of(const fs::path& run) {
  std::vector<fs::path> out(fs::directory_iterator(run / "checkpoints"), fs::directory_iterator{});
  std::sort(out.begin(), out.end());
  return out;
}

/// A run of an hour with its two newest checkpoints.
class Damage : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("study.yaml", changed(sphere_study(), "checkpoint: 30 min", "checkpoint: 10 min"));
    ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "run", "--until", "1 h"}, folder.path()).exit_code, 0);
    hash = info_of(folder / "run")["state_hash"];
    checkpoints = checkpoints_of(folder / "run");
    ASSERT_EQ(checkpoints.size(), 2u) << "the two newest are kept";
  }
  /// Resumes: the older checkpoint must be used, said so, and end in the same bits.
  void expect_older_is_used() {
    const Outcome resumed = run_morula({"resume", "run", "--until", "1 h"}, folder.path());
    EXPECT_EQ(resumed.exit_code, 0) << resumed.all();
    EXPECT_THAT(resumed.err, AllOf(HasSubstr(checkpoints[1].filename().string()), HasSubstr(checkpoints[0].filename().string()),
                                   HasSubstr("older"), HasSubstr("warn")));
    EXPECT_EQ(info_of(folder / "run")["state_hash"], hash);
  }
  TestFolder folder;
  std::string hash;
  std::vector<fs::path> checkpoints;
};

TEST_F(Damage, OfATruncatedCheckpointIsNoticedAndTheOlderOneIsUsed) {
  fs::resize_file(checkpoints[1], fs::file_size(checkpoints[1]) * 2 / 3);
  expect_older_is_used();
}

TEST_F(Damage, OfOneAlteredByteIsNoticedAndTheOlderOneIsUsed) {
  // the byte lies within the table of cells: somewhere in the second half of the file, where no zero padding is
  std::string bytes = read_text(checkpoints[1]);
  std::size_t at = bytes.size() / 2;
  while (at + 8 < bytes.size() && bytes.substr(at, 8).find('\0') != std::string::npos) ++at;
  bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
  std::ofstream(checkpoints[1], std::ios::binary) << bytes;
  expect_older_is_used();
}

TEST_F(Damage, OfOneCheckpointAfterAnotherAlwaysLeavesOneThatCanBeUsed) {
  fs::resize_file(checkpoints[1], fs::file_size(checkpoints[1]) / 2);
  const Outcome first = run_morula({"resume", "run", "--until", "70 min"}, folder.path());
  ASSERT_EQ(first.exit_code, 0) << first.all();
  EXPECT_THAT(first.err, HasSubstr("is kept as 'cp_00000"));
  std::vector<fs::path> usable;
  for (const fs::path& path : checkpoints_of(folder / "run"))
    if (path.filename().string().find("damaged") == std::string::npos) usable.push_back(path);
  ASSERT_EQ(usable.size(), 2u) << "the damaged one is none of the two that are kept";
  fs::resize_file(usable[1], fs::file_size(usable[1]) / 2);
  const Outcome second = run_morula({"resume", "run", "--until", "2 h"}, folder.path());
  ASSERT_EQ(second.exit_code, 0) << second.all();
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "whole", "--until", "2 h"}, folder.path()).exit_code, 0);
  EXPECT_EQ(info_of(folder / "run")["state_hash"], info_of(folder / "whole")["state_hash"]);
}

TEST_F(Damage, OfNothingButTheVersionIsRefusedWithBothVersions) {
  const std::uint32_t other = 99;
  const hid_t file = H5Fopen(checkpoints[1].c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t version = H5Dopen(file, "format_version", H5P_DEFAULT);
  ASSERT_GE(H5Dwrite(version, H5T_NATIVE_UINT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, &other), 0);
  H5Dclose(version);
  H5Fclose(file);
  const Outcome resumed = run_morula({"resume", "run", "--until", "2 h"}, folder.path());
  EXPECT_EQ(resumed.exit_code, 2) << resumed.all();
  EXPECT_THAT(resumed.err,
              AllOf(HasSubstr("version 99"), HasSubstr("reads version 7"), HasSubstr("resume with the version of Morula that wrote it")));
  EXPECT_EQ(checkpoints_of(folder / "run"), checkpoints) << "nothing is removed";
}

TEST_F(Damage, OfAllCheckpointsIsExitThree) {
  for (const fs::path& path : checkpoints) fs::resize_file(path, 100);
  const Outcome resumed = run_morula({"resume", "run", "--until", "2 h"}, folder.path());
  EXPECT_EQ(resumed.exit_code, 3) << resumed.all();
  EXPECT_THAT(resumed.err, HasSubstr("no usable checkpoint"));
  EXPECT_FALSE(resumed.timed_out);
}

TEST_F(Damage, ByALinkInPlaceOfTheFolderOfCheckpointsTouchesNothingBehindIt) {
  fs::rename(folder / "run/checkpoints", folder / "elsewhere");
  fs::create_directory_symlink(folder / "elsewhere", folder / "run/checkpoints");
  const Outcome resumed = run_morula({"resume", "run", "--until", "2 h"}, folder.path());
  EXPECT_EQ(resumed.exit_code, 3) << resumed.all();
  EXPECT_THAT(resumed.err, AllOf(HasSubstr("symbolic link"), HasSubstr("checkpoints")));
  for (const fs::path& path : checkpoints) EXPECT_TRUE(fs::exists(folder / "elsewhere" / path.filename())) << path;
}

TEST_F(Damage, ByPipesInPlaceOfFilesIsToldAndNotWaitedFor) {
  for (const char* name : {"run.json", "study.resolved.yaml", "results.h5", "series.csv"}) {
    SCOPED_TRACE(name);
    const fs::path path = folder / "run" / name, aside = folder / "aside";
    fs::rename(path, aside);
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    CommandOptions options;
    options.timeout = std::chrono::seconds(30);
    const Outcome resumed = run_morula({"resume", "run", "--until", "2 h"}, folder.path(), options);
    EXPECT_FALSE(resumed.timed_out);
    EXPECT_EQ(resumed.exit_code, std::string_view(name) == "study.resolved.yaml" ? 2 : 3) << resumed.all();
    EXPECT_THAT(resumed.err, HasSubstr(name));
    fs::rename(aside, path);
  }
}

TEST_F(Damage, OfTheResolvedStudyIsRefused) {
  std::ofstream(folder / "run/study.resolved.yaml", std::ios::app) << "# changed by hand\n";
  const Outcome resumed = run_morula({"resume", "run", "--until", "2 h"}, folder.path());
  EXPECT_EQ(resumed.exit_code, 2) << resumed.all();
  EXPECT_THAT(resumed.err, HasSubstr("another study"));
}

TEST_F(Damage, OfTheSeriesIsToldWithItsLine) {
  const fs::path series = folder / "run/series.csv";
  const std::string text = read_text(series);
  std::ofstream(series) << text.substr(0, text.find('\n') + 1) << "1,2\n";
  const Outcome plotted = run_morula({"plot", "run"}, folder.path());
  EXPECT_EQ(plotted.exit_code, 3) << plotted.all();
  EXPECT_THAT(plotted.err, HasSubstr("series.csv:2: this row has 2 fields"));
  fs::remove(series);
  ASSERT_EQ(::mkfifo(series.c_str(), 0600), 0);
  CommandOptions options;
  options.timeout = std::chrono::seconds(30);
  const Outcome waiting = run_morula({"plot", "run"}, folder.path(), options);
  EXPECT_FALSE(waiting.timed_out);
  EXPECT_EQ(waiting.exit_code, 3) << waiting.all();
}

TEST_F(Damage, OfTheResultsSetsThemAsideAndTheRunGoesOn) {
  fs::resize_file(folder / "run/results.h5", fs::file_size(folder / "run/results.h5") / 2);
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "whole", "--until", "2 h"}, folder.path()).exit_code, 0);
  const Outcome resumed = run_morula({"resume", "run", "--until", "2 h"}, folder.path());
  ASSERT_EQ(resumed.exit_code, 0) << resumed.all();
  EXPECT_THAT(resumed.err, AllOf(HasSubstr("damaged"), HasSubstr("results.damaged-1.h5"), HasSubstr("warn")));
  EXPECT_EQ(info_of(folder / "run")["state_hash"], info_of(folder / "whole")["state_hash"]);
  EXPECT_TRUE(fs::exists(folder / "run/results.damaged-1.h5"));
  const Outcome exported = run_morula({"export", "run", "csv"}, folder.path());
  EXPECT_EQ(exported.exit_code, 0) << "the snapshots from then on\n" << exported.all();
}

TEST_F(Damage, ByAFileSizeLimitLeavesTheCheckpointsWhole) {
  // The limit holds for each file: results.h5 reaches it first, as on a disk that is full.
  const auto limit = fs::file_size(folder / "run/results.h5") / 1024 * 4 / 3;
  ASSERT_EQ(run_morula({"run", "study.yaml", "--out", "whole", "--until", "2 h"}, folder.path()).exit_code, 0);
  for (const std::string trap : {"", "trap '' XFSZ; "}) {  // the signal that the limit sends is caught, or ignored by the caller
    SCOPED_TRACE(trap);
    CommandOptions options;
    options.shell_before = trap + "ulimit -f " + std::to_string(limit) + ";";
    const std::string name = trap.empty() ? "caught" : "ignored";
    const Outcome full = run_morula({"run", "study.yaml", "--out", name, "--until", "20 h"}, folder.path(), options);
    EXPECT_EQ(full.exit_code, 6) << full.all();
    EXPECT_THAT(full.err, AllOf(HasSubstr("error: "), HasSubstr(name)));
    EXPECT_FALSE(full.timed_out);
    EXPECT_EQ(info_of(folder / name)["state"], "failed");
    EXPECT_TRUE(fs::exists(folder / name / "FAILED"));
    const Outcome resumed = run_morula({"resume", name, "--until", "2 h"}, folder.path());
    EXPECT_EQ(resumed.exit_code, 0) << "with room on the disk the run goes on\n" << resumed.all();
    EXPECT_EQ(read_text(folder / name / "series.csv"), read_text(folder / "whole/series.csv")) << "no row is missing, none stands twice";
    EXPECT_EQ(read_text(folder / name / "events.jsonl"), read_text(folder / "whole/events.jsonl"));
  }
}

TEST(FullDisk, LeavesFailedWhereverItIsMet) {
  if (geteuid() != 0) GTEST_SKIP() << "mounting a small disk needs root";
  const TestFolder folder;
  fs::create_directory(folder / "disk");
  int full = 0;
  // A run with a report, on disks that are full at its start, at any output, at its end and after it.
  for (int kilobytes = 40; kilobytes <= 520; kilobytes += 24) {
    SCOPED_TRACE(kilobytes);
    const std::string size = "size=" + std::to_string(kilobytes) + "k";
    if (mount("none", (folder / "disk").c_str(), "tmpfs", 0, size.c_str()) != 0) GTEST_SKIP() << "no disk can be mounted here";
    folder.write("disk/study.yaml", changed(sphere_study(), "report: false", "report: true"));
    const Outcome outcome = run_morula({"run", "study.yaml", "--out", "run"}, folder / "disk");
    const std::string said = run_morula({"status", "run", "--json"}, folder / "disk").out;
    const bool begun = fs::exists(folder / "disk/run/run.json");
    const bool marked = fs::exists(folder / "disk/run/FAILED");
    umount((folder / "disk").c_str());
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 6) << outcome.all();
    if (outcome.exit_code != 6 || !begun) continue;
    ++full;
    EXPECT_TRUE(marked) << outcome.all();
    EXPECT_EQ(json::parse(said)["state"], "failed") << outcome.all();
  }
  EXPECT_GE(full, 5);
}

TEST(FullDisk, LeavesTheCheckpointsWhole) {
  if (geteuid() != 0) GTEST_SKIP() << "mounting a small disk needs root";
  const TestFolder folder;
  fs::create_directory(folder / "disk");
  if (mount("none", (folder / "disk").c_str(), "tmpfs", 0, "size=1m") != 0) GTEST_SKIP() << "no disk can be mounted here";
  folder.write("disk/study.yaml", sphere_study());
  const Outcome full = run_morula({"run", "study.yaml", "--out", "run", "--until", "60 h"}, folder / "disk");
  const json info = fs::exists(folder / "disk/run/run.json") ? info_of(folder / "disk/run") : json{};
  umount((folder / "disk").c_str());
  EXPECT_EQ(full.exit_code, 6) << full.all();
  ASSERT_TRUE(info.contains("state_hash")) << full.all();
  EXPECT_EQ(info["state_hash"].get<std::string>().size(), 32u) << "a whole checkpoint is there";
}

}  // namespace
}  // namespace morula::test
