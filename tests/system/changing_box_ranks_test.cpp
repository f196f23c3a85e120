// The same bits on any number of threads and ranks and over a restart in the middle of the course of a box.
#include <gtest/gtest.h>

#include "tests/system/runs_on_ranks.h"

namespace morula::test {
namespace {

/// Spheres and shells, those of a region and their neighbours over any border, that grow, divide, change their bodies and wander through the faces of a box that shrinks and widens.
constexpr const char* kStudy = R"(schema: 1
study: box
seed: 5
time: {end: 15 min, output: 5 min, checkpoint: 5 min}
domain:
  size: [35 um, 35 um, 35 um]
  boundary: periodic
  course: [{time: 4 min, volume: 1}, {time: 10 min, volume: 0.8}, {time: 11 min, volume: 0.8}, {time: 15 min, volume: 0.9}]
cell_types:
  cell:
    radius: {mean: 5 um, spread: 5 %}
    cycle: {duration: {mean: 60 min, spread: 10 %}}
    migration: {speed: 40 um/h, persistence: 5 min}
    dcm: {nodes: 42, nucleus: {kind: rigid, radius: 2 um}}
contact: {range: 1 um}
initial:
  - {type: cell, count: 24, fill: box, size: [35 um, 35 um, 35 um], start_volume: 60 %, inflate: 4 min, age: random}
coupling:
  regions:
    - {name: left, shape: half_space, center: [-11 um, 0 um, 0 um], normal: [1, 0, 0], as: dcm, margin: 1 um}
    - {name: next_to_it, shape: neighbours, of: left, cells: 1, as: dcm}
output: {report: false}
)";

// One test: the reference is run once.
TEST(ChangingBox, GivesTheSameBitsOnThreadsAndRanksAndOverARestartInItsCourse) {
  const TestFolder folder;
  const auto reference = expect_same_bits_everywhere(folder, kStudy, "7 min");  // where the box is on its way
  EXPECT_GT(reference["shells"].get<int>(), 5);
  EXPECT_GT(reference["spheres"].get<int>(), 5);
  EXPECT_GT(reference["cells"].get<int>(), 24) << "and divisions";
}

}  // namespace
}  // namespace morula::test
