// Criteria and plots that a study declares, judged on runs of study files with default parameters.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "results/series_reader.h"
#include "scenarios/criteria/judge.h"
#include "scenarios/criteria/judge_criteria.h"
#include "scenarios/run/driver.h"
#include "tests/results/results_support.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

using testing::HasSubstr;

/// Two shells that do not touch, a sphere, and a type without cells.
constexpr const char* kApart = R"(schema: 1
study: apart
time: {end: 4 min, output: 1 min}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  cell: {radius: 6 um, dcm: {nodes: 42}}
  ball: {radius: 5 um, dcm: {nodes: 42}}
  none: {radius: 5 um, dcm: {nodes: 42}}
contact: {range: 1 um}
geometry:
  lid: {plane: {center: [0 um, 0 um, 40 um], normal: [0, 0, -1], size: 20 um}, motion: {velocity: [0 um/min, 0 um/min, -1 um/min]}}
initial:
  - {type: cell, at: [[-20 um, 0 um, 0 um], [20 um, 0 um, 0 um]], as: shell}
  - {type: ball, at: [[0 um, 20 um, 0 um]], as: sphere}
output: {series: [cell_count], report: REPORT}
criteria:
CRITERIA
plots:
  - {name: volumes, y: [volume(cell), volume(ball)], against: 900 um^3}
  - {name: lid, x: obstacle.way(lid), y: pressure(cell), title: Under the lid}
  - {name: pressures, y: pressure_inside, of: [cell, ball], at: end, x: radius, against: laplace}
  - {name: counted, y: cell_count, against: {data: count.csv, y: cells, source: a count}}
  - {name: each, y: volume(cell), over_cells: each}
  - {name: energy, y: volume(ball), over_cells: mean}
)";

class OwnCriteria : public testing::Test {
 protected:
  /// Runs the study once, with a report or without; false where it does not run.
  bool runs(const std::string& criteria, bool report = false) {
    folder_.write("count.csv", "time [min],cells\n0,3\n4,3\n");
    folder_.write("way.csv", "way [um],half_more [um]\n0,0.5\n2,2.5\n3,\n9,1\n");
    ReadOptions options;
    options.check_criteria = &check_criteria;
    auto study = test::read(test::changed("REPORT", report ? "true" : "false", test::changed("CRITERIA", criteria, kApart)), options,
                            folder_.path());
    EXPECT_TRUE(study.ok()) << study.error().text();
    if (!study.ok()) return false;
    study_ = std::move(study).value();
    RunRequest request;
    request.out = folder_.path() / "run";
    auto done = run(study_, request, Comm());
    EXPECT_TRUE(done.ok()) << done.error().message;
    if (!done.ok()) return false;
    for (const Verdict& v : done->verdicts) verdicts_.emplace(v.id, v);
    passed_ = done->passed;
    return true;
  }
  [[nodiscard]] const Verdict& verdict(const std::string& id) {
    EXPECT_TRUE(verdicts_.contains(id)) << id;
    return verdicts_.find(id)->second;
  }

  test::Folder folder_;
  Study study_;
  std::multimap<std::string, Verdict> verdicts_;
  bool passed_ = false;
};

