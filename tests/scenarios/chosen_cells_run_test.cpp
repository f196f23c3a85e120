/// The user's road to exchanges by hand: cells that a study names become shells, and spheres again.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>

#include "tests/scenarios/bodies_of_run.h"

namespace morula::scenarios {
namespace {

/// Founders in a row that adhere to their neighbours.
constexpr const char* kRow = R"(
schema: 1
study: row
time: {end: END, output: 5 min}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  cell: {radius: 4 um, cycle: CYCLE}
initial:
  - {type: cell, at: [PLACES]}
coupling:
  hold: 1 min
  regions: REGIONS
output: {report: false}
)";
constexpr const char* kFive =
    "[0 um, 0 um, 0 um], [7.6 um, 0 um, 0 um], [15.2 um, 0 um, 0 um], [22.8 um, 0 um, 0 um], [30.4 um, 0 um, 0 um]";

std::string row(const std::string& regions, const std::string& places = kFive, const std::string& cycle = "{model: none}",
                const std::string& end = "20 min") {
  return test::changed("REGIONS", regions, test::changed("PLACES", places, test::changed("CYCLE", cycle, test::changed("END", end, kRow))));
}

/// By time in minutes: id and body of each cell, S or s for shell and sphere.
std::map<int, std::string> bodies(const std::string& text) {
  std::map<int, std::string> out;
  for (const auto& [time, cells] : test::bodies_of_run(text))
    for (const auto& [id, body] : cells)
      out[static_cast<int>(std::lround(time / 60.0))] += id.text() + (body == BodyKind::kShell ? "S " : "s ");
  return out;
}

TEST(ChosenCells, AreShellsWhileTheStudySays) {
  auto at = bodies(row("[{name: chosen, shape: cells, ids: [2, 5], from: 4 min, until: 12 min}]"));
  EXPECT_EQ(at[0], "1s 2s 3s 4s 5s ");
  EXPECT_EQ(at[5], "1s 2S 3s 4s 5S ");
  EXPECT_EQ(at[10], "1s 2S 3s 4s 5S ");
  EXPECT_EQ(at[20], "1s 2s 3s 4s 5s ");
}

TEST(ChosenCells, StandBeforeTheRegionsBehindThem) {
  auto at = bodies(row("[{name: chosen, shape: cells, ids: 3, as: sphere}, {name: rest, shape: everything}]"));
  EXPECT_EQ(at[20], "1S 2S 3s 4S 5S ");
}

TEST(ChosenCells, HaveNeighboursThatAreCounted) {
  auto at = bodies(row("[{name: chosen, shape: cells, ids: 3}, {name: beside, shape: neighbours, of: chosen, cells: 1}]"));
  EXPECT_EQ(at[20], "1s 2S 3S 4S 5s ");
}

TEST(ChosenCells, AreDaughtersThatAreNamed) {
  const auto at = bodies(row("[{name: chosen, shape: cells, ids: \"1.0\", from: 50 min}]", "[0 um, 0 um, 0 um]",
                             "{duration: {mean: 40 min, spread: 0 %}}", "1.4 h"));
  std::istringstream last(at.rbegin()->second);
  std::map<std::string, int> seen;
  for (std::string word; last >> word;) ++seen[word.substr(0, 3) + word.back()];  // who of the two daughters it comes of, and its body
  EXPECT_EQ(seen.size(), 2u) << at.rbegin()->second;
  EXPECT_GE(seen["1.0S"], 2) << at.rbegin()->second;
  EXPECT_GE(seen["1.1s"], 2) << at.rbegin()->second;
}

}  // namespace
}  // namespace morula::scenarios
