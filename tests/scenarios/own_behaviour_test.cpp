// Behaviours that a program adds: their keys are part of the study, they act in every step, and what they remember is part of the state.
#include "tests/scenarios/own_parts.h"
#include "tests/scenarios/pressed_cells.h"

namespace morula::scenarios::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class OwnBehaviours : public OwnParts {
 protected:
  OwnBehaviours() : OwnParts(&add_pressed_cells) {}
};

TEST_F(OwnBehaviours, ActOnTheCellsThatTheyAreAbout) {
  run_whole(two_types(kDeath), "dead");
  EXPECT_EQ(column("dead", "deaths").back(), 3.0);
  const std::string events = file("dead", "events.jsonl");
  EXPECT_THAT(events, HasSubstr("Death under pressure"));
  const std::string methods = file("dead", "methods.md");
  EXPECT_THAT(methods, HasSubstr("Death under pressure"));
  EXPECT_THAT(methods, Not(HasSubstr("lack of a concentration")));
  EXPECT_THAT(file("dead", "study.resolved.yaml"), HasSubstr("pressure_rate: 60 1/h"));
}

TEST_F(OwnBehaviours, HaveTheSameBitsOnTwoThreadsAndAfterARestart) {
  const std::string text = two_types(kDeath + ", " + kTired);
  const RunSummary whole = run_whole(text, "whole");
  EXPECT_FALSE(whole.final_state.state_hash.empty());
  EXPECT_EQ(run_whole(text, "threads", 2).final_state.state_hash, whole.final_state.state_hash);
  EXPECT_EQ(run_split(text, "split", 300.0).final_state.state_hash, whole.final_state.state_hash);
  EXPECT_EQ(file("split", "events.jsonl"), file("whole", "events.jsonl"));
  EXPECT_EQ(file("split", "series.csv"), file("whole", "series.csv"));
}

TEST_F(OwnBehaviours, RememberFromStepToStep) {
  run_whole(two_types(kTired), "tired");
  const auto pressed = column("tired", "pressed");  // three of five cells
  EXPECT_NEAR(pressed[1] * 5.0 / 3.0, 300.0, 10.0);
  EXPECT_NEAR(pressed[2] * 5.0 / 3.0, 600.0, 10.0);
  run_whole(two_types(kTired), "same");
  EXPECT_EQ(file("same", "series.csv"), file("tired", "series.csv"));
  // Two minutes of growth for those that are pressed, ten for the others: V(t) = V_b (1 + t/10 h).
  const double ball = 4.0 / 3.0 * 3.14159265358979 * 216.0, hours = 3.0 * 2.0 / 60.0 + 2.0 * 10.0 / 60.0;
  run_whole(two_types("death: {pressure_above: 90 kPa, pressure_rate: 0 1/h}"), "grown");
  const auto tired = column("tired", "total_volume"), grown = column("grown", "total_volume");
  EXPECT_NEAR(grown[2] - tired[2], ball * (5.0 * 10.0 / 60.0 - hours) / 10.0, 0.15 * ball / 10.0);
}

TEST_F(OwnBehaviours, AreCheckedAndExplained) {
  const auto errors = [&](const std::string& own) {
    const auto study = read(two_types(own), options());
    return study.ok() ? std::string() : study.error().text();
  };
  EXPECT_EQ(errors(kDeath), "");
  EXPECT_THAT(errors("death: {shrink_time: 20 min}"), HasSubstr("`death` needs `field`, `below`, `rate`"));
  EXPECT_THAT(errors("death: {pressure_above: -1 kPa}"), HasSubstr("[E302]"));
  EXPECT_THAT(errors("death: {pressure_above: 1 s}"), HasSubstr("[E203]"));
  EXPECT_THAT(errors("death: {pressure_above: 100 kPa}"), HasSubstr("no cell bears 100 kPa [E510]"));
  EXPECT_THAT(errors("death: {pressure_above: 1 kPa, rate: 1 1/h}"), HasSubstr("`death` needs `field`, `below` [E103]"));
  EXPECT_THAT(errors("exhaustion: {}"), HasSubstr("key 'above' is missing"));
  EXPECT_FALSE(read(two_types(kDeath)).ok()) << "the program that has it not does not know it";
  EXPECT_THAT(explain("death.pressure_rate"), HasSubstr("default:  60 1/h"));
  EXPECT_THAT(explain("exhaustion"), HasSubstr("Cells tire under pressure."));
}

}  // namespace
}  // namespace morula::scenarios::test
