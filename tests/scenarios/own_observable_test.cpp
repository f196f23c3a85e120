// Columns of series.csv that a program adds: sums, means and extremes over cells, and what follows from the moment as a whole.
#include <cmath>

#include "coupling/observables/observable.h"
#include "tests/scenarios/own_parts.h"

namespace morula::scenarios::test {
namespace {

using testing::HasSubstr;

std::vector<Observable> ages(const Model& model) {
  const auto old = [](const CellView& cell) { return cell.age() > 3600.0 ? 1.0 : 0.0; };
  std::vector<Observable> out{
      {"mean_age", "s", "Mean age of the cells.", [](const Moment& m) { return m.cells.mean([](const CellView& c) { return c.age(); }); }},
      {"youngest", "s", "Age of the youngest cell.",
       [](const Moment& m) { return m.cells.smallest([](const CellView& c) { return c.age(); }); }},
      {"old_cells", "1", "Cells older than an hour.", [old](const Moment& m) { return m.cells.sum(old); }},
      {"volume_again", "um^3", "Volume of all cells.",
       [](const Moment& m) { return m.cells.sum([](const CellView& c) { return c.volume; }); }},
      {"highest", "um", "Largest z of a cell's centre.",
       [](const Moment& m) { return m.cells.largest([](const CellView& c) { return c.center.z; }); }}};
  for (std::size_t t = 0; t < model.types.size(); ++t)
    out.push_back({"mean_age_" + model.types[t].name, "s", "Mean age of " + model.types[t].name + ".", [t](const Moment& m) {
                     return m.cells.mean([t](const CellView& c) { return c.row().type == t ? c.age() : std::nan(""); });
                   }});
  return out;
}

class OwnObservables : public OwnParts {
 protected:
  OwnObservables() : OwnParts([](Laws& laws) { laws.observables.emplace_back(&ages); }) {}
};

const std::string kTwo = R"(schema: 1
study: two
time: {end: 10 min, output: 5 min, checkpoint: 5 min}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  ball: {radius: 6 um, cycle: {duration: 10 h}}
  skin: {radius: 6 um, body: shell, dcm: {nodes: 42}}
contact: {range: 1 um}
initial:
  - {type: ball, at: [[0 um, 0 um, 20 um], [0 um, 0 um, -20 um]], age: random}
  - {type: skin, at: [[0 um, 0 um, 0 um]]}
output: {report: false}
)";

TEST_F(OwnObservables, StandInTheSeriesBesideThoseThatAreThere) {
  run_whole(kTwo, "two");
  const auto mean = column("two", "mean_age"), of_skin = column("two", "mean_age_skin"), of_ball = column("two", "mean_age_ball");
  ASSERT_EQ(mean.size(), 3u);
  EXPECT_EQ(of_skin, (std::vector<double>{0.0, 300.0, 600.0}));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(mean[k], (2.0 * of_ball[k] + of_skin[k]) / 3.0, 1e-9 * mean[k]);
  EXPECT_NEAR(of_ball[2] - of_ball[0], 600.0, 1e-9);
  EXPECT_EQ(column("two", "youngest"), of_skin);
  EXPECT_EQ(column("two", "volume_again"), column("two", "total_volume"));
  EXPECT_NEAR(column("two", "highest")[0], 20.0, 1e-12);
  EXPECT_GT(column("two", "old_cells")[0], 0.0);  // both balls are hours old
}

TEST_F(OwnObservables, GoOnAfterARestart) {
  run_whole(kTwo, "whole");
  run_split(kTwo, "split", 300.0);
  EXPECT_EQ(file("split", "series.csv"), file("whole", "series.csv"));
}

TEST_F(OwnObservables, AreKnownToTheReaderAndExplained) {
  const std::string text = changed("output: {report: false}", "output: {report: false, series: [mean_age_skin, highest]}", kTwo);
  EXPECT_TRUE(read(text, options()).ok());
  const auto unknown = read(text);
  ASSERT_FALSE(unknown.ok());
  EXPECT_THAT(unknown.error().text(), HasSubstr("there is no observable 'mean_age_skin' [E403]"));
  EXPECT_THAT(explain("mean_age_skin"), HasSubstr("mean_age_<cell type> [s]: Mean age of <cell type>."));
  EXPECT_THAT(explain("mean_oxygen"), HasSubstr("mean_<field> [mM]"));
  EXPECT_THAT(explain("cell_count"), HasSubstr("Number of cells."));
  EXPECT_THAT(study_reference(*laws_), HasSubstr("| `youngest` | s | Age of the youngest cell. |"));
}

TEST_F(OwnObservables, CannotBearTheNameOfAnother) {
  Laws laws = *laws_;
  laws.observables.emplace_back([](const Model&) {
    return std::vector<Observable>{{"cell_count", "1", "Cells.", [](const Moment&) { return 0.0; }}};
  });
  laws_ = std::make_shared<const Laws>(std::move(laws));
  const auto refused = read(kTwo, options());
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().text(), HasSubstr("two of `observables` are called `cell_count`"));
}

}  // namespace
}  // namespace morula::scenarios::test
