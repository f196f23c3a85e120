// Disks that fill up and checkpoints that are not what they were.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/mount.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/system/morula_command.h"
#include "tests/system/studies.h"

namespace morula::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

json info_of(const fs::path& run) { return json::parse(run_morula({"info", run.string(), "--json"}, run.parent_path()).out); }

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
              AllOf(HasSubstr("version 99"), HasSubstr("reads version 2"), HasSubstr("resume with the version of Morula that wrote it")));
  EXPECT_EQ(checkpoints_of(folder / "run"), checkpoints) << "nothing is removed";
}

TEST_F(Damage, OfAllCheckpointsIsExitThree) {
  for (const fs::path& path : checkpoints) fs::resize_file(path, 100);
  const Outcome resumed = run_morula({"resume", "run", "--until", "2 h"}, folder.path());
  EXPECT_EQ(resumed.exit_code, 3) << resumed.all();
  EXPECT_THAT(resumed.err, HasSubstr("no usable checkpoint"));
  EXPECT_FALSE(resumed.timed_out);
}

TEST_F(Damage, OfTheResolvedStudyIsRefused) {
  std::ofstream(folder / "run/study.resolved.yaml", std::ios::app) << "# changed by hand\n";
  const Outcome resumed = run_morula({"resume", "run", "--until", "2 h"}, folder.path());
  EXPECT_EQ(resumed.exit_code, 2) << resumed.all();
  EXPECT_THAT(resumed.err, HasSubstr("another study"));
}

TEST_F(Damage, ByAFileSizeLimitLeavesTheCheckpointsWhole) {
  // The limit holds for each file: results.h5 reaches it first, as on a disk that is full.
  const auto limit = fs::file_size(folder / "run/results.h5") / 1024 * 4 / 3;
  CommandOptions options;
  options.shell_before = "trap '' XFSZ; ulimit -f " + std::to_string(limit) + ";";
  const Outcome full = run_morula({"run", "study.yaml", "--out", "full", "--until", "20 h"}, folder.path(), options);
  EXPECT_EQ(full.exit_code, 6) << full.all();
  EXPECT_THAT(full.err, AllOf(HasSubstr("error: "), HasSubstr("full")));
  EXPECT_FALSE(full.timed_out);
  const Outcome resumed = run_morula({"resume", "full", "--until", "2 h"}, folder.path());
  EXPECT_EQ(resumed.exit_code, 0) << "with room on the disk the run goes on\n" << resumed.all();
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
