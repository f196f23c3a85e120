// What is done with surfaces of cells between the file and the shell: splitting, mending, overlaps, remeshing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/mesh/icosphere.h"
#include "core/mesh/mesh_check.h"
#include "core/mesh/mesh_repair.h"
#include "core/mesh/primitives.h"
#include "core/mesh/remesh.h"
#include "core/mesh/split_mesh.h"
#include "core/mesh/surface_overlap.h"
#include "core/mesh/topology.h"

namespace morula {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TriangleMesh ball(double radius, const Vec3d& center = {}, int level = 2) {
  TriangleMesh mesh = make_icosphere(level);
  for (Vec3d& p : mesh.position) p = center + p * radius;
  return mesh;
}

TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.position.size());
  a.position.insert(a.position.end(), b.position.begin(), b.position.end());
  for (const Triangle& face : b.faces) a.faces.push_back({face[0] + first, face[1] + first, face[2] + first});
  return a;
}

double volume(const TriangleMesh& mesh) { return enclosed_volume(mesh.faces, mesh.position, volume_centroid(mesh.faces, mesh.position)); }

TEST(SplitMesh, FindsComponentsInTheOrderOfTheirFirstFaces) {
  const TriangleMesh two = joined(ball(1), ball(2, {5, 0, 0}));
  const auto parts = split_by_label(two, components_of_faces(two));
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NEAR(volume(parts[1].mesh), 8.0 * volume(parts[0].mesh), 1e-12);
  EXPECT_EQ(parts[1].face.front(), 320u);
  EXPECT_EQ(parts[1].node.front(), 162u);
}

TEST(SplitMesh, GivesCommonNodesToBothSides) {
  // Two tetrahedra on one triangle, as two cells of a tessellation share a wall.
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}},
                          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 1, 2}, {0, 4, 1}, {0, 2, 4}, {1, 4, 2}}};
  const std::vector<double> label{7, 7, 7, 7, 3, 3, 3, 3};
  const auto parts = split_by_label(mesh, label);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].label, 3.0);
  EXPECT_THAT(parts[0].node, ElementsAre(0, 1, 2, 4));
  for (const auto& part : parts) EXPECT_TRUE(check_mesh(part.mesh.position, part.mesh.faces).empty());
}

TEST(MeshRepair, LeavesASoundMeshAlone) {
  const TriangleMesh mesh = ball(3);
  const MeshRepair mended = repair_mesh(mesh);
  EXPECT_THAT(mended.repairs, IsEmpty());
  EXPECT_EQ(mended.mesh.position, mesh.position);
  EXPECT_EQ(mended.mesh.faces, mesh.faces);
}

TEST(MeshRepair, TurnsAFlippedPatchAndNamesItsFaces) {
  TriangleMesh mesh = ball(3);
  const TriangleMesh sound = mesh;
  const auto topology = *Topology::build(162, mesh.faces);
  const auto around = topology->faces_of_node(5);
  for (const std::uint32_t f : around) std::swap(mesh.faces[f][1], mesh.faces[f][2]);
  const MeshRepair mended = repair_mesh(mesh);
  ASSERT_EQ(mended.repairs.size(), 1u);
  EXPECT_THAT(mended.repairs[0], HasSubstr("a patch of " + std::to_string(around.size()) + " faces that ran against the rest"));
  EXPECT_THAT(mended.repairs[0], HasSubstr(std::to_string(around[0])));
  EXPECT_EQ(mended.mesh.faces, sound.faces);
}

TEST(MeshRepair, TurnsAWholeSurfaceThatIsInsideOut) {
  TriangleMesh mesh = ball(3);
  for (Triangle& face : mesh.faces) std::swap(face[1], face[2]);
  const MeshRepair mended = repair_mesh(mesh);
  EXPECT_GT(volume(mended.mesh), 0.0);
  EXPECT_THAT(mended.repairs, ElementsAre(HasSubstr("inside out")));
}

TEST(MeshRepair, UnitesDoublePointsAndDropsDoubleFacesAndFreePoints) {
  TriangleMesh mesh = ball(3);
  const double before = volume(mesh);
  mesh.faces.push_back(mesh.faces[10]);
  mesh.position.push_back(mesh.position[mesh.faces[20][0]] + Vec3d{1e-8, 0, 0});
  mesh.faces[20][0] = 162;
  mesh.position.push_back({9, 9, 9});
  const MeshRepair mended = repair_mesh(mesh);
  EXPECT_THAT(mended.repairs,
              ElementsAre(HasSubstr("one point that no face names"), HasSubstr("one point that lies on another"), HasSubstr("face 320")));
  EXPECT_EQ(mended.mesh.position.size(), 162u);
  EXPECT_TRUE(check_mesh(mended.mesh.position, mended.mesh.faces).empty());
  EXPECT_NEAR(volume(mended.mesh), before, 1e-6);
}

TEST(MeshRepair, GivesFacesWithoutAreaToTheirNeighbours) {
  // A point in the middle of an edge makes a cap: the two small faces and a face without area between them.
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.5, 0}},
                    {{0, 4, 1}, {0, 2, 4}, {1, 4, 2}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  EXPECT_FALSE(check_mesh(mesh.position, mesh.faces).empty());
  const MeshRepair cap = repair_mesh(mesh);
  EXPECT_THAT(cap.repairs, ElementsAre(HasSubstr("face 2 without area")));
  EXPECT_TRUE(check_mesh(cap.mesh.position, cap.mesh.faces).empty());
  EXPECT_DOUBLE_EQ(volume(cap.mesh), 1.0 / 6.0);
  // A node drawn near another one of its face leaves needles behind.
  TriangleMesh needle = ball(3);
  const Triangle face = needle.faces[33];
  needle.position[face[0]] = needle.position[face[1]] + (needle.position[face[0]] - needle.position[face[1]]) * 1e-12;
  needle.position[face[2]] = needle.position[face[1]] + (needle.position[face[2]] - needle.position[face[1]]) * 1.0;
  const MeshRepair mended = repair_mesh(needle);
  EXPECT_FALSE(mended.repairs.empty());
  EXPECT_TRUE(check_mesh(mended.mesh.position, mended.mesh.faces).empty());
}

