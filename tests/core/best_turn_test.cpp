#include "core/space/best_turn.h"

#include <gtest/gtest.h>

#include <vector>

namespace morula {
namespace {

const std::vector<Vec3d> kPlaces{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {-1, -1, 0.5}, {0.3, -0.2, -2}};

TEST(BestTurn, ComesBackFromPlacesThatWereTurnedAndMoved) {
  for (std::uint64_t cell = 1; cell < 20; ++cell) {
    const Rotation turn = random_rotation(Random(7, RandomStream::kOrientation), CellId::founder(cell), 0);
    std::vector<Vec3d> turned;
    for (const Vec3d& p : kPlaces) turned.push_back(turn * p * 1.7 + Vec3d{5, -3, 2});
    const Rotation found = best_turn(kPlaces, turned);
    for (const Vec3d& p : kPlaces) EXPECT_LT(norm(found * p - turn * p), 1e-13);
  }
}

TEST(BestTurn, IsNearestOfAllNearby) {
  std::vector<Vec3d> other = kPlaces;
  other[0] += Vec3d{0.2, -0.3, 0.1};
  other[3] += Vec3d{-0.1, 0.4, 0.2};
  Vec3d middle_from, middle_to;
  for (std::size_t i = 0; i < other.size(); ++i) middle_from += kPlaces[i] * 0.2, middle_to += other[i] * 0.2;
  const Rotation best = best_turn(kPlaces, other);
  const auto squares = [&](const Vec3d& more) {  // after a small turn beside it
    double sum = 0.0;
    for (std::size_t i = 0; i < other.size(); ++i) {
      const Vec3d there = best * (kPlaces[i] - middle_from);
      sum += norm2(there + cross(more, there) + cross(more, cross(more, there)) * 0.5 - (other[i] - middle_to));
    }
    return sum;
  };
  for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}, Vec3d{1, -1, 1}})
    for (const double angle : {-0.01, 0.01}) EXPECT_GT(squares(axis * angle), squares({}));
}

TEST(BestTurn, IsNoneOfPlacesInAPlane) {
  const std::vector<Vec3d> flat{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  EXPECT_EQ(best_turn(flat, flat) * (Vec3d{1, 2, 3}), (Vec3d{1, 2, 3}));
}

}  // namespace
}  // namespace morula
