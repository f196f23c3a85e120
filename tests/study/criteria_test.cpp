// Criteria and plots that a study declares: what `check` says of them.
#include <gmock/gmock.h>

#include <algorithm>

#include "coupling/observables/observable.h"
#include "scenarios/criteria/understand.h"
#include "scenarios/measures/measures.h"
#include "study/catalogue.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// Two cells that touch, one of which a grip pulls, and one on a plane; CRITERIA and PLOTS are put in.
constexpr const char* kPulled = R"(schema: 1
study: pulled
time: {end: 1 h, output: 10 min}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  left: {radius: 6 um, adhesion: {left: 0 J/m^2, right: 0.1 mJ/m^2, glass: 0.05 mJ/m^2}, dcm: {nodes: 162, cortex: {tension: 0.1 mN/m}}}
  right: {radius: 6 um, adhesion: {right: 0 J/m^2, glass: 0 J/m^2}, dcm: {nodes: 162, cortex: {tension: 0.1 mN/m}}}
contact: {range: 0.5 um}
geometry:
  glass: {plane: {center: [0 um, 0 um, -20 um], normal: [0, 0, 1], size: 20 um}}
initial:
  - {type: left, at: [[0 um, 0 um, -6 um]], as: shell, orientation: aligned}
  - {type: right, at: [[0 um, 0 um, 6 um]], as: shell, orientation: aligned}
loads:
  pull: {type: right, grip: {axis: [0, 0, 1], part: 20 %, ends: high, stiffness: 10 mN/m, center: [0 um, 0 um, 6 um], direction: [0, 0, 1],
         way: [{time: 0 s, distance: 0 um}, {time: 30 min, distance: 3 um}]}}
  push: {type: left, body_force: [0 nN, 0 nN, 1 pN]}
fields:
  oxygen: {diffusion: 2e-9 m^2/s, initial: 0.2 mM, boundary: {all: 0.2 mM}}
output: {series: [cell_count]}
CRITERIA)";

ReadOptions with_criteria() {
  ReadOptions options;
  options.check_criteria = &check_criteria;
  return options;
}

std::string study_with(const std::string& what) { return changed("CRITERIA", what, kPulled); }
std::string criterion(const std::string& what) { return study_with("criteria:\n  - {id: A.1, " + what + "}\n"); }

/// The only message of a study with this criterion.
std::string message_of(const std::string& what, const Folder* folder = nullptr) {
  const auto study = read(criterion(what), with_criteria(), folder != nullptr ? folder->path() : ".");
  EXPECT_FALSE(study.ok()) << what;
  if (study.ok()) return "";
  EXPECT_EQ(study.error().error_count(), 1u) << study.error().text();
  for (const Diagnostic& d : study.error().list()) EXPECT_GT(d.place.line, 20) << d.text;  // where the criterion is
  return study.error().text();
}

