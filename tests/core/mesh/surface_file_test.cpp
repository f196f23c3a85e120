#include "core/mesh/surface_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <limits>

#include "core/mesh/icosphere.h"
#include "core/mesh/mesh_check.h"
#include "core/mesh/primitives.h"
#include "core/mesh/surface_bytes.h"
#include "core/mesh/weld_nodes.h"

namespace morula {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kTetrahedron = R"(solid a name with facet in it
facet normal 0 0 -1
 outer loop
  vertex 0 0 0
  vertex 0 1.0e0 0
  vertex +1 0 0
 endloop
endfacet
facet normal nan nan nan
 outer loop
  vertex 0 0 0
  vertex 1 0 0
  vertex 0 0 1
 endloop
endfacet
facet normal 0 0 0
 outer loop
  vertex 0 0 0
  vertex 0 0 1
  vertex -0.0 1 0
 endloop
endfacet
facet normal 0 0 0
 outer loop
  vertex 1 0 0
  vertex 0 1 0
  vertex 0 0 1
 endloop
endfacet
endsolid a name
)";

class SurfaceFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("morula_surface_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path write(const std::string& name, const std::string& content) {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }
  std::string message(const fs::path& file) {
    const auto result = read_surface(file);
    if (result.ok()) return "read";
    EXPECT_EQ(result.error().kind, ErrorKind::kFile);
    EXPECT_FALSE(result.error().help.empty());
    EXPECT_THAT(result.error().message, HasSubstr(file.filename().string()));
    return result.error().message;
  }
  static std::string slurp(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  fs::path folder_;
};

TEST_F(SurfaceFile, ReadsATextStlAndWeldsItsNodes) {
  const auto mesh = read_surface(write("t.STL", kTetrahedron), {.scale = 2.0});
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->position.size(), 4u);
  EXPECT_EQ(mesh->faces.size(), 4u);
  EXPECT_TRUE(check_mesh(mesh->position, mesh->faces).empty());
  EXPECT_NEAR(enclosed_volume(mesh->faces, mesh->position, Vec3d{}), 8.0 / 6.0, 1e-15);
}

TEST_F(SurfaceFile, ReadsBackTheStlItWrites) {
  const TriangleMesh sphere = *make_sphere(6.0, 3);
  const fs::path file = folder_ / "sphere.stl";
  ASSERT_TRUE(write_stl(file, sphere).ok());
  EXPECT_EQ(fs::file_size(file), 84u + 50u * sphere.faces.size());
  EXPECT_FALSE(fs::exists(file.string() + ".part"));
  const auto mesh = read_surface(file);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->position.size(), sphere.position.size());
  ASSERT_EQ(mesh->faces.size(), sphere.faces.size());
  for (std::size_t f = 0; f < sphere.faces.size(); ++f)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_LT(norm(mesh->position[mesh->faces[f][c]] - sphere.position[sphere.faces[f][c]]), 6.0 * 1.2e-7);
  EXPECT_TRUE(check_mesh(mesh->position, mesh->faces).empty());
}

TEST_F(SurfaceFile, TellsABinaryStlThatBeginsWithSolid) {
  ASSERT_TRUE(write_stl(folder_ / "a.stl", *make_box({1, 1, 1}, 1.0)).ok());
  std::string content = slurp(folder_ / "a.stl");
  std::memcpy(content.data(), "solid facet normal", 18);
  const auto mesh = read_surface(write("b.stl", content));
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->faces.size(), 12u);
  EXPECT_EQ(mesh->position.size(), 8u);
}

TEST_F(SurfaceFile, KeepsAnOlderStlWhenTheNewOneCannotBeWritten) {
  EXPECT_FALSE(write_stl(folder_ / "missing" / "a.stl", make_icosphere(0)).ok());
  fs::create_directories(folder_ / "taken.stl");
  EXPECT_FALSE(write_stl(folder_ / "taken.stl", make_icosphere(0)).ok());
  EXPECT_FALSE(fs::exists(folder_ / "taken.stl.part"));
  if (fs::exists("/dev/full")) {
    fs::create_symlink("/dev/full", folder_ / "full.stl.part");
    const Status full = write_stl(folder_ / "full.stl", make_icosphere(2));
    ASSERT_FALSE(full.ok());
    EXPECT_EQ(full.error().kind, ErrorKind::kResources);
    EXPECT_FALSE(fs::exists(folder_ / "full.stl"));
  }
}

