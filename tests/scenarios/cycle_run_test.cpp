// Cell cycles in runs of studies: rates, phases and sizes as a user reads them from the results. Numbers: physics/cbm.md §5.
#include <cmath>
#include <tuple>

#include "results/lineage.h"
#include "tests/scenarios/own_parts.h"

namespace morula::scenarios::test {
namespace {

using testing::HasSubstr;

class CycleRun : public OwnParts {
 protected:
  CycleRun() : OwnParts([](Laws&) {}) {}
  /// Slope of the division volume against the birth volume of the cells that a run has divided, and how many these are.
  std::pair<double, double> slope(const std::string& run) {
    const auto lives = read_lineage(folder_.path() / run / "results.h5", folder_.path() / run / "events.jsonl");
    EXPECT_TRUE(lives.ok());
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (const CellLife& life : *lives) {
      const double a = life.birth_volume, b = life.division_volume;
      if (!(a > 0.0 && b > 0.0)) continue;
      n += 1.0, x += a, y += b, xx += a * a, xy += a * b;
    }
    return {(n * xy - x * y) / (n * xx - x * x), n};
  }
};

/// Soft spheres far apart, so that nothing holds them back. Cycles are those of the physics page at ten times the speed.
std::string far_apart(int count, const std::string& cycle, const std::string& end) {
  return R"(schema: 1
study: cycle
time: {end: )" +
         end + R"(, output: 36 min, checkpoint: 36 min}
numerics: {max_displacement: 2, newton: 1, tolerance: 0.1, initial_step: 1 min}
domain: {size: [1500 um, 1500 um, 1500 um]}
contact: {range: 1 um}
cell_types:
  a:
    radius: 5 um
    cycle: {)" +
         cycle + R"(}
    inhibit_growth: {pressure_above: never}
    adhesion: {a: 0 J/m^2}
    cbm: {law: hertz, young: 100 Pa}
initial:
  - {type: a, count: )" +
         std::to_string(count) + R"(, fill: random, size: [1400 um, 1400 um, 1400 um], age: random}
limits: {volume_error: 10 %}
output: {report: false}
)";
}

const std::string kFixed = "model: phases, phases: {G1: 42 min, S: 36 min, G2: 18 min, M: 12 min}";
const std::string kErlang =
    "model: phases, phases: {G1: {duration: 42 min, law: erlang, stages: 10}, S: {duration: 36 min, law: erlang, stages: 10}, "
    "G2: {duration: 18 min, law: erlang, stages: 10}, M: {duration: 12 min, law: erlang, stages: 10}}";

TEST_F(CycleRun, GrowsByTheRateOfItsPhases) {
  run_whole(far_apart(400, kFixed, "216 min"), "fixed");
  const auto fixed = column("fixed", "cell_count");
  EXPECT_NEAR(std::log(fixed[6] / fixed[0]) / 3.6, 0.385082, 0.01 * 0.385082);
  // The chances of the first cells take four cycles to be forgotten; the rate of the last two cycles.
  run_whole(far_apart(100, kErlang, "720 min"), "erlang");
  const auto erlang = column("erlang", "cell_count");
  EXPECT_NEAR(std::log(erlang[20] / erlang[14]) / 3.6, 0.389140, 0.01 * 0.389140);
  // Parts of the cells in the phases, the mean over these two cycles.
  const double parts[] = {0.471338, 0.315060, 0.132991, 0.080611};
  std::size_t p = 0;
  for (const char* phase : {"G1", "S", "G2", "M"}) {
    const auto cells = column("erlang", std::string("cells_in_") + phase);
    double mean = 0.0;
    for (std::size_t k = 15; k <= 20; ++k) mean += cells[k] / erlang[k] / 6.0;
    EXPECT_NEAR(mean, parts[p++], 0.01) << phase;
  }
}

TEST_F(CycleRun, ControlsSize) {
  const std::string rest = ", spread: 5 %}, growth: exponential, duration: {mean: 108 min, spread: 5 %}, share: {mean: 50 %, spread: 15 %}";
  const std::string phases = "model: phases, phases: {G1: {until: size}, M: {duration: 12 min, grows: false}}, ";
  for (const auto& [name, cycle, expected] :
       {std::tuple("adder", phases + "size: {control: adder" + rest, 1.0), {"sizer", "size: {control: sizer" + rest, 0.0}}) {
    run_whole(far_apart(60, cycle, "432 min"), name);
    const auto [found, cells] = slope(name);
    EXPECT_GT(cells, 250.0);
    EXPECT_NEAR(found, expected, 0.05) << name;
  }
}

TEST_F(CycleRun, HasTheSameBitsOnTwoThreadsAndAfterARestart) {
  const std::string text = far_apart(8,
                                     "model: phases, phases: {G1: {duration: 50 min, law: erlang, stages: 3, arrest: {contact: {from: 0 %, "
                                     "to: 3 %}}}, S: {duration: 30 min, law: "
                                     "gaussian, spread: 20 %}, M: {duration: 10 min, grows: false}}, quiescence: {phase: G1, hold: 2 min}, "
                                     "arrest: {pressure: {from: 1 Pa, to: 50 Pa}}",
                                     "216 min");
  const RunSummary whole = run_whole(text, "whole");
  EXPECT_FALSE(whole.final_state.state_hash.empty());
  EXPECT_THAT(file("whole", "events.jsonl"), HasSubstr("\"quiescence\""));
  EXPECT_THAT(file("whole", "events.jsonl"), HasSubstr("\"return\""));
  EXPECT_EQ(run_whole(text, "threads", 2).final_state.state_hash, whole.final_state.state_hash);
  EXPECT_EQ(run_split(text, "split", 108 * 60.0).final_state.state_hash, whole.final_state.state_hash);
  EXPECT_EQ(file("split", "events.jsonl"), file("whole", "events.jsonl"));
  EXPECT_EQ(file("split", "series.csv"), file("whole", "series.csv"));
  // The study with all its defaults is the same study.
  EXPECT_EQ(run_whole(file("whole", "study.resolved.yaml"), "resolved").final_state.state_hash, whole.final_state.state_hash);
  const std::string methods = file("whole", "methods.md");
  for (const char* law : {"Phases of the cycle", "Quiescence", "Arrest by contact", "Arrest under pressure"})
    EXPECT_THAT(methods, HasSubstr(law));
}

/// Two shells under a load, which is their pressure.
std::string pressed(const std::string& load) {
  return R"(schema: 1
study: pressed
time: {end: 2 h, output: 10 min, checkpoint: 1 h}
domain: {size: [150 um, 150 um, 150 um]}
cell_types:
  a: {radius: 6 um, body: shell, dcm: {nodes: 42, cortex: {elastic: none, tension: 0.1 mN/m}}, cycle: {duration: 10 h, arrest: {pressure: {from: 100 Pa, to: 200 Pa}}},
      inhibit_growth: {pressure_above: never}}
initial:
  - {type: a, at: [[0 um, 0 um, 20 um], [0 um, 0 um, -20 um]], age: birth}
loads:
  press: {type: a, pressure: {value: )" +
         load + R"(}}
output: {report: false}
)";
}

TEST_F(CycleRun, StopsGrowthAtThePressureOfItsArrest) {
  // V_t = V_b (1 + g t/10 h); the load compresses each cell by the same part of it all the time. 1 % of free growth from 30 min to 2 h is 0.0015.
  for (const auto& [load, factor] : {std::pair("202 Pa", 0.0), {"198 Pa", 0.02}, {"150 Pa", 0.5}, {"90 Pa", 1.0}}) {
    run_whole(pressed(load), load);
    const auto volume = column(load, "total_volume");
    EXPECT_NEAR(volume[12] / volume[3], (1.0 + 0.2 * factor) / (1.0 + 0.05 * factor), 0.0015) << load;
  }
}

}  // namespace
}  // namespace morula::scenarios::test
