#include "study/initial/cells_from_meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/mesh/remesh.h"
#include "core/mesh/surface_file.h"
#include "dcm/growth.h"
#include "results/state_hash.h"
#include "study/initial/make_tissue.h"
#include "tests/study/mesh_files.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

using test::as_vtk;
using test::ball;
using test::mesh_study;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

const std::vector<TriangleMesh> kPair{ball(6.0, {-6.1, 0, 0}), ball(5.0, {5.0, 0, 0})};

class CellsFromMeshes : public testing::Test {
 protected:
  Study good(const std::string& meshes, const std::string& entry = "type: cell, ") {
    auto study = test::read(mesh_study(meshes, entry), {}, folder_.path());
    EXPECT_TRUE(study.ok()) << study.error().text();
    return study.ok() ? std::move(study).value() : Study{};
  }
  std::string bad(const std::string& meshes, const std::string& entry = "type: cell, ") {
    return test::errors_of(mesh_study(meshes, entry), {}, folder_.path());
  }
  Tissue tissue(const Study& study) {
    auto made = make_tissue(study, shapes_, Comm());
    EXPECT_TRUE(made.ok()) << made.error().message;
    return made.ok() ? std::move(made->tissue) : Tissue{};
  }
  /// The cell with this founder's number.
  static std::size_t shell_of(const Tissue& tissue, std::uint64_t number) {
    for (std::size_t i = 0; i < tissue.cells.size(); ++i)
      if (tissue.cells.rows[i].id.founder_number() == number) return i;
    ADD_FAILURE() << "no cell " << number;
    return 0;
  }

  test::Folder folder_;
  ShapeLibrary shapes_;
};

double volume(const TriangleMesh& mesh) { return enclosed_volume(mesh.faces, mesh.position, {}); }

TEST_F(CellsFromMeshes, HaveTheSurfacesOfTheFileAsTheirShapeAtRest) {
  folder_.write("a.vtk", as_vtk(kPair));
  const Study study = good("file: a.vtk, scale: 1 um");
  ASSERT_EQ(study.initial[0].count, 2u);
  const Tissue made = tissue(study);
  ASSERT_EQ(made.shells.size(), 2u);
  for (std::uint64_t cell = 1; cell <= 2; ++cell) {
    const std::size_t i = shell_of(made, cell);
    const double wanted = volume(kPair[cell - 1]);
    const auto nodes = made.shells.nodes(i);
    EXPECT_NEAR(enclosed_volume(made.shells.topology(i).faces(), nodes, {}), wanted, 1e-6 * wanted);
    EXPECT_NEAR(made.cells.rows[i].target_volume, wanted, 1e-6 * wanted);
    EXPECT_NEAR(made.shells.rest_volume[i], wanted, 1e-6 * wanted);
    const Edge& edge = made.shells.topology(i).edges()[7];
    EXPECT_NEAR(made.shells.rest_length[made.shells.first_edge[i] + 7], norm(nodes[edge.i] - nodes[edge.j]), 1e-9);
    EXPECT_EQ(made.cells.rows[i].body, BodyKind::kShell);
  }
}

