#include "core/mesh/triangle_tree.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "core/mesh/icosphere.h"
#include "core/mesh/primitives.h"

namespace morula {
namespace {

Box box_of(const TriangleMesh& mesh, std::uint32_t face) {
  Box box;
  for (const std::uint32_t node : mesh.faces[face]) box.include(mesh.position[node]);
  return box;
}

TriangleMesh crowd_of_random_triangles(std::mt19937_64& engine, std::size_t count) {
  std::uniform_real_distribution<double> place(-10, 10), size(-1, 1);
  TriangleMesh mesh;
  for (std::size_t f = 0; f < count; ++f) {
    const Vec3d center{place(engine), place(engine), place(engine)};
    for (int c = 0; c < 3; ++c)
      mesh.position.push_back(center + Vec3d{size(engine), size(engine), size(engine)} * (f % 5 == 0 ? 0.0 : 1.0));
    const auto n = static_cast<std::uint32_t>(3 * f);
    mesh.faces.push_back({n, n + 1, n + 2});
  }
  return mesh;
}

TEST(TriangleTree, FindsTheFacesInABoxAsALoopOverAllDoes) {
  std::mt19937_64 engine(1);
  const TriangleMesh mesh = crowd_of_random_triangles(engine, 700);
  const TriangleTree tree(mesh.position, mesh.faces);
  std::uniform_real_distribution<double> place(-12, 12), size(0, 4);
  std::size_t total = 0;
  for (int n = 0; n < 300; ++n) {
    Box box;
    box.low = {place(engine), place(engine), place(engine)};
    box.high = box.low + Vec3d{size(engine), size(engine), size(engine)};
    std::vector<std::uint32_t> want;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
      if (box_of(mesh, f).overlaps(box)) want.push_back(f);
    ASSERT_EQ(tree.faces_in(box), want);
    total += want.size();
  }
  EXPECT_GT(total, 300u);
}

TEST(TriangleTree, FindsTheNearestFaceAsALoopOverAllDoesBitForBit) {
  std::mt19937_64 engine(2);
  std::uniform_real_distribution<double> place(-2, 2);
  const TriangleMesh sphere = make_icosphere(3);  // many ties: nearest points on common edges and nodes
  const TriangleMesh crowd = crowd_of_random_triangles(engine, 500);
  for (const TriangleMesh* mesh : {&sphere, &crowd}) {
    const TriangleTree tree(mesh->position, mesh->faces);
    for (int n = 0; n < 1500; ++n) {
      const Vec3d p = n % 10 == 0 ? mesh->position[static_cast<std::size_t>(n) % mesh->position.size()] * 1.5
                                  : Vec3d{place(engine), place(engine), place(engine)};
      std::uint32_t want = 0;
      double want2 = 1e300;
      for (std::uint32_t f = 0; f < mesh->faces.size(); ++f) {
        const auto& [a, b, c] = mesh->faces[f];
        const double d2 = closest_point_on_triangle(p, mesh->position[a], mesh->position[b], mesh->position[c]).distance2;
        if (d2 < want2) want2 = d2, want = f;
      }
      const auto found = tree.nearest(p);
      ASSERT_TRUE(found.has_value());
      ASSERT_EQ(found->closest.distance2, want2);
      ASSERT_EQ(found->face, want);
    }
  }
}

TEST(TriangleTree, FindsNothingBeyondTheCutoff) {
  const TriangleMesh box = *make_box({2, 2, 2}, 0.5);
  const TriangleTree tree(box.position, box.faces);
  EXPECT_FALSE(tree.nearest({3, 0, 0}, 1.999).has_value());
  EXPECT_TRUE(tree.nearest({3, 0, 0}, 2.0).has_value());
  EXPECT_TRUE(tree.nearest({1, 0, 0}, 0.0).has_value());
  EXPECT_FALSE(tree.nearest({1.1, 0, 0}, -1.0).has_value());
}

TEST(TriangleTree, MayBeEmpty) {
  const TriangleTree tree({}, {});
  EXPECT_TRUE(tree.bounds().empty());
  EXPECT_TRUE(tree.faces_in(Box{{-1, -1, -1}, {1, 1, 1}}).empty());
  EXPECT_FALSE(tree.nearest({0, 0, 0}).has_value());
}

TEST(TriangleTree, IsQuickForAHundredThousandFaces) {
  const TriangleMesh mesh = make_icosphere(6);  // 81,920 faces
  const auto start = std::chrono::steady_clock::now();
  const TriangleTree tree(mesh.position, mesh.faces);
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> place(-1.2, 1.2);
  double sum = 0.0;
  for (int n = 0; n < 10000; ++n) sum += tree.nearest({place(engine), place(engine), place(engine)})->closest.distance2;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_GT(sum, 0.0);
  EXPECT_LT(seconds, 10.0);  // 10,000 loops over all faces would take over half a minute; the tree takes a fraction of a second
}

}  // namespace
}  // namespace morula
