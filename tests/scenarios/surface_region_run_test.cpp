/// The user's road to regions by layers of the tissue and by the level of a field.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/close_packing.h"
#include "tests/scenarios/bodies_of_run.h"

namespace morula::scenarios {
namespace {

using testing::HasSubstr;

/// A cell, its 12 neighbours in a cubic close packing, and the 42 around these: three layers that adhere.
std::string ball(const std::string& regions, const std::string& more = "") {
  // A cubic close packing has shells of 1, 12, 6, 24, 12 sites at distances √0, √2, √4, √6, √8 of half its edge: contacts are cuboctahedra.
  std::vector<Vec3d> places = close_packed_places(2, 7.6);
  places.resize(55);
  std::string text = R"(
schema: 1
study: ball
time: {end: 10 min, output: 5 min}
domain: {size: [120 um, 120 um, 120 um]}
cell_types:
  cell: {radius: 4 um, dcm: {nodes: 42}}
)" + more + "initial:\n  - {type: cell, at: [";
  for (std::size_t k = 0; k < places.size(); ++k) text += (k > 0 ? ", " : "") + test::place_text(places[k]);
  return text + "]}\ncoupling:\n  hold: 1 min\n  regions: " + regions + "\noutput: {report: false}\n";
}

/// Shells among the founders with these numbers at the end of the run.
std::size_t shells(const std::map<CellId, BodyKind>& bodies, std::uint64_t first, std::uint64_t last) {
  std::size_t out = 0;
  for (std::uint64_t k = first; k <= last; ++k) out += bodies.at(CellId::founder(k)) == BodyKind::kShell;
  return out;
}

TEST(SurfaceRegion, HasTheOutermostLayersOfTheTissue) {
  // 55 sites: the centre, 12 that touch it, 42 at the surface (6 of them touch four of the 12, 24 two, 12 one).
  const auto outer = test::bodies_of_run(ball("[{name: rim, shape: surface}]"));
  ASSERT_FALSE(outer.empty());
  EXPECT_EQ(shells(outer.rbegin()->second, 1, 13), 0u);
  EXPECT_EQ(shells(outer.rbegin()->second, 14, 55), 42u);
  const auto two = test::bodies_of_run(ball("[{name: rim, shape: surface, layers: 2}]"));
  ASSERT_FALSE(two.empty());
  EXPECT_EQ(shells(two.rbegin()->second, 1, 1), 0u);
  EXPECT_EQ(shells(two.rbegin()->second, 2, 55), 54u);
}

TEST(SurfaceRegion, OfADisorderedTissueIsItsRimAndNoGapWithinIt) {
  const auto all = test::snapshots_of_run(R"(
schema: 1
study: disordered
time: {end: 80 min, output: 80 min}
domain: {size: [160 um, 160 um, 160 um]}
cell_types:
  cell: {radius: {mean: 4 um, spread: 10 %}, dcm: {nodes: 42}}
initial: [{type: cell, count: 240, fill: sphere, radius: 27 um}]
coupling: {regions: [{name: rim, shape: surface, from: 35 min}]}
output: {report: false}
)");
  ASSERT_FALSE(all.empty());
  const Snapshot& end = all.back().snapshot;
  Vec3d middle{};
  for (const Snapshot::Cell& cell : end.cells) middle += cell.centroid * (1.0 / 240.0);
  std::vector<std::pair<double, bool>> by_radius;
  for (const Snapshot::Cell& cell : end.cells) by_radius.emplace_back(norm(cell.centroid - middle), cell.body == BodyKind::kShell);
  std::ranges::sort(by_radius);
  const auto shells = [&](std::size_t from, std::size_t until) {
    return std::count_if(by_radius.begin() + static_cast<std::ptrdiff_t>(from), by_radius.begin() + static_cast<std::ptrdiff_t>(until),
                         [](const auto& one) { return one.second; });
  };
  EXPECT_LE(shells(0, 80), 1) << "of contacts alone a fifth of them would be: random packings have gaps of 65°";
  EXPECT_GE(shells(180, 240), 59);
}

TEST(SurfaceRegion, KeepsSpheresOneContactFurtherWhereTheRimIsSpheres) {
  const auto core = test::bodies_of_run(ball("[{name: rim, shape: surface, as: sphere}, {name: core, shape: everything}]"));
  ASSERT_FALSE(core.empty());
  EXPECT_EQ(shells(core.rbegin()->second, 1, 1), 1u);
  EXPECT_EQ(shells(core.rbegin()->second, 2, 55), 0u) << "who is a sphere leaves the rim beyond its first contact";
}

TEST(SurfaceRegion, TellsWhatItDoesNotKnow) {
  const auto told = [](const std::string& region) {
    const auto study = test::read(ball("[" + region + "]"));
    return study.ok() ? std::string() : study.error().text();
  };
  EXPECT_EQ(told("{name: rim, shape: surface}"), "");
  EXPECT_THAT(told("{name: rim, shape: surface, layers: 0}"), HasSubstr("[E302]"));
  EXPECT_THAT(told("{name: rim, shape: surface, margin: 3 um}"), HasSubstr("'margin' has no effect here"));
  EXPECT_THAT(told("{name: rim, shape: surface, center: [1 um, 0 um, 0 um]}"), HasSubstr("'center' has no effect here"));
  EXPECT_THAT(told("{name: rim, shape: surface, radius: 3 um}"), HasSubstr("has no `radius`"));
}

/// Cells in a row along x, far apart, in a field that rises from 0 at −60 µm to 1.2 mM at 60 µm.
constexpr const char* kRow = R"(
schema: 1
study: level
time: {end: 20 min, output: 1 min}
domain:
  size: [120 um, 20 um, 20 um]
  center: [0 um, 0 um, 0 um]
cell_types:
  cell: {radius: 4 um}
fields:
  food:
    diffusion: 1e-9 m^2/s
    initial: START
    voxel: 4 um
    boundary: {x_low: 0 mM, x_high: 1.2 mM}
initial:
  - {type: cell, at: [[-45 um, 0 um, 0 um], [-25 um, 0 um, 0 um], [-5 um, 0 um, 0 um], [15 um, 0 um, 0 um], [35 um, 0 um, 0 um]]}
coupling:
  hold: 1 min
  regions: REGIONS
output: {report: false}
)";

std::string row(const std::string& regions, const std::string& start = "0.6 mM") {
  return test::changed("REGIONS", regions, test::changed("START", start, kRow));
}

/// S or s by founder at the end.
std::string at_end(const std::string& text) {
  std::string out;
  const auto all = test::bodies_of_run(text);
  if (all.empty()) return out;
  for (const auto& [id, body] : all.rbegin()->second) out += body == BodyKind::kShell ? 'S' : 's';
  return out;
}

TEST(LevelRegion, HasTheCellsAboveOrBelowALevel) {
  // At rest the cells see 0.15, 0.35, 0.55, 0.75 and 0.95 mM.
  EXPECT_EQ(at_end(row("[{name: fed, shape: level, field: food, level: 0.7 mM}]")), "sssSS");
  EXPECT_EQ(at_end(row("[{name: starved, shape: level, field: food, level: 0.4 mM, side: below}]")), "SSsss");
}

TEST(LevelRegion, IsLeftOnlyBeyondItsSlack) {
  // All begin at 0.62 mM, above the level; at rest two are further below it than a fifth, and one (0.55 mM) is not.
  EXPECT_EQ(at_end(row("[{name: fed, shape: level, field: food, level: 0.6 mM}]", "0.62 mM")), "ssSSS");
  EXPECT_EQ(at_end(row("[{name: fed, shape: level, field: food, level: 0.6 mM, slack: 5 %}]", "0.62 mM")), "sssSS");
}

TEST(LevelRegion, MayBeWhereNeighboursAreCountedFrom) {
  const std::string text = test::changed(
      "[-45 um, 0 um, 0 um], [-25 um, 0 um, 0 um], [-5 um, 0 um, 0 um], [15 um, 0 um, 0 um], [35 um, 0 um, 0 um]",
      "[0 um, 0 um, 0 um], [7.6 um, 0 um, 0 um], [15.2 um, 0 um, 0 um], [22.8 um, 0 um, 0 um]",
      row("[{name: fed, shape: level, field: food, level: 0.81 mM, slack: 1 %}, {name: beside, shape: neighbours, of: fed, cells: 1}]"));
  EXPECT_EQ(at_end(text), "ssSS") << "0.6, 0.676, 0.752 and 0.828 mM";
}

TEST(LevelRegion, TellsWhatItDoesNotKnow) {
  const auto told = [](const std::string& region) {
    const auto study = test::read(row("[" + region + "]"));
    return study.ok() ? std::string() : study.error().text();
  };
  EXPECT_THAT(told("{name: fed, shape: level, field: fod, level: 0.7 mM}"), HasSubstr("food"));
  EXPECT_THAT(told("{name: fed, shape: level, field: food}"), HasSubstr("needs `level`"));
  EXPECT_THAT(told("{name: fed, shape: level, level: 0.7 mM}"), HasSubstr("needs `field`"));
  EXPECT_THAT(told("{name: fed, shape: level, field: food, level: 0 mM}"), HasSubstr("[E302]"));
  EXPECT_THAT(told("{name: fed, shape: level, field: food, level: 0.7 mM, side: beyond}"), HasSubstr("below"));
  EXPECT_THAT(told("{name: fed, shape: level, field: food, level: 0.7 mM, slack: 100 %}"), HasSubstr("[E302]"));
  EXPECT_THAT(told("{name: fed, shape: level, field: food, level: 0.7 mM, margin: 1 um}"), HasSubstr("'margin' has no effect here"));
}

}  // namespace
}  // namespace morula::scenarios