TEST(Criteria, OfEveryKindAreRead) {
  const Folder folder;
  folder.write("data.csv", "time [min],way [um],force [pN]\n0,0,1\n30,1,\n60,3,5\n");
  const auto study = read(study_with(R"(criteria:
  - {id: A, measure: cap.angle, of: {pair: [left, right]}, against: youngs_law, within: 4 deg}
  - {id: A, measure: cap.angle, of: {type: left, obstacle: glass}, against: youngs_law, within: 5 %}
  - {id: B, measure: volume, of: [left, right], at: every, between: [800 um^3, 1000 um^3]}
  - {id: C, measure: force(pull), from: 10 min, until: 30 min, over_time: max, against: jkr_pull_off, within: 50 %}
  - {id: D, measure: force(pull), against: {data: data.csv, y: force, source: a test}, within: 1 nN}
  - {id: E, measure: energy, over_time: slope, at: every, below: 0 fJ/h}
  - {id: F, measure: contact_area(left), above: contact_area(right)}
  - {id: G, measure: concentration, of: {type: left, field: oxygen}, at: 30 min, above: 0.1 mM}
  - {id: H, measure: volume, of: {cell: all}, over_cells: sum, against: 1810 um^3, within: 2 %}
  - {id: I, measure: cell_count, below: 2}
  - {id: J, measure: volume(left), over: {measure: volume(right)}, between: [0.9, 1.1]}
  - {id: K, measure: force(pull), over: jkr_pull_off, at: holds, until: 50 min, over_time: rising, above: 1}
  - {id: L, measure: force, of: {load: [pull, push], together: true}, at: holds(pull), along: way(pull), curve: r_squared, above: 0.9}
  - {id: M, measure: force(pull), along: way, curve: rms, against: {data: data.csv, x: way, y: force}, at: every, within: 1 nN}
plots:
  - {x: way(pull), y: force(pull), against: {theory: jkr_pull_off}}
  - {name: volumes, y: [volume(left), volume(right)], title: Volumes}
)"),
                          with_criteria(), folder.path());
  ASSERT_TRUE(study.ok()) << study.error().text();
  ASSERT_EQ(study->criteria.size(), 14u);
  Diagnostics none;
  const auto angle = understand(*study, study->criteria[0], none);
  ASSERT_TRUE(angle) << none.text();
  EXPECT_EQ(angle->expected.theory->name, "youngs_law");
  EXPECT_NEAR(angle->limit.high.internal, 4.0 * 3.14159265358979 / 180.0, 1e-12);
  const auto slope = understand(*study, study->criteria[5], none);
  ASSERT_TRUE(slope) << none.text();
  EXPECT_NEAR(slope->limit.high.factor, 1.0 / 3600.0, 1e-12);
  EXPECT_EQ(understand(*study, study->criteria[2], none)->question.measured.subjects.size(), 2u);
  const auto quotient = understand(*study, study->criteria[10], none);
  ASSERT_TRUE(quotient) << none.text();
  EXPECT_EQ(quotient->question.over.measure->text, "volume(right)");
  const auto line = understand(*study, study->criteria[12], none);
  ASSERT_TRUE(line) << none.text();
  EXPECT_TRUE(line->question.together);
  EXPECT_EQ(line->question.moments.moments.course.time.size(), 2u);  // the way of the grip
  const auto rms = understand(*study, study->criteria[13], none);
  ASSERT_TRUE(rms) << none.text();
  EXPECT_EQ(rms->expected.xs, (std::vector<double>{0.0, 3.0}));  // a row without a value is left out
  EXPECT_EQ(understand(*study, study->plots[0], none)->name, "force_pull_over_way_pull");
  // What a run writes holds what is judged and shown, though `output.series` names other columns.
  EXPECT_THAT(series_columns(*study), testing::IsSupersetOf({"energy", "grip_x_pull", "grip_y_pull", "grip_z_pull", "cell_count"}));
  // The resolved study says the same.
  folder.write("inputs/data.csv", "time [min],way [um],force [pN]\n0,0,1\n30,1,\n60,3,5\n");
  const auto again = read(study->resolved_text, with_criteria(), folder.path());
  ASSERT_TRUE(again.ok()) << again.error().text() << study->resolved_text;
  EXPECT_EQ(again->criteria.size(), 14u);
  EXPECT_EQ(again->criteria[0].against.theory.value, "youngs_law");
  EXPECT_EQ(again->plots[1].title.value, "Volumes");
}

