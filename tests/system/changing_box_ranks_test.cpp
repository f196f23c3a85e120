// The same bits on any number of threads and ranks and over a restart in the middle of the course of a box.
#include <gtest/gtest.h>

#include "tests/system/runs_on_ranks.h"

namespace morula::test {
namespace {

/// Spheres and shells, those of a region and their neighbours over any border, that grow, divide, change their bodies and wander through the faces of a box that shrinks and widens.
constexpr const char* kStudy = R"(schema: 1
study: box
seed: 5
time: {end: 1 h, output: 10 min, checkpoint: 10 min}
domain:
  size: [44 um, 44 um, 44 um]
  boundary: periodic
  course: [{time: 5 min, volume: 1}, {time: 35 min, volume: 0.7}, {time: 50 min, volume: 0.7}, {time: 1 h, volume: 0.8}]
cell_types:
  cell:
    radius: {mean: 5 um, spread: 5 %}
    cycle: {duration: {mean: 3 h, spread: 10 %}}
    migration: {speed: 20 um/h, persistence: 10 min}
    dcm: {nodes: 42, nucleus: {kind: rigid, radius: 2 um}}
contact: {range: 1 um}
initial:
  - {type: cell, count: 50, fill: box, size: [44 um, 44 um, 44 um], start_volume: 60 %, inflate: 4 min, age: random}
coupling:
  regions:
    - {name: left, shape: half_space, center: [-10 um, 0 um, 0 um], normal: [1, 0, 0], as: dcm, margin: 2 um}
    - {name: next_to_it, shape: neighbours, of: left, cells: 1, as: dcm}
output: {report: false}
)";

// One test: the reference is run once.
TEST(ChangingBox, GivesTheSameBitsOnThreadsAndRanksAndOverARestartInItsCourse) {
  const TestFolder folder;
  const auto reference = expect_same_bits_everywhere(folder, kStudy, "20 min");  // where the box is on its way
  EXPECT_GT(reference["shells"].get<int>(), 5);
  EXPECT_GT(reference["spheres"].get<int>(), 5);
  EXPECT_GT(reference["cells"].get<int>(), 50) << "and divisions";
}

}  // namespace
}  // namespace morula::test
