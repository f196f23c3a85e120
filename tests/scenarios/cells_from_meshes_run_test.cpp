// Cells with meshes of their own through a whole run: steps, snapshots, VTK files, pictures, and surfaces that can be read again.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "scenarios/initial/cells_from_meshes.h"
#include "scenarios/results/export.h"
#include "scenarios/results/snapshot_file.h"
#include "scenarios/run/driver.h"
#include "tests/scenarios/mesh_files.h"
#include "tests/scenarios/study_fixture.h"

namespace morula::scenarios {
namespace {

TEST(RunOfCellsFromMeshes, WritesTheSurfacesOfAllTopologies) {
  const test::Folder folder;
  folder.write("a.vtk", test::as_vtk({test::ball(6.0, {-6.0, 0, 0}, 3), test::ball(5.0, {5.0, 0, 0}, 2)}));
  std::string text = test::mesh_study("file: a.vtk, scale: 1 um, nodes: 100");
  text = test::changed("output: {report: false}", "output: {formats: [hdf5, vtk]}", text);
  const auto study = test::read(text, {}, folder.path());
  ASSERT_TRUE(study.ok()) << study.error().text();
  RunRequest request;
  request.out = folder.path() / "run";
  const auto run = scenarios::run(*study, request, Comm());
  ASSERT_TRUE(run.ok()) << run.error().message;
  const auto snapshot = read_snapshot(run->path / "results.h5", 2);
  ASSERT_TRUE(snapshot.ok()) << snapshot.error().message;
  ASSERT_EQ(snapshot->shells.size(), 2u);
  EXPECT_EQ(snapshot->topologies.size(), 2u);
  std::size_t pictures = 0, vtk = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(run->path)) {
    pictures += entry.path().extension() == ".png";
    vtk += entry.path().extension() == ".vtu";
  }
  EXPECT_GE(pictures, 2u);
  EXPECT_GE(vtk, 3u);

  // What a run wrote can be the start of another one.
  ASSERT_TRUE(export_snapshots(run->path / "results.h5", folder.path() / "stl", ExportFormat::kStl, {}).ok());
  std::filesystem::path last;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "stl"))
    if (entry.path().extension() == ".stl" && entry.path() > last) last = entry.path();
  const auto again = test::read(test::mesh_study("file: " + last.string() + ", scale: 1 um"), {}, folder.path());
  ASSERT_TRUE(again.ok()) << again.error().text();
  const MeshCellsRead read = read_mesh_cells(again->initial[0].meshes, 0, true);
  ASSERT_EQ(read.cells.size(), 2u);
  for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(read.cells[c].volume, snapshot->cells[c].volume, 1e-5 * snapshot->cells[c].volume);
}

}  // namespace
}  // namespace morula::scenarios