TEST(Criteria, OfUnknownMeasuresTheoriesAndThingsAreRefusedWithSuggestions) {
  EXPECT_THAT(message_of("measure: cap.angel, of: {pair: [left, right]}, above: 3 deg"),
              AllOf(HasSubstr("there is no measure 'cap.angel'"), HasSubstr("did you mean `cap.angle`?"), HasSubstr("E410")));
  EXPECT_THAT(message_of("measure: cell_cuont, above: 3"), AllOf(HasSubstr("did you mean `cell_count`?"), HasSubstr("E410")));
  EXPECT_THAT(message_of("measure: 'volume(left', above: 3 um^3"), HasSubstr("E410"));
  EXPECT_THAT(message_of("measure: cap.angle, of: {pair: [left, right]}, against: young_law, within: 3 deg"),
              AllOf(HasSubstr("there is no theory 'young_law'"), HasSubstr("`youngs_law`"), HasSubstr("E411")));
  EXPECT_THAT(message_of("measure: volume, of: {type: lefft}, above: 3 um^3"),
              AllOf(HasSubstr("there is no cell type 'lefft'"), HasSubstr("`left`"), HasSubstr("E401")));
  EXPECT_THAT(message_of("measure: volume(lefft), above: 3 um^3"), HasSubstr("E401"));
  EXPECT_THAT(message_of("measure: cap.angle, of: {type: left, obstacle: gless}, above: 3 deg"), HasSubstr("E401"));
  EXPECT_THAT(message_of("measure: force(pul), above: 3 nN"), AllOf(HasSubstr("there is no load 'pul'"), HasSubstr("`pull`")));
  EXPECT_THAT(message_of("measure: concentration, of: {type: left, field: oxigen}, above: 3 mM"), HasSubstr("E402"));
}

TEST(Criteria, AreTakenOfWhatTheMeasureIsTakenOf) {
  EXPECT_THAT(message_of("measure: volume, above: 3 um^3"), AllOf(HasSubstr("of what?"), HasSubstr("{type: left}"), HasSubstr("E412")));
  EXPECT_THAT(message_of("measure: volume, of: {load: pull}, above: 3 um^3"),
              AllOf(HasSubstr("is not taken of a load"), HasSubstr("E412")));
  EXPECT_THAT(message_of("measure: energy, of: {type: left}, above: 3 fJ"), HasSubstr("leave `of` away"));
  EXPECT_THAT(message_of("measure: energy(left), above: 3 fJ"), HasSubstr("E412"));
  EXPECT_THAT(message_of("measure: volume(left), of: {type: left}, above: 3 um^3"),
              AllOf(HasSubstr("says it once more"), HasSubstr("E412")));
  EXPECT_THAT(message_of("measure: cap.angle, of: {pair: [left]}, above: 3 deg"), HasSubstr("needs 2"));
  const auto idle =
      read(changed("  right: {radius", "  idle: {radius: 6 um}\n  right: {radius", criterion("measure: volume(idle), above: 3 um^3")),
           with_criteria());
  ASSERT_TRUE(idle.ok()) << idle.error().text();
  EXPECT_THAT(idle->warnings.text(), AllOf(HasSubstr("no cell is ever of type 'idle': there is nothing to measure"), HasSubstr("[E412]")));
  const auto spheres = read(changed(", as: shell, orientation: aligned}\n  - {type: right", "}\n  - {type: right",
                                    criterion("measure: least_angle(left), above: 15 deg")),
                            with_criteria());
  ASSERT_FALSE(spheres.ok());
  EXPECT_THAT(spheres.error().text(),
              AllOf(HasSubstr("'least_angle' of left needs shells, and these cells are always spheres"), HasSubstr("E412")));
  EXPECT_THAT(message_of("measure: way(push), above: 3 um"), HasSubstr("needs a grip with a `way`"));
  const std::string drift = criterion("measure: motion.beyond_drift(left), below: 3 um");
  EXPECT_TRUE(read(drift, with_criteria()).ok());
  const auto between = read(changed("output: 10 min", "output: 15 min", drift), with_criteria());
  ASSERT_FALSE(between.ok());
  EXPECT_THAT(between.error().text(), HasSubstr("needs outputs 20 min before and after one"));
  EXPECT_THAT(message_of("measure: volume, of: {tipe: left}, above: 3 um^3"), AllOf(HasSubstr("unknown key 'tipe'"), HasSubstr("E101")));
}

