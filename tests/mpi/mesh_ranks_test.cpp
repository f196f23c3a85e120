/// Cells with meshes of their own on all ranks against one: the same bits, also over a restart. Each has its own topology, one has the faces of an
/// icosphere and another shape.
#include <gtest/gtest.h>

#include <cstring>

#include "core/mesh/remesh.h"
#include "scenarios/run/driver.h"
#include "tests/results/results_support.h"
#include "tests/study/mesh_files.h"

namespace morula::scenarios {
namespace {

using testing_support::Folder;
using testing_support::slurp;

/// Eight ellipsoids in two layers, pressed a little into each other, each another one.
std::string cells_file() {
  std::vector<TriangleMesh> cells;
  for (int i = 0; i < 8; ++i) {
    const Vec3d center{10.1 * (i % 2) - 5.0, 10.2 * (i / 2 % 2) - 5.0, 10.15 * (i / 4) - 5.0};
    TriangleMesh cell = test::ball(1.0, {}, 2);
    for (Vec3d& p : cell.position) p = center + Vec3d{p.x * (5.0 + 0.02 * i), p.y * 5.1, p.z * (5.1 - 0.03 * i)};
    cells.push_back(std::move(cell));
  }
  return test::as_vtk(cells);
}

const std::string kStudy = R"(schema: 1
study: own_meshes
seed: 4
time: {end: 10 s, output: 5 s, checkpoint: 5 s}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  cell:
    radius: 5 um
    adhesion: {cell: 0.1 mJ/m^2, disc: 0.05 mJ/m^2}
    migration: {speed: 50 um/h, persistence: 10 min}
    dcm: {cortex: {tension: 0.2 mN/m}}
  disc:
    radius: 3 um
    dcm: {nodes: 42, cortex: {tension: 0.01 mN/m}}
contact: {range: 0.8 um}
initial:
  - {type: cell, meshes: {file: cells.vtk, scale: 1 um, nodes: 60}}
  - {type: disc, at: [[0.1 um, 0.2 um, 17 um]], as: shell, shape: biconcave}
output: {report: false}
)";

Study study_in(const std::filesystem::path& folder) {
  auto study = read_study_text("study.yaml", kStudy, folder);
  EXPECT_TRUE(study.ok()) << study.error().text();
  return std::move(study).value();
}

RunSummary expect_run(const Study& study, const std::filesystem::path& out, const Comm& comm, std::optional<double> until = {}) {
  RunRequest request;
  request.out = out;
  request.until = until;
  auto done = run(study, request, comm);
  EXPECT_TRUE(done.ok()) << done.error().message;
  return done.ok() ? std::move(done).value() : RunSummary{};
}

TEST(MeshesOnRanks, EndInTheBitsOfOneRankAndResumeOnAnotherNumber) {
  if (!has_remesher()) GTEST_SKIP() << "this build has no remesher (MORULA_WITH_GPL)";
  const Comm all(MPI_COMM_WORLD), alone(MPI_COMM_SELF);
  const Folder folder(all);
  if (all.is_root()) std::ofstream(folder / "cells.vtk") << cells_file();
  all.barrier();
  const Study study = study_in(folder / ".");
  std::vector<std::byte> bytes;
  if (all.is_root()) {
    const std::string hash = expect_run(study, folder / "alone", alone).final_state.state_hash;
    bytes.resize(hash.size());
    std::memcpy(bytes.data(), hash.data(), hash.size());
    expect_run(study, folder / "split", alone, 5.0);
  }
  all.broadcast(bytes);
  const std::string reference(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const RunSummary together = expect_run(study, folder / "together", all);
  EXPECT_EQ(together.final_state.shells, 9u);
  EXPECT_EQ(together.final_state.state_hash, reference);
  all.barrier();
  const auto resumed = resume(folder / "split", {}, all);
  ASSERT_TRUE(resumed.ok()) << resumed.error().message;
  EXPECT_EQ(resumed->final_state.state_hash, reference);
  if (all.is_root()) {
    EXPECT_EQ(slurp(folder / "together/series.csv"), slurp(folder / "alone/series.csv"));
  }
}

}  // namespace
}  // namespace morula::scenarios
