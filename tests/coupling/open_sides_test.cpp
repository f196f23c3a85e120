// Which cells lie at the surface of a tissue, and where it faces.
#include "coupling/open_sides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/random/rotation.h"

namespace morula {
namespace {

/// From a site of a lattice to its nearest neighbours: face-centred cubic, body-centred cubic with the six next ones.
std::vector<Vec3d> neighbours_in_fcc() {
  std::vector<Vec3d> out;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0}) out.insert(out.end(), {Vec3d{0, a, b}, Vec3d{a, 0, b}, Vec3d{a, b, 0}});
  return out;
}
std::vector<Vec3d> neighbours_in_bcc() {
  std::vector<Vec3d> out{{2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 2}, {0, 0, -2}};
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0})
      for (const double c : {-1.0, 1.0}) out.push_back({a, b, c});
  return out;
}

/// The same, turned as the number says, without those that reach further than `most` along `up`.
std::vector<Vec3d> turned(std::vector<Vec3d> all, std::uint64_t number, const Vec3d& up = {}, double most = 0.5) {
  std::erase_if(all, [&](const Vec3d& d) { return dot(d, up) > most; });
  const Rotation turn = random_rotation(Random(7, RandomStream::kOrientation), CellId::founder(number), 0);
  for (Vec3d& d : all) d = turn * d;
  return all;
}
Vec3d turned(const Vec3d& d, std::uint64_t number) {
  return random_rotation(Random(7, RandomStream::kOrientation), CellId::founder(number), 0) * d;
}

TEST(OpenSides, AreNoneWithinATissue) {
  for (std::uint64_t k = 1; k <= 200; ++k) {
    EXPECT_FALSE(OpenSides(turned(neighbours_in_fcc(), k)).any()) << k;
    EXPECT_FALSE(OpenSides(turned(neighbours_in_bcc(), k)).any()) << k;
    EXPECT_EQ(OpenSides(turned(neighbours_in_fcc(), k)).middle(), Vec3d{});
    std::vector<Vec3d> one_missing = neighbours_in_fcc();
    one_missing.pop_back();
    EXPECT_FALSE(OpenSides(turned(one_missing, k)).any()) << "the nearest is 60° from the gap";
  }
}

TEST(OpenSides, AreAtFlatSurfacesWhoseNormalTheyTell) {
  const Vec3d faces[] = {{0, 0, 1}, {1, 1, 1}, {1, 1, 0}};
  for (const Vec3d& up : faces)
    for (std::uint64_t k = 1; k <= 100; ++k) {
      const std::vector<Vec3d> half = turned(neighbours_in_fcc(), k, normalized(up), 1e-9);
      ASSERT_TRUE(OpenSides(half).any()) << k;
      // 192 directions are 14° apart: their mean over a cone of 25° is known to a few.
      EXPECT_GT(dot(OpenSides(half).middle(), turned(normalized(up), k)), std::cos(0.12)) << k;
    }
}

TEST(OpenSides, OfALayerAreTwoWithOneNormal) {
  std::vector<Vec3d> around;
  for (int k = 0; k < 6; ++k) around.push_back({std::cos(k * std::numbers::pi / 3.0), std::sin(k * std::numbers::pi / 3.0), 0.0});
  for (std::uint64_t k = 1; k <= 100; ++k) {
    ASSERT_TRUE(OpenSides(turned(around, k)).any());
    EXPECT_GT(std::abs(dot(OpenSides(turned(around, k)).middle(), turned(Vec3d{0, 0, 1}, k))), std::cos(0.12)) << k;
  }
}

TEST(OpenSides, ThatAreGapsWithinATissueAreNotOutward) {
  // Half of the neighbours are missing: at a surface those aside are open likewise, beside a gap they are closed.
  const std::vector<Vec3d> half = turned(neighbours_in_fcc(), 1, Vec3d{0, 0, 1}, 1e-9);
  const OpenSides open(half);
  const std::vector<OpenSides> at_surface(half.size(), open), around_gap(half.size());
  EXPECT_EQ(open.outward(half, at_surface).words, open.words);
  EXPECT_FALSE(open.outward(half, around_gap).any());
  // Half of those aside suffice; which of the others are open does not matter.
  std::vector<OpenSides> some(half.size());
  const Vec3d up = open.middle();
  int aside = 0;
  for (std::size_t j = 0; j < half.size(); ++j)
    if (std::abs(dot(normalized(half[j]), up)) < 0.2) some[j] = aside++ % 2 == 0 ? open : OpenSides();
  ASSERT_EQ(aside, 4);
  EXPECT_TRUE(open.outward(half, some).any());
  EXPECT_GT(dot(open.outward(half, some).middle(), up), 0.9);
  EXPECT_TRUE(OpenSides(std::span<const Vec3d>()).outward({}, {}).any()) << "a single cell";
}

TEST(OpenSides, OfPairsPointAwayAndOfSingleCellsNowhere) {
  EXPECT_TRUE(OpenSides(std::span<const Vec3d>()).any());
  EXPECT_EQ(OpenSides(std::span<const Vec3d>()).middle(), Vec3d{});
  const std::vector<Vec3d> one{{3.0, 0.0, 0.0}};
  EXPECT_TRUE(OpenSides(one).any());
  EXPECT_LT(OpenSides(one).middle().x, -0.99);
  const std::vector<Vec3d> chain{{3.0, 0.0, 0.0}, {-2.0, 0.0, 0.0}};
  EXPECT_TRUE(OpenSides(chain).any());
  EXPECT_NEAR(OpenSides(chain).middle().x, 0.0, 0.1) << "or none: all directions across the chain are alike";
}

}  // namespace
}  // namespace morula
