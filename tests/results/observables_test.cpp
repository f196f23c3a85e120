#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/laws.h"
#include "coupling/observables/measures.h"
#include "results/observables/local_snapshot.h"
#include "results/observables/select_observables.h"
#include "tests/coupling/tissue_fixture.h"
#include "tests/results/results_support.h"

namespace morula::scenarios {
namespace {

constexpr double kBall = 4.0 / 3.0 * std::numbers::pi;

std::unique_ptr<Simulation> simulation_of(const std::vector<Vec3d>& centers, const std::vector<BodyKind>& bodies,
                                          Model model = test::clusters_model()) {
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, centers, bodies);
  auto made = Simulation::create(std::move(model), std::move(tissue), Comm(), 1);
  EXPECT_TRUE(made.ok());
  return std::move(made).value();
}

double value_of(const std::string& name, Simulation& simulation, const Interval& interval = {}) {
  const Measures measures = measure(simulation);
  const auto chosen = select_observables(simulation.model(), *builtin_laws(), {name});
  EXPECT_TRUE(chosen.ok());
  const CellsAtOutput cells(simulation);
  return chosen->front().value({measures, interval, simulation.tissue().clock, simulation.tissue().ledger, cells});
}

TEST(Observables, OneSphereHasItsOwnRadius) {
  const auto simulation = simulation_of({{3, 4, 5}}, {BodyKind::kSphere});
  EXPECT_NEAR(value_of("spheroid_radius", *simulation), 6.0, 1e-9);
  EXPECT_NEAR(value_of("largest_extent", *simulation), 6.0, 1e-9);
  EXPECT_NEAR(value_of("total_volume", *simulation), kBall * 216.0, 1e-9);
}

/// The far side of a shell is where its nodes are, whatever its volume says.
TEST(Observables, AStretchedShellReachesAsFarAsItsNodes) {
  Model model = test::clusters_model();
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell});
  for (Vec3d& x : tissue.shells.position) x.z *= 3.0;
  auto made = Simulation::create(std::move(model), std::move(tissue), Comm(), 1);
  ASSERT_TRUE(made.ok());
  EXPECT_NEAR(value_of("largest_extent", **made), 18.0, 0.3);
}

TEST(Observables, KnowATissueOfKnownNumbers) {
  // Two spheres and a shell, far from each other, on a line: 0, 60 and 120 µm. R_g² = 2·60²/3 + 3/5·6².
  const auto simulation = simulation_of({{-60, 0, 0}, {0, 0, 0}, {60, 0, 0}}, {BodyKind::kSphere, BodyKind::kShell, BodyKind::kSphere});
  EXPECT_EQ(value_of("cell_count", *simulation), 3.0);
  EXPECT_EQ(value_of("sphere_count", *simulation), 2.0);
  EXPECT_EQ(value_of("shell_count", *simulation), 1.0);
  EXPECT_NEAR(value_of("shell_fraction", *simulation), 1.0 / 3.0, 1e-15);
  EXPECT_EQ(value_of("count_cell", *simulation), 3.0);
  EXPECT_NEAR(value_of("total_volume", *simulation), 3.0 * kBall * 216.0, 1e-8);
  EXPECT_NEAR(value_of("spheroid_radius", *simulation), std::sqrt(5.0 / 3.0 * (2.0 * 3600.0 / 3.0 + 0.6 * 36.0)), 1e-9);
  EXPECT_NEAR(value_of("largest_extent", *simulation), 66.0, 1e-9);
  // Laplace: the free shell holds 2γ/R = 2·0.5/6 kPa inside; nobody presses on anybody.
  EXPECT_NEAR(value_of("inner_pressure", *simulation), 1.0 / 6.0, 1e-9);
  for (const char* name : {"max_pressure", "mean_pressure", "shell_pressure"}) EXPECT_EQ(value_of(name, *simulation), 0.0) << name;
  EXPECT_EQ(value_of("mean_contact_area", *simulation), 0.0);
  EXPECT_EQ(value_of("overlap", *simulation), 0.0);
  EXPECT_LT(value_of("volume_error", *simulation), 1e-12);
}

