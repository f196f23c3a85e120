/// A shell that is pushed stops at what stands in its way: it never passes through, and forces balance.
#include <gtest/gtest.h>

#include "core/mesh/primitives.h"
#include "core/mesh/surface_file.h"
#include "tests/coupling/tissue_fixture.h"

#include <filesystem>
#include <fstream>

namespace morula {
namespace {

using test::clusters_model;
using test::make_tissue;

constexpr double kHour = 3600.0;
constexpr double kSpeed = 10.0 / kHour;  // 10 µm/h
constexpr double kFree = 0.1 * 452.389;  // medium friction of the whole cell [nN·s/µm]

Model pushed_model() {
  Model model = clusters_model(0.05);
  model.contact.range = 0.5;
  model.contact.repulsion = 100.0;
  model.contact.points_per_face = 3;
  return model;
}

/// Push the first cell along x for two hours with the force that moves a free cell at 10 µm/h; the others are held by an equal counter-force.
/// Returns the deepest penetration of the run; the tissue holds the end.
double push(const Model& model, Tissue& tissue, std::vector<RigidSurface> obstacles, bool hold_last) {
  ShapeLibrary shapes;
  Mechanics mechanics(model, std::move(obstacles), shapes, Comm(), 1);
  double deepest = 0.0, dt = 1.0;
  // Bodies come in canonical order: the left one is pushed to the right.
  const bool flipped = tissue.shells.size() == 2 && tissue.shells.nodes(0)[0].x > tissue.shells.nodes(1)[0].x;
  const double along = flipped ? -1.0 : 1.0;
  for (double time = 0.0; time < 2.0 * kHour; time += dt) {
    std::vector<Vec3d> force(tissue.cells.size());
    force.front() = {along * kSpeed * kFree, 0, 0};
    if (hold_last) force.back() = {-along * kSpeed * kFree, 0, 0};
    auto done = mechanics.step(tissue, dt, mechanics.spread(tissue, force));
    for (int retry = 0; !done.ok() && retry < 12; ++retry) {
      dt *= 0.5;
      done = mechanics.step(tissue, dt, mechanics.spread(tissue, force));
    }
    if (!done.ok()) {
      ADD_FAILURE() << done.error().what;
      break;
    }
    deepest = std::max(deepest, done->overlap);
    if (done->displacement < 0.05) dt = std::min(60.0, 1.5 * dt);
  }
  return deepest;
}

double leading_x(const Tissue& tissue) {
  double x = -1e300;
  for (const Vec3d& p : tissue.shells.nodes(0)) x = std::max(x, p.x);
  return x;
}

/// The model with one obstacle material of weak adhesion; `inside`: cells are inside its surface.
Model with_obstacle(Model model, const TriangleMesh& mesh, bool inside = false) {
  const ContactPair cells = model.pairs[0], wall{0.001, 0.1, 0.1};
  model.obstacles = {ObstacleSpec{"obstacle", mesh.position, mesh.faces, inside, {}}};
  model.pairs = {cells, wall, wall, wall};
  return model;
}

/// A shell pushed against an obstacle, after the push; it never goes deeper than 0.1 µm.
Tissue push_against(const TriangleMesh& obstacle, bool inside = false) {
  const Model model = with_obstacle(pushed_model(), obstacle, inside);
  ShapeLibrary shapes;
  Tissue tissue = make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell});
  tissue.obstacle_offset.resize(1);
  auto obstacles = contact_obstacles(model);
  EXPECT_TRUE(obstacles.ok());
  EXPECT_LT(push(model, tissue, std::move(*obstacles), false), 0.1);
  return tissue;
}

TEST(Obstacles, FinerThanContactsCanHoldAreRefusedByName) {
  const auto fine = make_sphere(8.0, 6), large = make_sphere(200.0, 6);  // 81,920 faces, all near one cell or few of them
  ASSERT_TRUE(fine.ok() && large.ok());
  const auto refused = contact_obstacles(with_obstacle(pushed_model(), *fine));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::kInput);
  EXPECT_NE(refused.error().message.find("faces within reach of one cell"), std::string::npos) << refused.error().message;
  EXPECT_TRUE(contact_obstacles(with_obstacle(pushed_model(), *large)).ok());
}