TEST(SurfaceOverlaps, NameTheDeepestNodeOfEachPair) {
  const std::vector<TriangleMesh> balls{ball(3), ball(3, {5.6, 0, 0}), ball(3, {0, 20, 0})};
  const auto found = find_overlaps(balls);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].a, 0u);
  EXPECT_EQ(found[0].b, 1u);
  EXPECT_NEAR(found[0].depth, 0.4, 0.08) << "nodes lie on the spheres, faces a little below";
  EXPECT_NEAR(found[0].place.x, 2.9, 0.15);
  EXPECT_THAT(find_overlaps(std::vector{ball(3), ball(3, {6.2, 0, 0})}), IsEmpty());
  const auto inside = find_overlaps(std::vector{ball(1), ball(3)});
  ASSERT_EQ(inside.size(), 1u) << "a cell within a cell";
  EXPECT_NEAR(inside[0].depth, 2.0, 0.15);
}

TEST(Remeshing, MeetsTheNumberOfNodesAndKeepsTheVolume) {
  if (!has_remesher()) GTEST_SKIP() << "this build has no remesher (MORULA_WITH_GPL)";
  const TriangleMesh mesh = ball(6.0, {10, -3, 2}, 3);
  const auto made = remesh_surface(mesh, {300, 0.0});
  ASSERT_TRUE(made.ok()) << made.error().message;
  EXPECT_NEAR(static_cast<double>(made->mesh.position.size()), 300.0, 0.05 * 300.0);
  EXPECT_NEAR(volume(made->mesh), volume(mesh), 1e-9 * volume(mesh));
  EXPECT_LT(std::abs(made->volume_error), 0.03);
  EXPECT_NEAR(made->mean_edge, edge_of_nodes(surface_area(mesh), 300), 0.1);
  // A sphere stays one: all nodes at the radius of the mesh's volume, give or take what the triangles cut off.
  for (const Vec3d& p : made->mesh.position) EXPECT_NEAR(norm(p - Vec3d{10, -3, 2}), 6.0, 0.06);
  EXPECT_TRUE(check_mesh(made->mesh.position, made->mesh.faces).empty());
}

TEST(Remeshing, MeetsTheEdgeAndIsTheSameEveryTime) {
  if (!has_remesher()) GTEST_SKIP() << "this build has no remesher (MORULA_WITH_GPL)";
  const TriangleMesh mesh = ball(6.0, {}, 3);
  const auto a = remesh_surface(mesh, {0, 1.5}), b = remesh_surface(mesh, {0, 1.5});
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_NEAR(a->mean_edge, 1.5, 0.15);
  EXPECT_EQ(a->mesh.position, b->mesh.position);
  EXPECT_EQ(a->mesh.faces, b->mesh.faces);
}

TEST(Remeshing, KeepsFlatSidesFlatWhenItGivesTheVolumeBack) {
  if (!has_remesher()) GTEST_SKIP() << "this build has no remesher (MORULA_WITH_GPL)";
  const TriangleMesh box = *make_box({8, 8, 8}, 1.0);
  const auto made = remesh_surface(box, {0, 1.3});
  ASSERT_TRUE(made.ok()) << made.error().message;
  EXPECT_NEAR(volume(made->mesh), 512.0, 1e-6);
  std::size_t middle = 0;
  for (const Vec3d& p : made->mesh.position) {
    if (std::abs(p.x) > 2.0 || std::abs(p.y) > 2.0 || p.z < 0.0) continue;
    ++middle;
    EXPECT_NEAR(p.z, 4.0, 0.1);
  }
  EXPECT_GE(middle, 5u);
}

TEST(Remeshing, SaysWhyWhereTheBuildLacksIt) {
  const auto made = remesh_surface(ball(6.0), {0, 1.5});
  EXPECT_EQ(made.ok(), has_remesher());
  if (!made.ok()) {
    EXPECT_THAT(made.error().message, testing::HasSubstr("built without CGAL's mesh processing"));
    EXPECT_EQ(made.error().kind, ErrorKind::kInput);
  }
}

/// One node of a damaged file that is far away: its spike would be cut into a hundred million pieces. One that stands out by a few radii is no spike.
TEST(Remeshing, RefusesSpikes) {
  TriangleMesh mesh = ball(6.0);
  mesh.position[0] = mesh.position[0] * 2.0;
  EXPECT_EQ(remesh_surface(mesh, {300, 0.0}).ok(), has_remesher());
  mesh.position[0] = mesh.position[0] * 1e12;
  for (const RemeshTarget& target : {RemeshTarget{300, 0.0}, RemeshTarget{0, 1.5}}) {
    const auto made = remesh_surface(mesh, target);
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().kind, ErrorKind::kInput);
    EXPECT_THAT(made.error().message, HasSubstr(has_remesher() ? "too many pieces" : "GPL"));
  }
}

TEST(Remeshing, RefusesTrianglesThatAreTooLargeAndOpenSurfaces) {
  const auto coarse = remesh_surface(ball(6.0), {0, 40.0});
  ASSERT_FALSE(coarse.ok());
  EXPECT_EQ(coarse.error().kind, ErrorKind::kInput);
  TriangleMesh open = ball(6.0);
  open.faces.pop_back();
  EXPECT_FALSE(remesh_surface(open, {0, 1.0}).ok());
}

}  // namespace
}  // namespace morula
