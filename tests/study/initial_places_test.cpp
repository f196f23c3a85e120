#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "study/initial/place_cells.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A study with two types, a plate and a stone, and these entries.
std::string with_cells(const std::string& entries, const std::string& more = "") {
  return R"(schema: 1
study: places
time: {end: 1 h}
domain: {size: [200 um, 200 um, 200 um], boundary: {z_low: wall}}
cell_types:
  red: {radius: 5 um}
  green: {radius: 4 um}
  big: {radius: 6 um, body: shell}
geometry:
  plate: {plane: {center: [0 um, 0 um, 40 um], normal: [0, 0, 1], size: 150 um}}
  stone: {sphere: {center: [50 um, 0 um, -40 um], radius: 10 um}}
)" + more +
         "initial:\n" + entries;
}

std::vector<PlacedCell> cells_of(const std::string& text) {
  const auto study = read(text);
  if (!study.ok()) {
    ADD_FAILURE() << study.error().text();
    return {};
  }
  auto placed = place_cells(*study);
  EXPECT_TRUE(placed.ok() && placed->problems.empty());
  return std::move(placed).value().cells;
}

/// Smallest distance of two cells over the sum of their radii, by brute force.
double closest(const std::vector<PlacedCell>& cells) {
  double least = 1e300;
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      least = std::min(least, norm(cells[i].center - cells[j].center) / (cells[i].radius() + cells[j].radius()));
  return least;
}

TEST(Fills, KeepOffEarlierEntries) {
  const auto cells =
      cells_of(with_cells("  - {type: big, count: 20, fill: sphere, radius: 25 um}\n"
                          "  - {type: big, count: 20, fill: box, size: [60 um, 60 um, 60 um]}\n"
                          "  - {type: big, at: [[0 um, 0 um, 80 um]]}\n"
                          "  - {type: red, count: 30, fill: sphere, radius: 40 um}\n"));
  ASSERT_EQ(cells.size(), 71u);
  EXPECT_GT(closest(cells), 0.93);  // shells touch, spheres lie at 0.95 of touching
  const std::vector<PlacedCell> shells(cells.begin(), cells.begin() + 41);
  EXPECT_GT(closest(shells), 0.98);
}

TEST(Fills, KeepOffObstacles) {
  const auto cells = cells_of(with_cells("  - {type: red, count: 60, fill: sphere, radius: 35 um, center: [50 um, 0 um, -40 um]}\n"));
  ASSERT_EQ(cells.size(), 60u);
  const Vec3d stone{50, 0, -40};
  for (const PlacedCell& cell : cells) EXPECT_GT(norm(cell.center - stone), 10.0 + 0.9 * 5.0);
  EXPECT_GT(closest(cells), 0.93);
}

TEST(Fills, SayWithLineAndCodeThatThereIsNoRoom) {
  const std::string full = with_cells(
      "  - {type: big, count: 30, fill: box, size: [36 um, 36 um, 36 um]}\n"
      "  - {type: red, count: 25, fill: box, size: [36 um, 36 um, 36 um]}\n");
  EXPECT_THAT(errors_of(full), AllOf(HasSubstr("study.yaml:14:"),
                                     HasSubstr("25 cells of red find no room beside what is there already: there are "
                                               "places for "),
                                     HasSubstr("[E658]")));
}

TEST(Fills, AtRandomFindRoomForAFewInABallThatIsWide) {
  const char* const radius[] = {"9", "13", "13", "16", "16", "16"};  // the first lattice of places is too wide for any of its cubes
  for (std::size_t count = 1; count <= 6; ++count)
    EXPECT_EQ(cells_of(with_cells("  - {type: big, count: " + std::to_string(count) +
                                  ", fill: random, center: [-50 um, 0 um, -20 um], radius: " + radius[count - 1] + " um}\n"))
                  .size(),
              count);
}

TEST(Fills, SayWhichCellLiesDeepInWhatWhereALayerIsTooLow) {
  // A gap of 11.5 µm between plates has room for the mean cell, of 5.5 µm, and none for one of 6 µm.
  const std::string low = with_cells("  - {types: {red: 50 %, big: 50 %}, count: 6, fill: layer, on: dish}\n",
                                     "  dish: {plane: {center: [0 um, 0 um, 80 um], normal: [0, 0, 1], size: 60 um}}\n"
                                     "  lid: {plane: {center: [0 um, 0 um, 91.5 um], normal: [0, 0, -1], size: 60 um}}\n");
  EXPECT_THAT(errors_of(low),
              AllOf(HasSubstr("6 cells of red and big find no room: the one of radius 6 um would lie 0.5 um deep in obstacle 'lid'"),
                    HasSubstr("[E658]")));
}

TEST(Fills, WithoutNeighboursLieWhereTheyAlwaysDid) {
  const auto alone = cells_of(with_cells("  - {type: red, count: 50, fill: sphere, radius: 25 um, center: [-50 um, 0 um, 0 um]}\n"));
  const auto beside =
      cells_of(with_cells("  - {type: red, count: 50, fill: sphere, radius: 25 um, center: [-50 um, 0 um, 0 um]}\n"
                          "  - {type: big, count: 5, fill: sphere, radius: 15 um, center: [60 um, 60 um, 0 um]}\n"));
  for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(alone[i].center, beside[i].center);
}

