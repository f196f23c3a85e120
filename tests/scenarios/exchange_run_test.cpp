/// The user's road to an exchange of bodies: a study with default parameters in which a sphere becomes a shell among spheres.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <string>

#include "core/ball.h"
#include "core/mesh/topology.h"
#include "coupling/overlap.h"
#include "scenarios/measures/finished_run.h"
#include "tests/scenarios/run_into.h"
#include "tests/scenarios/simulation_of.h"
#include "tests/study/study_fixture.h"

namespace morula::scenarios {
namespace {

constexpr const char* kStudy = R"(
schema: 1
study: exchange
seed: 1
time: {end: 20 min, output: 10 min}
domain: {size: [200 um, 200 um, 200 um], boundary: open}
cell_types:
  a:
    radius: {mean: 6 um, spread: 0 %}
    cycle: {model: none}
initial:
  - {type: a, count: 13, fill: sphere, radius: 17 um}
coupling:
  hold: 1 min
  regions:
    - {name: core, shape: sphere, center: [0 um, 0 um, 0 um], radius: 8 um, as: shell, margin: 4 um, from: 10 min}
)";

/// Row of a shell's cell.
std::size_t row_of_shell(const Tissue& tissue, std::size_t shell) {
  for (const BodyOfRow& body : bodies_of(tissue.cells))
    if (body.is_shell && body.number == shell) return body.row;
  return tissue.cells.size();
}

TEST(ExchangeRun, MakesAShellThatFitsAmongSpheresAtDefaultParameters) {
  const auto study = test::read(kStudy);
  ASSERT_TRUE(study.ok()) << study.error().text();
  auto made = test::simulation_of(*study);
  ASSERT_TRUE(made.ok()) << made.error().message;
  Simulation& simulation = **made;
  while (simulation.tissue().shells.size() == 0) {
    ASSERT_LT(simulation.tissue().clock.time, 700.0);
    ASSERT_TRUE(simulation.step(1200.0).ok());
  }
  const Tissue& tissue = simulation.tissue();
  const double radius = 6.0, ball = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  for (std::size_t s = 0; s < tissue.shells.size(); ++s) {
    const auto faces = tissue.shells.topology(s).faces();
    const auto nodes = tissue.shells.nodes(s);
    const Vec3d center = volume_centroid(faces, nodes);
    const double pressed = ball * std::exp(-tissue.cells.rows[row_of_shell(tissue, s)].pressure / 2.5);
    EXPECT_NEAR(enclosed_volume(faces, nodes, center), pressed, 1e-10 * ball);  // what the pressure that it bore leaves of its ball
    double least = 1e300, most = 0.0;
    for (const Vec3d& x : nodes) least = std::min(least, norm(x - center)), most = std::max(most, norm(x - center));
    EXPECT_LT(least, 0.97 * radius);  // flat where its neighbours are,
    EXPECT_GT(most, 1.01 * radius);   // and round between them
  }
  EXPECT_FALSE(tissue.clock.capped);
  while (tissue.clock.time < 1200.0) ASSERT_TRUE(simulation.step(1200.0).ok());
  EXPECT_LT(deepest_overlap(simulation).value, 0.1);
}

/// The simulation of the study above with `more` in its section `coupling`, just after the exchange; `events` of that step.
std::unique_ptr<Simulation> just_exchanged(const std::string& more, std::vector<Event>& events) {
  const auto study = test::read(test::changed("  hold: 1 min\n", "  hold: 1 min\n" + more, kStudy));
  EXPECT_TRUE(study.ok()) << study.error().text();
  auto made = test::simulation_of(*study);
  EXPECT_TRUE(made.ok());
  while ((*made)->tissue().shells.size() == 0 && (*made)->tissue().clock.time < 700.0) {
    auto done = (*made)->step(1200.0);
    EXPECT_TRUE(done.ok());
    events = std::move(done->events);
  }
  return std::move(*made);
}

/// Two balls of 6 µm whose centres are d apart lose caps of the height h = R − d/2 each: π h² (3R − h)/3.
double caps_of_row(const Simulation& simulation, std::size_t row) {
  const std::vector<Vec3d> center = simulation.centers();
  double sum = 0.0;
  for (std::size_t j = 0; j < center.size(); ++j) {
    const double h = 6.0 - 0.5 * norm(center[j] - center[row]);
    if (j != row && h > 0.0) sum += std::numbers::pi * h * h * (18.0 - h) / 3.0;
  }
  return sum;
}

std::size_t row_of(const Tissue& tissue, CellId id) {
  return static_cast<std::size_t>(std::ranges::find(tissue.cells.rows, id, &CellRow::id) - tissue.cells.rows.begin());
}

TEST(ExchangeRun, TellsTheRoomTheForcesAndTheWaysOfTheNeighbours) {
  std::vector<Event> events;
  const auto simulation = just_exchanged("", events);
  const auto promotion = std::ranges::find(events, EventKind::kPromotion, &Event::kind);
  ASSERT_NE(promotion, events.end());
  ASSERT_TRUE(promotion->exchange.has_value());
  const std::vector<Vec3d> before = simulation->centers();
  const std::size_t shell = row_of(simulation->tissue(), promotion->cell);
  // What its pressure leaves of its ball, less the ball without what lies behind its contacts; its centre moved a little while it found its shape.
  const double ball = ball_volume(6.0), pressed = ball * std::exp(-simulation->tissue().cells.rows[shell].pressure / 2.5);
  EXPECT_NEAR(promotion->exchange->room, pressed - (ball - caps_of_row(*simulation, shell)), 1e-3);
  EXPECT_GT(promotion->exchange->room, 1.0);
  EXPECT_GT(promotion->exchange->largest_force, 1e-3);
  EXPECT_LE(promotion->exchange->mean_force, promotion->exchange->largest_force);
  std::size_t beside = 0;
  double most = 0.0;
  const double told_from = simulation->tissue().clock.time;
  std::optional<Event> settled;
  while (!settled && simulation->tissue().clock.time < 1300.0) {
    auto done = simulation->step(1400.0);
    ASSERT_TRUE(done.ok());
    for (const Event& event : done->events)
      if (event.kind == EventKind::kExchangeSettled && event.cell == promotion->cell) settled = event;
  }
  ASSERT_TRUE(settled.has_value());
  EXPECT_GE(settled->time, told_from + 600.0);
  EXPECT_LT(settled->time, told_from + 661.0);
  const std::vector<Vec3d> now = simulation->centers();
  for (std::size_t j = 0; j < now.size(); ++j) {
    if (j == shell || !(norm(before[j] - before[shell]) < 1.2 * 12.0)) continue;
    ++beside;
    most = std::max(most, norm(now[j] - before[j]) / 6.0);
  }
  EXPECT_EQ(settled->exchange->neighbours, beside);
  EXPECT_EQ(promotion->exchange->neighbours, beside);
  EXPECT_NEAR(settled->exchange->largest_way, most, 1e-9);
  EXPECT_GT(most, 0.0);
  EXPECT_TRUE(simulation->tissue().watched.empty());
}

/// Decision 0088. Default shells rest nearer to each other than default spheres: a cell that becomes a shell is where it was, and then both come together as
/// their friction lets them, and nothing moves their middle. (It went 0.36 R to its neighbour while the clock stood.)
TEST(ExchangeRun, DoesNotMoveTheCellThatBecomesAShell) {
  const auto study = test::read(R"(
schema: 1
study: pair
time: {end: 90 min, output: 5 min}
domain: {size: [200 um, 200 um, 200 um]}
cell_types: {a: {radius: 6 um}}
initial: [{type: a, as: sphere, at: [[0 um, 0 um, 0 um], [11.35 um, 0 um, 0 um]]}]
coupling: {regions: [{name: one, shape: cells, ids: [1], from: 30 min}]}
output: {report: false}
)");
  ASSERT_TRUE(study.ok()) << study.error().text();
  const test::Folder folder;
  ASSERT_TRUE(test::run_into(folder.path() / "run", *study));
  FinishedRun files(*study, folder.path() / "run");
  const auto events = files.events();
  ASSERT_TRUE(events.ok());
  const auto promotion = std::ranges::find((*events)->begin(), (*events)->end(), "promotion", &EventLine::kind);
  ASSERT_NE(promotion, (*events)->end());
  EXPECT_LT(promotion->exchange->own_way, 0.02);
  EXPECT_GT(promotion->exchange->largest_force, 0.3) << "the adhesion that draws both together [nN]";
  const auto before = files.snapshot_at(1800.0), after = files.snapshot_at(5400.0);
  ASSERT_TRUE(before.ok() && *before && after.ok() && *after);
  const Vec3d way_of_shell = (*after)->cells[0].centroid - (*before)->cells[0].centroid,
              way_of_sphere = (*after)->cells[1].centroid - (*before)->cells[1].centroid;
  EXPECT_GT(norm(way_of_shell) + norm(way_of_sphere), 0.2 * 6.0);
  EXPECT_NEAR(norm(way_of_shell) / norm(way_of_sphere), 1.0, 0.1) << "the friction of both with the medium is about the same";
  const auto series = files.series();
  ASSERT_TRUE(series.ok());
  EXPECT_LT((*series)->find("centre_drift")->values.back(), 0.02 * 6.0) << "no more than the cell went while the clock stood";
}

/// A ball of cells inflates and presses on itself; then the inner ones become shells together, in one step: one in a hundred cells may.
constexpr const char* kGroup = R"(
schema: 1
study: group
time: {end: 80 min, output: 1 min, checkpoint: 80 min}
domain: {size: [200 um, 200 um, 200 um]}
output: {report: false}
cell_types:
  cell: {radius: 6 um, cycle: {model: none}, adhesion: {cell: 1e-4 J/m^2}, dcm: {nodes: 42}}
initial:
  - {type: cell, count: 1500, fill: sphere, radius: 74 um, start_volume: 50 %, inflate: 20 min}
coupling:
  regions:
    - {name: core, shape: sphere, center: [0 um, 0 um, 0 um], radius: 12 um, margin: 20 um, from: 20 min}
)";

