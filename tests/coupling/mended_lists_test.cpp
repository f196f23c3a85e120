/// After events scene and lists are mended, and no bit tells whether they were mended or made anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>

#include "core/contact/contact_layer.h"
#include "core/space/curve.h"
#include "coupling/behaviours/birth.h"
#include "coupling/cell_record.h"
#include "coupling/simulation.h"

namespace morula {
namespace {

/// A tissue in which much happens at a time: cells of both bodies divide within minutes, some die, and a ball in the middle is of shells now, of
/// spheres then.
Model living_model(bool periodic) {
  Model model;
  model.seed = 5;
  model.space.box = periodic ? Box{{-26, -26, -26}, {26, 26, 26}} : Box{{-80, -80, -80}, {80, 80, 80}};
  if (periodic)
    for (auto& axis : model.space.boundary) axis = {BoundaryKind::kPeriodic, BoundaryKind::kPeriodic};
  CellType type;
  type.name = "cell";
  type.cycles = true;
  type.cycle_duration = {2200.0, 0.3};
  type.migration.speed = 20.0 / 3600.0;
  type.apoptosis_time = 200.0;
  type.shell_nodes = 42;
  type.shell.spring_stiffness = 0.173;
  type.shell.tension = 0.2;
  type.shell.hinge_stiffness = 1e-3;
  model.types = {type};
  model.pairs = {ContactPair{0.05, 50.0, 50.0}};
  model.contact.range = 0.8;
  for (int k = 0; k < 20; ++k) {
    Region core;
    core.name = "core";
    core.radius = k % 2 == 0 ? 12.0 : 6.0;
    core.margin = 0.5;
    core.center = {k % 3 * 4.0, 0.0, 0.0};
    core.from = 120.0 * k;
    core.until = 120.0 * (k + 1);
    model.swaps.regions.push_back(core);
  }
  model.swaps.hold = 30.0;
  model.step.max_step = 15.0;
  return model;
}

Tissue tissue_of(const Model& model, std::vector<CellRecord> cells) {
  Tissue tissue;
  tissue.clock.next_step = model.step.max_step;
  put_together(tissue, std::move(cells));
  return tissue;
}

Tissue living_tissue(const Model& model) {
  std::vector<CellRecord> cells;
  std::uint64_t number = 0;
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y)
      for (int z = -3; z <= 3; ++z) {
        if ((x + y + z) % 2 != 0) continue;
        CellRecord& cell = cells.emplace_back();
        cell.row = make_founder(CellId::founder(++number), 0, model.types[0], model.seed, 0.0, true);
        const Vec3d center{7.4 * x + 0.1, 7.4 * y - 0.2, 7.4 * z + 0.3};
        cell.row.order = curve_place(center);
        cell.sphere = SphereRecord{center, 5.0, {}, {}};
        if (number % 3 != 0) continue;
        cell.row.phase = Phase::kDying;
        cell.row.death_time = -2.5 * static_cast<double>(number);
      }
  return tissue_of(model, std::move(cells));
}

/// Which cells differ in anything, in words; empty: none.
std::string difference(const Tissue& a, const Tissue& b) {
  if (a.cells.size() != b.cells.size()) return "another number of cells";
  std::string out;
  const auto bytes_of = [](const CellRecord& cell) {
    std::vector<std::byte> bytes;
    append_bytes(cell, bytes);
    return bytes;
  };
  for (const BodyOfRow& body : bodies_of(a.cells)) {
    const CellRecord one = record_of(a, body), other = record_of(b, body);
    if (bytes_of(one) == bytes_of(other)) continue;
    out += one.row.id.text() + (body.is_shell ? " shell" : " sphere");
    if (one.sphere && other.sphere && one.sphere->attached != other.sphere->attached) out += " with other partners";
    out += "; ";
  }
  return out;
}

/// Two simulations of one model, one of which makes everything anew in every step.
struct Both {
  std::unique_ptr<Simulation> mended, anew;
  std::map<EventKind, int> events;
  int after_events = 0;  ///< steps right after one
  int went_on = 0;       ///< of these, those whose lists were older than the step: what they allow of motion was not used up by it alone