TEST(Criteria, HaveOneLimitInTheUnitOfTheMeasure) {
  EXPECT_THAT(message_of("measure: volume(left)"), AllOf(HasSubstr("has no limit"), HasSubstr("E414")));
  EXPECT_THAT(message_of("measure: volume(left), above: 3 um^3, below: 9 um^3"), HasSubstr("more than one limit"));
  EXPECT_THAT(message_of("measure: volume(left), within: 3 um^3"), HasSubstr("`within` without `against`"));
  EXPECT_THAT(message_of("measure: volume(left), against: 3 um^3"), HasSubstr("`against` without `within`"));
  EXPECT_THAT(message_of("measure: volume(left), against: {value: 3 um^3, measure: volume(right)}, within: 3 %"),
              HasSubstr("several things"));
  EXPECT_THAT(message_of("measure: volume(left), above: 3 um"), AllOf(HasSubstr("is a volume"), HasSubstr("E203")));
  EXPECT_THAT(message_of("measure: volume(left), above: 3"), HasSubstr("E201"));
  EXPECT_THAT(message_of("measure: cell_count, above: 3 um"), HasSubstr("E205"));
  EXPECT_THAT(message_of("measure: volume(left), against: 3 um^3, within: 3 nN"), HasSubstr("E203"));
  EXPECT_THAT(message_of("measure: volume(left), at: every, over_time: slope, above: 3 um^3"), HasSubstr("per time"));
  EXPECT_THAT(message_of("measure: volume(left), above: area(left)"), AllOf(HasSubstr("is an area"), HasSubstr("E203")));
  EXPECT_THAT(message_of("measure: volume(left), between: [3 um^3]"), HasSubstr("E303"));
  EXPECT_THAT(message_of("measure: volume(left), between: [3 um^3, 2 um^3]"), HasSubstr("E414"));
  EXPECT_THAT(message_of("measure: volume(left), against: 3 um^3, within: -5 %"), AllOf(HasSubstr("'within' is -5 %"), HasSubstr("E414")));
  EXPECT_THAT(message_of("measure: volume(left), over: 5, above: 1"), HasSubstr("'over' is a volume"));
  EXPECT_THAT(message_of("measure: volume.change(left), against: 0, within: 2 %"), AllOf(HasSubstr("could not hold"), HasSubstr("E414")));
  EXPECT_THAT(message_of("measure: volume(left), against: 3 um^3, within: volume(right)"),
              AllOf(HasSubstr("with `curve: rms` only"), HasSubstr("E414")));
  EXPECT_THAT(message_of("above: 3 um^3"), AllOf(HasSubstr("measure"), HasSubstr("E103")));
}

TEST(Criteria, AreHeldAgainstTheoriesThatFit) {
  EXPECT_THAT(message_of("measure: volume(left), against: youngs_law, within: 3 %"),
              AllOf(HasSubstr("'youngs_law' says nothing about 'volume'"), HasSubstr("it predicts cap.angle"), HasSubstr("E413")));
  EXPECT_THAT(message_of("measure: cap.contact_radius, of: {pair: [left, right]}, against: elastic_cap, within: 3 %"),
              AllOf(HasSubstr("'elastic_cap' knows cells of 642 nodes and more whose E h is twice the tension"), HasSubstr("E413")));
  EXPECT_THAT(message_of("measure: cell_count, against: exponential_growth, within: 3 %"), HasSubstr("with a cycle"));
  const auto warnings = [](const char* cortex) {
    const auto study = read(changed("dcm: {nodes: 162, cortex: {tension: 0.1 mN/m}}",
                                    std::string("dcm: {nodes: 162, cortex: {tension: 0.1 mN/m, ") + cortex + "}}",
                                    criterion("measure: cap.angle, of: {pair: [left, right]}, against: youngs_law, within: 4 deg")),
                            with_criteria());
    return study.ok() ? study->warnings.text() : study.error().text();
  };
  EXPECT_THAT(warnings("elastic: springs, young: 1 kPa"),
              AllOf(HasSubstr("'youngs_law' knows a surface tension alone"), HasSubstr("is 2 times the tension"), HasSubstr("[E413]")));
  EXPECT_THAT(warnings("elastic: none"), testing::Not(HasSubstr("E413")));
}