TEST_F(SurfaceFile, NamesMissingEmptyAndForeignFiles) {
  EXPECT_THAT(message(folder_ / "none.stl"), HasSubstr("no such file"));
  EXPECT_THAT(message(write("empty.stl", "")), HasSubstr("is empty"));
  EXPECT_THAT(message(write("empty.obj", "")), HasSubstr("is empty"));
  EXPECT_THAT(message(write("mesh.ply", "ply\n")), HasSubstr("no known format"));
  EXPECT_THAT(message(write("text.stl", "Once upon a time")), HasSubstr("no STL file"));
  EXPECT_THAT(message(write("text.obj", "Once upon a time")), AllOf(HasSubstr("text.obj:1"), HasSubstr("'Once'")));
  EXPECT_THAT(message(write("binary.obj", std::string("v 0 0 0\0\1\2", 10))), HasSubstr("binary"));
  std::string noise(3000, '\0');
  for (std::size_t n = 0; n < noise.size(); ++n) noise[n] = static_cast<char>(n * n * 31 + n / 7);
  EXPECT_THAT(message(write("noise.stl", noise)), HasSubstr("announces"));
  fs::create_directories(folder_ / "folder.stl");
  EXPECT_THAT(message(folder_ / "folder.stl"), HasSubstr("is a folder"));
}

TEST_F(SurfaceFile, RefusesPipesDevicesAndHugeFilesWithoutReadingThem) {
  const fs::path pipe = folder_ / "pipe.stl", zero = folder_ / "zero.obj", huge = folder_ / "huge.stl";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", zero);
  std::ofstream(huge) << "solid";
  fs::resize_file(huge, kMaxSurfaceBytes + 1);  // sparse: reading it would find zero bytes
  EXPECT_THAT(read_surface(pipe).error().message, testing::HasSubstr("is a pipe or device"));
  EXPECT_THAT(read_surface(zero).error().message, testing::HasSubstr("is a pipe or device"));
  EXPECT_THAT(read_surface(huge).error().message, testing::HasSubstr("is too large: 1024 MiB, at most 1024 MiB"));
  EXPECT_THAT(read_labelled_mesh(pipe, 1.0).error().message, testing::HasSubstr("is a pipe or device"));
}

TEST_F(SurfaceFile, NamesATruncatedBinaryStl) {
  ASSERT_TRUE(write_stl(folder_ / "a.stl", *make_box({1, 1, 1}, 1.0)).ok());
  const std::string content = slurp(folder_ / "a.stl");
  EXPECT_THAT(message(write("cut.stl", content.substr(0, 333))),
              AllOf(HasSubstr("announces 12 faces"), HasSubstr("684 bytes"), HasSubstr("has 333")));
}

TEST_F(SurfaceFile, NamesATruncatedTextStl) {
  const std::string text = kTetrahedron;
  EXPECT_THAT(message(write("cut.stl", text.substr(0, text.find("endloop")))), HasSubstr("ends in the middle of a face"));
  EXPECT_THAT(message(write("cut2.stl", text.substr(0, text.find("endsolid")))), HasSubstr("without 'endsolid'"));
  EXPECT_THAT(message(write("none.stl", "solid x\nendsolid x\n")), HasSubstr("no faces"));
}

TEST_F(SurfaceFile, NamesTheLineOfAWordThatDoesNotBelong) {
  std::string text = kTetrahedron;
  text.replace(text.find("endloop"), 7, "vertex 1 2 3\n endloop");
  EXPECT_THAT(message(write("square.stl", text)), AllOf(HasSubstr("square.stl:7"), HasSubstr("'vertex'"), HasSubstr("'endloop'")));
}

TEST_F(SurfaceFile, NamesCoordinatesThatAreNotFiniteNumbers) {
  for (const std::string bad : {"nan", "inf", "-inf", "1e999", "1,5", "0x1"}) {
    std::string text = kTetrahedron;
    text.replace(text.find("1.0e0"), 5, bad);
    EXPECT_THAT(message(write("bad.stl", text)), AllOf(HasSubstr("bad.stl:5"), HasSubstr("'" + bad + "'")));
    EXPECT_THAT(message(write("bad.obj", "v 0 0 0\nv 0 " + bad + " 0\n")), AllOf(HasSubstr("bad.obj:2"), HasSubstr("'" + bad + "'")));
  }
  ASSERT_TRUE(write_stl(folder_ / "a.stl", *make_box({1, 1, 1}, 1.0)).ok());
  std::string content = slurp(folder_ / "a.stl");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(content.data() + 84 + 3 * 50 + 16, &nan, sizeof nan);
  EXPECT_THAT(message(write("nan.stl", content)), AllOf(HasSubstr("face 3"), HasSubstr("not finite")));
}

