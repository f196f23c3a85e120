// Cells with meshes of their own through a whole run: steps, snapshots, VTK files, pictures, and surfaces that can be read again.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "core/mesh/remesh.h"
#include "results/export.h"
#include "results/snapshot_file.h"
#include "scenarios/run/driver.h"
#include "study/initial/cells_from_meshes.h"
#include "tests/study/mesh_files.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

TEST(RunOfCellsFromMeshes, WritesTheSurfacesOfAllTopologies) {
  if (!has_remesher()) GTEST_SKIP() << "this build has no remesher (MORULA_WITH_GPL)";
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

/// `mesh_study` whose cells have a nucleus of 2 µm, in parts of a radius of 6 µm, and links to it.
std::string with_nucleus(const std::string& meshes, const std::string& kind) {
  return test::changed("dcm: {cortex: {tension: 0.2 mN/m}}}\n  other",
                       "dcm: {cortex: {tension: 0.2 mN/m}, nucleus: {kind: " + kind +
                           ", radius: 2 um}, cytoskeleton: {nucleus_links: {number: 60, stiffness: 0.01 nN/um}}}}\n  other",
                       test::mesh_study(meshes));
}

TEST(RunOfCellsFromMeshes, GivesThemNucleiAtTheirCentroids) {
  const test::Folder folder;
  // An egg: half a ball of 6 µm and half an ellipsoid on it.
  TriangleMesh egg = test::ball(6.0, {}, 2);
  for (Vec3d& p : egg.position) p = Vec3d{1, 2, 3} + (p.z > 0.0 ? Vec3d{p.x, p.y, 1.5 * p.z} : p);
  folder.write("a.vtk", test::as_vtk({egg}));
  for (const char* kind : {"rigid", "shell"}) {
    SCOPED_TRACE(kind);
    const auto study = test::read(with_nucleus("file: a.vtk, scale: 1 um", kind), {}, folder.path());
    ASSERT_TRUE(study.ok()) << study.error().text();
    RunRequest request;
    request.out = folder.path() / kind;
    const auto run = scenarios::run(*study, request, Comm());
    ASSERT_TRUE(run.ok()) << run.error().message;
    const auto start = read_snapshot(run->path / "results.h5", 0), end = read_snapshot(run->path / "results.h5", 2);
    ASSERT_TRUE(start.ok() && end.ok());
    Vec3d nucleus = {};
    if (kind == std::string("rigid")) {
      ASSERT_EQ(start->nuclei.size(), 1u);
      nucleus = start->nuclei[0].center;
    } else {
      ASSERT_EQ(start->nuclear_shells.size(), 1u);
      for (const Vec3d& x : start->nuclear_nodes) nucleus += x * (1.0 / static_cast<double>(start->nuclear_nodes.size()));
    }
    EXPECT_LT(norm(nucleus - start->cells[0].centroid), 1e-4);
    // Two half ellipsoids of half axes 6 and 9: (3/8)(9² − 6²)/(9 + 6) above the plane between them.
    EXPECT_NEAR(nucleus.z - 3.0, 1.125, 0.05);
    EXPECT_EQ(end->nuclei.size() + end->nuclear_shells.size(), 1u);
  }
}

TEST(RunOfCellsFromMeshes, RefusesANucleusThatHasNoRoom) {
  const test::Folder folder;
  TriangleMesh plate = test::ball(6.0, {}, 2);
  for (Vec3d& p : plate.position) p.z *= 0.3;  // 1.8 µm from its middle
  folder.write("plate.vtk", test::as_vtk({plate}));
  // The radius is given for a ball of 6 µm and goes with the cube root of the volume: 2 µm · 0.3^(1/3) = 1.34 µm; 3 µm: 2.01 µm, less 1 % that a mesh lacks.
  EXPECT_TRUE(test::read(with_nucleus("file: plate.vtk, scale: 1 um", "rigid"), {}, folder.path()).ok());
  const std::string large = test::changed("radius: 2 um}", "radius: 3 um}", with_nucleus("file: plate.vtk, scale: 1 um", "rigid"));
  const auto refused = test::read(large, {}, folder.path());
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().text().find("plate.vtk has no room for its nucleus of radius 1.99 um"), std::string::npos)
      << refused.error().text();
  EXPECT_NE(refused.error().text().find("[E593]"), std::string::npos);
}

}  // namespace
}  // namespace morula::scenarios
