#include <gtest/gtest.h>

#include <cmath>

#include "scenarios/library/library.h"
#include "scenarios/run/cost_model.h"
#include "scenarios/run/progress.h"
#include "scenarios/run/timings.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

TEST(CostModel, LeftFollowsTheLoadNotTheFraction) {
  CostModel model(60.0);
  for (int i = 0; i < 100; ++i) model.observe(60.0, 0.6, {100.0, 0.0});  // 1e-4 wall s per simulated s and sphere
  const WallRange still = model.left(1000.0, {100.0, 0.0}, 0.0);
  EXPECT_NEAR(still.low, 0.85 * 10.0, 1e-9);
  EXPECT_NEAR(still.high, 1.25 * 10.0, 1e-9);
  EXPECT_NEAR(model.left(1000.0, {200.0, 0.0}, 0.0).high, 25.0, 1e-9);
  EXPECT_LT(model.left(1000.0, {}, 0.0).low, 0.0) << "no cell is left";
  EXPECT_NEAR(model.left(1000.0, {0.0, 100.0}, 0.0).high, 37.5, 1e-9);  // a node is worth three spheres
  // Growth over ln 2: ∫ e^{gt} = 1/g.
  const double growth = std::log(2.0) / 1000.0;
  EXPECT_NEAR(model.left(1000.0, {100.0, 0.0}, growth).high, 1.25 * 1e-4 * 100.0 / growth, 1e-9);
  // Shells multiply, too, and each node costs more among more of them: ∫ e^{1.25 g t}.
  const auto integral = [&](double power, double time) { return std::expm1(power * growth * time) / (power * growth); };
  EXPECT_NEAR(model.left(1000.0, {0.0, 100.0, 1.0}, growth).high, 1.25 * 1e-4 * 300.0 * integral(1.25, 1000.0), 1e-9);
  // Room for √2 times as many: that is reached after half of the doubling time, and cells beyond are spheres.
  const double until = 0.5 * 1000.0, room = std::sqrt(2.0);
  const auto shells = [&](double power) { return integral(power, until) + std::pow(room, power) * (1000.0 - until); };
  EXPECT_NEAR(model.left(1000.0, {0.0, 100.0, 1.0, room}, growth).high,
              1.25 * 1e-4 * (300.0 * shells(1.25) + integral(1.0, 1000.0) - shells(1.0)), 1e-9);
}

TEST(CostModel, IsNotMisledByWhatHappensOnce) {
  CostModel model(60.0);
  for (int i = 0; i < 200; ++i) model.observe(60.0, 0.6, {100.0, 0.0});
  model.observe(60.0, 120.0, {100.0, 0.0});  // two hundred times as long as a step
  // It counts as ten steps among those that are remembered, 1/(1 − 0.97) = 33: (33 + 9)/33 of the cost.
  EXPECT_NEAR(model.left(1000.0, {100.0, 0.0}, 0.0).high, 12.5 * (1.0 + 9.0 * 0.03), 0.2);
}

/// The first step of a second, of a run whose steps will be of two minutes, says nothing; eight of them, by how they grow, most of it.
TEST(CostModel, KnowsWhatIsLeftFromHowTheFirstStepsGrow) {
  CostModel model(120.0);
  EXPECT_LT(model.left(1.0, {1.0, 1.0}, 0.0).low, 0.0);
  double time = 0.0, step = 1.0;
  const double end = 24.0 * 3600.0, each = 0.01;
  for (int i = 0; i < 12; ++i, step = std::min(1.5 * step, 120.0)) {
    EXPECT_EQ(model.left(end - time, {100.0}, 0.0).low >= 0.0, i >= 8);
    model.observe(step, each, {100.0});
    time += step;
  }
  const double steps_left = (end - time) / 120.0 + 1.0;
  const WallRange left = model.left(end - time, {100.0}, 0.0);
  EXPECT_LT(left.low, 1.5 * steps_left * each);
  EXPECT_GT(left.high, steps_left * each / 1.5);
}

