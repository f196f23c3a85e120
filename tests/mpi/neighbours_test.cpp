/// What a rank sends in a step depends on its neighbours, not on how many ranks there are; what it sees is what one rank sees.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/mpi_traffic.h"
#include "core/space/curve.h"
#include "coupling/behaviours/birth.h"
#include "coupling/cell_record.h"
#include "coupling/mechanics/scene.h"
#include "coupling/sight.h"

namespace morula {
namespace {

constexpr double kSpacing = 9.0;  // [µm]
constexpr int kCellsOfRank = 8;

/// Touching spheres in a row; each rank has the next stretch of it.
Tissue part_of_a_row(const Comm& comm) {
  CellType type;
  std::vector<CellRecord> cells;
  for (int i = 0; i < kCellsOfRank; ++i) {
    const int number = comm.rank() * kCellsOfRank + i;
    const Vec3d center{kSpacing * number, 0.0, 0.0};
    CellRecord& cell = cells.emplace_back();
    cell.row = make_founder(CellId::founder(static_cast<std::uint64_t>(number) + 1), 0, type, 1, 0.0, false);
    cell.row.order = curve_place(center);
    cell.sphere = SphereRecord{center, 5.0, {}, {}};
  }
  Tissue tissue;
  put_together(tissue, std::move(cells));
  return tissue;
}

TEST(NeighboursOnRanks, AnExchangeOfPointsIsOneMessageForEachNeighbour) {
  const Comm comm(MPI_COMM_WORLD);
  const Tissue tissue = part_of_a_row(comm);
  Space space;
  space.box = {{-100, -100, -100}, {1000, 100, 100}};
  ShapeLibrary shapes;
  Scene scene;
  scene.build(tissue, space, 2.0, shapes, comm);
  const auto neighbours = static_cast<std::size_t>(comm.rank() > 0) + static_cast<std::size_t>(comm.rank() + 1 < comm.size());
  EXPECT_EQ(scene.ghost_count(), neighbours) << "of each neighbour the sphere at its end";

  std::vector<Vec3d> velocity(scene.point_count());
  for (std::size_t i = 0; i < scene.owned_spheres(); ++i) velocity[i] = {static_cast<double>(comm.rank()), static_cast<double>(i), 1.0};
  const MpiTraffic before = mpi_traffic();
  scene.exchange(std::span(velocity));
  const MpiTraffic after = mpi_traffic();
  EXPECT_EQ(after.messages.calls - before.messages.calls, neighbours);
  EXPECT_EQ(after.messages.bytes - before.messages.bytes, neighbours * sizeof(Vec3d));
  EXPECT_EQ(after.collectives.calls, before.collectives.calls);
  for (std::size_t i = scene.owned_spheres(); i < scene.bodies().size(); ++i) {
    const bool is_before = scene.bodies()[i].id < tissue.cells.rows.front().id;
    EXPECT_EQ(velocity[i], (Vec3d{comm.rank() + (is_before ? -1.0 : 1.0), is_before ? kCellsOfRank - 1.0 : 0.0, 1.0}));
  }
}

/// A cavity whose walls lie on different ranks: triangles and balls, each in the way of others.
void add_walls(SightMap& map, const Comm& comm) {
  std::uint32_t number = 0;
  for (int k = 0; k < 60; ++k) {
    const double angle = 0.37 * k, height = std::sin(1.7 * k), radius = 10.0 + 4.0 * std::cos(2.3 * k);
    const Vec3d center{radius * std::cos(angle), radius * std::sin(angle), 8.0 * height};
    if (k % comm.size() != comm.rank()) continue;
    if (k % 3 == 0)
      map.add_ball(center, 2.0);
    else
      map.add_triangle(center, center + Vec3d{5, 1, 0}, center + Vec3d{0, 3, 6}, number++);
  }
}

TEST(NeighboursOnRanks, TheMapOfSightIsThatOfOneRankAndGrowsWithNoRanks) {
  const Comm world(MPI_COMM_WORLD), alone(MPI_COMM_SELF);
  SightMap together({0.1, 0.2, 0.3}, 30.0), single({0.1, 0.2, 0.3}, 30.0);
  add_walls(together, world);
  add_walls(single, alone);
  const MpiTraffic before = mpi_traffic();
  together.join(world);
  const MpiTraffic after = mpi_traffic();
  single.join(alone);
  EXPECT_EQ(
      after.collectives.bytes - before.collectives.bytes,
      world.size() > 1 ? std::size_t{2 * 6} * SightMap::kSide * SightMap::kSide * sizeof(double) : 0u);  // distances, and which comes first
  EXPECT_GT(single.covered(), 0.1);
  EXPECT_EQ(together.covered(), single.covered());
  EXPECT_EQ(world.sum(static_cast<std::int64_t>(together.seen().size())), static_cast<std::int64_t>(single.seen().size()));
  const auto all = together.in_the_way(world), one = single.in_the_way(alone);
  EXPECT_GT(one.volume, 0.0);
  EXPECT_EQ(all.volume, one.volume);
  EXPECT_EQ(all.directions, one.directions);
}

}  // namespace
}  // namespace morula
