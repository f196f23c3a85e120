#include "results/checkpoint_folder.h"
#include "results/hdf5_plan.h"
#include "results/state_hash.h"
#include "tests/results/results_support.h"

namespace morula::scenarios {
namespace {

using namespace testing_support;

struct CheckpointFolder : CheckpointTest {
  std::filesystem::path checkpoints = folder / "checkpoints";

  void save(double time) {
    Tissue tissue = make_tissue(comm, library, 20);
    tissue.clock.time = time;
    const auto saved = save_checkpoint(checkpoints, tissue, kInfo, comm);
    ASSERT_TRUE(saved.ok()) << saved.error().message;
  }
  void damage(const std::string& name) {
    comm.barrier();
    if (comm.is_root()) {
      std::string bytes = slurp(checkpoints / name);
      bytes.resize(bytes.size() / 2);
      spit(checkpoints / name, bytes);
    }
    comm.barrier();
  }
};

TEST_F(CheckpointFolder, KeepsTheTwoNewest) {
  for (const double time : {1.0, 2.0, 3.0}) save(time);
  comm.barrier();
  const auto paths = checkpoints_in(checkpoints);
  ASSERT_EQ(paths.size(), 2u);
  EXPECT_EQ(paths[0].filename(), "cp_000003.h5");
  EXPECT_EQ(paths[1].filename(), "cp_000002.h5");
  const auto loaded = load_newest_checkpoint(checkpoints, model, library, comm);
  ASSERT_TRUE(loaded.ok());
  EXPECT_EQ(loaded->checkpoint.tissue.clock.time, 3.0);
  EXPECT_TRUE(loaded->warnings.empty());
}

TEST_F(CheckpointFolder, UsesTheOlderOneWhenTheNewestIsDamagedAndSaysSo) {
  for (const double time : {1.0, 2.0}) save(time);
  damage("cp_000002.h5");
  const auto loaded = load_newest_checkpoint(checkpoints, model, library, comm);
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_EQ(loaded->checkpoint.tissue.clock.time, 1.0);
  ASSERT_EQ(loaded->warnings.size(), 2u);
  EXPECT_NE(loaded->warnings[0].find("cp_000002.h5"), std::string::npos);
  EXPECT_NE(loaded->warnings[1].find("cp_000001.h5"), std::string::npos);
  const auto good = newest_good_checkpoint(checkpoints, comm);
  ASSERT_TRUE(good.ok());
  EXPECT_EQ(good->path.filename(), "cp_000001.h5");
}

TEST_F(CheckpointFolder, WithoutAGoodOneIsAnErrorThatNamesTheFiles) {
  save(1.0);
  damage("cp_000001.h5");
  const auto loaded = load_newest_checkpoint(checkpoints, model, library, comm);
  ASSERT_FALSE(loaded.ok());
  EXPECT_EQ(loaded.error().kind, ErrorKind::kFile);
  EXPECT_NE(loaded.error().message.find("cp_000001.h5"), std::string::npos);
  EXPECT_FALSE(load_newest_checkpoint(folder / "nowhere", model, library, comm).ok());
}

TEST_F(CheckpointFolder, AnotherVersionIsRefusedAndNotPassedOver) {
  save(1.0);
  StoragePlan plan(comm);
  plan.add_value("format_version", "1", kCheckpointFormat + 1);
  ASSERT_TRUE(create_file(checkpoints / "cp_000002.h5", std::move(plan), comm).ok());
  const auto loaded = load_newest_checkpoint(checkpoints, model, library, comm);
  ASSERT_FALSE(loaded.ok());
  EXPECT_EQ(loaded.error().kind, ErrorKind::kInput);
  EXPECT_FALSE(newest_good_checkpoint(checkpoints, comm).ok());
}

TEST_F(CheckpointFolder, IgnoresOtherFiles) {
  save(1.0);
  if (comm.is_root()) {
    spit(checkpoints / "cp_000009.h5.tmp", "left by a killed process");
    spit(checkpoints / "notes.txt", "mine");
  }
  comm.barrier();
  EXPECT_EQ(checkpoints_in(checkpoints).size(), 1u);
}

}  // namespace
}  // namespace morula::scenarios
