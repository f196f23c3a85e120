#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

#include "results/checkpoint.h"
#include "results/hdf5_plan.h"
#include "results/hdf5_reader.h"
#include "results/state_hash.h"
#include "tests/results/results_support.h"

namespace morula::scenarios {
namespace {

using namespace testing_support;

struct Checkpoint : CheckpointTest {
  std::filesystem::path path = folder / "cp.h5";
};

TEST_F(Checkpoint, ComesBackBitForBit) {
  const Tissue tissue = make_tissue(comm, library);
  const Status written = write_checkpoint(path, tissue, kInfo, comm);
  ASSERT_TRUE(written.ok()) << written.error().message;
  const auto loaded = read_checkpoint(path, model, library, comm);
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_EQ(state_hash(loaded->tissue, comm).hex(), state_hash(tissue, comm).hex());
  EXPECT_EQ(loaded->info.run_name, kInfo.run_name);
  EXPECT_EQ(loaded->info.study_hash, kInfo.study_hash);
  EXPECT_EQ(loaded->info.wall_time, kInfo.wall_time);
  EXPECT_TRUE(std::is_sorted(loaded->tissue.cells.rows.begin(), loaded->tissue.cells.rows.end(), before));
  EXPECT_FALSE(std::filesystem::exists(folder / "cp.h5.tmp"));
}

TEST_F(Checkpoint, IsReadOnAnotherNumberOfRanks) {
  const Tissue tissue = make_tissue(comm, library);
  ASSERT_TRUE(write_checkpoint(path, tissue, kInfo, comm).ok());
  const Comm alone(MPI_COMM_SELF);
  const auto loaded = read_checkpoint(path, model, library, alone);
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_EQ(state_hash(loaded->tissue, alone), state_hash(tissue, comm));
}

TEST_F(Checkpoint, WrittenByAnyNumberOfRanksIsTheSameFile) {
  ASSERT_TRUE(write_checkpoint(path, make_tissue(comm, library), kInfo, comm).ok());
  if (comm.is_root()) {
    const Comm alone(MPI_COMM_SELF);
    ASSERT_TRUE(write_checkpoint(folder / "alone.h5", make_tissue(alone, library), kInfo, alone).ok());
    EXPECT_TRUE(slurp(path) == slurp(folder / "alone.h5"));
  }
}

TEST_F(Checkpoint, SharesTheLibrarysShapes) {
  const Tissue tissue = make_tissue(comm, library);
  ASSERT_TRUE(write_checkpoint(path, tissue, kInfo, comm).ok());
  const auto loaded = read_checkpoint(path, model, library, comm);
  ASSERT_TRUE(loaded.ok());
  std::int64_t shared = 0;
  for (const auto& shape : loaded->tissue.shells.shape) shared += shape == library.icosphere(42).value();
  EXPECT_GT(comm.sum(shared), 0);
}

TEST_F(Checkpoint, OfNothingAndOfOneKindOfBodyWorks) {
  for (const int cells : {0, 1, 2}) {
    const Tissue tissue = make_tissue(comm, library, cells);
    ASSERT_TRUE(write_checkpoint(path, tissue, kInfo, comm).ok());
    const auto loaded = read_checkpoint(path, model, library, comm);
    ASSERT_TRUE(loaded.ok()) << loaded.error().message;
    EXPECT_EQ(state_hash(loaded->tissue, comm), state_hash(tissue, comm)) << cells << " cells";
  }
}

/// One process tries more: the file of several is the same (`WrittenByAnyNumberOfRanksIsTheSameFile`), and while the root reads it they wait.
int tries(int by_one_process, const Comm& comm) { return comm.size() > 1 ? by_one_process / 10 : by_one_process; }

TEST_F(Checkpoint, NoticesAnAlteredByteAnywhere) {
  const Tissue tissue = make_tissue(comm, library);
  ASSERT_TRUE(write_checkpoint(path, tissue, kInfo, comm).ok());
  if (!comm.is_root()) return;
  const Comm alone(MPI_COMM_SELF);
  const std::string hash = state_hash(make_tissue(alone, library), alone).hex();
  const std::string good = slurp(path);
  std::mt19937_64 engine(11);
  int refused = 0;
  const int wanted = tries(150, comm);
  for (int i = 0; i < wanted; ++i) {
    std::string bad = good;
    const std::size_t place = engine() % bad.size();
    bad[place] = static_cast<char>(bad[place] ^ (1 << (engine() % 8)));
    spit(folder / "bad.h5", bad);
    const auto loaded = read_checkpoint(folder / "bad.h5", model, library, alone);
    refused += !loaded.ok();
    // A byte that belongs to nothing may change; the state must not.
    if (loaded.ok()) {
      EXPECT_EQ(state_hash(loaded->tissue, alone).hex(), hash) << "byte " << place;
      EXPECT_EQ(loaded->info.study_hash, kInfo.study_hash);
    }
  }
  EXPECT_GT(refused, wanted * 9 / 10);
}

TEST_F(Checkpoint, NoticesEveryAlteredByteOfTheValues) {
  ASSERT_TRUE(write_checkpoint(path, make_tissue(comm, library), kInfo, comm).ok());
  if (!comm.is_root()) return;
  const Comm alone(MPI_COMM_SELF);
  const std::string good = slurp(path);
  const Tissue tissue = make_tissue(alone, library);
  std::mt19937_64 engine(12);
  for (int i = 0; i < tries(50, comm); ++i) {
    // a value that is in the file: a node of a shell, found by its bytes
    const Vec3d node = tissue.shells.position[engine() % tissue.shells.position.size()];
    const std::string bytes(reinterpret_cast<const char*>(&node), sizeof node);
    const std::size_t place = good.find(bytes);
    ASSERT_NE(place, std::string::npos);
    std::string bad = good;
    bad[place + engine() % bytes.size()] ^= 1;
    spit(folder / "bad.h5", bad);
    const auto loaded = read_checkpoint(folder / "bad.h5", model, library, alone);
    ASSERT_FALSE(loaded.ok());
    EXPECT_EQ(loaded.error().kind, ErrorKind::kFile);
    EXPECT_NE(loaded.error().message.find("shells/position"), std::string::npos) << loaded.error().message;
  }
}

TEST_F(Checkpoint, NoticesTruncation) {
  ASSERT_TRUE(write_checkpoint(path, make_tissue(comm, library), kInfo, comm).ok());
  if (!comm.is_root()) return;
  const Comm alone(MPI_COMM_SELF);
  const std::string good = slurp(path);
  std::vector<std::size_t> lengths{0, 1, 100, good.size() - 1};
  for (std::size_t i = 1; i < 20; ++i) lengths.push_back(i * good.size() / 20);
  for (const std::size_t length : lengths) {
    spit(folder / "cut.h5", good.substr(0, length));
    const auto loaded = read_checkpoint(folder / "cut.h5", model, library, alone);
    ASSERT_FALSE(loaded.ok()) << length << " bytes of " << good.size();
    EXPECT_EQ(loaded.error().kind, ErrorKind::kFile);
    EXPECT_NE(loaded.error().message.find("cut.h5"), std::string::npos);
  }
}

TEST_F(Checkpoint, OfAnotherVersionIsRefusedNamingBoth) {
  StoragePlan plan(comm);
  plan.add_value("format_version", "1", std::uint32_t{77});
  plan.add_text("info/morula_version", "9.9.9");
  ASSERT_TRUE(create_file(path, std::move(plan), comm).ok());
  const auto loaded = read_checkpoint(path, model, library, comm);
  ASSERT_FALSE(loaded.ok());
  EXPECT_EQ(loaded.error().kind, ErrorKind::kInput);
  for (const std::string& part : {std::string("77"), std::string("9.9.9"), "reads version " + std::to_string(kCheckpointFormat)})
    EXPECT_NE(loaded.error().message.find(part), std::string::npos) << loaded.error().message;
}

TEST_F(Checkpoint, OfAnotherModelIsRefused) {
  ASSERT_TRUE(write_checkpoint(path, make_tissue(comm, library), kInfo, comm).ok());
  Model other = model;
  other.fields.resize(1);
  const auto loaded = read_checkpoint(path, other, library, comm);
  ASSERT_FALSE(loaded.ok());
  EXPECT_EQ(loaded.error().kind, ErrorKind::kInput);
  other = model;
  other.types.resize(1);
  EXPECT_FALSE(read_checkpoint(path, other, library, comm).ok());
}

TEST_F(Checkpoint, MissingFileIsAClearError) {
  const auto loaded = read_checkpoint(folder / "none.h5", model, library, comm);
  ASSERT_FALSE(loaded.ok());
  EXPECT_EQ(loaded.error().kind, ErrorKind::kFile);
  EXPECT_NE(loaded.error().message.find("none.h5"), std::string::npos);
}

/// The size of files this process may write.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_limit_);
    const rlimit limit{bytes, old_limit_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_handler_);
  }

