/// Cells that take from fields and look at them, from study files with default numerics.
#include <algorithm>
#include <map>

#include "coupling/sensed_fields.h"
#include "fields/reaction.h"
#include "tests/scenarios/own_parts.h"
#include "tests/scenarios/simulation_of.h"

namespace morula::scenarios::test {
namespace {

using ::testing::HasSubstr;

class CellsInFields : public OwnParts {
 protected:
  CellsInFields() : OwnParts([](Laws&) {}) {}
  double last(const std::string& run, const std::string& name) { return column(run, name).back(); }
};

/// 1 amol/s of 0.1 mM in (60 µm)³ without flux are 0.0333 mM in two hours.
TEST_F(CellsInFields, DyingCellsTakeAndMakeThePartThatTheStudySays) {
  const auto text = [](const std::string& uptake, const std::string& secretion) {
    return R"(schema: 1
study: dying
time: {end: 2 h, output: 1 h}
domain: {size: [60 um, 60 um, 60 um]}
cell_types:
  a: {cycle: {model: none}, death: {o_below: 0.2 mM, rate: 100000 1/h, shrink_time: 4 h}}
initial:
  - {type: a, at: [0 um, 0 um, 0 um]}
fields:
  o: {diffusion: 500 um^2/s, initial: 0.1 mM)" +
           uptake + secretion + R"(}
output: {report: false}
)";
  };
  run_whole(text(", uptake: {a: {rate: 1 amol/s, half_saturation: 1e-6 mM}}", ""), "none");
  EXPECT_NEAR(last("none", "mean_o"), 0.1, 5e-4) << "what it took before it began to die";
  run_whole(text(", uptake: {a: {rate: 1 amol/s, half_saturation: 1e-6 mM, dying: 100 %}}", ""), "all");
  EXPECT_NEAR(last("all", "mean_o"), 0.1 - 1.0 / 30.0, 1e-4);
  run_whole(text("", ", secretion: {a: {rate: 1 amol/s, dying: 50 %}}"), "half");
  EXPECT_NEAR(last("half", "mean_o"), 0.1 + 0.5 / 30.0, 5e-4);
}

/// A trigger whose two values are 3 % apart: what a cell sees must not depend on its body by more than that.
TEST_F(CellsInFields, ACellSeesTheSameInBothBodies) {
  const std::string text = R"(schema: 1
study: both
time: {end: 3 h, output: 30 min}
domain: {size: [80 um, 80 um, 80 um]}
cell_types:
  a: {radius: RADIUS, cycle: {model: none}, adhesion: {a: 0 J/m^2}}
initial:
  - {type: a, at: [5 um, 5 um, 5 um], as: BODY}
fields:
  o: {diffusion: 10 um^2/s, initial: 0.1 mM, boundary: 0.1 mM, uptake: {a: {rate: 20 amol/s, half_saturation: 0.05 mM}}}
output: {report: false}
)";
  for (const char* radius : {"4 um", "6 um", "8 um", "11 um"}) {
    std::vector<double> least, mean;
    for (const char* body : {"sphere", "shell"}) {
      std::string one = text;
      one.replace(one.find("RADIUS"), 6, radius);
      one.replace(one.find("BODY"), 4, body);
      run_whole(one, std::string(body) + radius);
      least.push_back(last(std::string(body) + radius, "min_o"));
      mean.push_back(0.1 - last(std::string(body) + radius, "mean_o"));
    }
    EXPECT_NEAR(least[1], least[0], 0.005 * least[0]) << radius;
    EXPECT_NEAR(mean[1], mean[0], 0.01 * mean[0]) << radius << ": what they have taken";
  }
}