TEST(Criteria, OfPopulationsThatGrowExponentiallyNeedCellsThatAllDivide) {
  const auto errors_with = [](const char* keys) {
    const auto study = read(std::string("schema: 1\nstudy: growing\ntime: {end: 1 h}\ndomain: {size: [100 um, 100 um, 100 um]}\n"
                                        "fields: {oxygen: {diffusion: 2e-9 m^2/s, initial: 0.2 mM, uptake: {a: {rate: 1 amol/s}}}}\n"
                                        "cell_types: {a: {radius: 5 um, cycle: {duration: 18 h") +
                                keys + "}, b: {radius: 5 um, cycle: {model: none}}}\ninitial: [{type: a, at: [[0 um, 0 um, 0 um]]}]\n" +
                                "criteria: [{id: A, measure: count_a, against: exponential_growth, within: 3 %}]\n",
                            with_criteria());
    return study.ok() ? std::string() : study.error().text();
  };
  EXPECT_EQ(errors_with("}"), "");
  EXPECT_THAT(errors_with("}, death: {field: oxygen, below: 0.05 mM, rate: 0.1 1/h}"),
              AllOf(HasSubstr("needs cells that do not die"), HasSubstr("E413")));
  EXPECT_THAT(errors_with(", arrest: {pressure: {from: 100 Pa, to: 200 Pa}}}"), AllOf(HasSubstr("leave `arrest` away"), HasSubstr("E413")));
  EXPECT_THAT(errors_with(", daughters: {fates: [{types: [a, b], share: 50 %}]}}"),
              AllOf(HasSubstr("leave `fates` away"), HasSubstr("E413")));
}

/// Cells whose volume does not double from division to division: their number still grows as the theory has it.
TEST(Criteria, OfVolumesThatGrowExponentiallyNeedCellsThatDoubleTheirs) {
  const auto errors_with = [](const char* cycle, const char* measure) {
    const auto study = read(std::string("schema: 1\nstudy: growing\ntime: {end: 1 h}\ndomain: {size: [100 um, 100 um, 100 um]}\n"
                                        "cell_types: {a: {radius: 5 um, cycle: {duration: 18 h") +
                                cycle + "}}}\ninitial: [{type: a, at: [[0 um, 0 um, 0 um]]}]\ncriteria: [{id: A, measure: " + measure +
                                ", against: exponential_growth, within: 3 %}]\n",
                            with_criteria());
    return study.ok() ? std::string() : study.error().text();
  };
  EXPECT_EQ(errors_with("", "total_volume"), "");
  for (const char* cycle : {", model: phases, growth: none", ", ratio: 3"}) {
    EXPECT_EQ(errors_with(cycle, "cell_count"), "") << cycle;
    EXPECT_THAT(errors_with(cycle, "total_volume"), AllOf(HasSubstr("cells that double it"), HasSubstr("E413"))) << cycle;
  }
}

TEST(Criteria, AreDividedByWhatHasTheirDimension) {
  EXPECT_THAT(message_of("measure: volume(left), over: {measure: area(left)}, above: 3"),
              AllOf(HasSubstr("is an area"), HasSubstr("E203")));
  EXPECT_THAT(message_of("measure: volume(left), over: 3 um, above: 3"), HasSubstr("E203"));
  EXPECT_THAT(message_of("measure: volume(left), over: {measure: volume(right)}, above: 3 um^3"), HasSubstr("E205"));
  EXPECT_THAT(message_of("measure: volume(left), over: youngs_law, above: 3"), HasSubstr("E413"));
  EXPECT_THAT(message_of("measure: volume(left), above: 'volume(left, right)'"), AllOf(HasSubstr("of several things"), HasSubstr("E412")));
}