/// A run of the study above: what its files tell of the group of shells.
struct Grouped {
  double promotions = 0.0, volume = 0.0, room = 0.0, later = 0.0;  ///< sums [1, µm³]
  double at_once = 0.0;                                            ///< volume of the shells when they begin [µm³]
  double in_the_end = 0.0;                                         ///< and at the end
  double overlap = 0.0;                                            ///< the deepest of all rows [µm]
};

Grouped run_group(const std::string& exchange) {
  const test::Folder folder;
  const auto study = test::read(test::changed("  regions:\n", exchange + "  regions:\n", kGroup));
  EXPECT_TRUE(study.ok()) << (study.ok() ? "" : study.error().text());
  if (!study.ok()) return {};
  const std::filesystem::path out_folder = folder.path() / "run";
  test::run_into(out_folder, *study);
  FinishedRun files(*study, out_folder);
  Grouped out;
  const auto events = files.events();
  const auto series = files.series();
  EXPECT_TRUE(events.ok() && series.ok());
  if (!events.ok() || !series.ok()) return {};
  for (const EventLine& event : **events)
    if (event.kind == "promotion" && event.exchange) {
      out.promotions += 1.0, out.volume += event.exchange->volume;
      out.room += event.exchange->room, out.later += event.exchange->later;
    }
  const auto shells_at = [&](double time) {
    double sum = 0.0;
    const auto snapshot = files.snapshot_at(time);
    EXPECT_TRUE(snapshot.ok() && *snapshot);
    if (snapshot.ok() && *snapshot)
      for (const Snapshot::Cell& cell : (*snapshot)->cells)
        if (cell.body == BodyKind::kShell) sum += cell.volume;
    return sum;
  };
  out.at_once = shells_at(1200.0), out.in_the_end = shells_at(4800.0);
  const SeriesColumn* overlap = (*series)->find("worst_overlap");
  EXPECT_NE(overlap, nullptr);
  if (overlap) out.overlap = std::ranges::max(overlap->values);
  return out;
}