TEST(PushedShell, StopsAtAnotherShell) {
  const Model model = pushed_model();
  ShapeLibrary shapes;
  Tissue tissue = make_tissue(model, shapes, {{0, 0, 0}, {13, 0.3, -0.2}}, {BodyKind::kShell, BodyKind::kShell});
  EXPECT_LT(push(model, tissue, {}, true), 0.1);
  const Vec3d a = volume_centroid(tissue.shells.topology(0).faces(), tissue.shells.nodes(0));
  const Vec3d b = volume_centroid(tissue.shells.topology(1).faces(), tissue.shells.nodes(1));
  EXPECT_GT(std::abs(b.x - a.x), 9.0);
  EXPECT_LT(std::abs(b.x - a.x), 12.5);  // and in touch
}

TEST(PushedShell, StopsAtASphere) {
  const Model model = pushed_model();
  ShapeLibrary shapes;
  Tissue tissue = make_tissue(model, shapes, {{0, 0, 0}, {13, 0.3, -0.2}}, {BodyKind::kShell, BodyKind::kSphere});
  (void)push(model, tissue, {}, true);
  const Vec3d a = volume_centroid(tissue.shells.topology(0).faces(), tissue.shells.nodes(0));
  EXPECT_GT(tissue.spheres.position[0].x - a.x, 7.0);  // a sphere has no shape: its share of the flattening is overlap
}

TEST(PushedShell, StopsAtAPlane) {
  const auto plate = make_box({1.0, 30.0, 30.0}, 40.0);
  ASSERT_TRUE(plate.ok());
  TriangleMesh mesh = *plate;
  for (Vec3d& p : mesh.position) p.x += 7.5;  // its face is at x = 7
  const Tissue tissue = push_against(mesh);
  EXPECT_LT(leading_x(tissue), 7.15);
  EXPECT_GT(leading_x(tissue), 6.0);
}

TriangleMesh moved(const Result<TriangleMesh>& mesh, double along_x) {
  EXPECT_TRUE(mesh.ok());
  TriangleMesh out = *mesh;
  for (Vec3d& p : out.position) p.x += along_x;
  return out;
}

TEST(PushedShell, StopsAtTheWallOfAMouldOfEightyThousandFaces) {
  const TriangleMesh mould = moved(make_sphere(30.0, 6), -23.0);  // its wall is at x = 7
  ASSERT_EQ(mould.faces.size(), 81920u);
  const Tissue tissue = push_against(mould, true);
  double farthest = 0.0;
  for (const Vec3d& x : tissue.shells.nodes(0)) farthest = std::max(farthest, norm(x - Vec3d{-23, 0, 0}));
  EXPECT_GT(farthest, 29.5);
  EXPECT_LT(farthest, 30.1);
}

TEST(PushedShell, StopsAtARodAndAtOneWithRoundEnds) {
  for (const auto& [name, rod] : {std::pair{"cylinder", make_cylinder(4.0, 40.0, 1.0)}, {"capsule", make_capsule(4.0, 40.0, 1.0)}}) {
    SCOPED_TRACE(name);
    const Tissue tissue = push_against(moved(rod, 11.0));  // begins at x = 7
    const Vec3d center = volume_centroid(tissue.shells.topology(0).faces(), tissue.shells.nodes(0));
    EXPECT_LT(center.x, 4.0) << "it may wrap itself around, but goes not through";
    EXPECT_GT(leading_x(tissue), 6.5);
  }
}

TEST(PushedShell, StopsAtASurfaceFromAFile) {
  for (const char* name : {"morula_push.stl", "morula_push.obj"}) {
    SCOPED_TRACE(name);
    const auto sphere = make_sphere(8.0, 3);
    ASSERT_TRUE(sphere.ok());
    const auto path = std::filesystem::temp_directory_path() / name;
    if (path.extension() == ".obj") {
      std::ofstream out(path);
      for (const Vec3d& p : sphere->position) out << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
      for (const Triangle& t : sphere->faces) out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
    } else {
      ASSERT_TRUE(write_stl(path, *sphere).ok());
    }
    const Tissue tissue = push_against(moved(read_surface(path), 15.0));  // begins at x = 7
    const Vec3d center = volume_centroid(tissue.shells.topology(0).faces(), tissue.shells.nodes(0));
    EXPECT_GT(norm(center - Vec3d{15, 0, 0}), 10.0);  // it may slip aside, but not through
  }
}

}  // namespace
}  // namespace morula