/// Of fluid shells beside spheres: there a surface can flow into gaps that no cell fills.
TEST(Observables, AnEdgeThatIsDrawnOutIsSeenWhereThereAreSpheres) {
  const auto drawn_out = [](bool fluid, BodyKind other) {
    Model model = test::clusters_model();
    model.types[0].shell.spring_stiffness = fluid ? 0.0 : 1.0;
    model.types[0].shell.sheets.clear();
    ShapeLibrary shapes;
    Tissue tissue = test::make_tissue(model, shapes, {{-60, 0, 0}, {60, 0, 0}}, {other, BodyKind::kShell});
    tissue.shells.nodes(tissue.shells.size() - 1)[0] *= 1.5;
    return measure(*std::move(Simulation::create(model, std::move(tissue), Comm(), 1)).value()).drawn_out;
  };
  const Extreme seen = drawn_out(true, BodyKind::kSphere);
  EXPECT_GT(seen.value, 5.0);
  EXPECT_EQ(seen.cell, CellId::founder(2));
  EXPECT_EQ(drawn_out(false, BodyKind::kSphere).value, 0.0);
  EXPECT_EQ(drawn_out(true, BodyKind::kShell).value, 0.0) << "all are shells";
}

TEST(Observables, VolumeErrorSeesAVolumeThatGotLost) {
  Model model = test::clusters_model();
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{-60, 0, 0}, {0, 0, 0}}, {BodyKind::kSphere, BodyKind::kShell});
  for (CellRow& row : tissue.cells.rows)
    if (row.body == BodyKind::kShell) row.target_volume *= 1.05;  // the row grew, the body did not
  const CellId shell = tissue.cells.rows[0].body == BodyKind::kShell ? tissue.cells.rows[0].id : tissue.cells.rows[1].id;
  const auto simulation = std::move(Simulation::create(model, std::move(tissue), Comm(), 1)).value();
  const Measures measures = measure(*simulation);
  // V^law = 1.05 V e^((2γ/R′ − p)K): the tension holds a little less in the larger cell.
  EXPECT_NEAR(measures.volume_error.value, 1.0 - 1.0 / 1.05, 2e-3);
  EXPECT_EQ(measures.volume_error.cell, shell);
  EXPECT_NEAR(measures.total_volume_error, 0.025 / 1.025, 1e-3);
}

TEST(Observables, OverlapCountsANucleusThatReachesThroughTheCortex) {
  Model model = test::clusters_model();
  model.types[0].interior.nucleus_fraction = 0.072;
  ShapeLibrary shapes;
  Tissue tissue = test::make_tissue(model, shapes, {{0, 0, 0}}, {BodyKind::kShell});
  const auto inside = std::move(Simulation::create(model, tissue, Comm(), 1)).value();
  EXPECT_EQ(measure(*inside).overlap.value, 0.0);
  const double radius = std::cbrt(0.072) * 6.0;
  tissue.shells.nucleus[0] = Vec3d{0, 0, 6.0 - radius + 0.4};
  const auto outside = std::move(Simulation::create(model, std::move(tissue), Comm(), 1)).value();
  const Measures measures = measure(*outside);
  EXPECT_GT(measures.overlap.value, 0.15);  // less than 0.4: points of faces lie within the sphere of the nodes
  EXPECT_LT(measures.overlap.value, 0.6);
  EXPECT_EQ(measures.overlap.cell, CellId::founder(1));
}

TEST(Observables, OverlapNamesTheCell) {
  const auto simulation = simulation_of({{0, 0, 0}, {11.7, 0, 0}}, {BodyKind::kShell, BodyKind::kShell});
  const Measures measures = measure(*simulation);
  EXPECT_GT(measures.overlap.value, 0.1);
  EXPECT_LT(measures.overlap.value, 0.3);  // spheres of mesh radius a little over 6, 11.7 apart
  EXPECT_EQ(measures.overlap.cell, CellId::founder(1));
}

