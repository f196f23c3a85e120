// Cell cycles in runs of studies: rates, phases and sizes as a user reads them from the results. Numbers: physics/cbm.md §5.
#include "tests/scenarios/own_parts.h"

namespace morula::scenarios::test {
namespace {

using testing::HasSubstr;

class CycleRun : public OwnParts {
 protected:
  CycleRun() : OwnParts([](Laws&) {}) {}
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

/// A cell that inflates at the start divides when its cycle says, whatever its law of growth.
TEST_F(CycleRun, LastsAsLongWhileACellInflates) {
  for (const std::string& growth : {std::string("linear"), std::string("exponential"), std::string("logistic, limit: 3"),
                                    std::string("relaxing, limit: 1.1"), std::string("exponential, model: phases")}) {
    const std::string name = growth.substr(0, growth.find(',')) + std::to_string(growth.size());
    run_whole(R"(schema: 1
study: inflated
time: {end: 2.2 h, output: 1 min, step: 10 s}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  a: {cycle: {duration: 2 h, growth: )" +
                  growth + R"(}, inhibit_growth: {pressure_above: never}}
initial:
  - {type: a, at: [[0 um, 0 um, 0 um]], age: birth, start_volume: 50 %, inflate: 30 min}
output: {report: false}
)",
              name);
    const std::vector<double> cells = column(name, "cell_count"), times = column(name, "time");
    const auto divided = std::ranges::find(cells, 2.0);
    ASSERT_NE(divided, cells.end()) << growth;
    EXPECT_NEAR(times[static_cast<std::size_t>(divided - cells.begin())], 7200.0, 90.0) << growth;
  }
}

}  // namespace
}  // namespace morula::scenarios::test
