// The cycle of a cell type as a study gives it.
#include <gmock/gmock.h>

#include "study/catalogue.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string with_cycle(const std::string& cycle, const std::string& more = "") {
  return R"(schema: 1
study: cycle
time: {end: 1 h, output: 1 h, checkpoint: 1 h}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  a: {radius: 6 um, cycle: {)" +
         cycle + "}" + more + R"(}
initial:
  - {type: a, at: [[0 um, 0 um, 0 um]], age: birth}
)";
}

std::string errors(const std::string& cycle, const std::string& more = "") {
  const auto study = read(with_cycle(cycle, more));
  return study.ok() ? std::string() : study.error().text();
}

TEST(GrowthKeys, ChooseALawAndItsNumbers) {
  const auto study = read(with_cycle("growth: logistic, limit: 1.25"));
  ASSERT_TRUE(study.ok()) << study.error().text();
  const CellCycle& cycle = study->model.types[0].cycle;
  EXPECT_EQ(cycle.growth->word, "logistic");
  EXPECT_EQ(cycle.growth_values("limit"), 1.25);
  EXPECT_THAT(errors("growth: linear, limit: 1.25"), HasSubstr("it belongs to `growth: logistic` or `growth: relaxing`"));
  EXPECT_THAT(errors("growth: logistic, limit: 1"), HasSubstr("[E302]"));
  EXPECT_THAT(errors("growth: quadratic"), HasSubstr("logistic"));
  EXPECT_THAT(errors("growth: none"), HasSubstr("[E700]"));
}

/// Gompertz: dV/dt = r V ln(V_∞/V), in a program of one's own.
std::shared_ptr<const GrowthLaw> gompertz() {
  return std::make_shared<const GrowthLaw>(GrowthLaw{
      .info = {.name = "gompertz", .title = "Gompertz", .equation = "dV/dt = r V ln(V_∞/V)", .source = "a test", .parameters = {}},
      .word = "gompertz",
      .doc = "ever more slowly",
      .own = {{.name = "plateau", .doc = "V_∞/V_d.", .fallback = "2", .low = 1.0, .low_open = true, .example = "2", .source = "a test"}},
      .at = [](const GrowthPace& p, const LawValues&, double) { return p.from; },
      .after = [](const GrowthPace&, const LawValues&, double volume, double) { return volume; },
      .time_to = [](const GrowthPace&, const LawValues&, double, double) { return 1.0; }});
}

TEST(GrowthKeys, KnowTheLawsOfTheProgram) {
  Laws laws = *builtin_laws();
  laws.growth.push_back(gompertz());
  ReadOptions options;
  options.laws = std::make_shared<const Laws>(laws);
  const auto study = read(with_cycle("growth: gompertz, plateau: 3"), options);
  ASSERT_TRUE(study.ok()) << study.error().text();
  EXPECT_EQ(study->model.types[0].cycle.growth_values("plateau"), 3.0);
  EXPECT_THAT(explain_study("cycle.growth", *options.laws).value_or(""), HasSubstr("gompertz: ever more slowly"));
  EXPECT_FALSE(read(with_cycle("growth: gompertz")).ok());
}

TEST(PhaseKeys, AreAListInTheirOrder) {
  const auto study =
      read(with_cycle("model: phases, phases: {first: 3 h, second: {duration: 2 h, law: erlang, stages: 4}, third: {duration: 1 h, "
                      "law: gaussian, spread: 20 %, grows: false}}"));
  ASSERT_TRUE(study.ok()) << study.error().text();
  const CellType& type = study->model.types[0];
  ASSERT_EQ(type.cycle.phases.size(), 3u);
  EXPECT_EQ(type.cycle.phases[0].name, "first");
  EXPECT_EQ(type.cycle.phases[0].time.mean, 3 * 3600.0);
  EXPECT_EQ(type.cycle.phases[1].length, CyclePhase::Length::kErlang);
  EXPECT_EQ(type.cycle.phases[1].stages, 4u);
  EXPECT_FALSE(type.cycle.phases[2].grows);
  EXPECT_EQ(type.cycle.phases[2].time.relative_spread, 0.2);
  EXPECT_EQ(type.cycle_duration.mean, 6 * 3600.0) << "for those who ask how long a cycle is";
}

