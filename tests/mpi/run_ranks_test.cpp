#include <gtest/gtest.h>

#include "scenarios/run/driver.h"
#include "tests/results/results_support.h"

namespace morula::scenarios {
namespace {

using testing_support::Folder;
using testing_support::slurp;

// A core of shells in growing and migrating spheres, with oxygen: everything that may depend on who owns what.
const std::string kHybrid = R"(schema: 1
study: hybrid
time: {end: 20 min, output: 5 min}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  cell:
    radius: {mean: 6 um, spread: 10 %}
    cycle: {model: volume_threshold, duration: {mean: 3 h, spread: 20 %}}
    migration: {speed: 5 um/h, persistence: 30 min}
    dcm: {nodes: 42}
contact: {range: 1 um}
initial:
  - {type: cell, count: 24, fill: sphere, radius: 40 um}
fields:
  oxygen: {diffusion: 2e-9 m^2/s, initial: 0.2 mM, boundary: {all: 0.2 mM}, uptake: {cell: 40 amol/s}, voxel: 20 um}
coupling:
  regions:
    - {name: core, shape: sphere, center: [0 um, 0 um, 0 um], radius: 14 um, as: dcm, margin: 3 um}
output: {report: false}
)";

Study hybrid() {
  auto study = read_study_text("study.yaml", kHybrid, ".");
  EXPECT_TRUE(study.ok()) << study.error().text();
  return std::move(study).value();
}

RunSummary expect_run(const std::filesystem::path& out, const Comm& comm, std::optional<double> until = {}) {
  RunRequest request;
  request.out = out;
  request.until = until;
  auto done = run(hybrid(), request, comm);
  EXPECT_TRUE(done.ok()) << done.error().message;
  return done.ok() ? std::move(done).value() : RunSummary{};
}

/// The run on one rank, made by the root; its hash on all ranks.
std::string hash_alone(const Folder& folder, const Comm& all) {
  std::vector<std::byte> bytes;
  if (all.is_root()) {
    const std::string hash = expect_run(folder / "alone", Comm(MPI_COMM_SELF)).final_state.state_hash;
    bytes.resize(hash.size());
    std::memcpy(bytes.data(), hash.data(), hash.size());
  }
  all.broadcast(bytes);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(RunOnRanks, EndsInTheBitsOfOneRank) {
  const Comm all(MPI_COMM_WORLD);
  const Folder folder(all);
  const std::string alone = hash_alone(folder, all);
  const RunSummary together = expect_run(folder / "together", all);
  EXPECT_GE(together.final_state.shells, 2u);
  EXPECT_EQ(together.final_state.state_hash, alone);
  all.barrier();
  if (all.is_root()) {
    EXPECT_EQ(slurp(folder / "together/series.csv"), slurp(folder / "alone/series.csv"));
    EXPECT_EQ(slurp(folder / "together/events.jsonl"), slurp(folder / "alone/events.jsonl"));
  }
}

TEST(RunOnRanks, ResumesOnAnotherNumberOfRanks) {
  const Comm all(MPI_COMM_WORLD);
  const Folder folder(all);
  const std::string alone = hash_alone(folder, all);
  if (all.is_root()) expect_run(folder / "split", Comm(MPI_COMM_SELF), 600.0);
  all.barrier();
  const auto done = resume(folder / "split", {}, all);
  ASSERT_TRUE(done.ok()) << done.error().message;
  EXPECT_EQ(done->final_state.state_hash, alone);
}

}  // namespace
}  // namespace morula::scenarios