TEST_F(CellsFromMeshes, ComeAlikeFromVtkStlAndObjByPartComponentArrayAndFile) {
  folder_.write("a.vtk", as_vtk(kPair, "SCALARS id int\nLOOKUP_TABLE default\n30 20\n"));
  TriangleMesh both = kPair[0];
  for (const Vec3d& p : kPair[1].position) both.position.push_back(p);
  for (const Triangle& f : kPair[1].faces) both.faces.push_back({f[0] + 162, f[1] + 162, f[2] + 162});
  ASSERT_TRUE(write_stl(folder_.path() / "both.stl", both).ok());
  ASSERT_TRUE(write_stl(folder_.path() / "one.stl", kPair[0]).ok());
  ASSERT_TRUE(write_stl(folder_.path() / "two.stl", kPair[1]).ok());
  std::string obj;
  for (std::size_t c = 0; c < 2; ++c) {
    obj += "o cell" + std::to_string(c) + "\n";
    for (const Vec3d& p : kPair[c].position)
      obj += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
    for (const Triangle& f : kPair[c].faces)
      obj += "f " + std::to_string(f[0] + 1 + 162 * c) + " " + std::to_string(f[1] + 1 + 162 * c) + " " +
             std::to_string(f[2] + 1 + 162 * c) + "\n";
  }
  folder_.write("a.obj", obj);
  for (const char* source : {"file: a.vtk", "file: a.vtk, cell_is: component", "file: both.stl", "files: [one.stl, two.stl], cell_is: file",
                             "file: a.obj", "file: a.obj, cell_is: part", "file: a.obj, cell_is: component"}) {
    SCOPED_TRACE(source);
    const Study study = good(std::string(source) + ", scale: 1 um");
    const MeshCellsRead read = read_mesh_cells(study.initial[0].meshes, 0, true);
    ASSERT_EQ(read.cells.size(), 2u);
    for (std::size_t c = 0; c < 2; ++c) {
      EXPECT_NEAR(read.cells[c].volume, volume(kPair[c]), 1e-4 * volume(kPair[c]));
      EXPECT_EQ(read.cells[c].mesh.position.size(), 162u);
    }
  }
  const MeshCellsRead by_id = read_mesh_cells(good("file: a.vtk, scale: 1 um, id_array: id").initial[0].meshes, 0, true);
  ASSERT_EQ(by_id.cells.size(), 2u);
  EXPECT_LT(by_id.cells[0].volume, by_id.cells[1].volume) << "in the order of the numbers";
  EXPECT_THAT(by_id.cells[0].name, HasSubstr("(id 20)"));
}

TEST_F(CellsFromMeshes, TakeTypesFromAListOrAnArray) {
  folder_.write("a.vtk", as_vtk(kPair, "SCALARS kind int\nLOOKUP_TABLE default\n1 0\n"));
  const Tissue listed = tissue(good("file: a.vtk, scale: 1 um, types: [other, cell]", ""));
  EXPECT_EQ(listed.cells.rows[shell_of(listed, 1)].type, 1);
  EXPECT_EQ(listed.cells.rows[shell_of(listed, 2)].type, 0);
  const Tissue by_array = tissue(good("file: a.vtk, scale: 1 um, types: [cell, other], type_array: kind", ""));
  EXPECT_EQ(by_array.cells.rows[shell_of(by_array, 1)].type, 1);
  EXPECT_EQ(by_array.cells.rows[shell_of(by_array, 2)].type, 0);
}

TEST_F(CellsFromMeshes, StartWithThePressureOfTheFile) {
  folder_.write("a.vtk", as_vtk(kPair, "SCALARS p float\nLOOKUP_TABLE default\n120 -30\n"));
  const Tissue made = tissue(good("file: a.vtk, scale: 1 um, pressure_array: p, pressure_unit: 1 Pa"));
  for (const auto& [cell, pressure] : {std::pair(1u, 0.12), std::pair(2u, -0.03)}) {
    const std::size_t i = shell_of(made, cell);
    const double inside = enclosed_volume(made.shells.topology(i).faces(), made.shells.nodes(i), {});
    EXPECT_NEAR(-2.5 * std::log(inside / made.shells.reference_volume[i]), pressure, 1e-9) << "p = -K_V ln(V/V0), K_V = 2.5 kPa by default";
  }
}