TEST_F(OwnCriteria, PassFailOrFindNothingAndAreTold) {
  ASSERT_TRUE(runs(R"(  - {id: PASS, measure: volume(cell), between: [850 um^3, 950 um^3]}
  - {id: FAIL, measure: volume(cell), above: 1e-6 mm^3}
  - {id: NOTHING, measure: volume(none), above: 1 um^3}
  - {id: NO_PAIR, measure: cap.angle, of: {pair: [cell, ball]}, below: 90 deg}
  - {id: TOO_FEW, measure: cell_count, from: 0 s, until: 0 s, over_time: slope, below: 1 1/s}
  - {id: NO_CONTACT, measure: contacts_beyond_range, at: every, below: 1}
  - {id: EACH, measure: volume, of: [cell, ball], below: 800 um^3})"));
  EXPECT_FALSE(passed_);
  const Verdict pass = verdict("PASS");
  EXPECT_TRUE(pass.passed) << pass.value;
  EXPECT_EQ(pass.limit, "850 to 950 um^3");
  EXPECT_EQ(pass.quantity, "volume, cell");
  const Verdict fail = verdict("FAIL");
  EXPECT_FALSE(fail.passed);
  EXPECT_EQ(fail.limit, ">= 1e-06 mm^3");
  EXPECT_NEAR(fail.value, 900e-9, 50e-9);
  for (const char* id : {"NOTHING", "NO_PAIR", "TOO_FEW", "NO_CONTACT"}) {
    EXPECT_FALSE(verdict(id).passed) << id;
    EXPECT_TRUE(std::isnan(verdict(id).value)) << id;
  }
  ASSERT_EQ(verdicts_.count("EACH"), 2u);  // each thing by itself: the shells are too large, the sphere is not
  const auto [each, end] = verdicts_.equal_range("EACH");
  EXPECT_FALSE(each->second.passed);
  EXPECT_TRUE(std::next(each)->second.passed);
  EXPECT_EQ(std::next(each)->second.quantity, "volume, ball");
}

TEST_F(OwnCriteria, FindTheValuesThatAreKnown) {
  ASSERT_TRUE(runs(R"(  - {id: BALL, measure: volume(ball), against: 523.5987756 um^3, within: 1e-6 %}
  - {id: WIDTH, measure: width_x(ball), against: 10 um, within: 1e-9 um}
  - {id: SUM, measure: volume(all), over_cells: sum, against: 2333 um^3, within: 2 %}
  - {id: ROUND, measure: elongation(cell), at: every, between: [1, 1.01]}
  - {id: SPHERICITY, measure: sphericity(ball), against: 1, within: 1e-12}
  - {id: LAPLACE, measure: pressure_inside(cell), against: laplace, within: 15 %}
  - {id: STILL, measure: displacement(all), over_time: max, at: every, below: 0.1 um}
  - {id: LID, measure: obstacle.way(lid), against: 4 um, within: 1e-9 um}
  - {id: LID.speed, measure: obstacle.way(lid), at: every, over_time: slope, against: 1 um/min, within: 1e-9 um/min}
  - {id: LID.rise, measure: obstacle.way(lid), from: 1 min, until: 3 min, over_time: rise, against: 2 um, within: 1e-9 um}
  - {id: LID.growth, measure: obstacle.way(lid), from: 1 min, over_time: growth, against: 300 %, within: 1e-9}
  - {id: COUNT, measure: cell_count, at: every, against: {data: count.csv, y: cells}, within: 0}
  - {id: SAME, measure: volume(cell), against: {measure: volume(cell)}, within: 1 um^3}
  - {id: LARGER, measure: volume(cell), above: volume(ball)}
  - {id: SMALLER, measure: volume(cell), below: volume(ball)}
  - {id: FIRST, measure: width_x, of: {cell: 1}, at: 2 min, between: [11 um, 13 um]})"));
  for (const auto& [id, v] : verdicts_)
    EXPECT_EQ(v.passed, id != "SMALLER") << id << ": " << v.quantity << " is " << v.value << ", wanted " << v.limit;
  EXPECT_EQ(verdict("SMALLER").limit, "<= 523.599 um^3");
  EXPECT_EQ(verdict("SMALLER").quantity, "volume below volume(ball), cell");
  EXPECT_EQ(verdict("LID.speed").quantity, "way of the obstacle against 1 um/min, slope over time, lid");
}

TEST_F(OwnCriteria, DivideJoinAndFollowCurves) {
  ASSERT_TRUE(runs(R"(  - {id: RATIO, measure: volume(cell), over: {measure: volume(ball)}, against: 1.728, within: 2 %}
  - {id: PER, measure: obstacle.way(lid), over: 2 um, against: 2, within: 1e-9}
  - {id: LAPLACE, measure: pressure_inside(cell), over: laplace, between: [0.85, 1.15]}
  - {id: LINE, measure: obstacle.way(lid), at: every, along: obstacle.way, curve: r_squared, of: {obstacle: lid}, above: 0.999999999}
  - {id: LINE.zero, measure: pressure(cell), at: every, along: obstacle.way(lid), curve: intercept, between: [-1 Pa, 1 Pa]}
  - {id: RMS, measure: obstacle.way(lid), at: every, along: obstacle.way(lid), curve: rms, against: {data: way.csv, x: way, y: half_more},
     within: 0.6 um}
  - {id: RMS.other, measure: obstacle.way(lid), at: every, along: obstacle.way(lid), curve: rms,
     against: {data: way.csv, x: way, y: half_more}, within: obstacle.way(lid)}
  - {id: DATA, measure: obstacle.way(lid), at: 1 min, along: obstacle.way(lid), against: {data: way.csv, x: way, y: half_more}, within: 0.6 um}
  - {id: RISING, measure: obstacle.way(lid), at: every, over_time: rising, above: 1}
  - {id: FALLING, measure: obstacle.way(lid), at: every, over_time: falling, above: 1}
  - {id: CHANGE, measure: obstacle.way(lid), from: 1 min, over_time: change, against: 3, within: 1e-9}
  - {id: HOLDS, measure: obstacle.way(lid), at: holds, against: 4 um, within: 1e-9 um}
  - {id: SUM, measure: volume, of: {type: [cell, ball, none], together: true}, over_cells: sum, against: 2333 um^3, within: 2 %}
  - {id: WORST, measure: volume, of: {type: [ball, cell], together: true}, below: 800 um^3}
  - {id: SINCE, measure: volume.change(cell), at: every, against: 0, within: 0.05})"));
  for (const auto& [id, v] : verdicts_)
    EXPECT_EQ(v.passed, id != "FALLING" && id != "WORST") << id << ": " << v.quantity << " is " << v.value << ", wanted " << v.limit;
  EXPECT_NEAR(verdict("RMS").value, 0.5, 1e-9);  // of the two points that the lid has come by; a row without a value is none
  EXPECT_NEAR(verdict("DATA").value, 0.5, 1e-9);
  EXPECT_EQ(verdict("FALLING").value, 0.0);
  ASSERT_EQ(verdicts_.count("WORST"), 1u);
  EXPECT_GT(verdict("WORST").value, 800.0);
  EXPECT_EQ(verdict("WORST").quantity, "volume, ball, cell");
  EXPECT_EQ(verdict("RATIO").quantity, "volume over volume(ball) against 1.728, relative, cell");
}

TEST(ColumnNames, ThatTwoThingsHaveAreToldByCheck) {
  ReadOptions options;
  options.check_criteria = &check_criteria;
  const auto text = [](const char* field) {
    return std::string(
               "schema: 1\nstudy: names\ntime: {end: 1 h}\ndomain: {size: [100 um, 100 um, 100 um]}\ncell_types: {a: {radius: 5 um}}\n"
               "initial: [{type: a, at: [[0 um, 0 um, 0 um]]}]\nfields: {") +
           field + ": {diffusion: 2e-10 m^2/s, initial: 0.1 mM, voxel: 20 um}}\n";
  };
  EXPECT_TRUE(test::read(text("oxygen"), options).ok());
  const auto study = test::read(text("way"), options);
  ASSERT_FALSE(study.ok());
  EXPECT_THAT(study.error().text(), testing::AllOf(HasSubstr("'way' would make a second column 'mean_way'"), HasSubstr("[E112]")));
}

TEST_F(OwnCriteria, FindNothingInWhatIsInfiniteOrMissing) {
  ASSERT_TRUE(runs(R"(  - {id: INFINITE, measure: cell_count, over: {measure: divisions}, above: 2}
  - {id: TOGETHER, measure: volume, of: {type: [cell, none], together: true}, above: 1 um^3}
  - {id: NO_STEP, measure: mean_step, at: start, below: 1 h}
  - {id: CAP, measure: cap.angle, of: {pair: [cell, cell]}, below: 90 deg}
  - {id: CAP_ON, measure: cap.contact_radius, of: {type: cell, obstacle: lid}, below: 1}
  - {id: ONE, measure: volume, of: {type: [cell, ball], together: true}, above: 1 um^3})"));
  for (const char* id : {"INFINITE", "TOGETHER", "NO_STEP", "CAP", "CAP_ON"}) {  // caps are of cells that touch
    EXPECT_FALSE(verdict(id).passed) << id;
    EXPECT_TRUE(std::isnan(verdict(id).value)) << id;
  }
  EXPECT_TRUE(verdict("ONE").passed);
}

TEST_F(OwnCriteria, AreHeldAgainstWhatIsMadeInTheSameWay) {
  folder_.write("whole.csv", "time [min],cells\n0,3\n2,3\n4,7");  // no newline at the end
  folder_.write("rising.csv", "time [min],v [um^3]\n0,100\n4,104\n");
  folder_.write("line.csv", "r [um],v [um^3]\n4,400\n7,700\n");
  folder_.write("between.csv", "r [um],v [um^3]\n5.5,714\n");
  ASSERT_TRUE(runs(R"(  - {id: DIVIDED, measure: cell_count, over: 3, at: start, above: sphere_count}
  - {id: NOT_DIVIDED, measure: cell_count, over: 3, at: start, below: sphere_count}
  - {id: LAST_ROW, measure: cell_count, at: end, against: {data: whole.csv, y: cells}, within: 0.1}
  - {id: MEAN, measure: cell_count, from: 0 min, until: 4 min, over_time: mean, against: {data: count.csv, y: cells}, within: 1e-9}
  - {id: SLOPE, measure: total_volume, from: 0 min, until: 4 min, over_time: slope, against: {data: rising.csv, y: v}, within: 0.5 um^3/min}
  - {id: SUM, measure: volume(cell), over_cells: sum, against: {measure: volume(cell)}, within: 1e-9 %}
  - {id: RATE, measure: obstacle.way(lid), over: 2 um, over_time: slope, from: 0 min, until: 4 min, between: [0.49 1/min, 0.51 1/min]}
  - {id: ALONG, measure: volume(all), over_cells: mean, along: radius, against: {data: line.csv, x: r, y: v}, within: 1 um^3}
  - {id: FALLING, measure: volume, of: [cell, ball], along: radius, curve: rms, against: {data: between.csv, x: r, y: v}, within: 20 um^3}
  - {id: UNITS, measure: volume(ball), between: [0.5 pL, 600 fL]})"));
  EXPECT_NEAR(verdict("ALONG").value, 2333.0 / 3.0 - 100.0 * 17.0 / 3.0, 10.0) << "at the mean radius of the three";
  EXPECT_TRUE(verdict("FALLING").passed) << "from the large cells to the small one: " << verdict("FALLING").value;
  EXPECT_TRUE(verdict("DIVIDED").passed) << "3/3 is not below 1";
  EXPECT_EQ(verdict("DIVIDED").limit, ">= 1");
  EXPECT_TRUE(verdict("NOT_DIVIDED").passed);
  EXPECT_FALSE(verdict("LAST_ROW").passed) << "7 cells at the end, says the file";
  EXPECT_TRUE(verdict("MEAN").passed) << verdict("MEAN").value;
  EXPECT_FALSE(verdict("SLOPE").passed) << "the volume hardly rises, the data do by 1 um^3/min";
  EXPECT_NEAR(verdict("SLOPE").value, 1.0, 0.3);
  EXPECT_TRUE(verdict("SUM").passed) << verdict("SUM").value;
  EXPECT_TRUE(verdict("RATE").passed) << verdict("RATE").value;
  EXPECT_EQ(verdict("UNITS").limit, "0.5 pL to 600 fL");
}

TEST_F(OwnCriteria, PlotsStandInTheReportAndBesideIt) {
  ASSERT_TRUE(runs("  - {id: PASS, measure: cell_count, above: 3}", true));
  EXPECT_TRUE(passed_);
  const auto plots = declared_plots(study_, folder_.path() / "run");
  ASSERT_TRUE(plots.ok()) << plots.error().message;
  ASSERT_EQ(plots->size(), 6u);
  EXPECT_EQ((*plots)[0].plot.curves.size(), 2u);
  EXPECT_EQ((*plots)[0].plot.curves[0].x.size(), 5u);
  EXPECT_EQ((*plots)[0].plot.limits.size(), 1u);
  const CurvePlot& lid = (*plots)[1].plot;
  EXPECT_EQ(lid.title, "Under the lid");
  EXPECT_EQ(lid.y.unit, "Pa");
  ASSERT_EQ(lid.curves.size(), 1u);
  EXPECT_NEAR(lid.curves[0].x.back(), 4.0, 1e-9);
  const CurvePlot& pressures = (*plots)[2].plot;  // one moment: a point for each type, and the theory beside it
  ASSERT_EQ(pressures.curves.size(), 2u);
  EXPECT_EQ(pressures.curves[0].x.size(), 2u);
  EXPECT_EQ(pressures.curves[1].name, "Laplace's law");
  EXPECT_EQ((*plots)[3].plot.curves.back().name, "a count");
  const CurvePlot& each = (*plots)[4].plot;  // two cells at each of five moments: no line leads from one to the other
  ASSERT_EQ(each.curves.size(), 1u);
  EXPECT_EQ(each.curves[0].x.size(), 10u);
  EXPECT_EQ(each.curves[0].style, CurveStyle::kPoints);
  EXPECT_EQ((*plots)[0].plot.curves[0].style, CurveStyle::kLine);
  const std::string report = testing_support::slurp(folder_.path() / "run/report.html");
  for (const char* words : {"Under the lid", "Laplace", "a count", "criteria passed"}) EXPECT_THAT(report, HasSubstr(words));
  for (const char* name : {"volumes.svg", "volumes.csv", "lid.svg", "pressures.svg", "counted.svg"})
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "run/plots" / name)) << name;
  EXPECT_THAT(testing_support::slurp(folder_.path() / "run/plots/energy.csv"), HasSubstr("um^3"))
      << "the study's plot, not the one of every run";
}

/// A lone cell comes to rest at once: what its energy then does are the tolerances of the steps.
TEST(CommonCriteria, DoNotJudgeTheEnergyOfACellAtRestByItsRounding) {
  const test::Folder folder;
  const auto study = test::read(R"(schema: 1
study: rest
time: {end: 10 min, output: 1 min}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  cell: {radius: 3 um, body: shell, adhesion: {cell: 0 J/m^2}, cycle: {model: none}, dcm: {nodes: 162, cortex: {elastic: none, tension: 2 mN/m}}}
initial: [{type: cell, at: [0 um, 0 um, 0 um]}]
output: {report: false}
)");
  ASSERT_TRUE(study.ok()) << study.error().text();
  RunRequest request;
  request.out = folder.path() / "run";
  const auto done = run(*study, request, Comm());
  ASSERT_TRUE(done.ok()) << done.error().message;
  const auto energy = std::ranges::find(done->verdicts, std::string("INV.7"), &Verdict::id);
  ASSERT_NE(energy, done->verdicts.end());
  EXPECT_TRUE(energy->passed) << energy->value;
}

/// A patch of marked faces has no force while no face has the mark.
TEST(OwnMeasures, ForceOfAPatchIsThatWhichFacesBear) {
  const test::Folder folder;
  const auto force = [&](const char* size, const char* name) {
    const auto study = test::read(std::string(R"(schema: 1
study: patch
time: {end: 2 min, output: 1 min}
domain: {size: [60 um, 60 um, 60 um]}
cell_types: {a: {radius: 6 um, body: shell}}
marks: {m: {types: [a], box: {center: [0 um, 0 um, 6 um], size: )") +
                                  size + R"(}}}
loads: {l: {type: a, patch: {force: [0 nN, 0 nN, 1 nN], marked: m}}}
initial: [{type: a, at: [0 um, 0 um, 0 um]}]
output: {report: false}
criteria: [{id: F, measure: force, of: {load: l}, at: end, above: 0 nN}]
)");
    EXPECT_TRUE(study.ok()) << study.error().text();
    RunRequest request;
    request.out = folder.path() / name;
    const auto done = run(*study, request, Comm());
    EXPECT_TRUE(done.ok());
    if (!done.ok()) return std::nan("");
    const auto verdict = std::ranges::find(done->verdicts, std::string("F"), &Verdict::id);
    return verdict != done->verdicts.end() ? verdict->value : std::nan("");
  };
  EXPECT_EQ(force("[20 um, 20 um, 20 um]", "faces"), 1.0);
  EXPECT_EQ(force("[0.001 um, 0.001 um, 0.001 um]", "none"), 0.0);
}

}  // namespace
}  // namespace morula::scenarios
