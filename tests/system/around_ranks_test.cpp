// The same bits on any number of threads and ranks and over a restart for what looks at a cell's surroundings: layers of the tissue, levels of a field, axes of
// division along the surface, a gradient or a row.
#include <gtest/gtest.h>

#include "tests/system/runs_on_ranks.h"

namespace morula::test {
namespace {

constexpr const char* kStudy = R"(schema: 1
study: around
seed: 3
time: {end: 15 min, output: 5 min, checkpoint: 5 min}
domain:
  size: [80 um, 80 um, 80 um]
cell_types:
  skin:
    radius: {mean: 5 um, spread: 5 %}
    cycle: {duration: {mean: 45 min, spread: 10 %}, axis: along_surface, daughters: {fates: [{share: 50 %, types: [skin, tip]}]}}
    adhesion: {skin: 5e-5 J/m^2, tip: 5e-5 J/m^2, row: 5e-5 J/m^2}
    variation: {tension: {spread: 10 %, correlation: 50 %}, stiffness: 10 %, adhesion: {spread: 10 %, correlation: -30 %}}
    dcm: {nodes: 42}
  tip:
    like: skin
    cycle: {duration: {mean: 45 min, spread: 10 %}, axis: gradient, field: food}
  row:
    like: skin
    cycle: {duration: {mean: 45 min, spread: 10 %}, axis: long, axis_spread: 10 deg}
fields:
  food: {diffusion: 1e-9 m^2/s, initial: 0.5 mM, voxel: 8 um, boundary: {x_low: 0.1 mM, x_high: 0.9 mM}}
initial:
  - {types: {skin: 40 %, tip: 30 %, row: 30 %}, count: 40, fill: sphere, radius: 21 um, age: random}
coupling:
  max_shells: 12
  regions:
    - {name: fed, shape: level, field: food, level: 0.6 mM}
    - {name: rim, shape: surface, layers: 1}
output: {report: false}
)";

// One test: the reference is run once.
TEST(LookingAround, GivesTheSameBitsOnThreadsAndRanksAndOverARestart) {
  const TestFolder folder;
  const auto reference = expect_same_bits_everywhere(folder, kStudy, "7 min");
  EXPECT_GE(reference["shells"].get<int>(), 12);
  EXPECT_GT(reference["cells"].get<int>(), 45) << "and divisions";
}

}  // namespace
}  // namespace morula::test