/// Decision 0059. The group begins with the room that its balls have between each other, and comes to its own; at once it begins deep within each other.
TEST(ExchangeRun, OfAGroupTakesItsRoomLittleByLittle) {
  const Grouped slow = run_group("");
  EXPECT_GE(slow.promotions, 8.0);
  EXPECT_GT(slow.later, 1e-3 * slow.volume);
  EXPECT_LT(slow.later, slow.room);
  EXPECT_LT(slow.at_once, slow.volume - slow.later);  // pressed as their balls were
  EXPECT_GT(slow.at_once, 0.97 * (slow.volume - slow.later));
  EXPECT_GT(slow.in_the_end, 0.98 * slow.volume);  // 6 time constants later, pressed as they are
  EXPECT_LT(slow.overlap, 0.06);
  const Grouped fast = run_group("  exchange: at_once\n");
  EXPECT_EQ(fast.promotions, slow.promotions);
  EXPECT_EQ(fast.later, 0.0);
  EXPECT_LT(fast.at_once, fast.volume);
  EXPECT_GT(fast.at_once, slow.at_once + 0.9 * slow.later);
  EXPECT_NEAR(fast.in_the_end, slow.in_the_end, 5e-3 * fast.volume);
  EXPECT_LT(fast.overlap, 0.06);
}