TEST_F(SurfaceFile, ReadsAnObjWithAllWaysToNameANode) {
  const auto mesh = read_surface(write("box.obj",
                                       "# a box\r\nmtllib x.mtl\no box\n"
                                       "v 0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nv 9 9 9\n"
                                       "vt 0 0\nvn 0 0 1\ns off\n"
                                       "f 1 4 3 2\nf 5/1 6/1 7/1 8/1 # top\nf 1//1 2//1 6//1 5//1\nf 2/1/1 3/1/1 7/1/1 6/1/1\n"
                                       "f -7 -6 -2 -3\nf 4 \\\n 1 5 8\n"));
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->position.size(), 8u);  // the node at (9, 9, 9) belongs to no face
  EXPECT_EQ(mesh->faces.size(), 12u);
  for (const MeshProblem& problem : check_mesh(mesh->position, mesh->faces)) ADD_FAILURE() << problem.message;
  EXPECT_NEAR(enclosed_volume(mesh->faces, mesh->position, Vec3d{}), 1.0, 1e-15);
}

TEST_F(SurfaceFile, NamesTheLineOfABadObjFace) {
  const std::string nodes = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_THAT(message(write("a.obj", nodes + "f 1 2 4\n")), AllOf(HasSubstr("a.obj:4"), HasSubstr("node 4 does not exist")));
  EXPECT_THAT(message(write("a.obj", nodes + "\nf 1 2 0\n")), AllOf(HasSubstr("a.obj:5"), HasSubstr("node 0 does not exist")));
  EXPECT_THAT(message(write("a.obj", nodes + "f -4 2 1\n")), HasSubstr("node -4 does not exist"));
  EXPECT_THAT(message(write("a.obj", nodes + "f 1 2\n")), HasSubstr("only 2 nodes"));
  EXPECT_THAT(message(write("a.obj", nodes + "f 1 2 x\n")), HasSubstr("'x' is not a node"));
  EXPECT_THAT(message(write("a.obj", nodes + "f 1 2 99999999999999999999\n")), HasSubstr("is not a node"));
  EXPECT_THAT(message(write("a.obj", "v 0 0\n")), AllOf(HasSubstr("a.obj:1"), HasSubstr("coordinate is missing")));
  EXPECT_THAT(message(write("a.obj", nodes)), HasSubstr("no faces"));
  EXPECT_THAT(message(write("a.obj", "surf 0 1 0 1 1\n")), HasSubstr("'surf' is not known"));
}

TEST_F(SurfaceFile, IsCheckedForWhatTheIssueCallsBadSurfaces) {
  TriangleMesh open = *make_sphere(6.0, 2), flipped = open, crossing = open;
  open.faces.erase(open.faces.begin() + 17);
  std::swap(flipped.faces[40][0], flipped.faces[40][1]);
  crossing.position[80] = crossing.position[80] * -1.4;
  const auto first_problem = [&](const TriangleMesh& bad) {
    EXPECT_TRUE(write_stl(folder_ / "bad.stl", bad).ok());
    const auto mesh = read_surface(folder_ / "bad.stl");
    EXPECT_TRUE(mesh.ok());
    const auto problems = check_mesh(mesh->position, mesh->faces);
    return problems.empty() ? MeshProblemKind::kEmpty : problems[0].kind;
  };
  EXPECT_EQ(first_problem(open), MeshProblemKind::kHole);
  EXPECT_EQ(first_problem(flipped), MeshProblemKind::kFlippedFaces);
  EXPECT_EQ(first_problem(crossing), MeshProblemKind::kSelfIntersection);
}

TEST(WeldedNodes, GoToTheLowestNodeInReachAndNoFarther) {
  TriangleMesh mesh;
  mesh.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1.0005, 0, 0}, {0, 1.002, 0}, {1, 1, 0}, {7, 7, 7}};
  mesh.faces = {{0, 1, 2}, {3, 5, 4}};
  const TriangleMesh welded = with_welded_nodes(mesh, 1e-3);
  EXPECT_EQ(welded.position.size(), 5u);
  EXPECT_EQ(welded.faces[1], (Triangle{1, 4, 3}));
  EXPECT_EQ(welded.position[1], (Vec3d{1, 0, 0}));
}

}  // namespace
}  // namespace morula
