/// The user's road to axes of division that look at what lies around a cell.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "tests/scenarios/snapshots_of_run.h"

namespace morula::scenarios::test {
namespace {

/// Cells of one age that divide once, at 30 min.
std::string cells(const std::string& axis, const std::string& places, const std::string& body = "sphere", const std::string& more = "") {
  return R"(
schema: 1
study: axes
time: {end: 31 min, output: 31 min}
domain: {size: [160 um, 160 um, 60 um], center: [0 um, 0 um, 0 um]}
cell_types:
  cell: {radius: 4 um, body: )" +
         body + R"(, adhesion: {cell: 1e-4 J/m^2}, dcm: {nodes: 162}, cycle: {duration: 30 min, axis: )" + axis + R"(}}
)" + more +
         "initial:\n  - {type: cell, at: [" + places + "], age: birth}\noutput: {report: false}\n";
}

/// From the second daughter to the first, of length 1, by mother.
std::map<CellId, Vec3d> daughters_of(const std::string& text) {
  std::map<CellId, Vec3d> out;
  const auto all = snapshots_of_run(text);
  if (all.empty()) return out;
  for (const Snapshot::Cell& a : all.back().snapshot.cells)
    for (const Snapshot::Cell& b : all.back().snapshot.cells)
      if (a.parent == b.parent && a.parent.valid() && a.id == a.parent.daughter(0) && b.id == a.parent.daughter(1))
        out[a.parent] = normalized(a.centroid - b.centroid);
  return out;
}

std::string at(double x, double y, double z) { return place_text({x, y, z}); }

constexpr double kApart = 8.1;  // neither body begins too deep in another

/// A layer of 19 that touch, in a hexagon.
std::string layer() {
  std::string out;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      if (std::abs(i + j) <= 2) out += (out.empty() ? "" : ", ") + at(kApart * (i + 0.5 * j), kApart * std::sqrt(0.75) * j, 0.0);
  return out;
}
bool is_inner(CellId mother) {
  std::uint64_t number = 0;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      if (std::abs(i + j) <= 2 && CellId::founder(++number) == mother) return std::max({std::abs(i), std::abs(j), std::abs(i + j)}) <= 1;
  return false;
}

TEST(DivisionAxisRun, AlongTheSurfaceKeepsTheInnerCellsOfALayerInIt) {
  // At the rim of a layer the surface goes round: there both directions lie along it.
  for (const char* body : {"sphere", "shell"}) {
    const auto found = daughters_of(cells("along_surface", layer(), body));
    ASSERT_EQ(found.size(), 19u) << body;
    int inner = 0;
    for (const auto& [mother, u] : found) {
      if (!is_inner(mother)) continue;
      ++inner;
      EXPECT_LT(std::abs(u.z), 0.25) << body << " " << mother.text();
    }
    EXPECT_EQ(inner, 7);
  }
}

TEST(DivisionAxisRun, LongOfSpheresLiesWithinTheirLayer) {
  const auto found = daughters_of(cells("long", layer()));
  ASSERT_EQ(found.size(), 19u);
  for (const auto& [mother, u] : found) EXPECT_LT(std::abs(u.z), 0.2) << mother.text();
}

TEST(DivisionAxisRun, LongOfSpheresLiesAlongTheirRow) {
  std::string row;
  for (int i = 0; i < 6; ++i) row += (i > 0 ? ", " : "") + at(7.6 * i - 19.0, 0.0, 0.0);
  const auto found = daughters_of(cells("long", row));
  ASSERT_EQ(found.size(), 6u);
  for (const auto& [mother, u] : found) EXPECT_GT(std::abs(u.x), 0.9) << mother.text();
}

TEST(DivisionAxisRun, GradientPointsUpTheField) {
  const std::string field =
      "fields: {food: {diffusion: 1e-9 m^2/s, initial: 0.6 mM, voxel: 5 um, boundary: {y_low: 0.2 mM, y_high: 1 mM}}}\n";
  const std::string apart = at(-30, 0, 0) + ", " + at(0, 5, 0) + ", " + at(30, -5, 0);
  for (const char* body : {"sphere", "shell"}) {
    const auto found = daughters_of(cells("gradient, field: food", apart, body, field));
    ASSERT_EQ(found.size(), 3u);
    for (const auto& [mother, u] : found) EXPECT_GT(u.y, 0.99) << body << " " << mother.text();
  }
}

TEST(DivisionAxisRun, AlongTheGeometryLiesInTheSurfaceOfAnObstacle) {
  // A slope whose normal is (1, 0, 1): cells above it divide across that.
  const std::string slope = "geometry: {slope: {plane: {center: [0 um, 0 um, -15 um], normal: [1, 0, 1], size: 60 um}}}\n";
  const std::string apart = at(-10, -20, 12) + ", " + at(0, 0, 12) + ", " + at(10, 20, 12);
  const auto found = daughters_of(cells("along_geometry, geometry: slope", apart, "sphere", slope));
  ASSERT_EQ(found.size(), 3u);
  for (const auto& [mother, u] : found) EXPECT_NEAR(dot(u, normalized(Vec3d{1, 0, 1})), 0.0, 1e-6) << mother.text();
}

}  // namespace
}  // namespace morula::scenarios::test
