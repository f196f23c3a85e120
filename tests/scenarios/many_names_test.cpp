// Studies with more fields and more marks than a byte or a fixed array would have room for.
#include <gtest/gtest.h>

#include "results/file_io.h"
#include "results/series_reader.h"
#include "results/snapshot_file.h"
#include "scenarios/run/driver.h"
#include "tests/results/results_support.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

/// Two shells whose upper caps do not adhere, in two fields and in `fields` more; the cap is the last of `marks` marks.
std::string study_with(int fields, int marks) {
  std::string text = R"(schema: 1
study: many
time: {end: 2 min, output: 30 s, checkpoint: 1 min}
domain: {size: [60 um, 60 um, 60 um]}
cell_types:
  cell: {radius: 6 um, body: shell, dcm: {nodes: 42}}
contact:
  range: 1 um
  pairs: [{between: [cell, cell], regions: [{faces: [cap, any], adhesion: 0 J/m^2}]}]
initial:
  - {type: cell, at: [[-6 um, 0 um, 0 um], [6 um, 0 um, 0 um]]}
output: {report: false}
fields:
)";
  for (int f = 0; f < fields; ++f)
    text += "  f" + std::to_string(f) +
            ": {diffusion: 1e-9 m^2/s, initial: 0.2 mM, boundary: {all: 0.2 mM}, uptake: {cell: " + std::to_string(10 + f) +
            " amol/s}, voxel: 10 um}\n";
  text += "marks:\n";
  for (int k = 1; k < marks; ++k) text += "  m" + std::to_string(k) + ": {types: [cell], cone: {axis: [0, 0, -1], angle: 30 deg}}\n";
  return text + "  cap: {types: [cell], cone: {axis: [0, 0, 1], angle: 100 deg}}\n";
}

class ManyNames : public ::testing::Test {
 protected:
  Study study(const std::string& text) {
    auto read = test::read(text, {}, folder_.path());
    EXPECT_TRUE(read.ok()) << read.error().text();
    return std::move(read).value();
  }
  RunSummary go(const std::string& text, const std::string& name, std::optional<double> until = {}) {
    RunRequest request;
    request.out = folder_.path() / name;
    request.until = until;
    auto done = run(study(text), request, Comm());
    EXPECT_TRUE(done.ok()) << done.error().message;
    return done.ok() ? std::move(done).value() : RunSummary{};
  }
  std::vector<double> column(const std::string& run, const std::string& name) {
    const auto series = read_series(folder_.path() / run / "series.csv");
    const SeriesColumn* found = series.ok() ? series->find(name) : nullptr;
    EXPECT_TRUE(found) << name;
    return found != nullptr ? found->values : std::vector<double>{};
  }
  test::Folder folder_;
};

TEST_F(ManyNames, ActAsFewDo) {
  go(study_with(1, 1), "few");
  go(study_with(7, 13), "many");
  EXPECT_EQ(column("few", "energy"), column("many", "energy")) << "the thirteenth mark acts as an only one does";
  EXPECT_EQ(column("few", "mean_contact_area"), column("many", "mean_contact_area"));
  EXPECT_EQ(column("few", "mean_f0"), column("many", "mean_f0"));
  EXPECT_LT(column("many", "mean_f6").back(), column("many", "mean_f0").back()) << "the seventh field is taken up fastest";
  const auto index = list_snapshots(folder_.path() / "many/results.h5");
  ASSERT_TRUE(index.ok());
  const auto last = read_snapshot(folder_.path() / "many/results.h5", index->size() - 1);
  ASSERT_TRUE(last.ok()) << last.error().message;
  ASSERT_EQ(last->variables.size(), 15u) << "amounts and concentrations of seven fields, and outside_law";
  EXPECT_EQ(last->variables[12].name, "amount/f6");
  EXPECT_EQ(last->variables[12].unit, "amol");
  EXPECT_NEAR(last->variables[12].values[0] / last->variables[0].values[0], 1.6, 0.01) << "16 and 10 amol/s, nearly at plenty";
  EXPECT_EQ(last->mark_names.size(), 13u);
  EXPECT_GT(last->marks().size(), 0u);
  EXPECT_TRUE(last->marks().any_has(12));
}

TEST_F(ManyNames, GoOverARestart) {
  const RunSummary whole = go(study_with(7, 13), "whole");
  go(study_with(7, 13), "split", 60.0);
  const auto rest = resume(folder_.path() / "split", {}, Comm());
  ASSERT_TRUE(rest.ok()) << rest.error().message;
  EXPECT_EQ(rest->final_state.state_hash, whole.final_state.state_hash);
}

}  // namespace
}  // namespace morula::scenarios