TEST(PhaseKeys, HaveTheUsualFourWithoutAList) {
  const auto study = read(with_cycle("model: phases, duration: 36 h"));
  ASSERT_TRUE(study.ok()) << study.error().text();
  const auto& phases = study->model.types[0].cycle.phases;
  ASSERT_EQ(phases.size(), 4u);
  EXPECT_EQ(phases[3].name, "M");
  EXPECT_DOUBLE_EQ(phases[0].time.mean, 7.0 / 18.0);
}

TEST(PhaseKeys, AreChecked) {
  const std::string phases = "model: phases, phases: ";
  EXPECT_THAT(errors(phases + "{G1: 0 h}"), HasSubstr("[E302]"));
  EXPECT_THAT(errors(phases + "{G1: {law: erlang, stages: 3}}"), HasSubstr("needs `duration` [E516]"));
  EXPECT_THAT(errors(phases + "{G1: {duration: 1 h, law: erlang}}"), HasSubstr("`erlang` needs `stages` [E516]"));
  EXPECT_THAT(errors(phases + "{G1: {duration: 1 h, law: gaussian}}"), HasSubstr("`gaussian` needs `spread` [E516]"));
  EXPECT_THAT(errors(phases + "{G1: {duration: 1 h, stages: 3}}"), HasSubstr("it belongs to `law: erlang`"));
  EXPECT_THAT(errors(phases + "{G1: {duration: 1 h, law: poisson}}"), HasSubstr("erlang"));
  EXPECT_THAT(errors(phases + "{G1: {duration: 1 h, until: size}}"), HasSubstr("[E515]"));
  EXPECT_THAT(errors(phases + "{G1: {until: size}, S: 1 h}"), HasSubstr("[E702]"));
  EXPECT_THAT(
      errors(phases + "{G1: {until: size, law: erlang, stages: 3}}"),
      AllOf(HasSubstr("'stages' has no effect here"), HasSubstr("'law' has no effect here"), HasSubstr("ends by size has no duration")));
  EXPECT_EQ(errors(phases + "{G1: {until: size}, S: {duration: 1 h, grows: false}}"), "");
  EXPECT_THAT(errors(phases + "{G1: {duration: 1 h, grows: false}}"), HasSubstr("grow in no phase [E700]"));
  EXPECT_EQ(errors(phases + "{G1: {duration: 1 h, grows: false}}, growth: none"), "");
  EXPECT_THAT(errors(phases + "{G0: 1 h}"), HasSubstr("[E112]"));
  EXPECT_THAT(errors(phases + "{G1: 1 h}, duration: 20 h"), HasSubstr("'duration' has no effect here"));
  EXPECT_THAT(errors("phases: {G1: 1 h}"), HasSubstr("they belong to `model: phases`"));
}

TEST(SizeKeys, AreTheVolumesOfTheirControl) {
  const double birth = 4.0 / 3.0 * 3.14159265358979 * 216.0;
  const auto sizer = read(with_cycle("size: sizer, ratio: 2.5")),
             adder = read(with_cycle("size: {control: adder, spread: 10 %}, ratio: 2.5"));
  ASSERT_TRUE(sizer.ok() && adder.ok());
  EXPECT_NEAR(sizer->model.types[0].cycle.size, 2.5 * birth, 1e-9);
  EXPECT_NEAR(adder->model.types[0].cycle.size, 1.5 * birth, 1e-9);
  EXPECT_EQ(adder->model.types[0].cycle.size_spread, 0.1);
  EXPECT_THAT(errors("ratio: 1"), HasSubstr("[E302]"));
  EXPECT_THAT(errors("size: {control: sizer, volume: 800 um^3}"), HasSubstr("[E701]"));
  EXPECT_EQ(errors("size: {control: sizer, volume: 1800 um^3}"), "");
  EXPECT_THAT(errors("size: {volume: 1800 um^3}"), HasSubstr("[E515]"));
  EXPECT_THAT(errors("size: sizer, model: phases"), HasSubstr("no phase of 'a' ends by size"));
}