TEST(Criteria, AreCurvesOverWhatIsNamed) {
  EXPECT_THAT(message_of("measure: force(pull), curve: r_squared, above: 0.9"), AllOf(HasSubstr("needs `along`"), HasSubstr("E414")));
  EXPECT_THAT(message_of("measure: force(pull), along: wya, curve: r_squared, above: 0.9"), HasSubstr("`way`"));
  EXPECT_THAT(message_of("measure: volume(left), along: way, curve: r_squared, above: 0.9"), HasSubstr("E412"));
  EXPECT_THAT(message_of("measure: force(pull), along: way, curve: rms, below: 1 nN"), HasSubstr("how near a curve is to data"));
  EXPECT_THAT(message_of("measure: volume(left), along: radius, above: 9 um^3"),
              AllOf(HasSubstr("nothing is read along 'radius'"), HasSubstr("E414")));
  EXPECT_THAT(message_of("measure: force(pull), along: way, curve: r_squared, over_time: mean, above: 0.9"),
              AllOf(HasSubstr("is of all cells and moments"), HasSubstr("E414")));
  EXPECT_THAT(message_of("measure: mean_pressure, over_cells: max, below: 9 Pa"),
              AllOf(HasSubstr("of the run as a whole"), HasSubstr("E414")));
}

TEST(Criteria, AskForOutputsThatTheRunHas) {
  EXPECT_THAT(message_of("measure: volume(left), at: holds, above: 3 um^3"), AllOf(HasSubstr("no load or obstacle"), HasSubstr("E416")));
  EXPECT_THAT(message_of("measure: volume(left), at: holds(pul), above: 3 um^3"), AllOf(HasSubstr("`pull`"), HasSubstr("E412")));
  EXPECT_THAT(message_of("measure: cell_count, at: 7 min, above: 3"),
              AllOf(HasSubstr("the run writes nothing at 7 min"), HasSubstr("E416")));
  EXPECT_THAT(message_of("measure: cell_count, at: 2 h, above: 3"), HasSubstr("E416"));
  EXPECT_THAT(message_of("measure: cell_count, at: 10 um, above: 3"), HasSubstr("E203"));
  EXPECT_THAT(message_of("measure: cell_count, at: end, from: 10 min, above: 3"), HasSubstr("E416"));
  EXPECT_THAT(message_of("measure: cell_count, from: 30 min, until: 10 min, above: 3"), HasSubstr("E416"));
  EXPECT_THAT(message_of("measure: slide.speed(push), above: 1"),
              AllOf(HasSubstr("from the first to the last of several moments"), HasSubstr("E416")));
  EXPECT_THAT(message_of("measure: cell_count, from: 11 min, until: 14 min, above: 3"),
              AllOf(HasSubstr("writes nothing from 11 min to 14 min"), HasSubstr("E416")));
}

TEST(Criteria, OfACourseAskForSeveralMoments) {
  for (const char* word : {"slope", "rise", "left", "falling"})
    EXPECT_THAT(message_of("measure: cell_count, over_time: " + std::string(word) + ", above: 0"),
                AllOf(HasSubstr("finds nothing at one moment alone"), HasSubstr("E515")));
  EXPECT_TRUE(read(criterion("measure: cell_count, at: every, over_time: rise, above: 0"), with_criteria()).ok());
  EXPECT_TRUE(read(criterion("measure: cell_count, over_time: max, above: 0"), with_criteria()).ok());
}

