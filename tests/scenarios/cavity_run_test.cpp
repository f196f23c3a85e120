/// Cavities with a wall of both bodies, from a study to its results.
#include "core/vec3.h"
#include "scenarios/measures/single_cell.h"
#include "tests/scenarios/own_parts.h"

namespace morula::scenarios::test {
namespace {

class CavityRun : public OwnParts {
 protected:
  CavityRun() : OwnParts([](Laws&) {}) {}

  /// Mean distance of the centres of the spheres, or of the shells, from the origin, by snapshot [µm].
  std::vector<double> distances(const std::string& run, BodyKind body) {
    const auto moments = all_snapshots(folder_.path() / run);
    EXPECT_TRUE(moments.ok());
    std::vector<double> out;
    for (const Snapshot& moment : *moments) {
      double sum = 0.0;
      int count = 0;
      for (const Snapshot::Cell& cell : moment.cells)
        if (cell.body == body) sum += norm(cell.centroid), ++count;
      out.push_back(sum / count);
    }
    return out;
  }
};

/// Nine shells and three spheres about a cavity, twelve corners of an icosahedron: each bears 5 Pa on a twelfth of its wall, some 2 nN, from minute 20 on. (Spheres
/// bore nothing, and what they should have borne went to the shells: they were drawn inwards by 0.1 µm.)
TEST_F(CavityRun, SpheresInItsWallAreDrivenOutwards) {
  run_whole(R"(schema: 1
study: cyst
time: {end: 23 min, output: 1 min}
contact: {range: 1 um}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  wall: {radius: 19 um, body: shell, adhesion: {others: 0.2 mN/m}, friction: {medium: 1e6 N s/m^3}, dcm: {nodes: 162, cortex: {elastic: none, tension: 0.3 mN/m}}}
  ball: {like: wall, body: sphere}
initial:
  - type: wall
    start_volume: 40 %
    inflate: 15 min
    at: [[0 um, -15.77 um, -25.52 um], [-15.77 um, -25.52 um, 0 um], [-25.52 um, 0 um, -15.77 um], [0 um, -15.77 um, 25.52 um], [-15.77 um, 25.52 um, 0 um],
         [25.52 um, 0 um, -15.77 um], [0 um, 15.77 um, -25.52 um], [15.77 um, -25.52 um, 0 um], [-25.52 um, 0 um, 15.77 um]]
  - type: ball
    start_volume: 40 %
    inflate: 15 min
    at: [[0 um, 15.77 um, 25.52 um], [15.77 um, 25.52 um, 0 um], [25.52 um, 0 um, 15.77 um]]
lumens: {cavity: {center: [0 um, 0 um, 0 um], from: 20 min, pressure: 5 Pa}}
output: {report: false}
)",
            "cyst");
  const auto spheres = distances("cyst", BodyKind::kSphere), shells = distances("cyst", BodyKind::kShell);
  ASSERT_EQ(spheres.size(), 24u);
  EXPECT_GT(spheres[23] - spheres[20], 0.2);
  EXPECT_GT(shells[23] - shells[20], 0.0);
  EXPECT_LT(column("cyst", "open_cavity").back(), 0.05);
}

}  // namespace
}  // namespace morula::scenarios::test
