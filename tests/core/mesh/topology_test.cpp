#include "core/mesh/topology.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/mesh/icosphere.h"

namespace morula {
namespace {

using testing::HasSubstr;

std::vector<Triangle> tetrahedron() { return {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}; }

std::vector<Triangle> two_tetrahedra_sharing_node_0() {
  auto faces = tetrahedron();
  for (const Triangle& face : tetrahedron()) {
    Triangle other;
    for (std::size_t c = 0; c < 3; ++c) other[c] = face[c] == 0 ? 0 : face[c] + 3;
    faces.push_back(other);
  }
  return faces;
}

std::string message_of(std::uint32_t nodes, std::vector<Triangle> faces) {
  const auto result = Topology::build(nodes, std::move(faces));
  if (result.ok()) return "accepted";
  EXPECT_FALSE(result.error().help.empty());
  EXPECT_EQ(result.error().kind, ErrorKind::kInput);
  return result.error().message;
}

class EveryIcosphere : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    mesh_ = make_icosphere(GetParam());
    auto built = Topology::build(static_cast<std::uint32_t>(mesh_.position.size()), mesh_.faces);
    ASSERT_TRUE(built.ok()) << built.error().message;
    topology_ = *built;
  }
  TriangleMesh mesh_;
  std::shared_ptr<const Topology> topology_;
};

TEST_P(EveryIcosphere, HasTheCountsOfASphere) {
  const std::uint32_t nodes = 10u * (1u << (2 * GetParam())) + 2;
  EXPECT_EQ(topology_->node_count(), nodes);
  EXPECT_EQ(topology_->face_count(), 2 * nodes - 4);
  EXPECT_EQ(topology_->edge_count(), 3 * nodes - 6);
  const long euler = long{topology_->node_count()} - topology_->edge_count() + topology_->face_count();
  EXPECT_EQ(euler, 2);
}

TEST_P(EveryIcosphere, HasTwelveNodesOfValenceFiveAndTheRestSix) {
  std::uint32_t fives = 0, sixes = 0;
  for (std::uint32_t node = 0; node < topology_->node_count(); ++node) {
    fives += topology_->faces_of_node(node).size() == 5;
    sixes += topology_->faces_of_node(node).size() == 6;
  }
  EXPECT_EQ(fives, 12u);
  EXPECT_EQ(sixes, topology_->node_count() - 12);
}

TEST_P(EveryIcosphere, HasEdgesThatKnowTheirFacesAndOppositeNodes) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  const auto walks = [&](std::uint32_t f, Triangle want) {
    Triangle face = topology_->faces()[f];
    for (int turn = 0; turn < 3; ++turn, std::ranges::rotate(face, face.begin() + 1))
      if (face == want) return true;
    return false;
  };
  const Edge* previous = nullptr;
  for (const Edge& edge : topology_->edges()) {
    EXPECT_LT(edge.i, edge.j);
    EXPECT_TRUE(seen.insert({edge.i, edge.j}).second);
    EXPECT_TRUE(walks(edge.left, {edge.i, edge.j, edge.k}));
    EXPECT_TRUE(walks(edge.right, {edge.j, edge.i, edge.l}));
    if (previous) {
      EXPECT_LT(std::pair(previous->i, previous->j), std::pair(edge.i, edge.j));
    }
    previous = &edge;
  }
}

TEST_P(EveryIcosphere, HasFaceEdgesOppositeToTheCorners) {
  for (std::uint32_t f = 0; f < topology_->face_count(); ++f)
    for (std::size_t c = 0; c < 3; ++c) {
      const Edge& edge = topology_->edges()[topology_->face_edges()[f][c]];
      EXPECT_TRUE(edge.left == f || edge.right == f);
      EXPECT_EQ(edge.left == f ? edge.k : edge.l, topology_->faces()[f][c]);
    }
}

TEST_P(EveryIcosphere, ListsTheFacesOfEachNodeInIncreasingOrder) {
  std::size_t total = 0;
  for (std::uint32_t node = 0; node < topology_->node_count(); ++node) {
    const auto faces = topology_->faces_of_node(node);
    total += faces.size();
    for (std::size_t n = 0; n < faces.size(); ++n) {
      if (n > 0) {
        EXPECT_LT(faces[n - 1], faces[n]);
      }
      EXPECT_TRUE(std::ranges::count(topology_->faces()[faces[n]], node) == 1);
    }
  }
  EXPECT_EQ(total, 3u * topology_->face_count());
}