TEST_F(CellsFromMeshes, AreRemeshedAndMovedTogether) {
  if (!has_remesher()) GTEST_SKIP() << "this build has no remesher (MORULA_WITH_GPL)";
  folder_.write("a.vtk", as_vtk({ball(6.0, {-6.1, 40, 0}, 3), ball(5.0, {5.0, 40, 0}, 3)}));
  const Study study = good("file: a.vtk, scale: 1 um, nodes: 162, center: [1 um, 2 um, 3 um]");
  EXPECT_THAT(study.notes, Contains(HasSubstr("2 cells remeshed to")));
  const Tissue made = tissue(study);
  Vec3d moment;
  double whole = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(static_cast<double>(made.shells.nodes(i).size()), 162.0, 9.0);
    const double inside = enclosed_volume(made.shells.topology(i).faces(), made.shells.nodes(i), {});
    EXPECT_NEAR(inside, made.cells.rows[i].target_volume, 1e-9 * inside);
    moment += volume_centroid(made.shells.topology(i).faces(), made.shells.nodes(i)) * inside;
    whole += inside;
  }
  EXPECT_NEAR(norm(moment / whole - Vec3d{1, 2, 3}), 0.0, 0.02);
  EXPECT_NE(made.shells.shape[0]->topology, made.shells.shape[1]->topology);
}

TEST_F(CellsFromMeshes, AreMendedAndTheLogNamesWhatWas) {
  std::vector<TriangleMesh> cells = kPair;
  for (const std::uint32_t f : {40u, 41u}) std::swap(cells[1].faces[f][0], cells[1].faces[f][1]);
  folder_.write("a.vtk", as_vtk(cells));
  const Study study = good("file: a.vtk, scale: 1 um");
  EXPECT_THAT(study.notes, Contains(AllOf(HasSubstr("a.vtk, cell 1: a patch of"), HasSubstr("turned over"))));
  EXPECT_THAT(bad("file: a.vtk, scale: 1 um, repair: false"), AllOf(HasSubstr("a.vtk, cell 1: "), HasSubstr("against the faces around"),
                                                                    HasSubstr("[E622]"), HasSubstr("leave `repair: false` away")));
}

TEST_F(CellsFromMeshes, RefuseSurfacesThatAreNoneNamingCellAndPlace) {
  std::vector<TriangleMesh> cells = kPair;
  cells[1].faces.erase(cells[1].faces.begin() + 50);
  folder_.write("open.vtk", as_vtk(cells));
  EXPECT_THAT(bad("file: open.vtk, scale: 1 um"),
              AllOf(HasSubstr("study.yaml:11:"), HasSubstr("open.vtk, cell 1: the surface is open"), HasSubstr("[E621]")));
  cells = kPair;
  cells[0].position[3] = cells[0].position[3] * -1.0 + Vec3d{-12.2, 0, 0};  // through the middle to the other side and beyond
  cells[0].position[3] += (cells[0].position[3] - Vec3d{-6.1, 0, 0}) * 0.5;
  folder_.write("crossing.vtk", as_vtk(cells));
  EXPECT_THAT(bad("file: crossing.vtk, scale: 1 um"),
              AllOf(HasSubstr("crossing.vtk, cell 0: faces "), HasSubstr("cross or touch"), HasSubstr("[E623]")));
  cells = {ball(6.0, {-6.1, 0, 0}), ball(5.0, {3.0, 0, 0})};
  folder_.write("deep.vtk", as_vtk(cells));
  EXPECT_THAT(bad("file: deep.vtk, scale: 1 um"), AllOf(HasSubstr("deep.vtk, cell 0 reaches 1.8"), HasSubstr("um into deep.vtk, cell 1"),
                                                        HasSubstr("through face"), HasSubstr("[E546]")));
  EXPECT_THAT(bad("file: deep.vtk, scale: 1 um, overlap: 2.1 um"), AllOf(HasSubstr("would stop at its limit"), HasSubstr("[E597]")));
  const auto allowed =
      test::read(mesh_study("file: deep.vtk, scale: 1 um, overlap: 2.1 um") + "limits: {overlap: 2.1 um}\n", {}, folder_.path());
  ASSERT_TRUE(allowed.ok()) << allowed.error().text();
  EXPECT_THAT(allowed->notes, Contains(HasSubstr("deepest overlap at the start")));
}