/// A full periodic box, pressed to 0.9 of the volume of its cells, in which all cells are shells from 30 to 60 min.
constexpr const char* kPressed = R"(
schema: 1
study: pressed
time: {end: 75 min, output: 1 min}
domain: {size: [24 um, 24 um, 24 um], boundary: periodic, course: [{time: 0 s, volume: 1}, {time: 10 min, volume: 0.9}]}
cell_types:
  a: {radius: 5 um, body: sphere, adhesion: {a: 0 J/m^2}, dcm: {nodes: 42}}
initial:
  - {type: a, count: 27, fill: random, size: [24 um, 24 um, 24 um], start_volume: 50 %, inflate: 5 min}
coupling:
  exchange: gradual
  regions: [{name: all, shape: everything, as: shell, from: 30 min, until: 60 min}]
output: {report: false}
)";

/// Decision 0076. Who is a shell does not change how much a tissue is pressed: p and the room of its cells are those of before, both ways, and nobody gains or
/// loses volume. (With the volume of their balls shells pressed each other twice as much, and spheres of the volume of pressed shells half as much.)
TEST(ExchangeRun, KeepsThePressureOfAPressedTissue) {
  for (const char* exchange : {"gradual", "at_once"}) {
    const auto study = test::read(test::changed("exchange: gradual", std::string("exchange: ") + exchange, kPressed));
    ASSERT_TRUE(study.ok()) << study.error().text();
    const test::Folder folder;
    const std::filesystem::path out = folder.path() / "run";
    ASSERT_TRUE(test::run_into(out, *study));
    FinishedRun files(*study, out);
    const auto series = files.series();
    ASSERT_TRUE(series.ok());
    const auto column = [&](const char* name) { return (*series)->find(name)->values; };
    const auto time = column("time"), pressure = column("mean_pressure"), shells = column("shell_count");
    const auto row_at = [&](double when) { return static_cast<std::size_t>(std::ranges::find(time, when) - time.begin()); };
    const std::size_t before = row_at(1740.0), as_shells = row_at(3540.0);
    ASSERT_LT(as_shells, time.size());
    EXPECT_EQ(shells[before], 0.0);
    EXPECT_EQ(shells[as_shells], 27.0);
    EXPECT_EQ(shells.back(), 0.0);
    EXPECT_GT(pressure[before], 0.2);
    for (std::size_t k = before; k < time.size(); ++k)
      EXPECT_NEAR(pressure[k] / pressure[before], 1.0, 0.16) << exchange << " at " << time[k] << " s";
    EXPECT_NEAR(pressure[as_shells] / pressure[before], 1.0, 0.08) << exchange;
    EXPECT_NEAR(pressure.back() / pressure[before], 1.0, 0.04) << exchange;
    EXPECT_LT(std::ranges::max(column("worst_overlap")), 0.2);
    // Shells that fill the room are in contact all over, and nowhere twice: faces along the edges of cells are near to two others (decision 0026).
    const auto full = files.snapshot_at(3540.0);
    ASSERT_TRUE(full.ok() && *full);
    for (const Snapshot::Cell& cell : (*full)->cells) {
      EXPECT_GT(cell.contact_area, 0.9 * cell.area);
      EXPECT_LT(cell.contact_area, 1.000001 * cell.area);
    }
  }
}

