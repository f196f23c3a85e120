/// The user's road to regions that count contacts: cells in a row, of which those within two contacts of another are shells.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/scenarios/bodies_of_run.h"

namespace morula::scenarios {
namespace {

// Eight cells of 4 µm in a row, 7.6 µm apart, and a ninth that touches none. They adhere and stay together.
constexpr const char* kRow = R"(
schema: 1
study: row
time: {end: 25 min, output: 1 min}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  cell: {radius: 4 um}
  leader: {like: cell}
GEOMETRY
initial:
  - {type: leader, at: [[0 um, 0 um, 0 um]]}
  - {type: cell, at: [[7.6 um, 0 um, 0 um], [15.2 um, 0 um, 0 um], [22.8 um, 0 um, 0 um], [30.4 um, 0 um, 0 um], [38 um, 0 um, 0 um],
                      [45.6 um, 0 um, 0 um], [53.2 um, 0 um, 0 um], [7.6 um, 30 um, 0 um]]}
coupling:
  hold: 2 min
  regions: REGIONS
output: {report: false}
)";

std::string with(const std::string& regions, const std::string& geometry = "") {
  return test::changed("GEOMETRY", geometry, test::changed("REGIONS", regions, kRow));
}

/// S or s by founder: shell or sphere in the results of a run, at this time.
std::string bodies_at(double time, const std::string& text) {
  std::string out;
  for (const auto& [moment, cells] : test::bodies_of_run(text))
    for (const auto& [id, body] : cells)
      if (std::abs(moment - time) <= 1.0) out += body == BodyKind::kShell ? 'S' : 's';
  return out;
}

TEST(NeighboursRegion, HasTheCellsWithinSoManyContactsOfACellOfAType) {
  EXPECT_EQ(bodies_at(1200.0, with("[{name: around_leader, shape: neighbours, of: leader, cells: 2}]")), "SSSssssss");
}

TEST(NeighboursRegion, CountsFromARegionBeforeIt) {
  EXPECT_EQ(bodies_at(1200.0, with("[{name: core, shape: sphere, center: [22.8 um, 0 um, 0 um], radius: 2 um, margin: 1 um}, "
                                   "{name: buffer, shape: neighbours, of: core, cells: 1}]")),
            "ssSSSssss");
  EXPECT_EQ(bodies_at(1200.0, with("[{name: core, shape: sphere, center: [22.8 um, 0 um, 0 um], radius: 2 um, margin: 1 um}, "
                                   "{name: buffer, shape: neighbours, of: core, cells: 1, as: sphere}, "
                                   "{name: rest, shape: neighbours, of: buffer, cells: 2}]")),
            "SssSssSSs")
      << "the first region in the list decides, spheres stay in that of spheres to two contacts, and the last counts from all of these";
}

TEST(NeighboursRegion, CountsFromTheCellsThatTouchAnObstacle) {
  // The wall is at x = 57 µm; the last cell of the row reaches to 57.2 and adheres to it. Nothing else touches it.
  const std::string wall = "geometry:\n  wall: {box: {center: [62 um, 0 um, 0 um], size: [10 um, 60 um, 60 um]}}";
  const std::string text = with("[{name: near_wall, shape: neighbours, of: wall, cells: 2}]", wall);
  EXPECT_EQ(bodies_at(1200.0, test::changed("{radius: 4 um}", "{radius: 4 um, adhesion: {wall: 1e-4 J/m^2}}", text)), "ssssssSSs");
}

TEST(NeighboursRegion, LeavesWithinOneContactMoreAlone) {
  // From two contacts to one: what is two away stays, what is three away would not have been in it.
  const std::string text = with(
      "[{name: first, shape: neighbours, of: leader, cells: 3, until: 10 min}, "
      "{name: then, shape: neighbours, of: leader, cells: 1}]");
  EXPECT_EQ(bodies_at(540.0, text), "SSSSsssss");
  EXPECT_EQ(bodies_at(1500.0, text), "SSSssssss") << "two contacts away is one beyond the last: it stays; three is not";
}

TEST(NeighboursRegion, TellsWhatItDoesNotKnow) {
  const auto nobody = test::read(with("[{name: r, shape: neighbours, of: leadre, cells: 2}]"));
  ASSERT_FALSE(nobody.ok());
  EXPECT_NE(nobody.error().text().find("no region before this one, cell type or obstacle 'leadre'"), std::string::npos);
  EXPECT_NE(nobody.error().text().find("leader"), std::string::npos);
  const auto itself = test::read(with("[{name: r, shape: neighbours, of: r, cells: 2}]"));
  ASSERT_FALSE(itself.ok()) << "a region does not count from itself";
  const auto margin = test::read(with("[{name: r, shape: neighbours, of: leader, cells: 2, margin: 3 um}]"));
  ASSERT_FALSE(margin.ok());
  EXPECT_NE(margin.error().text().find("'margin' has no effect here"), std::string::npos);
  EXPECT_FALSE(test::read(with("[{name: r, shape: neighbours, of: leader, cells: 0}]")).ok());
  EXPECT_FALSE(test::read(with("[{name: r, shape: neighbours, cells: 2}]")).ok());
}

}  // namespace
}  // namespace morula::scenarios
