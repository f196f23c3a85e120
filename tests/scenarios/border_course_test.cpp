// Concentrations on the faces of the domain that change with time.
#include <cmath>

#include "tests/scenarios/own_parts.h"

namespace morula::scenarios::test {
namespace {

using testing::HasSubstr;

/// One voxel of 20 µm: dc/dt = k (c_b − c), k = 12 D/h² = 0.03/s (six faces half a voxel away). While c_b = a t, c = a (t − (1 − e^(−kt))/k).
const std::string kStudy = R"(schema: 1
study: border
time: {end: 20 min, step: 5 s, output: 5 min, checkpoint: 5 min}
domain: {size: [20 um, 20 um, 20 um]}
cell_types:
  idle: {radius: 6 um}
fields:
  dye: {diffusion: 1e-12 m^2/s, initial: 0 mM, voxel: 20 um, tolerance: 1e-8, boundary: {all: 1 mM}, course: [{time: 0 s, factor: 0}, {time: 10 min, factor: 1}, {time: 613 s, factor: 0.5}]}
initial: [{type: idle, at: [[0 um, 0 um, 0 um]]}]
output: {report: false}
)";

class BorderCourse : public OwnParts {
 protected:
  BorderCourse() : OwnParts([](Laws&) {}) {}
};

TEST_F(BorderCourse, IsFollowedByTheFieldAndItsCornersAreNotCut) {
  run_whole(kStudy, "whole");
  const auto time = column("whole", "time"), dye = column("whole", "mean_dye");
  ASSERT_EQ(time.size(), 5u);
  const double k = 0.03, a = 1.0 / 600.0;
  const auto ramp = [&](double t) { return a * (t - (1.0 - std::exp(-k * t)) / k); };
  EXPECT_NEAR(dye[1], ramp(300.0), 1e-6);
  EXPECT_NEAR(dye[2], ramp(600.0), 1e-6);
  // The fall by a half in 13 s ends between two steps of 5 s; then c goes to what is left on the faces as e^(−kt).
  const double b = 0.5 / 13.0, at_end = ramp(600.0) * std::exp(-k * 13.0) + (1.0 - std::exp(-k * 13.0)) * (1.0 + b / k) - b * 13.0;
  EXPECT_NEAR(dye[3], 0.5 + (at_end - 0.5) * std::exp(-k * (900.0 - 613.0)), 1e-6);
  EXPECT_LT(column("whole", "balance_dye").back(), 1e-12);
}

/// A field at rest is gone through in steps as long as there are; what then begins to change it needs a thousandth of them.
TEST_F(BorderCourse, BeginsAfterARestOfHours) {
  run_whole(R"(schema: 1
study: late
time: {end: 150 min, output: 30 min}
domain: {size: [200 um, 200 um, 200 um]}
cell_types: {idle: {radius: 6 um}}
fields:
  dye: {diffusion: 1e-9 m^2/s, initial: 0.1 mM, boundary: 0.1 mM, course: [{time: 60 min, factor: 1}, {time: 120 min, factor: 0}]}
initial: [{type: idle, at: [[0 um, 0 um, 0 um]]}]
output: {report: false}
)",
            "late");
  const auto dye = column("late", "mean_dye");
  ASSERT_EQ(dye.size(), 6u);
  EXPECT_NEAR(dye[2], 0.1, 1e-9);
  EXPECT_NEAR(dye[3], 0.05, 1e-4);  // behind the border by the mean of u, ∇²u = −1/D, 0.8 s of the ramp: 2e-5 mM
  EXPECT_NEAR(dye[5], 0.0, 1e-6);
}

TEST_F(BorderCourse, IsNotNeededForAFieldToBeginLate) {
  run_whole(R"(schema: 1
study: late
time: {end: 4 h, output: 1 h}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  mother: {radius: 6 um, cycle: {duration: 100 min, daughters: {fates: [{share: 100 %, types: [mother, source]}]}}}
  source: {radius: 6 um}
fields:
  dye: {diffusion: 1e-9 m^2/s, initial: 0 mM, secretion: {source: 10 amol/s}, decay: 0.001 1/s}
initial: [{type: mother, at: [[0 um, 0 um, 0 um]], age: birth}]
output: {report: false}
)",
            "source");
  // One source from 100 min on, a second from 200 min: d(cV)/dt = 10 amol/s each − k cV, V = 8e6 µm³.
  const double k = 0.001, at_end = 10.0 / k * (2.0 - std::exp(-k * 8400.0) - std::exp(-k * 2400.0));
  EXPECT_NEAR(column("source", "mean_dye").back(), at_end / 8e6, 0.02 * at_end / 8e6);  // cells begin with a step
}

TEST_F(BorderCourse, MayTakeAllAwayWithoutAFalseAlarmOfTheBalance) {
  run_whole(changed("factor: 0.5}]", "factor: 0}]", kStudy), "gone");
  EXPECT_LT(column("gone", "mean_dye").back(), 1e-7);
  EXPECT_LT(column("gone", "balance_dye").back(), 1e-12);
}

TEST_F(BorderCourse, HasTheSameBitsAfterARestartAndFromTheResolvedStudy) {
  const RunSummary whole = run_whole(kStudy, "whole");
  EXPECT_EQ(run_split(kStudy, "split", 300.0).final_state.state_hash, whole.final_state.state_hash);
  run_whole(file("whole", "study.resolved.yaml"), "again");
  EXPECT_EQ(file("again", "series.csv"), file("whole", "series.csv"));
}

TEST_F(BorderCourse, NeedsConcentrationsThatCanFollow) {
  const auto errors = [&](const std::string& from, const std::string& to) {
    const auto found = read(changed(from, to, kStudy), options());
    return found.ok() ? std::string() : found.error().text();
  };
  EXPECT_THAT(errors("boundary: {all: 1 mM}, ", ""), HasSubstr("[E111]"));
  EXPECT_THAT(errors("boundary: {all: 1 mM}", "boundary: {all: 0 mM}"), HasSubstr("[E111]"));
  EXPECT_THAT(errors("factor: 1}", "factor: -1}"), HasSubstr("a concentration cannot be -1 times what it is"));
  EXPECT_THAT(errors("{time: 613 s", "{time: 313 s"), HasSubstr("[E510]"));
}

}  // namespace
}  // namespace morula::scenarios::test
