/// What an exchange of bodies does to the neighbours is found in its neighbourhood alone, and is that of the whole tissue.
#include "coupling/exchange_effects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "core/close_packing.h"
#include "coupling/simulation.h"
#include "tests/coupling/tissue_fixture.h"

namespace morula {
namespace {

using test::clusters_model;
using test::make_tissue;

constexpr double kRadius = 6.0;
constexpr double kSpacing = 11.2;  // spheres overlap [µm]

std::map<CellId, Vec3d> forces_on_all(const Model& model, ShapeLibrary& shapes, const Tissue& tissue) {
  Mechanics whole(model, contact_obstacles(model).value(), shapes, Comm(), 1);
  const std::vector<Vec3d> force = whole.net_forces(tissue);
  std::map<CellId, Vec3d> out;
  for (const BodyOfRow& body : bodies_of(tissue.cells)) out[tissue.cells.rows[body.row].id] = force[body.place(tissue.shells.size())];
  return out;
}

/// The middle cell and one far away from it become shells; every `shell_every`th other cell is one already.
void expect_effects_of_the_whole_tissue(const Model& model, std::size_t shell_every) {
  ShapeLibrary shapes;
  const std::vector<Vec3d> places = close_packed_places(4, kSpacing);
  std::vector<BodyKind> bodies(places.size(), BodyKind::kSphere);
  for (std::size_t i = 1; shell_every != 0 && i + 1 < places.size(); i += shell_every) bodies[i] = BodyKind::kShell;
  Tissue tissue = make_tissue(model, shapes, places, bodies);
  Mechanics mechanics(model, contact_obstacles(model).value(), shapes, Comm(), 1);
  const std::vector<CellId> exchanged = {CellId::founder(1), CellId::founder(places.size())};
  const std::vector<std::size_t> rows = rows_of(tissue.cells, exchanged);
  std::vector<SwapOrder> orders;
  for (const std::size_t row : rows) orders.push_back({row, BodyKind::kShell, {}});

  const auto before = forces_on_all(model, shapes, tissue);
  const std::vector<double> caps = mechanics.as_balls(tissue).caps;
  const ExchangeWatch watch = watch_exchanges(model, tissue, orders, mechanics, shapes, Comm());
  std::vector<Event> events;
  std::vector<CellRecord> changed;
  for (const BodyOfRow& body : bodies_of(tissue.cells, rows)) {
    EXPECT_NEAR(watch.caps_of(tissue.cells.rows[body.row].id), caps[body.place(tissue.shells.size())], 1e-9);
    CellRecord& cell = changed.emplace_back(record_of(tissue, body));
    promote(cell, model.types[0], 0.0, 0.0, shapes, 1);
    events.push_back({0.0, EventKind::kPromotion, cell.row.id, {}, {}, {}});
    events.back().exchange = ExchangeEffect{.room = watch.caps_of(cell.row.id)};
  }
  for (Vec3d& node : changed.back().shell->position) node += Vec3d{0.03, 0.0, 0.04};
  const CellId moved = changed.back().row.id;
  replace_cells(tissue, rows, std::move(changed));
  tell_exchanges(watch, tissue, mechanics, shapes, Comm(), events);
  const auto after = forces_on_all(model, shapes, tissue);

  // The middle cell loses twelve caps of height h = R - d/2: π h² (3R − h)/3 each.
  const double h = kRadius - 0.5 * kSpacing;
  EXPECT_NEAR(watch.caps_of(exchanged[0]), 12.0 * std::numbers::pi * h * h * (3.0 * kRadius - h) / 3.0, 1e-6);
  for (const Event& event : events) {
    const Vec3d center = places[event.cell == exchanged[0] ? 0 : places.size() - 1];
    double most = 0.0, sum = 0.0;
    std::uint32_t neighbours = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const CellId id = CellId::founder(i + 1);
      if (std::ranges::binary_search(exchanged, id) || norm(places[i] - center) > 1.2 * 2.0 * kRadius) continue;
      const double change = norm(after.at(id) - before.at(id));
      most = std::max(most, change), sum += change, ++neighbours;
    }
    EXPECT_NEAR(event.exchange->own_way, event.cell == moved ? 0.05 / kRadius : 0.0, 1e-3) << "a mesh has its middle where its ball had it";
    EXPECT_EQ(event.exchange->neighbours, neighbours);
    EXPECT_NEAR(event.exchange->largest_force, most, 1e-9 * (1.0 + most));
    EXPECT_NEAR(event.exchange->mean_force, sum / neighbours, 1e-9 * (1.0 + most));
    EXPECT_GT(most, 1e-3);
  }
  EXPECT_EQ(tissue.watched.size(), events[0].exchange->neighbours + events[1].exchange->neighbours);
}

/// Face-centred balls of which `shells` are shells and the first `count`, the middle one and those around it, become some: caps of each among shells, beyond
/// what a pressure takes of a ball.
std::vector<double> caps_among_shells(std::size_t count, const std::vector<std::size_t>& shells, double pressed = 0.0) {
  const Model model = clusters_model();
  ShapeLibrary shapes;
  const std::vector<Vec3d> places = close_packed_places(4, kSpacing);
  std::vector<BodyKind> bodies(places.size(), BodyKind::kSphere);
  for (const std::size_t i : shells) bodies[i] = BodyKind::kShell;
  const Tissue tissue = make_tissue(model, shapes, places, bodies);
  Mechanics mechanics(model, contact_obstacles(model).value(), shapes, Comm(), 1);
  std::vector<CellId> exchanged;
  for (std::size_t i = 0; i < count; ++i) exchanged.push_back(CellId::founder(i + 1));
  std::vector<SwapOrder> orders;
  for (const std::size_t row : rows_of(tissue.cells, exchanged)) orders.push_back({row, BodyKind::kShell, {}});
  const ExchangeWatch watch = watch_exchanges(model, tissue, orders, mechanics, shapes, Comm());
  std::vector<double> out;
  for (const CellId id : exchanged) out.push_back(watch.room_to_come_of(id, pressed));
  return out;
}

/// Of the middle ball all twelve neighbours become shells with it; each of these touches the middle one and four of the others.
TEST(ExchangeEffects, OfAGroupAreTheCapsOfItsBallsWithEachOther) {
  const double h = kRadius - 0.5 * kSpacing, cap = std::numbers::pi * h * h * (3.0 * kRadius - h) / 3.0;
  const std::vector<double> group = caps_among_shells(13, {});
  ASSERT_EQ(group.size(), 13u);
  EXPECT_NEAR(group[0], 12.0 * cap, 1e-9 * cap);
  for (std::size_t i = 1; i < group.size(); ++i) EXPECT_NEAR(group[i], 5.0 * cap, 1e-9 * cap);
}

/// Decision 0076: what its pressure takes from a ball is not left out once more.
TEST(ExchangeEffects, OfPressedBallsAreTheCapsBeyondWhatPressureTakes) {
  const double h = kRadius - 0.5 * kSpacing, caps = 12.0 * std::numbers::pi * h * h * (3.0 * kRadius - h) / 3.0;
  EXPECT_NEAR(caps_among_shells(13, {}, 0.25 * caps)[0], 0.75 * caps, 1e-9 * caps);
  EXPECT_EQ(caps_among_shells(13, {}, 1.1 * caps)[0], 0.0);
  EXPECT_NEAR(caps_among_shells(13, {}, -0.2 * caps)[0], caps, 1e-9 * caps);  // pulled
}

TEST(ExchangeEffects, OfACellBesideShellsAreTheCapsWithTheBallsThatTheseWouldBe) {
  const double h = kRadius - 0.5 * kSpacing, cap = std::numbers::pi * h * h * (3.0 * kRadius - h) / 3.0;
  EXPECT_EQ(caps_among_shells(1, {})[0], 0.0);
  EXPECT_NEAR(caps_among_shells(1, {2, 5})[0], 2.0 * cap, 1e-6 * cap);
}

TEST(ExchangeEffects, AmongSpheresAreThoseOfTheWholeTissue) { expect_effects_of_the_whole_tissue(clusters_model(), 0); }

TEST(ExchangeEffects, AmongShellsAndSpheresAreThoseOfTheWholeTissue) { expect_effects_of_the_whole_tissue(clusters_model(), 3); }

TEST(ExchangeEffects, AmongSpheresThatResistTheirPackingAreThoseOfTheWholeTissue) {
  Model model = clusters_model();
  model.types[0].sphere.packing = cbm::PackingCurve::through(cbm::ideal_filled_cell(2.5, 0.45, 0.4).value()).value();
  expect_effects_of_the_whole_tissue(model, 0);
  expect_effects_of_the_whole_tissue(model, 4);
}

}  // namespace
}  // namespace morula