TEST_F(CellsFromMeshes, RefuseFilesThatCannotBeRead) {
  folder_.write("a.vtk", as_vtk(kPair, "SCALARS p float\nLOOKUP_TABLE default\n120 -30\n"));
  EXPECT_THAT(bad("file: none.vtk, scale: 1 um"), HasSubstr("file 'none.vtk' does not exist [E601]"));
  EXPECT_THAT(bad("file: ., scale: 1 um"), HasSubstr("[E602]"));
  folder_.write("empty.vtk", "");
  EXPECT_THAT(bad("file: empty.vtk, scale: 1 um"), AllOf(HasSubstr("is empty"), HasSubstr("[E620]")));
  folder_.write("garbage.vtk", std::string("\x7f"
                                           "ELF\0\x01\xfe garbage",
                                           15));
  EXPECT_THAT(bad("file: garbage.vtk, scale: 1 um"), AllOf(HasSubstr("is no legacy VTK file"), HasSubstr("[E620]")));
  std::vector<TriangleMesh> nan = kPair;
  nan[1].position[5].y = std::nan("");
  folder_.write("nan.vtk", as_vtk(nan));
  EXPECT_THAT(bad("file: nan.vtk, scale: 1 um"), AllOf(HasSubstr("point 167"), HasSubstr("not finite"), HasSubstr("[E620]")));
  folder_.write("a.ply", "ply\n");
  EXPECT_THAT(bad("file: a.ply, scale: 1 um"), HasSubstr("cells are read from .vtk (legacy), .stl and .obj files"));
}

TEST_F(CellsFromMeshes, RefuseKeysThatAreMissingOrContradictEachOther) {
  folder_.write("a.vtk", as_vtk(kPair, "SCALARS p float\nLOOKUP_TABLE default\n120 -30\n"));
  EXPECT_THAT(bad("file: a.vtk"), AllOf(HasSubstr("'scale' is missing"), HasSubstr("[E103]")));
  EXPECT_THAT(bad("file: a.vtk, scale: 1"), HasSubstr("[E201]"));
  EXPECT_THAT(bad("file: a.vtk, scale: 0 um"), HasSubstr("[E302]"));
  EXPECT_THAT(bad("scale: 1 um"), HasSubstr("`meshes` needs either `file` or `files`"));
  EXPECT_THAT(bad("file: a.vtk, scale: 1 m"), AllOf(HasSubstr("which is no cell [E550]"), HasSubstr("check `scale`")));
  EXPECT_THAT(bad("file: a.vtk, scale: 1 um, id_array: ids"), AllOf(HasSubstr("has no array 'ids' [E545]"), HasSubstr("it has `p`")));
  EXPECT_THAT(bad("file: a.vtk, scale: 1 um, pressure_array: q, pressure_unit: 1 Pa"), HasSubstr("[E545]"));
  EXPECT_THAT(bad("file: a.vtk, scale: 1 um, pressure_array: p"), HasSubstr("belong together"));
  EXPECT_THAT(bad("file: a.vtk, scale: 1 um, types: [cell]", ""),
              AllOf(HasSubstr("names 1 cell types, and there are 2 cells"), HasSubstr("[E549]")));
  EXPECT_THAT(bad("file: a.vtk, scale: 1 um, types: [cell, cell], type_array: p", ""), HasSubstr("type number 120"));
  EXPECT_THAT(bad("file: a.vtk, scale: 1 um, types: [cell, sell]", ""), HasSubstr("no cell type 'sell'"));
  EXPECT_THAT(bad("file: a.vtk, scale: 1 um, types: [cell, cell]"), HasSubstr("both say the type"));
  EXPECT_THAT(bad("file: a.vtk, scale: 1 um", ""), HasSubstr("key 'type' is missing"));
  EXPECT_THAT(bad("file: a.vtk, scale: 1 um, nodes: 162, edge: 1 um"), HasSubstr("both say how fine"));
  EXPECT_THAT(bad("file: a.vtk, scale: 1 um, cell_is: file"), AllOf(HasSubstr("consists of 2 separate surfaces"), HasSubstr("[E547]")));
  if (has_remesher()) {
    EXPECT_THAT(bad("file: a.vtk, scale: 1 um, edge: 30 um"), HasSubstr("[E548]"));
    EXPECT_THAT(bad("file: a.vtk, scale: 1 um, edge: 0.001 um"), AllOf(HasSubstr("a cell can have 15000"), HasSubstr("[E548]")));
    std::vector<TriangleMesh> spiked = kPair;
    spiked[1].position[0] = spiked[1].position[0] * 1e5;  // as a damaged file has it
    folder_.write("spiked.vtk", as_vtk(spiked));
    EXPECT_THAT(bad("file: spiked.vtk, scale: 1 um, nodes: 162"), AllOf(HasSubstr("too many pieces"), HasSubstr("[E548]")));
    EXPECT_THAT(bad("file: a.vtk, scale: 1 um, nodes: 642"), AllOf(HasSubstr("more than half of the mean edge"), HasSubstr("[E503]")));
  } else {
    EXPECT_THAT(bad("file: a.vtk, scale: 1 um, edge: 30 um"), AllOf(HasSubstr("cannot remesh cells"), HasSubstr("[E691]")));
    EXPECT_THAT(bad("file: a.vtk, scale: 1 um, nodes: 642"), HasSubstr("[E691]"));
  }
  EXPECT_THAT(bad("file: a.vtk, scale: 1 um, center: [48 um, 0 um, 0 um]"), HasSubstr("reaches out of the domain"));
  EXPECT_THAT(bad("file: a.vtk, scale: 1 um", "type: cell, as: sphere, "), HasSubstr("cells from meshes are shells"));
  EXPECT_THAT(bad("file: a.vtk, scale: 1 um", "type: cell, start_volume: 50 %, inflate: 1 s, "),
              HasSubstr("'start_volume' has no meaning"));
  EXPECT_THAT(bad("file: a.vtk, scale: 1 um", "type: cell, shape: biconcave, "), HasSubstr("of their own"));
  EXPECT_THAT(bad("file: a.vtk, scale: 1 um", "type: cell, at: [[0 um, 0 um, 0 um]], "),
              HasSubstr("only one of `fill`, `at`, `csv` and `meshes`"));
}