TEST(CostModel, GrowthRateIsTheMeanOverCells) {
  Model model;
  model.types.resize(2);
  model.types[0].cycles = true;
  model.types[0].cycle_duration.mean = 1000.0;
  EXPECT_NEAR(free_growth_rate(model, {30, 10}, 1e4), 0.75 * std::log(2.0) / 1000.0, 1e-15);
  EXPECT_EQ(free_growth_rate(model, {0, 0}, 1e4), 0.0);
}

/// A stem cell (D = 4000 s) divides into one of its kind and one that divides four times as fast: dS/dt = 0, dA/dt = r_S S + r_A A with r = ln 2/D.
TEST(CostModel, GrowthRateCountsWhatDaughtersBecome) {
  Model model;
  model.types.resize(2);
  model.types[0].cycles = model.types[1].cycles = true;
  model.types[0].cycle_duration.mean = 4000.0, model.types[1].cycle_duration.mean = 1000.0;
  model.types[0].fates.all = {{1.0, {0, 1}}};
  const double t = 6000.0, r = std::log(2.0) / 1000.0;
  const double at_end = 10.0 + 10.0 * 0.25 * std::expm1(r * t);
  EXPECT_NEAR(free_growth_rate(model, {10, 0}, t), std::log(at_end / 10.0) / t, 2e-3 * r);
}

TEST(CostModel, EstimatesAStudyBeforeItRuns) {
  const auto study = test::read(test::changed("count: 60, fill: sphere, radius: 40 um", "count: 400, fill: sphere, radius: 60 um"));
  ASSERT_TRUE(study.ok()) << study.error().text();
  const auto guess = estimate(*study);
  ASSERT_TRUE(guess.ok()) << guess.error().message;
  EXPECT_EQ(guess->cells, 400);
  EXPECT_GT(guess->shells, 20);  // the region holds (25/49)³ of the cells
  EXPECT_LT(guess->shells, 120);
  EXPECT_EQ(guess->nodes, 162 * guess->shells);
  EXPECT_GT(guess->cells_at_end, 10000.0);  // 96 h of an 18 h cycle: 40 times
  EXPECT_GT(guess->memory, 1e7);
  EXPECT_LT(guess->wall.low, guess->wall.high);
}

/// Shells of a region fill its room; where the type itself is a shell, all cells are.
TEST(CostModel, ShellsMultiplyAsFarAsRegionsHaveRoom) {
  const auto study = test::read(test::kGoodStudy);
  ASSERT_TRUE(study.ok()) << study.error().text();
  const double room = most_shells(study->model, 1e6);
  EXPECT_GT(room, 20.0);
  EXPECT_LT(room, 200.0);
  Model free = study->model;
  for (CellType& type : free.types) type.initial_body = BodyKind::kShell;
  EXPECT_TRUE(std::isinf(most_shells(free, 1e6)));
  EXPECT_TRUE(std::isinf(most_shells(Model{}, 1e6)));
}

TEST(CostModel, CountsTheNodesOfNucleiThatAreShells) {
  const auto study = test::read(test::changed("bulk_modulus: 2.5 kPa", "nucleus: {kind: shell, radius: 3 um, nodes: 42}"));
  ASSERT_TRUE(study.ok()) << study.error().text();
  const auto guess = estimate(*study);
  ASSERT_TRUE(guess.ok()) << guess.error().message;
  EXPECT_GT(guess->shells, 20);
  EXPECT_EQ(guess->nodes, (162 + 42) * guess->shells);
}

/// A region around a needle that goes into a tissue has none of its cells at first.
TEST(CostModel, FollowsRegionsThatMove) {
  const auto memory_with = [](std::vector<std::string> overrides) {
    const test::Folder folder;
    for (const TemplateFile& file : find_template("hybrid_hotspot")->files) folder.write(std::string(file.path), std::string(file.content));
    ReadOptions options;
    options.overrides = std::move(overrides);
    const auto study = read_study(folder.path() / "study.yaml", options);
    if (!study.ok()) return ADD_FAILURE() << study.error().text(), 0.0;
    const auto guess = estimate(*study);
    if (!guess.ok()) return ADD_FAILURE() << guess.error().message, 0.0;
    EXPECT_EQ(guess->shells, 0);
    return guess->memory;
  };
  constexpr double kBytesOfTwentyShells = 20 * 162 * 2200.0;
  EXPECT_GT(memory_with({}), memory_with({"geometry.needle.motion.course=[{time: 0 s, distance: 0 um}, {time: 1 h, distance: 0 um}]",
                                          "criteria=[]", "plots=[]"}) +
                                 kBytesOfTwentyShells);
}