TEST(Observables, FieldsAreMeasured) {
  Model model = test::clusters_model();
  fields::FieldSpec oxygen;
  oxygen.name = "oxygen";
  oxygen.diffusion = 2000.0;
  oxygen.initial = 0.2;
  oxygen.voxel = 50.0;
  model.fields = {oxygen};
  const auto simulation = simulation_of({{0, 0, 0}}, {BodyKind::kSphere}, model);
  EXPECT_NEAR(value_of("mean_oxygen", *simulation), 0.2, 1e-15);
  EXPECT_EQ(value_of("min_oxygen", *simulation), 0.2);
  EXPECT_LT(value_of("field_balance", *simulation), 1e-15);
}

TEST(Observables, StepNumbersAreMeansSinceTheLastOutput) {
  const auto simulation = simulation_of({{0, 0, 0}}, {BodyKind::kSphere});
  Interval interval;
  StepOutcome outcome;
  for (int i = 1; i <= 4; ++i) {
    outcome.mechanics.step = 10.0 * i;
    outcome.mechanics.newton = i;
    outcome.mechanics.linear_iterations = 5;
    outcome.mechanics.overlap = 0.01 * (5 - i);
    outcome.retries = i == 2;
    interval.add(outcome);
  }
  EXPECT_EQ(value_of("step_size", *simulation, interval), 25.0);
  EXPECT_EQ(value_of("newton_iterations", *simulation, interval), 2.5);
  EXPECT_EQ(value_of("linear_iterations", *simulation, interval), 5.0);
  EXPECT_EQ(value_of("retries", *simulation, interval), 1.0);
  EXPECT_EQ(value_of("worst_overlap", *simulation, interval), 0.04);
}

TEST(Observables, HaveUniqueNamesUnitsAndDocs) {
  Model model = test::clusters_model();
  model.fields.resize(1);
  model.fields[0].name = "glucose";
  std::set<std::string> names;
  for (const Observable& o : observables(model, *builtin_laws())) {
    EXPECT_TRUE(names.insert(o.name).second) << o.name;
    EXPECT_FALSE(o.unit.empty()) << o.name;
    EXPECT_TRUE(o.doc.ends_with('.')) << o.name;
  }
  EXPECT_TRUE(names.contains("mean_glucose"));
}

TEST(Observables, AnUnknownNameGetsASuggestion) {
  const auto chosen = select_observables(test::clusters_model(), *builtin_laws(), {"cell_cuont"});
  ASSERT_FALSE(chosen.ok());
  EXPECT_EQ(chosen.error().kind, ErrorKind::kInput);
  EXPECT_NE(chosen.error().help.find("cell_count"), std::string::npos);
}

TEST(LocalSnapshot, HoldsEveryCellWithItsBody) {
  const auto simulation = simulation_of({{-60, 0, 0}, {0, 0, 0}, {60, 0, 0}}, {BodyKind::kSphere, BodyKind::kShell, BodyKind::kShell});
  const Snapshot snapshot = local_snapshot(*simulation);
  ASSERT_EQ(snapshot.cells.size(), 3u);
  ASSERT_EQ(snapshot.shells.size(), 2u);
  EXPECT_EQ(snapshot.nodes.size(), 324u);
  EXPECT_EQ(snapshot.topologies.size(), 1u);
  EXPECT_EQ(snapshot.topologies[0].size(), 320u);
  for (const Snapshot::Shell& shell : snapshot.shells) {
    const Snapshot::Cell& cell = snapshot.cells[shell.cell];
    EXPECT_EQ(cell.body, BodyKind::kShell);
    Vec3d mean{};
    for (std::uint32_t n = 0; n < shell.node_count; ++n) mean += snapshot.nodes[shell.first_node + n] * (1.0 / shell.node_count);
    EXPECT_LT(norm(mean - cell.centroid), 0.1);
    EXPECT_NEAR(cell.radius, 6.0, 1e-6);
    EXPECT_NEAR(cell.volume, kBall * 216.0, 1e-6);
  }
}

}  // namespace
}  // namespace morula::scenarios