TEST_F(CellsFromMeshes, ReadToTheSameStudyFromTheResolvedText) {
  if (!has_remesher()) GTEST_SKIP() << "this build has no remesher (MORULA_WITH_GPL)";
  folder_.write("a.vtk", as_vtk(kPair, "SCALARS p float\nLOOKUP_TABLE default\n120 -30\n"));
  const Study study = good("files: [a.vtk], scale: 1 um, pressure_array: p, pressure_unit: 1 Pa, nodes: 120");
  ASSERT_EQ(study.input_files.size(), 1u);
  EXPECT_EQ(study.input_files[0].copy, "inputs/a.vtk");
  folder_.write("run/inputs/a.vtk", as_vtk(kPair, "SCALARS p float\nLOOKUP_TABLE default\n120 -30\n"));
  const auto again = test::read(study.resolved_text, {}, folder_.path() / "run");
  ASSERT_TRUE(again.ok()) << again.error().text() << study.resolved_text;
  EXPECT_EQ(state_hash(tissue(*again), Comm()).hex(), state_hash(tissue(study), Comm()).hex());
}

TEST(TargetVolume, GivesAFreeCellTheReferenceVolumeOfThePressure) {
  const double target = target_volume_of(9000.0, 0.12, 1.0, 2.5);
  EXPECT_NEAR(dcm::pressure_free_reference(target, 1.0, 2.5), 9000.0 * std::exp(0.12 / 2.5), 1e-9 * 9000.0);
  // At the Laplace pressure of its sphere a cell is free: its target is its volume.
  const double radius = std::cbrt(3.0 * 9000.0 / (4.0 * std::numbers::pi));
  EXPECT_NEAR(target_volume_of(9000.0, 2.0 / radius, 1.0, 2.5), 9000.0, 1e-8);
}

}  // namespace
}  // namespace morula::scenarios
