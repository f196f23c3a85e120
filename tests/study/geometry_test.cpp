#include <gmock/gmock.h>

#include <numbers>

#include "core/mesh/mesh_check.h"
#include "core/mesh/primitives.h"
#include "core/mesh/surface_file.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {
namespace {

using testing::HasSubstr;

/// The good study fills the place where these obstacles stand; here the shapes count, not the cells.
const ReadOptions kShapesOnly{.judge_places = false};

Study with_obstacle(const std::string& shape) {
  auto study = read(changed("sphere: {radius: 150 um}, side: inside", shape), kShapesOnly);
  EXPECT_TRUE(study.ok()) << study.error().text();
  return study.ok() ? std::move(study).value() : Study{};
}

TEST(StudyGeometry, PrimitivesAreClosedOutwardAndWhereTheyWereAskedFor) {
  struct Case {
    const char* shape;
    double volume;  ///< of the ideal body
    Vec3d inside, outside;
  };
  const double pi = std::numbers::pi;
  const Case cases[] = {
      {"plane: {size: 100 um, center: [0 um, 0 um, 7 um], normal: [0, 0, 2]}", 1e5, {20, 20, 6.9}, {20, 20, 7.1}},
      {"plane: {size: 100 um, normal: [-1, 0, 0]}", 1e5, {0.1, 0, 0}, {-0.1, 0, 0}},
      {"sphere: {radius: 50 um, center: [60 um, 0 um, 0 um]}", 4.0 / 3.0 * pi * 125000, {100, 0, 0}, {0, 0, 0}},
      {"box: {size: [10 um, 20 um, 30 um], center: [5 um, 0 um, 0 um]}", 6000, {1, 9, 14}, {-1, 0, 0}},
      {"cylinder: {from: [0 um, 0 um, 0 um], to: [100 um, 0 um, 0 um], radius: 10 um}", pi * 1e4, {1, 9, 0}, {-1, 0, 0}},
      {"capsule: {from: [0 um, 0 um, 0 um], to: [0 um, 100 um, 0 um], radius: 10 um}",
       pi * 1e4 + 4.0 / 3.0 * pi * 1000,
       {0, -9, 0},
       {0, -11, 0}},
  };
  for (const Case& c : cases) {
    const Study study = with_obstacle(c.shape);
    ASSERT_EQ(study.model.obstacles.size(), 1u) << c.shape;
    const ObstacleSpec& o = study.model.obstacles[0];
    EXPECT_TRUE(check_mesh(o.position, o.faces).empty()) << c.shape;
    // Nodes lie on the ideal surface, edges are at most 0.15 R: the chords cost about 1 %.
    EXPECT_NEAR(enclosed_volume(o.faces, o.position, {}) / c.volume, 1.0, 0.015) << c.shape;
    EXPECT_NEAR(winding_number(o.position, o.faces, c.inside), 1.0, 1e-6) << c.shape;
    EXPECT_NEAR(winding_number(o.position, o.faces, c.outside), 0.0, 1e-6) << c.shape;
  }
}

TEST(StudyGeometry, MotionIsFixedOrAVelocity) {
  EXPECT_EQ(with_obstacle("sphere: {radius: 150 um}, side: inside").model.obstacles[0].velocity, (Vec3d{}));
  const auto study = read(changed("motion: fixed", "motion: {velocity: [0 um/h, 0 um/h, 36 um/h]}"));
  ASSERT_TRUE(study.ok()) << study.error().text();
  EXPECT_DOUBLE_EQ(study->model.obstacles[0].velocity.z, 0.01);
  EXPECT_THAT(errors_of(changed("motion: fixed", "motion: moving")), HasSubstr("'motion' must be a list [x, y, z]"));
}

/// A study with this surface as an obstacle: its messages, or "" when it is accepted.
std::string messages_with(const TriangleMesh& mesh) {
  const Folder folder;
  EXPECT_TRUE(write_stl(folder.path() / "surface.stl", mesh).ok());
  const auto study = read(changed("sphere: {radius: 150 um}", "stl: surface.stl, scale: 10 um"), kShapesOnly, folder.path());
  return study.ok() ? "" : study.error().text();
}

TriangleMesh ball() { return std::move(make_sphere(10.0, 2)).value(); }

/// Plates 20 um apart, of which one has gone 30 um after 90 min: they meet on two thirds of the way from 30 to 90 min.
TEST(StudyGeometry, PlanesThatGoThroughEachOtherAreTold) {
  const auto told = [](const std::string& top, const std::string& more) {
    const auto study = test::read(
        "schema: 1\nstudy: plates\ntime: {end: 3 h}\ndomain: {size: [100 um, 100 um, 100 um]}\n"
        "cell_types: {cell: {radius: 6 um, body: sphere}}\ngeometry:\n"
        "  bottom: {plane: {center: [0 um, 0 um, -10 um], size: 80 um}}\n"
        "  top: {plane: {center: " +
            top + ", size: 80 um}, " + more +
            "}\n"
            "initial: [{type: cell, at: [[0 um, 0 um, -3 um]]}]\n",
        kShapesOnly);
    return study.ok() ? study->warnings.text() : study.error().text();
  };
  const std::string down = "motion: {direction: [0, 0, -1], course: [{time: 30 min, distance: 0 um}, {time: 90 min, distance: ";
  const std::string above = "[0 um, 0 um, 10 um], normal: [0, 0, -1]";
  EXPECT_THAT(told(above, down + "30 um}]}"), testing::AllOf(HasSubstr("'bottom' and 'top' meet after 70 min"), HasSubstr("[E706]")));
  EXPECT_THAT(told(above, "motion: {velocity: [0 um/h, 0 um/h, -10 um/h]}"), HasSubstr("meet after 120 min"));
  EXPECT_EQ(told(above, down + "12 um}]}"), "");
  EXPECT_EQ(told("[0 um, 0 um, 10 um]", down + "30 um}]}"), "") << "it does not face the other";
  EXPECT_EQ(told("[0 um, 0 um, -30 um], normal: [0, 0, -1]", "motion: {velocity: [0 um/h, 0 um/h, -1 um/h]}"), "") << "back to back";
}

TEST(StudyGeometry, SoundStlIsReadAndScaled) {
  const Folder folder;
  ASSERT_TRUE(write_stl(folder.path() / "mesh.stl", ball()).ok());
  const auto study = read(changed("sphere: {radius: 150 um}", "stl: mesh.stl, scale: 10 um"), kShapesOnly, folder.path());
  ASSERT_TRUE(study.ok()) << study.error().text();
  EXPECT_NEAR(norm(study->model.obstacles[0].position[0]), 100.0, 1e-4);
  EXPECT_EQ(study->input_files[0].copy, "inputs/mesh.stl");
}

TEST(StudyGeometry, OpenSurfaceIsRefused) {
  TriangleMesh mesh = ball();
  mesh.faces.pop_back();
  const std::string message = messages_with(mesh);
  EXPECT_THAT(message, HasSubstr("study.yaml:22:18: error: surface 'surface.stl': "));
  EXPECT_THAT(message, HasSubstr("[E621]"));
}

TEST(StudyGeometry, FlippedFaceAndInsideOutSurfaceAreRefused) {
  TriangleMesh mesh = ball();
  std::swap(mesh.faces[5][0], mesh.faces[5][1]);
  EXPECT_THAT(messages_with(mesh), HasSubstr("[E622]"));
  mesh = ball();
  for (Triangle& face : mesh.faces) std::swap(face[0], face[1]);
  EXPECT_THAT(messages_with(mesh), HasSubstr("[E622]"));
}

TEST(StudyGeometry, SelfCrossingSurfaceIsRefused) {
  TriangleMesh mesh = ball();
  mesh.position[0] = mesh.position[0] * -1.5;  // one node pulled out through the other side
  EXPECT_THAT(messages_with(mesh), HasSubstr("[E623]"));
}

TEST(StudyGeometry, DamagedStlIsRefused) {
  const Folder folder;
  folder.write("mesh.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 nan\n");
  EXPECT_THAT(errors_of(changed("sphere: {radius: 150 um}", "stl: mesh.stl"), {}, folder.path()), HasSubstr("[E620]"));
  std::filesystem::create_directories(folder.path() / "dir.stl");
  EXPECT_THAT(errors_of(changed("sphere: {radius: 150 um}", "stl: dir.stl"), {}, folder.path()), HasSubstr("[E602]"));
}

}  // namespace
}  // namespace morula::scenarios::test
