// A step that mechanics refuses leaves nothing behind: what is tried again, shorter, is what would have been done if it had been so short at once.
#include "coupling/behaviours/behaviour.h"
#include "coupling/cell_record.h"
#include "coupling/cell_view.h"
#include "coupling/laws.h"
#include "coupling/simulation.h"
#include "results/state_hash.h"
#include "study/initial/make_tissue.h"
#include "tests/coupling/same_rows.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios::test {
namespace {

/// Cells that count the time, turn, swell, and one of which begins to die.
void add_busy_cells(Laws& laws) {
  laws.behaviours.push_back(std::make_shared<const Behaviour>(
      Behaviour{.info = {.name = "busy", .title = "Busy", .equation = "a test", .source = "a test", .parameters = {}},
                .section = {.name = "busy", .doc = "A test.", .example = "{}"},
                .variables = {{.name = "time", .unit = "s"}},
                .build = [](const OwnValues&) -> Behave {
                  return [](const CellStep& step, CellWish& wish) {
                    step.state[0] += step.dt;
                    wish.volume = 1.0 + 1e-4 * step.dt;
                    wish.polarity = step.cell.polarity() + Vec3d{0.01 * step.dt, 0, 0};
                    wish.die = step.cell.row().id == CellId::founder(4);
                  };
                }}));
}

/// Far from each other, under a force that moves spheres by 0.54 µm in 60 s and by half of that in 30 s; 0.36 µm is too far for one step. Every phase
/// ends within the step, water flows in, and one cell is a shell with a nucleus.
constexpr const char* kStudy = R"(schema: 1
study: refused
time: {end: 1 h, step: 60 s}
domain: {size: [200 um, 200 um, 200 um]}
cell_types:
  sphere:
    cycle: {model: phases, phases: {G1: {duration: 40 s, law: erlang, stages: 3}, S: 30 s, M: 1 h}}
    migration: {speed: 20 um/h}
    polarity: {start: [0, 1, 0], turning: 5 1/h}
    osmosis: {permeability: 1e-3 um/s/kPa, outside: 200 mM}
    busy: {}
  shell: {like: sphere, body: shell, dcm: {nodes: 42, nucleus: {volume_fraction: 10 %}}}
contact: {range: 0.3 um}
initial:
  - {type: sphere, at: [[0 um, 0 um, 40 um], [40 um, 0 um, 0 um], [0 um, 40 um, 0 um], [0 um, 0 um, -40 um]]}
  - {type: shell, at: [[-40 um, 0 um, 0 um]]}
loads:
  pull: {type: sphere, body_force: [0.407 nN, 0 nN, 0 nN]}
)";

/// A tissue after one step that began with this length [s], and how often it was tried in vain.
std::pair<Tissue, int> after_a_step(double dt) {
  Laws laws = *builtin_laws();
  add_busy_cells(laws);
  ReadOptions options;
  options.laws = std::make_shared<const Laws>(std::move(laws));
  const auto study = read(kStudy, options);
  EXPECT_TRUE(study.ok()) << (study.ok() ? "" : study.error().text());
  if (!study.ok()) return {};
  ShapeLibrary shapes;
  Tissue tissue = make_tissue(*study, shapes, Comm()).value().tissue;
  tissue.clock.next_step = dt;
  for (std::size_t i = 0; i < tissue.cells.size(); ++i) {
    tissue.cells.optional.inflation_left.set(i, 30.0);
    tissue.cells.optional.inflation_rate.set(i, 0.1);
  }
  auto simulation = Simulation::create(study->model, std::move(tissue), Comm(), 1).value();
  const auto done = simulation->step(3600.0);
  EXPECT_TRUE(done.ok()) << (done.ok() ? "" : done.error().message);
  return {simulation->tissue(), done.ok() ? done->retries : -1};
}

TEST(RefusedStep, LeavesNothingBehind) {
  auto [refused, retries] = after_a_step(60.0);
  ASSERT_GE(retries, 1);
  auto [straight, none] = after_a_step(refused.clock.time);
  ASSERT_EQ(none, 0);
  ASSERT_EQ(straight.clock.time, refused.clock.time);
  ASSERT_EQ(straight.cells.size(), refused.cells.size());
  for (std::size_t i = 0; i < refused.cells.size(); ++i) EXPECT_TRUE(same_rows(refused.cells.state(i), straight.cells.state(i))) << i;
  refused.clock = straight.clock;  // the length that the controller wants next may differ
  EXPECT_EQ(state_hash(refused, Comm()), state_hash(straight, Comm()));
  const Cells& cells = refused.cells;
  EXPECT_GT(cells.optional.reference_excess[0], 0.0);
  EXPECT_DOUBLE_EQ(cells.optional.inflation_left[0], 30.0 - 0.1 * refused.clock.time);
  EXPECT_EQ(cells.variables.back().values[0], refused.clock.time);
}

}  // namespace
}  // namespace morula::scenarios::test