TEST(Criteria, AskEachQuestionOnce) {
  for (const char* twice : {"criteria:\n  - {id: A, measure: cell_count, above: 3}\n  - {id: A, measure: cell_count, above: 4}\n",
                            "criteria:\n  - {id: A, measure: volume(left), over: {measure: volume(right)}, above: 3}\n"
                            "  - {id: A, measure: volume(left), over: {measure: volume(right)}, above: 4}\n"}) {
    EXPECT_THAT(errors_of(study_with(twice), with_criteria()), AllOf(HasSubstr("stands twice"), HasSubstr("E415"))) << twice;
  }
  EXPECT_TRUE(
      read(study_with("criteria:\n  - {id: A, measure: volume(left), above: 3 um^3}\n  - {id: A, measure: volume(right), above: 3 um^3}\n"),
           with_criteria())
          .ok());
}

TEST(Criteria, ReadDataThatCanBeCompared) {
  const Folder folder;
  folder.write("good.csv", "time [h],count\n0,1\n1,2\n");
  folder.write("units.csv", "time [um],count\n0,1\n1,2\n");
  folder.write("order.csv", "time [h],count\n1,1\n0,2\n");
  const auto with = [&](const std::string& data) {
    return message_of("measure: cell_count, against: {data: " + data + "}, within: 1", &folder);
  };
  EXPECT_TRUE(read(criterion("measure: cell_count, against: {data: good.csv, y: count}, within: 1"), with_criteria(), folder.path()).ok());
  EXPECT_THAT(with("missing.csv, y: count"), HasSubstr("E601"));
  EXPECT_THAT(with("good.csv, y: coumt"), AllOf(HasSubstr("no column 'coumt'"), HasSubstr("`count`"), HasSubstr("E417")));
  EXPECT_THAT(with("good.csv"), HasSubstr("which column"));
  EXPECT_THAT(with("units.csv, y: count"), HasSubstr("has the unit 'um', but is compared with a time"));
  EXPECT_THAT(with("order.csv, y: count"), HasSubstr("does not increase"));
}

TEST(Plots, AreRefusedWhereTheyCannotBeDrawn) {
  const auto told = [](const std::string& plots) { return errors_of(study_with("plots:\n" + plots), with_criteria()); };
  EXPECT_THAT(told("  - {y: volum(left)}\n"), AllOf(HasSubstr("`volume`"), HasSubstr("E410")));
  EXPECT_THAT(told("  - {x: way(pull), y: [force(pull), volume(left)]}\n"), HasSubstr("make two plots"));
  EXPECT_THAT(told("  - {y: volume(left)}\n  - {y: volume(left)}\n"), HasSubstr("two plots are called 'volume_left'"));
  EXPECT_THAT(told("  - {name: a b, y: volume(left)}\n"), HasSubstr("E112"));
  EXPECT_THAT(told("  - {y: []}\n"), HasSubstr("E104"));
}

TEST(Registry, NamesNoMeasureAndNoTheoryTwiceAndSaysWhatTheyAre) {
  const auto study = read(study_with(""));
  ASSERT_TRUE(study.ok()) << study.error().text();
  std::vector<std::string> names = measure_names(*study);  // columns of series.csv, too
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  for (const Measure& measure : measures()) {
    EXPECT_THAT(measure.doc, testing::EndsWith(".")) << measure.name;
    EXPECT_FALSE(measure.title.empty());
    EXPECT_TRUE(measure.take) << measure.name;
  }
  for (const Theory& theory : theories()) {
    EXPECT_FALSE(theory.source.empty() || theory.formula.empty() || theory.predicts.empty()) << theory.name;
    for (const std::string& one : theory.predicts)
      EXPECT_TRUE(one.ends_with('_') || find_measure(*study, one)) << theory.name << " predicts " << one;
  }
  for (const Observable& column : observables(study->model, *study->laws)) EXPECT_TRUE(series_measure(*study, column.name)) << column.name;
}

}  // namespace
}  // namespace morula::scenarios::test