/// 20 cells that become 66 reach a half space in which none is at first.
TEST(CostModel, FollowsTissuesThatGrowIntoRegions) {
  const auto memory_with_region_at = [](const std::string& x) {
    const auto study = test::read(
        "schema: 1\nstudy: into\ntime: {end: 24 h, output: 24 h, checkpoint: 24 h}\n"
        "domain: {size: [240 um, 240 um, 240 um], boundary: open}\n"
        "cell_types: {cell: {radius: 6 um, cycle: {duration: 14 h}, dcm: {nodes: 42}}}\n"
        "initial: [{type: cell, count: 20, fill: sphere, radius: 19 um}]\ncoupling: {regions: [{name: far, shape: "
        "half_space, center: [" +
        x + ", 0 um, 0 um], normal: [-1, 0, 0]}]}\noutput: {report: false}\n");
    if (!study.ok()) return ADD_FAILURE() << study.error().text(), 0.0;
    const auto guess = estimate(*study);
    if (!guess.ok()) return ADD_FAILURE() << guess.error().message, 0.0;
    EXPECT_EQ(guess->shells, 0);
    return guess->memory;
  };
  constexpr double kBytesOfAShell = 42 * 2200.0;
  EXPECT_GT(memory_with_region_at("20 um"), memory_with_region_at("90 um") + 3.0 * kBytesOfAShell);
}

TEST(Progress, LiveLineReadsAsInTheGuide) {
  Progress p;
  p.time = 39.4 * 3600.0;
  p.end = 96 * 3600.0;
  p.cells = 1212;
  p.shells = 87;
  p.step = 18.0;
  p.left = {35 * 60.0, 50 * 60.0};
  EXPECT_EQ(live_line(p), " 41 % ▕███████▍          ▏ t 39.4 h of 96 h · 1212 cells (87 shells) · dt 18 s · left 35–50 min");
  EXPECT_EQ(plain_line(p), " 41 %  t 39.4 h of 96 h · 1212 cells (87 shells) · dt 18 s · left 35–50 min");
}

TEST(Progress, PlainLinesComeEachTwentieth) {
  PlainPace pace;
  Progress p;
  p.end = 100.0;
  int lines = 0;
  for (int i = 0; i <= 1000; ++i) {
    p.time = 0.1 * i;
    lines += pace.due(p);
  }
  EXPECT_EQ(lines, 21);
}

TEST(Progress, DurationsAreForPeople) {
  EXPECT_EQ(duration_text(0.62), "0.62 s");
  EXPECT_EQ(duration_text(2.04), "2 s");
  EXPECT_EQ(duration_text(9.96), "10 s");
  EXPECT_EQ(duration_text(12.0), "12 s");
  EXPECT_EQ(duration_text(81 * 60.0), "81 min");
  EXPECT_EQ(duration_text(2 * 3600.0 + 300.0), "2 h 05 min");
  EXPECT_EQ(duration_text(WallRange{30.0, 200.0}), "30 s to 3 min");
  EXPECT_EQ(duration_text(WallRange{}), "unknown");
}

TEST(Timings, TableAddsUp) {
  Timings t;
  t.stages = {{"solve", 6.0}, {"contacts", 3.0}};
  t.wall = 10.0;
  t.work = {1000, 2e6, 4e4};
  t.bytes_per_node = 512.0;
  const std::string table = timings_table(t);
  EXPECT_NE(table.find("solve                  6.00   60.0 %        6.000\n"), std::string::npos) << table;
  EXPECT_NE(table.find("other                  1.00   10.0 %"), std::string::npos) << table;
  EXPECT_NE(table.find("1000 steps · 5000 ns per node-step · 2.5e+05 ns per cell-step · 512 bytes per node"), std::string::npos) << table;
}

}  // namespace
}  // namespace morula::scenarios