TEST(Mixture, HasExactCountsInADrawnOrder) {
  const auto cells = cells_of(with_cells("  - {types: {red: 35 %, green: 45 %, big: 20 %}, count: 33, fill: sphere, radius: 35 um}\n"));
  std::map<int, int> count;
  for (const PlacedCell& cell : cells) ++count[cell.row.type];
  EXPECT_EQ(count[0], 11);  // 11.55, 14.85 and 6.6: the largest remainders get the two that are left
  EXPECT_EQ(count[1], 15);
  EXPECT_EQ(count[2], 7);
  int changes = 0;
  for (std::size_t i = 1; i < cells.size(); ++i) changes += cells[i].row.type != cells[i - 1].row.type;
  EXPECT_GT(changes, 10) << "not one type after the other";
  EXPECT_GT(closest(cells), 0.97);
}

TEST(Mixture, RefusesPartsThatAreNoWhole) {
  const auto error = [](const std::string& types) {
    return errors_of(with_cells("  - {types: " + types + ", count: 33, fill: sphere, radius: 35 um}\n"));
  };
  EXPECT_THAT(error("{red: 50 %, green: 40 %}"), AllOf(HasSubstr("add up to 90 %"), HasSubstr("[E660]"), HasSubstr("study.yaml:13:")));
  EXPECT_THAT(error("{red: 50 %, gren: 50 %}"), AllOf(HasSubstr("[E401]"), HasSubstr("did you mean `green`?")));
  EXPECT_THAT(error("{red: 50 %, green: 50 %}, type: red"), HasSubstr("[E111]"));
  EXPECT_THAT(errors_of(with_cells("  - {types: {red: 100 %}, at: [[0 um, 0 um, 0 um]]}\n")), HasSubstr("[E111]"));
}

TEST(Points, MayBeOneAlone) {
  const auto one = cells_of(with_cells("  - {type: big, at: [1 um, 2 um, 80 um]}\n"));
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].center, (Vec3d{1.0, 2.0, 80.0}));
  EXPECT_THAT(errors_of(with_cells("  - {type: big, at: [1 um, 80 um]}\n")), HasSubstr("'at' has 2 numbers, but needs 3: [x, y, z]"));
  EXPECT_THAT(errors_of(with_cells("  - {type: big, at: 80 um}\n")), HasSubstr("'at' must be [x, y, z], or a list of these"));
}

TEST(Layer, LiesHexagonallyOnAWall) {
  const auto cells = cells_of(with_cells("  - {type: red, count: 19, fill: layer, on: z_low, center: [10 um, 20 um, 0 um]}\n"));
  ASSERT_EQ(cells.size(), 19u);
  int neighbours = 0;
  for (const PlacedCell& a : cells) {
    EXPECT_NEAR(a.center.z, -95.0, 1e-9);
    EXPECT_LE(std::hypot(a.center.x - 10.0, a.center.y - 20.0), 2.0 * 9.5 + 0.1) << "two rings";
    for (const PlacedCell& b : cells) neighbours += &a != &b && norm(a.center - b.center) < 1.1 * 9.5;
  }
  EXPECT_EQ(neighbours, 84) << "42 contacts of 19 discs in two rings around one";
}

TEST(Layer, LiesOnAPlaneBesideWhatIsThere) {
  const auto cells =
      cells_of(with_cells("  - {type: big, at: [[0 um, 0 um, 46 um]]}\n"
                          "  - {types: {red: 50 %, green: 50 %}, count: 20, fill: layer, on: plate}\n"));
  ASSERT_EQ(cells.size(), 21u);
  for (std::size_t i = 1; i < cells.size(); ++i) EXPECT_NEAR(cells[i].center.z, 40.0 + cells[i].radius(), 1e-9);
  EXPECT_GT(closest(cells), 0.93);
}

/// Places 9.5 µm apart: rows of 5 and 6 within 60 µm, three of them within 28 µm.
TEST(Layer, KeepsToARectangle) {
  const auto layer = [](const std::string& rest) {
    return with_cells("  - {type: red, fill: layer, on: z_low, center: [3 um, -2 um, 0 um], " + rest + "}\n");
  };
  const std::string size = ", size: [60 um, 28 um, 1 um]";
  const auto cells = cells_of(layer("count: 15" + size));
  ASSERT_EQ(cells.size(), 15u);
  double longest = 0.0, widest = 0.0;
  for (const PlacedCell& cell : cells) {
    longest = std::max(longest, std::abs(cell.center.x - 3.0));
    widest = std::max(widest, std::abs(cell.center.y + 2.0));
  }
  EXPECT_GT(closest(cells), 0.93);
  EXPECT_LE(longest, 25.0 + 1e-9);
  EXPECT_GT(longest, 19.0);
  EXPECT_LE(widest, 9.0 + 1e-9);
  EXPECT_GT(widest, 8.0);
  EXPECT_THAT(errors_of(layer("count: 30" + size)), AllOf(HasSubstr("[E658]"), HasSubstr("there are places for 17")));
  EXPECT_THAT(errors_of(layer("count: 5, radius: 20 um" + size)), AllOf(HasSubstr("[E111]"), HasSubstr("`radius`")));
}