TEST_F(CellsInFields, ACellBeyondTheDomainIsToldAndFailsTheRun) {
  const auto text = [](const std::string& fields) {
    return R"(schema: 1
study: beyond
time: {end: 10 min, output: 2 min}
domain: {size: [60 um, 60 um, 60 um]}
cell_types: {a: {cycle: {model: none}}}
initial:
  - {type: a, at: [[0 um, 0 um, 0 um], [26 um, 20 um, 0 um]], as: sphere}
loads: {push: {type: a, body_force: [1 nN, 0 nN, 0 nN]}}
output: {report: false}
)" + fields;
  };
  const RunSummary out = run_whole(text("fields: {o: {diffusion: 500 um^2/s, initial: 0.1 mM, uptake: {a: 1 amol/s}}}\n"), "fields");
  EXPECT_GE(last("fields", "outside_fields"), 1.0);
  EXPECT_EQ(column("fields", "outside_fields").front(), 0.0);
  const auto told = std::ranges::find(out.verdicts, "LIMIT.outside_fields", &Verdict::id);
  ASSERT_NE(told, out.verdicts.end());
  EXPECT_FALSE(told->passed);
  for (const Verdict& verdict : run_whole(text(""), "plain").verdicts) EXPECT_NE(verdict.id, "LIMIT.outside_fields");
}

/// A type takes what the type that it is like takes, where a field does not name it.
TEST_F(CellsInFields, TypesThatAreLikeOthersTakeWhatTheyTake) {
  const std::string text = R"(schema: 1
study: like
time: {end: 1 h, output: 1 h}
domain: {size: [100 um, 100 um, 100 um]}
cell_types:
  a: {cycle: {model: none}}
  b: {like: a}
  c: {like: b}
  d: {like: a}
initial: [{type: a, at: [0 um, 0 um, 0 um]}]
fields:
  o: {diffusion: 1000 um^2/s, initial: 0.1 mM, uptake: {a: 1 amol/s, d: 0 amol/s}, secretion: {b: 2 amol/s}}
)";
  const auto rates = [](const Study& study) {
    std::map<std::pair<std::string, int>, double> out;
    for (const fields::FieldReaction& one : study.model.fields[0].reactions) out[{one.what->info.name, one.type}] = one.values("rate");
    return out;
  };
  const Study read = study(text);
  const std::map<std::pair<std::string, int>, double> right{
      {{"uptake", 0}, 1.0}, {{"uptake", 1}, 1.0}, {{"uptake", 2}, 1.0}, {{"secretion", 1}, 2.0}, {{"secretion", 2}, 2.0}};
  EXPECT_EQ(rates(read), right);
  EXPECT_EQ(rates(study(read.resolved_text)), right) << "the resolved study says the same";
}

/// A field that rises from 0 to 2 mM along x: its gradient is the same for a cell in the middle, and for one whose back is nearer to a face than half a
/// voxel or beyond it, as far as there is a field.
TEST_F(CellsInFields, TheGradientIsSeenUpToAFaceWithAConcentration) {
  const auto simulation = simulation_of(study(R"(schema: 1
study: face
time: {end: 1 h, output: 1 h}
domain: {size: [200 um, 80 um, 80 um]}
cell_types: {a: {radius: 5 um, cycle: {model: none}}}
initial: [{type: a, at: [[0 um, 0 um, 0 um], [-92 um, 0 um, 0 um], [-84 um, 0 um, 20 um], [94 um, 0 um, 0 um]], as: sphere}]
fields:
  o: {diffusion: 50000 um^2/s, initial: 1 mM, voxel: 40 um, boundary: {x_low: 0 mM, x_high: 2 mM}}
)"));
  ASSERT_TRUE(simulation.ok());
  while ((*simulation)->tissue().clock.time < 3600.0) ASSERT_TRUE((*simulation)->step(3600.0).ok());
  const std::vector<Vec3d> center = (*simulation)->centers();
  std::vector<std::size_t> rows(center.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
  const auto seen = sense_field((*simulation)->model(), (*simulation)->tissue(), 0, rows, center, Comm());
  ASSERT_TRUE(seen.ok());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR((*seen)[i].gradient.x, 0.01, 1e-4) << center[i].x;
    EXPECT_NEAR((*seen)[i].concentration, 1.0 + 0.01 * center[i].x, 1e-3) << center[i].x;
  }
}

}  // namespace
}  // namespace morula::scenarios::test
