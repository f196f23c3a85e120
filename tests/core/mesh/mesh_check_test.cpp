#include "core/mesh/mesh_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/mesh/icosphere.h"
#include "core/mesh/primitives.h"

namespace morula {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using Kind = MeshProblemKind;

std::vector<MeshProblem> check(const TriangleMesh& mesh, MeshExpectation expectation = {}) {
  return check_mesh(mesh.position, mesh.faces, expectation);
}

std::vector<Kind> kinds(const std::vector<MeshProblem>& problems) {
  std::vector<Kind> out;
  for (const MeshProblem& problem : problems) out.push_back(problem.kind);
  return out;
}

void append(TriangleMesh& mesh, const TriangleMesh& other, const Vec3d& shift = {}) {
  const auto first = static_cast<std::uint32_t>(mesh.position.size());
  for (const Vec3d& x : other.position) mesh.position.push_back(x + shift);
  for (const auto& [a, b, c] : other.faces) mesh.faces.push_back({a + first, b + first, c + first});
}

TriangleMesh turned_over(TriangleMesh mesh) {
  for (Triangle& face : mesh.faces) std::swap(face[1], face[2]);
  return mesh;
}

TEST(MeshCheck, FindsNothingWrongWithASphere) { EXPECT_THAT(check(make_icosphere(3)), SizeIs(0)); }

TEST(MeshCheck, FindsAnEmptyMesh) { EXPECT_THAT(kinds(check({})), ElementsAre(Kind::kEmpty)); }

TEST(MeshCheck, FindsBadIndicesAndCoordinatesAtOnce) {
  TriangleMesh mesh = make_icosphere(1);
  mesh.faces[3][1] = 42;
  mesh.position[7].y = std::numeric_limits<double>::quiet_NaN();
  mesh.position[9].x = INFINITY;
  const auto problems = check(mesh);
  EXPECT_THAT(kinds(problems), ElementsAre(Kind::kBadIndex, Kind::kNotFinite, Kind::kNotFinite));
  EXPECT_THAT(problems[0].message, AllOf(HasSubstr("face 3"), HasSubstr("node 42")));
  EXPECT_THAT(problems[1].message, HasSubstr("node 7"));
}

TEST(MeshCheck, FindsAHoleWithItsFacesAndPlace) {
  TriangleMesh mesh = make_icosphere(2);
  const Triangle gone = mesh.faces[100];
  mesh.faces.erase(mesh.faces.begin() + 100);
  const auto problems = check(mesh);
  ASSERT_THAT(kinds(problems), ElementsAre(Kind::kHole));
  EXPECT_THAT(problems[0].faces, SizeIs(3));
  EXPECT_THAT(problems[0].message, HasSubstr("border of 3 edges"));
  const Vec3d middle = (mesh.position[gone[0]] + mesh.position[gone[1]] + mesh.position[gone[2]]) / 3.0;
  EXPECT_LT(norm(problems[0].place - middle), 1e-14);
  MeshExpectation open;
  open.closed = false;
  EXPECT_THAT(check(mesh, open), SizeIs(0));
}

TEST(MeshCheck, FindsAFlippedPatchAndNamesItsFaces) {
  TriangleMesh mesh = make_icosphere(2);
  const auto topology = *Topology::build(162, mesh.faces);
  std::vector<std::uint32_t> patch(topology->faces_of_node(50).begin(), topology->faces_of_node(50).end());
  for (const std::uint32_t f : patch) std::swap(mesh.faces[f][0], mesh.faces[f][1]);
  const auto problems = check(mesh);
  ASSERT_THAT(kinds(problems), ElementsAre(Kind::kFlippedFaces));
  EXPECT_EQ(problems[0].faces, patch);
  EXPECT_LT(norm(problems[0].place - mesh.position[50]), 0.1);
}

TEST(MeshCheck, FindsASurfaceThatIsInsideOut) {
  const auto problems = check(turned_over(make_icosphere(1)));
  ASSERT_THAT(kinds(problems), ElementsAre(Kind::kInsideOut));
  EXPECT_THAT(problems[0].message, HasSubstr("inside out"));
  MeshExpectation either;
  either.outward = false;
  EXPECT_THAT(check(turned_over(make_icosphere(1)), either), SizeIs(0));
}

TEST(MeshCheck, WantsACavityToFaceInwardsAndOtherPartsOutwards) {
  const TriangleMesh outer = *make_sphere(3.0, 1), inner = *make_sphere(1.0, 1);
  TriangleMesh hollow = outer;
  append(hollow, turned_over(inner));
  EXPECT_THAT(check(hollow), SizeIs(0));
  TriangleMesh nested = outer;
  append(nested, inner);
  EXPECT_THAT(kinds(check(nested)), ElementsAre(Kind::kInsideOut));
  TriangleMesh apart = outer;
  append(apart, turned_over(inner), {10, 0, 0});
  EXPECT_THAT(kinds(check(apart)), ElementsAre(Kind::kInsideOut));
}

TEST(MeshCheck, FindsASurfaceThatCrossesItself) {
  TriangleMesh mesh = *make_sphere(1.0, 2);
  append(mesh, *make_sphere(1.0, 2), {1.3, 0.1, 0.05});
  const auto problems = check(mesh);
  ASSERT_FALSE(problems.empty());
  EXPECT_EQ(problems.size(), MeshExpectation{}.most_of_a_kind);
  for (const MeshProblem& problem : problems) {
    EXPECT_EQ(problem.kind, Kind::kSelfIntersection);
    EXPECT_LT(problem.faces[0], 320u);
    EXPECT_GE(problem.faces[1], 320u);
  }
  EXPECT_THAT(problems.back().message, HasSubstr("more like this"));
}

TEST(MeshCheck, FindsANodePushedThroughTheOppositeSide) {
  TriangleMesh mesh = *make_sphere(1.0, 2);
  mesh.position[10] = mesh.position[10] * -1.5;
  const auto problems = check(mesh);
  ASSERT_FALSE(problems.empty());
  for (const MeshProblem& problem : problems) EXPECT_EQ(problem.kind, Kind::kSelfIntersection);
}

TEST(MeshCheck, FindsNeighboursThatCrossBesideTheirCommonNode) {
  // A pyramid whose apex is pushed down and out through its base: crossing faces have nodes in common with the base.
  TriangleMesh mesh;
  mesh.position = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 1}};
  mesh.faces = {{0, 3, 2}, {0, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  EXPECT_THAT(check(mesh), SizeIs(0));
  mesh.position[4] = {1.5, 0.5, 0.0};  // on the base: touches it
  const auto problems = check(mesh);
  EXPECT_FALSE(problems.empty());
  EXPECT_THAT(kinds(problems), testing::Contains(Kind::kSelfIntersection));
}

TEST(MeshCheck, FindsTwoFacesFoldedOntoEachOther) {
  TriangleMesh mesh;
  mesh.position = {{0, 0, 0}, {1, 0, 0}, {0.2, 1, 0}, {0.5, 1, 0}};
  mesh.faces = {{0, 1, 2}, {1, 0, 3}};
  MeshExpectation open;
  open.closed = false;
  EXPECT_THAT(kinds(check(mesh, open)), ElementsAre(Kind::kSelfIntersection));
  mesh.position[3] = {0.5, -1, 0};  // flat, side by side
  EXPECT_THAT(check(mesh, open), SizeIs(0));
}

TEST(MeshCheck, SeesAGapOfOneRoundingAndATouchOfNone) {
  const TriangleMesh box = *make_box({1, 1, 1}, 1.0);
  TriangleMesh touching = box;
  append(touching, box, {1.0, 0, 0});
  EXPECT_THAT(kinds(check(touching)), testing::Each(Kind::kSelfIntersection));
  EXPECT_FALSE(check(touching).empty());
  TriangleMesh apart = box;
  append(apart, box, {std::nextafter(1.0, 2.0), 0, 0});
  for (std::size_t n = 8; n < 16; ++n)
    if (apart.position[n].x <= 0.5) apart.position[n].x = std::nextafter(0.5, 1.0);
  EXPECT_THAT(check(apart), SizeIs(0));
}

TEST(MeshCheck, FindsDegenerateFaces) {
  TriangleMesh mesh = make_icosphere(1);
  mesh.faces.push_back({3, 3, 7});
  // A thin tent on an open edge: three nodes in a line.
  mesh.position.insert(mesh.position.end(), {Vec3d{9, 0, 0}, Vec3d{10, 0, 0}, Vec3d{11, 0, 0}});
  mesh.faces.push_back({42, 43, 44});
  const auto problems = check(mesh);
  EXPECT_THAT(kinds(problems), ElementsAre(Kind::kDegenerateFace, Kind::kDegenerateFace, Kind::kHole));
  EXPECT_THAT(problems[0].message, HasSubstr("face 80 names a node twice"));
  EXPECT_THAT(problems[1].message, AllOf(HasSubstr("face 81 has no area"), HasSubstr("(10, 0, 0)")));
}

TEST(MeshCheck, FindsDuplicateFacesAndTheEdgesTheyOverload) {
  TriangleMesh mesh = make_icosphere(1);
  const auto [a, b, c] = mesh.faces[12];
  mesh.faces.push_back({c, a, b});
  const auto problems = check(mesh);
  EXPECT_THAT(kinds(problems), ElementsAre(Kind::kDuplicateFace, Kind::kNonManifoldEdge, Kind::kNonManifoldEdge, Kind::kNonManifoldEdge));
  EXPECT_THAT(problems[0].faces, ElementsAre(12, 80));
  EXPECT_THAT(problems[1].message, HasSubstr("3 faces"));
}

TEST(MeshCheck, FindsANodeThatNoFaceNames) {
  TriangleMesh mesh = make_icosphere(1);
  mesh.position.push_back({5, 5, 5});
  EXPECT_THAT(kinds(check(mesh)), ElementsAre(Kind::kUnusedNode));
}

TEST(MeshCheck, FindsANodeWhereTwoSheetsMeet) {
  TriangleMesh mesh = *make_box({1, 1, 1}, 1.0);
  TriangleMesh other = mesh;
  const auto first = static_cast<std::uint32_t>(mesh.position.size());
  append(mesh, other, {1, 1, 1});
  // The corner they have in common becomes one node.
  std::uint32_t kept = 0, gone = 0;
  for (std::uint32_t n = 0; n < 2 * first; ++n)
    if (norm(mesh.position[n] - Vec3d{0.5, 0.5, 0.5}) < 1e-12) (n < first ? kept : gone) = n;
  for (Triangle& face : mesh.faces)
    for (std::uint32_t& node : face) node = node == gone ? kept : node;
  const auto problems = check(mesh);
  EXPECT_THAT(kinds(problems), ElementsAre(Kind::kUnusedNode, Kind::kNonManifoldNode));
  EXPECT_THAT(problems[1].message, HasSubstr("(0.5, 0.5, 0.5)"));
}

TEST(MeshCheck, FindsAMoebiusBand) {
  TriangleMesh mesh;
  constexpr std::uint32_t kParts = 12;
  for (std::uint32_t n = 0; n < kParts; ++n) {
    const double around = 2.0 * M_PI * n / kParts, tilt = around / 2.0;
    for (const double side : {-0.3, 0.3}) {
      const double r = 2.0 + side * std::cos(tilt);
      mesh.position.push_back({r * std::cos(around), r * std::sin(around), side * std::sin(tilt)});
    }
  }
  for (std::uint32_t n = 0; n < kParts; ++n) {
    const std::uint32_t a = 2 * n, b = a + 1;
    const std::uint32_t c = n + 1 < kParts ? a + 2 : 1, d = n + 1 < kParts ? a + 3 : 0;
    mesh.faces.push_back({a, c, b});
    mesh.faces.push_back({b, c, d});
  }
  MeshExpectation open;
  open.closed = false;
  EXPECT_THAT(kinds(check(mesh, open)), ElementsAre(Kind::kNotOrientable));
}

TEST(MeshCheck, ReportsAllKindsOfProblemsAtOnce) {
  TriangleMesh mesh = *make_sphere(1.0, 2);
  append(mesh, *make_sphere(1.0, 2), {1.3, 0.1, 0.05});
  std::swap(mesh.faces[5][0], mesh.faces[5][1]);
  mesh.faces.erase(mesh.faces.begin() + 600);
  EXPECT_THAT(kinds(check(mesh)),
              AllOf(testing::Contains(Kind::kHole), testing::Contains(Kind::kFlippedFaces), testing::Contains(Kind::kSelfIntersection)));
  const Status status = require_sound_mesh("capsule.stl", mesh.position, mesh.faces);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, AllOf(HasSubstr("capsule.stl"), HasSubstr("open"), HasSubstr("against"), HasSubstr("cross")));
}

TEST(WindingNumber, IsOneInsideAndZeroOutside) {
  const TriangleMesh mesh = *make_box({2, 3, 4}, 1.0);
  EXPECT_NEAR(winding_number(mesh.position, mesh.faces, {0.3, 0.4, 0.5}), 1.0, 1e-13);
  EXPECT_NEAR(winding_number(mesh.position, mesh.faces, {1.3, 0.4, 0.5}), 0.0, 1e-13);
  EXPECT_NEAR(winding_number(mesh.position, turned_over(mesh).faces, {0.3, 0.4, 0.5}), -1.0, 1e-13);
}

}  // namespace
}  // namespace morula