std::string warnings(const std::string& cycle) { return warnings_of(with_cycle(cycle)); }

TEST(CycleKeys, ThatNeedGrowthAreToldWithoutIt) {
  const std::string still = "model: phases, growth: none, phases: {G1: {duration: 1 h}}";
  EXPECT_THAT(warnings(still + ", ratio: 3"), HasSubstr("'ratio' has no effect here"));
  EXPECT_THAT(warnings(still + ", arrest: {volume: {from: 95 %, to: 85 %}}"), HasSubstr("'arrest' has no effect here"));
  EXPECT_EQ(warnings(still), "");
  EXPECT_THAT(warnings("model: none, growth: exponential, size: adder"),
              AllOf(HasSubstr("'growth' has no effect here: cells of 'a' rest"), HasSubstr("'size' has no effect here")));
  EXPECT_EQ(warnings("model: none"), "");
  EXPECT_THAT(warnings("model: none, arrest: {volume: {from: 95 %, to: 85 %}}"),
              HasSubstr("'arrest' has no effect here: cells of 'a' rest"));
}

TEST(PhaseKeys, AnArrestOfAPhaseThatEndsBySizeIsToldUnlessItLeadsToG0) {
  const std::string held = "model: phases, phases: {A: {until: size, arrest: {volume: {from: 95 %, to: 85 %}}}}";
  EXPECT_THAT(warnings(held), HasSubstr("'arrest' of phase 'A' has no effect here: the phase ends by size"));
  EXPECT_EQ(warnings(held + ", quiescence: {phase: A, below: 20 %, above: 80 %}"), "");
}

TEST(ArrestKeys, AreChecked) {
  const std::string never = ", inhibit_growth: {pressure_above: never}";
  EXPECT_EQ(
      errors("arrest: {pressure: {from: 200 Pa, to: 800 Pa}, volume: {from: 95 %, to: 85 %}, contact: {from: 50 %, to: 90 %}}", never), "");
  EXPECT_THAT(errors("arrest: {pressure: {from: 800 Pa, to: 200 Pa}}", never), HasSubstr("[E510]"));
  EXPECT_THAT(errors("arrest: {pressure: {from: 800 Pa, to: 800 Pa}}", never), HasSubstr("[E510]"));
  EXPECT_THAT(errors("arrest: {pressure: {from: 800 Pa}}", never), HasSubstr("key 'to' is missing"));
  EXPECT_THAT(errors("arrest: {volume: {from: 80 %, to: 90 %}}"), HasSubstr("[E510]"));
  EXPECT_THAT(errors("arrest: {contact: {from: 80 %, to: 70 %}}"), HasSubstr("[E510]"));
  EXPECT_THAT(errors("arrest: {field: {field: oxygen, half: 1 mM}}"), HasSubstr("[E402]"));
  EXPECT_THAT(errors("arrest: {presure: {from: 1 Pa, to: 2 Pa}}"), HasSubstr("pressure"));
  EXPECT_THAT(errors("arrest: {pressure: {from: 1 kPa, to: 2 kPa}}"), HasSubstr("stops at 1 kPa already"));
}

TEST(QuiescenceKeys, AreChecked) {
  const std::string phases =
      "model: phases, phases: {G1: {duration: 3 h, arrest: {contact: {from: 50 %, to: 90 %}}}, S: 1 h}, quiescence: ";
  EXPECT_EQ(errors(phases + "{phase: G1}"), "");
  EXPECT_THAT(errors(phases + "{phase: G2}"), HasSubstr("there is no phase 'G2'"));
  EXPECT_THAT(errors(phases + "{phase: S}"), HasSubstr("nothing holds phase 'S' back"));
  EXPECT_THAT(errors(phases + "{phase: G1, below: 60 %}"), HasSubstr("[E510]"));
  EXPECT_THAT(errors("quiescence: {phase: G1}"), HasSubstr("it belongs to `model: phases`"));
}

}  // namespace
}  // namespace morula::scenarios::test
