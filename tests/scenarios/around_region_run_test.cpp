/// The user's road to regions that lie around an obstacle or move along with it: a plate comes down upon resting cells. When each of them becomes a shell
/// follows from its distance to the plate alone.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "coupling/regions/region.h"
#include "tests/scenarios/simulation_of.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

// The lower face of the plate, 20 µm wide, begins at z = 29 µm and goes down by 1 µm a minute for 24 min, then up again.
constexpr const char* kStudy = R"(
schema: 1
study: around
time: {end: 1 h, output: 10 min}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  cell: {radius: 4 um}
geometry:
  plate:
    box: {center: [0 um, 0 um, 30 um], size: [20 um, 20 um, 2 um]}
    motion: {direction: [0, 0, -1], course: [{time: 0 s, distance: 0 um}, {time: 24 min, distance: 24 um}, {time: 48 min, distance: 0 um}]}
initial:
  - {type: cell, at: [[0 um, 0 um, 0 um], [19 um, 0 um, 0 um], [0 um, 0 um, -9 um]]}
coupling:
  hold: 2 min
  regions: [REGION]
)";

/// When cells 1, 2, 3 became shells and spheres again [min]; −1: never.
struct Times {
  double up = -1.0, down = -1.0;
};
std::map<CellId, Times> times_with(const std::string& region) {
  std::map<CellId, Times> out;
  const auto study = test::read(test::changed("REGION", region, kStudy));
  EXPECT_TRUE(study.ok()) << study.error().text();
  if (!study.ok()) return out;
  auto made = test::simulation_of(*study);
  EXPECT_TRUE(made.ok());
  if (!made.ok()) return out;
  Simulation& simulation = **made;
  while (simulation.tissue().clock.time < 3600.0) {
    const double before = simulation.tissue().clock.time;
    EXPECT_TRUE(simulation.step(3600.0).ok());
    if (!(simulation.tissue().clock.time > before)) break;
    for (const CellRow& row : simulation.tissue().cells.rows) {
      Times& times = out[row.id];
      if (row.body == BodyKind::kShell && times.up < 0.0) times.up = simulation.tissue().clock.time / 60.0;
      if (row.body == BodyKind::kSphere && times.up >= 0.0 && times.down < 0.0) times.down = simulation.tissue().clock.time / 60.0;
    }
  }
  return out;
}

/// Bodies are exchanged at the start of a step, one in a step, and a step takes a minute at most.
constexpr double kLate = 3.01;

void expect_at(double found, double wanted) {
  EXPECT_GE(found, wanted - 1e-6);
  EXPECT_LE(found, wanted + kLate);
}

TEST(AroundRegion, HasTheCellsThatTheObstacleComesNearTo) {
  auto times = times_with("{name: hotspot, shape: around, geometry: plate, within: 12 um, margin: 2 um}");
  expect_at(times[CellId::founder(1)].up, 17.0);                    // straight below: 29 − t = 12
  expect_at(times[CellId::founder(1)].down, 33.0);                  // leaves at 14 µm: 5 + (t − 24) = 14
  expect_at(times[CellId::founder(2)].up, 29.0 - std::sqrt(63.0));  // 9 µm beyond the edge: 12² − 9² = 63
  EXPECT_EQ(times[CellId::founder(3)].up, -1.0) << "14 µm is the nearest that the plate comes";
}

TEST(FollowingRegion, MovesAlongWithTheObstacle) {
  auto times = times_with("{name: ball, shape: sphere, center: [0 um, 0 um, 30 um], radius: 18 um, margin: 2 um, follow: plate}");
  expect_at(times[CellId::founder(1)].up, 12.0);  // 30 − t = 18
  EXPECT_EQ(times[CellId::founder(2)].up, -1.0) << "19 µm aside, in a ball of 18 µm";
  expect_at(times[CellId::founder(3)].up, 21.0);  // 39 − t = 18
}

TEST(AroundRegion, TakesTheRoomOfTheLayerAroundABody) {
  const auto study = test::read(test::changed("box: {center: [0 um, 0 um, 30 um], size: [20 um, 20 um, 2 um]}",
                                              "box: {center: [0 um, 0 um, 40 um], size: [20 um, 10 um, 2 um]}",
                                              test::changed("REGION", "{name: r, shape: around, geometry: plate, within: 6 um}", kStudy)));
  ASSERT_TRUE(study.ok()) << study.error().text();
  const Region& region = study->model.swaps.regions.at(0);
  // Steiner: area d, a quarter cylinder along each of the twelve edges, a ball in pieces at the corners.
  const double d = 6.0, faces = 2.0 * (20.0 * 10.0 + 20.0 * 2.0 + 10.0 * 2.0) * d, edges = std::numbers::pi * d * d * (20.0 + 10.0 + 2.0),
               corners = 4.0 / 3.0 * std::numbers::pi * d * d * d;
  EXPECT_NEAR(region.shape->volume(region), faces + edges + corners, 1e-9 * (faces + edges + corners));
}

std::string errors(const std::string& region) { return test::errors_of(test::changed("REGION", region, kStudy)); }

TEST(AroundRegion, RefusesWhatHasNoMeaning) {
  EXPECT_NE(errors("{name: r, shape: around, geometry: plat, within: 6 um}").find("there is no obstacle 'plat' [E401]"), std::string::npos);
  EXPECT_NE(errors("{name: r, shape: around, geometry: plate, within: 0 um}").find("[E30"), std::string::npos);
  EXPECT_NE(errors("{name: r, shape: around, geometry: plate, within: 6 um, center: [0 um, 0 um, 1 um]}")
                .find("'center' has no effect here [E515]"),
            std::string::npos);
  EXPECT_NE(errors("{name: r, shape: around, geometry: plate, within: 6 um, follow: plate}").find("'follow' has no effect here [E515]"),
            std::string::npos);
  EXPECT_NE(errors("{name: r, shape: everything, follow_tissue: true}").find("'follow_tissue' has no effect here [E515]"),
            std::string::npos);
  EXPECT_NE(errors("{name: r, shape: sphere, radius: 9 um, follow: plate, follow_tissue: true}")
                .find("follows either the tissue or an obstacle [E111]"),
            std::string::npos);
  EXPECT_NE(errors("{name: r, shape: sphere, radius: 9 um, follow: plane}").find("there is no obstacle 'plane' [E401]"), std::string::npos);
}

}  // namespace
}  // namespace morula::scenarios