TEST_P(EveryIcosphere, NumbersNeighboursCloseTogether) {
  // A band around the sphere has about sqrt(4π N) nodes; Cuthill-McKee levels are such bands, and neighbours are at most a level apart.
  std::uint32_t widest = 0;
  for (const Edge& edge : topology_->edges()) widest = std::max(widest, edge.j - edge.i);
  EXPECT_LE(widest, 1.5 * std::sqrt(4.0 * 3.14159265358979 * topology_->node_count()));
  EXPECT_TRUE(std::ranges::is_sorted(topology_->faces()));
  for (const Triangle& face : topology_->faces()) EXPECT_EQ(face[0], *std::ranges::min_element(face));
}

INSTANTIATE_TEST_SUITE_P(Levels, EveryIcosphere, testing::Values(1, 2, 3, 4));

TEST(Topology, AcceptsATetrahedron) { EXPECT_EQ(message_of(4, tetrahedron()), "accepted"); }

TEST(Topology, NamesAFaceWithANodeThatDoesNotExist) {
  auto faces = tetrahedron();
  faces[2][1] = 9;
  EXPECT_THAT(message_of(4, faces), HasSubstr("face 2 (1, 9, 3)"));
}

TEST(Topology, NamesADegenerateFace) {
  auto faces = tetrahedron();
  faces[1][1] = 0;
  EXPECT_THAT(message_of(4, faces), HasSubstr("face 1 (0, 0, 3) is degenerate"));
}

TEST(Topology, NamesADuplicateFaceWhateverItsFirstNodeOrDirection) {
  for (const Triangle copy : {Triangle{1, 0, 2}, Triangle{2, 1, 0}, Triangle{0, 1, 2}}) {
    auto faces = tetrahedron();
    faces.push_back(copy);
    EXPECT_THAT(message_of(4, faces), testing::AllOf(HasSubstr("face 4"), HasSubstr("face 0")));
  }
}

TEST(Topology, NamesTheEdgeOfAHole) {
  auto faces = tetrahedron();
  faces.pop_back();
  EXPECT_THAT(message_of(4, faces), testing::AllOf(HasSubstr("edge 0-2 has one face only"), HasSubstr("open")));
}

TEST(Topology, NamesAnEdgeWithThreeFaces) {
  auto faces = tetrahedron();
  faces.push_back({0, 1, 4});
  EXPECT_THAT(message_of(5, faces), HasSubstr("edge 0-1 has 3 faces: 0, 1, 4"));
}

TEST(Topology, NamesAFlippedFace) {
  auto faces = tetrahedron();
  std::swap(faces[3][0], faces[3][1]);
  EXPECT_THAT(message_of(4, faces), testing::AllOf(HasSubstr("same direction"), HasSubstr("edge 0-2"), HasSubstr("0 and 3")));
}

TEST(Topology, NamesANodeWhereTheSurfaceTouchesItself) {
  EXPECT_THAT(message_of(7, two_tetrahedra_sharing_node_0()), HasSubstr("node 0 form more than one ring"));
}

TEST(Topology, NamesANodeWithoutFaces) { EXPECT_THAT(message_of(5, tetrahedron()), HasSubstr("node 4 belongs to no face")); }

TEST(Topology, RejectsAnEmptyMesh) { EXPECT_THAT(message_of(0, {}), HasSubstr("no faces")); }

TEST(Topology, HasEqualHashesForEqualFaceListsOnly) {
  const auto hash = [](std::vector<Triangle> faces) { return (*Topology::build(4, std::move(faces)))->hash(); };
  EXPECT_EQ(hash(tetrahedron()), hash(tetrahedron()));
  auto reordered = tetrahedron();
  std::swap(reordered[0], reordered[1]);
  EXPECT_NE(hash(tetrahedron()), hash(reordered));
  auto rotated = tetrahedron();
  std::ranges::rotate(rotated[0], rotated[0].begin() + 1);
  EXPECT_NE(hash(tetrahedron()), hash(rotated));
}

}  // namespace
}  // namespace morula