 private:
  rlimit old_limit_{};
  void (*old_handler_)(int);
};

TEST_F(Checkpoint, RunningOutOfRoomLeavesTheOldOneAndIsAnErrorOnAllRanks) {
  const Tissue tissue = make_tissue(comm, library);
  ASSERT_TRUE(write_checkpoint(path, tissue, kInfo, comm).ok());
  const std::string good = slurp(path);
  for (const double part : {0.0, 0.1, 0.5, 0.9}) {
    const FileSizeLimit limit(static_cast<rlim_t>(part * static_cast<double>(good.size())));
    const Status written = write_checkpoint(path, tissue, kInfo, comm);
    ASSERT_FALSE(written.ok()) << "with room for " << part << " of it";
    EXPECT_EQ(written.error().kind, ErrorKind::kResources) << written.error().message;
    comm.barrier();
    EXPECT_FALSE(std::filesystem::exists(folder / "cp.h5.tmp"));
    EXPECT_TRUE(slurp(path) == good);
  }
}

TEST_F(Checkpoint, FullDiskIsAnErrorAndNothingIsLost) {
  std::filesystem::path disk = folder / "disk";
  bool mounted = false;
  if (comm.is_root()) {
    std::filesystem::create_directory(disk);
    mounted = ::mount("none", disk.c_str(), "tmpfs", 0, "size=160k") == 0;
  }
  if (!comm.any(mounted)) GTEST_SKIP() << "no right to mount a small disk here";
  const Tissue tissue = make_tissue(comm, library, 20);
  const Status first = write_checkpoint(disk / "a.h5", tissue, kInfo, comm);
  EXPECT_TRUE(first.ok()) << first.error().message;
  const Status second = write_checkpoint(disk / "b.h5", make_tissue(comm, library, 60), kInfo, comm);
  EXPECT_FALSE(second.ok());
  if (!second.ok()) {
    EXPECT_EQ(second.error().kind, ErrorKind::kResources) << second.error().message;
  }
  EXPECT_TRUE(read_checkpoint(disk / "a.h5", model, library, comm).ok());
  comm.barrier();
  if (comm.is_root()) {
    EXPECT_FALSE(std::filesystem::exists(disk / "b.h5"));
    ::umount2(disk.c_str(), MNT_DETACH);
  }
}

TEST_F(Checkpoint, EveryDatasetSaysItsUnits) {
  ASSERT_TRUE(write_checkpoint(path, make_tissue(comm, library), kInfo, comm).ok());
  const auto file = Hdf5Reader::open(path);
  ASSERT_TRUE(file.ok());
  EXPECT_EQ(file->units("cells/pressure").value(), "kPa");
  EXPECT_EQ(file->units("shells/position").value(), "um");
  EXPECT_EQ(file->units("fields/1/concentration").value(), "mM");
  EXPECT_EQ(file->units("clock/time").value(), "s");
}

}  // namespace
}  // namespace morula::scenarios