  Both(const Model& model, int threads) : Both(model, threads, living_tissue(model)) {}
  Both(const Model& model, int threads, const Tissue& tissue) {
    for (auto* simulation : {&mended, &anew}) {
      auto created = Simulation::create(model, tissue, Comm(), threads);
      EXPECT_TRUE(created.ok() && (*created)->first_swaps().ok());
      *simulation = std::move(created).value();
    }
  }
  void steps(int count) {
    for (int k = 0; k < count; ++k) {
      const auto done = mended->step(1e6);
      ASSERT_TRUE(done.ok()) << done.error().message;
      anew->mechanics().bodies_changed();
      ASSERT_TRUE(anew->step(1e6).ok());
      if (happened_) {
        ++after_events;
        went_on += mended->mechanics().contacts().skin_used() > 1.2 * anew->mechanics().contacts().skin_used();
      }
      happened_ = !done->events.empty();
      for (const Event& event : done->events) ++events[event.kind];
      ASSERT_EQ(mended->tissue().clock.time, anew->tissue().clock.time);
      ASSERT_EQ(difference(mended->tissue(), anew->tissue()), "") << "after step " << k + 1;
    }
  }
  [[nodiscard]] int all() const {
    int out = 0;
    for (const auto& [kind, count] : events) out += count;
    return out;
  }

 private:
  bool happened_ = false;
};

TEST(MendedLists, GiveTheBitsOfNewOnesInALivingTissue) {
  Both both(living_model(false), 1);
  both.steps(170);
  EXPECT_GE(both.events[EventKind::kDivision], 30);
  EXPECT_GE(both.events[EventKind::kRemoval], 10);
  EXPECT_GE(both.events[EventKind::kPromotion], 10);
  EXPECT_GE(both.events[EventKind::kDemotion], 10);
  EXPECT_GE(both.all(), 200);
  EXPECT_GT(3 * both.went_on, both.after_events);  // they were mended, and not made anew; what moves fast uses up its lists
}

TEST(MendedLists, GiveTheBitsOfNewOnesInAPeriodicBox) {
  Both both(living_model(true), 1);
  both.steps(70);
  EXPECT_GE(both.all(), 50);
}

/// A ball of spheres that swells, in which now and then one divides: the daughters part fast, all others keep their distances. The lists of pairs are made
/// anew now and then, and not whenever a daughter has gone far.
TEST(MendedLists, OutliveFastSistersInASwellingBall) {
  Model model = living_model(false);
  model.swaps.regions.clear();
  CellType& type = model.types[0];
  type.cycle_duration = {12.0 * 3600.0, 0.1};
  type.migration.speed = 0.0;
  model.step.max_step = 60.0;
  std::vector<CellRecord> cells;
  std::uint64_t number = 0;
  for (int x = -6; x <= 6; ++x)
    for (int y = -6; y <= 6; ++y)
      for (int z = -6; z <= 6; ++z) {
        if ((x + y + z) % 2 != 0) continue;
        CellRecord& cell = cells.emplace_back();
        cell.row = make_founder(CellId::founder(++number), 0, type, model.seed, 0.0, true);
        const Vec3d center = Vec3d{1.0 * x, 1.0 * y, 1.0 * z} * 6.6;
        cell.row.order = curve_place(center);
        cell.sphere = SphereRecord{center, std::cbrt(0.75 / std::numbers::pi * cell.row.target_volume), {}, {}};
      }
  const Tissue ball = tissue_of(model, std::move(cells));
  Both on_threads(model, 2, ball);
  on_threads.steps(20);
  EXPECT_GE(on_threads.events[EventKind::kDivision], 3);
  Both both(model, 1, ball);
  both.steps(120);
  EXPECT_GE(both.events[EventKind::kDivision], 20);
  EXPECT_GT(both.after_events, 15);
  EXPECT_LT(both.mended->mechanics().contacts().times_rebuilt(), 20u);  // 41 where the fastest sphere sets the time
}

}  // namespace
}  // namespace morula
