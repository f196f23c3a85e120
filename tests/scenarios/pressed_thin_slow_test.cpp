/// Shells that growing spheres press thin do not pass through themselves (decision 0089): a study with default parameters, on the user's road.
#include <gtest/gtest.h>

#include <algorithm>

#include "results/series_reader.h"
#include "scenarios/run/driver.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

constexpr const char* kCapsule = R"(schema: 1
study: pressed_thin
seed: 2
time: {end: 40 h, output: 1 h}
domain: {size: [100 um, 100 um, 100 um], boundary: open}
cell_types:
  cell:
    radius: 6 um
    cycle: {duration: 20 h}
    inhibit_growth: {pressure_above: never}
geometry:
  capsule: {sphere: {radius: 22 um}, side: inside}
initial:
  - {type: cell, count: 13, fill: sphere, radius: 16 um}
coupling:
  max_shells: 2
  regions:
    - {name: core, shape: sphere, radius: 8 um}
output: {report: false}
)";

/// Of seeds 1 to 7 all go on; without self-contact 2 to 7 end between 16 and 40 h.
TEST(PressedThin, ShellsAmongGrowingSpheresGoOn) {
  const auto ends_well = [](const std::string& keys) {
    const test::Folder folder;
    const auto study = test::read(test::changed("    radius: 6 um\n", "    radius: 6 um\n" + keys, kCapsule));
    EXPECT_TRUE(study.ok()) << study.error().text();
    if (!study.ok()) return false;
    RunRequest request;
    request.out = folder.path() / "run";
    const auto done = run(*study, request, Comm());
    if (!done.ok()) return false;
    const auto series = read_series(request.out / "series.csv");
    EXPECT_TRUE(series.ok());
    EXPECT_GE(series->find("cell_count")->values.back(), 50.0);
    EXPECT_LT(std::ranges::max(series->find("worst_overlap")->values), 0.3);
    return true;
  };
  EXPECT_TRUE(ends_well(""));
  EXPECT_FALSE(ends_well("    dcm: {self_contact: off}\n"));
}

}  // namespace
}  // namespace morula::scenarios