TEST(Layer, NeedsAPlaneOrAWall) {
  const auto error = [](const std::string& on) { return errors_of(with_cells("  - {type: red, count: 5, fill: layer" + on + "}\n")); };
  EXPECT_THAT(error(""), AllOf(HasSubstr("[E103]"), HasSubstr("on: z_low")));
  EXPECT_THAT(error(", on: z_high"), AllOf(HasSubstr("is no wall"), HasSubstr("[E660]")));
  EXPECT_THAT(error(", on: stone"), AllOf(HasSubstr("is no plane"), HasSubstr("[E660]")));
  EXPECT_THAT(error(", on: plat"), AllOf(HasSubstr("[E660]"), HasSubstr("did you mean `plate`?")));
  EXPECT_THAT(error(", on: plate, radius: 6 um"), HasSubstr("[E658]"));
}

TEST(RandomFill, KeepsDistanceAndDependsOnTheSeed) {
  const std::string text = with_cells(
      "  - {type: big, at: [[0 um, 0 um, 0 um]]}\n"
      "  - {type: red, count: 60, fill: random, size: [80 um, 60 um, 60 um]}\n");
  const auto cells = cells_of(text);
  ASSERT_EQ(cells.size(), 61u);
  EXPECT_GT(closest(cells), 0.9499);
  for (std::size_t i = 1; i < cells.size(); ++i) {
    EXPECT_LE(std::abs(cells[i].center.x), 35.0);
    EXPECT_LE(std::abs(cells[i].center.z), 25.0);
  }
  EXPECT_EQ(cells_of(text)[7].center, cells[7].center);
  EXPECT_NE(cells_of(changed("initial:", "seed: 5\ninitial:", text))[7].center, cells[7].center);
  EXPECT_THAT(errors_of(with_cells("  - {type: red, count: 60, fill: random, radius: 22 um}\n")), HasSubstr("[E506]"));
  EXPECT_THAT(errors_of(with_cells("  - {types: {red: 50 %, green: 50 %}, count: 90, fill: random, radius: 22 um}\n")),
              HasSubstr("[E506]"));
}

TEST(RandomFill, PacksWhatOneByOneWouldNotFit) {
  const auto cells = cells_of(with_cells("  - {type: red, count: 150, fill: random, radius: 33.5 um}\n"));  // 0.50 of the ball
  ASSERT_EQ(cells.size(), 150u);
  EXPECT_GT(closest(cells), 0.974);
  for (const PlacedCell& cell : cells) EXPECT_LE(norm(cell.center), 33.5 - 5.0 + 0.25);
}

TEST(RandomFill, PacksAGivenClosedSurface) {
  const std::string vessel =
      changed("geometry:\n", "geometry:\n  vessel: {sphere: {center: [0 um, 0 um, 0 um], radius: 35 um}, side: inside}\n",
              with_cells("  - {type: red, count: 160, fill: random, size: [72 um, 72 um, 72 um]}\n"));
  const auto cells = cells_of(vessel);
  ASSERT_EQ(cells.size(), 160u);
  EXPECT_GT(closest(cells), 0.974);
  for (const PlacedCell& cell : cells) EXPECT_LE(norm(cell.center), 35.0 - 5.0 + 0.25);
}

TEST(RandomFill, SaysWhatCannotBePacked) {
  EXPECT_THAT(errors_of(with_cells("  - {type: big, count: 60, fill: random, radius: 26.8 um}\n")),  // 0.67 of the ball
              AllOf(HasSubstr("cannot be packed so densely at random: they have 0.67 times its volume"), HasSubstr("[E658]"),
                    HasSubstr("study.yaml:13:")));
}

TEST(Check, AnswersAtOnceForVeryManyCellsAndSaysWhatItLeftOut) {
  const auto study = read(with_cells("  - {type: red, count: 100000000, fill: box, size: [190 um, 190 um, 190 um]}\n"), {});
  ASSERT_FALSE(study.ok());
  const auto wide = read(changed("[190 um, 190 um, 190 um]", "[9 mm, 9 mm, 9 mm]",
                                 changed("size: [200 um, 200 um, 200 um]", "size: [10 mm, 10 mm, 10 mm]",
                                         with_cells("  - {type: red, count: 100000000, fill: box, size: [190 um, 190 um, 190 um]}\n"))));
  ASSERT_TRUE(wide.ok()) << wide.error().text();
  EXPECT_THAT(wide->notes, testing::Contains(HasSubstr("the places of 100000000 cells are found and judged when the run begins")));
}

}  // namespace
}  // namespace morula::scenarios::test