/// A trigger asks for a shell what only spheres answer so: the run says that cells go to and fro, once.
TEST(ExchangeRun, SaysThatCellsGoToAndFro) {
  std::string text = test::changed(", course: [{time: 0 s, volume: 1}, {time: 10 min, volume: 0.9}]", "", kPressed);
  text = test::changed("  exchange: gradual\n", "", text);
  text = test::changed("{end: 75 min, output: 1 min}", "{end: 45 min, output: 5 min}", text);
  text = test::changed("  regions: [{name: all, shape: everything, as: shell, from: 30 min, until: 60 min}]",
                       "  triggers: [{promote: contact_share < 0.3, demote: contact_share > 0.5, hold: 3 min}]", text);
  const auto study = test::read(text);
  ASSERT_TRUE(study.ok()) << study.error().text();
  const test::Folder folder;
  const std::filesystem::path out = folder.path() / "run";
  ASSERT_TRUE(test::run_into(out, *study));
  FinishedRun files(*study, out);
  const auto events = files.events();
  ASSERT_TRUE(events.ok());
  std::map<std::string, int> promotions;
  int warnings = 0;
  for (const EventLine& event : **events) {
    if (event.kind == "promotion") ++promotions[event.cell];
    if (event.kind != "warning" || event.text.find("became a shell for the 4th time") == std::string::npos) continue;
    ++warnings;
    EXPECT_NE(event.text.find("contact_share"), std::string::npos) << event.text;
  }
  EXPECT_EQ(warnings, 1);
  EXPECT_TRUE(std::ranges::is_sorted(**events, {}, &EventLine::time));
  EXPECT_TRUE(std::ranges::any_of(**events, [](const EventLine& event) { return event.exchange && event.exchange->own_way > 1e-4; }))
      << "how far a cell itself went is told";
  EXPECT_TRUE(std::ranges::any_of(promotions, [](const auto& one) { return one.second >= 4; }));
}

/// Decision 0059. Shells that rest in a cluster are to become spheres, whose law ends where the balls of the cluster hardly overlap: they stay shells, and
/// nobody is beyond the law. With the law's own end they all become spheres.
TEST(ExchangeRun, DoesNotMakeSpheresThatTheirLawDoesNotKnow) {
  const auto shells_and_demotions = [](const std::string& packing, const std::string& hold = "1 min") {
    const test::Folder folder;
    std::string text =
        test::changed("radius: 8 um, as: shell, margin: 4 um, from: 10 min", "radius: 80 um, as: shell, until: 10 min", kStudy);
    text = test::changed("    cycle: {model: none}\n", "    cycle: {model: none}\n    dcm: {nodes: 42}\n" + packing, text);
    text = test::changed("hold: 1 min", "hold: " + hold, text);
    const auto study = test::read(test::changed("boundary: open}\n", "boundary: open}\noutput: {report: false}\n", text));
    EXPECT_TRUE(study.ok()) << (study.ok() ? "" : study.error().text());
    if (!study.ok()) return std::pair(-1.0, -1.0);
    const std::filesystem::path out_folder = folder.path() / "run";
    test::run_into(out_folder, *study);
    FinishedRun files(*study, out_folder);
    const auto series = files.series();
    EXPECT_TRUE(series.ok());
    if (!series.ok()) return std::pair(-1.0, -1.0);
    return std::pair((*series)->find("shell_count")->values.back(), (*series)->find("demotions")->values.back());
  };
  const auto free = shells_and_demotions("");
  EXPECT_EQ(free.first, 0.0);
  EXPECT_GE(free.second, 13.0);
  const std::string packing =
      "    cbm: {packing: {law: knots, knots: [{packing: 0.1 %, pressure: 0 Pa}, {packing: 0.15 %, pressure: 2 Pa}, {packing: 0.2 %, "
      "pressure: 5 Pa}]}}\n";
  EXPECT_EQ(shells_and_demotions(packing).first, 13.0);
  EXPECT_EQ(shells_and_demotions(packing, "0 s").first, 13.0);  // asked at every step
}

/// Shells divide, and their daughters are shells: more than the budget has. The log says so once.
TEST(ExchangeRun, TellsThatShellsAreMoreThanTheirBudget) {
  const auto study = test::read(R"(
schema: 1
study: budget
time: {end: 30 min, output: 10 min}
domain: {size: [200 um, 200 um, 200 um], boundary: open}
cell_types:
  a: {body: shell, cycle: {duration: {mean: 20 min, spread: 0 %}}, dcm: {nodes: 42}}
initial:
  - {type: a, at: [[0 um, 0 um, 0 um]]}
coupling: {max_shells: 1}
)");
  ASSERT_TRUE(study.ok()) << study.error().text();
  const test::Folder folder;
  const std::filesystem::path out = folder.path();
  ASSERT_TRUE(test::run_into(out / "run", *study));
  std::ifstream log(out / "run" / "log.txt");
  const std::string text{std::istreambuf_iterator<char>(log), {}};
  const std::string note = "2 cells are shells, more than `coupling.max_shells` (1): daughters of shells are shells whatever it says";
  const auto at = text.find(note);
  ASSERT_NE(at, std::string::npos) << text;
  EXPECT_EQ(text.find("coupling.max_shells", at + note.size()), std::string::npos);
}

}  // namespace
}  // namespace morula::scenarios
