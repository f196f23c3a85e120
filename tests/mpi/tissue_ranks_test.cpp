/// A hybrid tissue on all ranks against the same tissue on one: the same bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <string>

#include "core/space/curve.h"
#include "coupling/behaviours/birth.h"
#include "coupling/cell_variables.h"
#include "coupling/simulation.h"
#include "coupling/swaps.h"
#include "tests/coupling/crowded_nodes.h"
#include "tests/coupling/tissue_fixture.h"
#include "tests/fields/helpers.h"

namespace morula {
namespace {

/// `interior`: shells have a nucleus on links, and water flows.
Model hybrid_model(bool interior = false) {
  Model model;
  model.seed = 5;
  model.space.box = {{-80, -80, -80}, {80, 80, 80}};
  CellType type;
  type.name = "cell";
  type.cycles = true;
  type.cycle_duration = {6 * 3600.0, 0.1};
  type.migration.speed = 2.0 / 3600.0;
  type.shell_nodes = 42;
  type.shell.spring_stiffness = 0.173;
  type.shell.tension = 0.2;
  type.shell.hinge_stiffness = 1e-3;
  if (interior) {
    type.interior.nucleus_fraction = 0.1;
    type.interior.nucleus_links = {20, 0.01, 0.1, false};
    type.interior.cortex_links = {dcm::LinkParameters::kAll, 0.005, 0.0, true};
    type.osmosis.permeability = 1e-3;
    type.osmosis.outside = 270.0;
    type.osmosis.field = 0;
  }
  model.types = {type};
  model.pairs = {ContactPair{0.05, 50.0, 50.0}};
  model.contact.range = 0.8;
  fields::FieldSpec oxygen;
  oxygen.name = "oxygen";
  oxygen.diffusion = 2000.0;
  oxygen.initial = 0.2;
  oxygen.voxel = 10.0;
  for (auto& axis : oxygen.boundary)
    for (auto& face : axis) face = {fields::FaceCondition::Kind::kValue, 0.2};
  oxygen.reactions = {fields::test::uptake_of(40.0, 0.005)};
  model.fields = {oxygen};
  Region core;
  core.name = "core";
  core.radius = 11.0;
  core.margin = 1.0;
  model.swaps.regions = {core};
  model.swaps.hold = 300.0;
  model.step.max_step = 30.0;
  return model;
}

/// Only the root runs what is to be compared with alone: four ranks that all did it would share two cores.
bool is_asked(const Comm& comm) { return comm.size() > 1 || Comm(MPI_COMM_WORLD).is_root(); }

/// Cells within √reach2 rows of the middle: 43, or 19 for 4, or 13 for 2.
Tissue hybrid_tissue(const Model& model, const Comm& comm, int reach2 = 6) {
  std::vector<CellRecord> cells;
  std::uint64_t number = 0;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z) {
        if ((x + y + z) % 2 != 0 || x * x + y * y + z * z > reach2) continue;
        const CellId id = CellId::founder(++number);
        if (static_cast<int>(number % static_cast<std::uint64_t>(comm.size())) != comm.rank()) continue;
        CellRecord& cell = cells.emplace_back();
        cell.row = make_founder(id, 0, model.types[0], model.seed, 0.0, true);
        const Vec3d center{8.3 * x + 0.1, 8.3 * y - 0.2, 8.3 * z + 0.3};
        cell.row.order = curve_place(center);
        cell.sphere = SphereRecord{center, 6.0, {}, {}};
      }
  Tissue tissue;
  put_together(tissue, std::move(cells));
  return tissue;
}

/// Everything of every cell on every rank, by id.
std::map<std::uint64_t, std::vector<std::byte>> everything(const Simulation& simulation) {
  Tissue copy = simulation.tissue();
  std::vector<std::byte> bytes;
  for (const CellRecord& cell : take_apart(copy)) {
    std::vector<std::byte> one;
    append_bytes(cell, one);
    const std::uint64_t head[2] = {cell.row.id.bits(), one.size()};
    const auto* raw = reinterpret_cast<const std::byte*>(head);  // NOLINT
    bytes.insert(bytes.end(), raw, raw + sizeof head);
    bytes.insert(bytes.end(), one.begin(), one.end());
  }
  const auto all = simulation.comm().gather_to_all(bytes);
  std::map<std::uint64_t, std::vector<std::byte>> out;
  for (std::size_t at = 0; at < all.size();) {
    std::uint64_t head[2];
    std::memcpy(head, all.data() + at, sizeof head);
    at += sizeof head;
    out[head[0]] = {all.begin() + static_cast<std::ptrdiff_t>(at), all.begin() + static_cast<std::ptrdiff_t>(at + head[1])};
    at += head[1];
  }
  return out;
}

std::map<std::uint64_t, std::vector<std::byte>> run(const Model& model, const Comm& comm, int steps, int threads,
                                                    std::vector<double>* field_total = nullptr, Ledger* ledger = nullptr, int reach2 = 6) {
  if (!is_asked(comm)) return {};
  auto created = Simulation::create(model, hybrid_tissue(model, comm, reach2), comm, threads);
  EXPECT_TRUE(created.ok());
  Simulation& simulation = **created;
  EXPECT_TRUE(simulation.first_swaps().ok());
  for (int k = 0; k < steps; ++k) {
    const auto done = simulation.step(1e6);
    if (!done.ok()) {
      ADD_FAILURE() << done.error().message;
      break;
    }
  }
  if (ledger != nullptr) *ledger = simulation.tissue().ledger;
  if (field_total != nullptr) field_total->push_back(fields::total_amount(simulation.tissue().fields[0], comm));
  return everything(simulation);
}

using Everything = std::map<std::uint64_t, std::vector<std::byte>>;

void expect_same(const Everything& together, const Everything& single) {
  if (!Comm(MPI_COMM_WORLD).is_root()) return;
  ASSERT_EQ(together.size(), single.size());
  std::size_t different = 0;
  for (const auto& [id, bytes] : single) {
    const auto found = together.find(id);
    ASSERT_NE(found, together.end()) << CellId(id).text();
    if (found->second != bytes && ++different < 4) ADD_FAILURE() << "cell " << CellId(id).text() << " differs";
  }
  EXPECT_EQ(different, 0u);
}

TEST(TissueOnRanks, HasTheSameBitsAsOnOne) {
  const Comm world(MPI_COMM_WORLD), alone(MPI_COMM_SELF);
  std::vector<double> amount;
  const auto together = run(hybrid_model(), world, 60, 1, &amount);
  const auto single = run(hybrid_model(), alone, 60, 1, &amount);
  EXPECT_GT(together.size(), 19u);
  if (world.is_root()) {
    EXPECT_EQ(amount[0], amount[1]);
  }
  expect_same(together, single);
}

/// A ball of so many spheres that what they do in common is found, and does not shorten their steps (common_way.h).
TEST(TissueOnRanks, SwellsWithTheSameBitsAsOnOne) {
  const Comm world(MPI_COMM_WORLD), alone(MPI_COMM_SELF);
  Model model = hybrid_model();
  model.swaps.regions.clear();
  model.fields.clear();
  model.step.max_step = 120.0;
  const auto swollen = [&](const Comm& comm) -> Everything {
    if (!is_asked(comm)) return {};
    std::vector<CellRecord> cells;
    std::uint64_t number = 0;
    for (int i = 0; i < 2197; ++i) {
      const Vec3d row{i % 13 - 6.0, i / 13 % 13 - 6.0, i / 169 - 6.0}, center = row * 9.0 + Vec3d{0.1, -0.2, 0.3};
      if (norm2(row) > 42.0) continue;
      const CellId id = CellId::founder(++number);
      if (static_cast<int>(number % static_cast<std::uint64_t>(comm.size())) != comm.rank()) continue;
      CellRecord& cell = cells.emplace_back();
      cell.row = make_founder(id, 0, model.types[0], model.seed, 0.0, true);
      cell.row.order = curve_place(center);
      cell.sphere = SphereRecord{center, 6.0, {}, {}};
    }
    Tissue tissue;
    put_together(tissue, std::move(cells));
    auto created = Simulation::create(model, std::move(tissue), comm, 1);
    EXPECT_TRUE(created.ok());
    bool beyond = false;
    for (int k = 0; k < 12; ++k) {
      const auto done = (*created)->step(1e6);
      EXPECT_TRUE(done.ok());
      beyond = beyond || (done.ok() && done->mechanics.way < 0.8 * 2.0 * done->mechanics.displacement);
    }
    EXPECT_TRUE(beyond);
    return everything(**created);
  };
  const Everything together = swollen(world), single = swollen(alone);
  EXPECT_GT(together.size(), 1000u);
  expect_same(together, single);
}

/// Parts of a tissue may have no cell on some of the ranks that look at them: these take part all the same.
TEST(TissueOnRanks, FindsTheForcesOnSomeWhereARankHasNobody) {
  const Comm world(MPI_COMM_WORLD);
  const Model model = morula::test::clusters_model();
  ShapeLibrary shapes;
  const std::vector<Vec3d> places{{0, 0, 0}, {11, 0, 0}, {22, 0, 0}, {33, 0, 0}};
  const std::vector<BodyKind> bodies{BodyKind::kShell, BodyKind::kSphere, BodyKind::kShell, BodyKind::kSphere};
  const Tissue whole = morula::test::make_tissue(model, shapes, places, bodies, 42), here = world.is_root() ? whole : Tissue{};
  std::vector<char> wanted(here.cells.size(), 0);
  if (world.is_root()) wanted[0] = 1;
  Mechanics together(model, {}, shapes, world, 1), alone(model, {}, shapes, Comm(), 1);
  const std::vector<Vec3d> some = together.net_forces_on(here, wanted), all = alone.net_forces(whole);
  ASSERT_EQ(some.size(), here.cells.size());
  if (!world.is_root()) return;
  EXPECT_EQ(some[0], all[0]);
  EXPECT_GT(norm(all[0]), 0.0);
}

/// Shells all over the tissue give way to spheres while their neighbours lie on other ranks: who adheres to whom comes from there.
TEST(TissueOnRanks, DemotesWithTheSameBitsAsOnOne) {
  const Comm world(MPI_COMM_WORLD), alone(MPI_COMM_SELF);
  Model model = hybrid_model();
  model.types[0].cycles = false;
  model.swaps.regions[0].shape = everything_region();
  model.swaps.regions[0].until = 60.0;
  model.swaps.hold = 60.0;
  model.step.max_step = 15.0;
  Ledger ledger;
  const auto together = run(model, world, 17, 1, nullptr, &ledger, 4);
  const auto single = run(model, alone, 17, 1, nullptr, nullptr, 4);
  EXPECT_GE(ledger.demotions, 5u);
  EXPECT_LT(ledger.demotions, together.size());  // the last state holds both bodies
  expect_same(together, single);
}

/// Cells become shells one after the other while their neighbours lie on other ranks: each finds its shape on one rank, between cells of several.
TEST(TissueOnRanks, PromotesWithTheSameBitsAsOnOne) {
  const Comm world(MPI_COMM_WORLD), alone(MPI_COMM_SELF);
  Model model = hybrid_model();
  model.swaps.regions[0].radius = 13.0;
  model.swaps.regions[0].from = 60.0;
  Ledger ledger;
  const auto together = run(model, world, 20, 1, nullptr, &ledger);
  EXPECT_GE(ledger.promotions, 8u);
  expect_same(together, run(model, alone, 20, 2));
}

/// Shells divide among shells of other ranks: their daughters stay out of these, and cling to their sisters wherever these live.
TEST(TissueOnRanks, DividesShellsWithTheSameBitsAsOnOne) {
  const Comm world(MPI_COMM_WORLD), alone(MPI_COMM_SELF);
  Model model = hybrid_model();
  model.types[0].cycle_duration = {600.0, 0.3};
  model.swaps.regions[0].shape = everything_region();
  model.step.max_step = 15.0;
  Ledger ledger;
  const auto together = run(model, world, 20, 1, nullptr, &ledger, 2);
  const auto single = run(model, alone, 20, 1, nullptr, nullptr, 2);
  EXPECT_GE(ledger.divisions, 3u);
  EXPECT_EQ(together.size(), 13u + ledger.divisions);
  expect_same(together, single);
}

/// Thirteen shells whose nodes crowd about their equators, after some steps.
Everything renewed_shells(const Model& model, const Comm& comm, bool as_rods = false) {
  if (!is_asked(comm)) return {};
  Tissue tissue = hybrid_tissue(model, comm, 2);
  std::vector<CellRecord> cells = take_apart(tissue);
  ShapeLibrary shapes;
  for (CellRecord& cell : cells) {
    // Room for each: a ball of radius 5.5, or a rod as long as that and a fifth as wide.
    const double volume = cell.row.birth_volume = cell.row.target_volume = as_rods ? 23.0 : 700.0;
    cell.row.division_volume = 2.0 * volume;
    cell.shell = spherical_shell(shapes.icosphere(162).value(), cell.sphere->position, volume, volume);
    if (!as_rods) test::crowd(cell.shell->position, 0.42);
    for (Vec3d& x : cell.shell->position) {
      const Vec3d d = x - cell.sphere->position;
      if (as_rods) x = cell.sphere->position + Vec3d{3.0 * d.x, d.y / std::sqrt(3.0), d.z / std::sqrt(3.0)};
    }
    cell.sphere.reset();
  }
  put_together(tissue, std::move(cells));
  auto simulation = Simulation::create(model, std::move(tissue), comm, 1);
  EXPECT_TRUE(simulation.ok());
  for (int k = 0; k < 5; ++k) EXPECT_TRUE((*simulation)->step(1e6).ok());
  return everything(**simulation);
}

TEST(TissueOnRanks, RenewsMeshesWithTheSameBitsAsOnOne) {
  Model model = hybrid_model();
  model.types[0].renew_mesh_below = 0.5;
  dcm::ShellParameters& shell = model.types[0].shell;  // fluid: nothing brings the nodes back
  shell.spring_stiffness = shell.hinge_stiffness = shell.shape_stiffness = 0.0;
  model.swaps = {};
  model.step.max_step = 0.1;
  const Everything together = renewed_shells(model, Comm(MPI_COMM_WORLD)), single = renewed_shells(model, Comm(MPI_COMM_SELF));
  ASSERT_EQ(together.size(), 13u);
  ShapeLibrary shapes;
  double renewed = 0.0;
  for (const auto& [id, bytes] : together)
    renewed += read_records(bytes, shapes)[0].row.variable(mesh_renewal_variable(model, MeshRenewal::kDone));
  EXPECT_GE(renewed, 10.0);
  expect_same(together, single);
}

TEST(TissueOnRanks, GivesShellsMeshesOfTheirOwnWithTheSameBitsAsOnOne) {
  Model model = hybrid_model();
  model.types[0].renew_mesh_below = 0.6;
  model.types[0].own_mesh = true;
  dcm::ShellParameters& shell = model.types[0].shell;
  shell.spring_stiffness = shell.hinge_stiffness = shell.shape_stiffness = 0.0;
  model.swaps = {};
  model.step.max_step = 0.1;
  const Everything together = renewed_shells(model, Comm(MPI_COMM_WORLD), true), single = renewed_shells(model, Comm(MPI_COMM_SELF), true);
  ASSERT_EQ(together.size(), 13u);
  ShapeLibrary shapes;
  int own = 0;
  for (const auto& [id, bytes] : together) own += read_records(bytes, shapes)[0].shell->shape->icosphere_nodes == 0 ? 1 : 0;
  EXPECT_GE(own, 10);
  expect_same(together, single);
}

/// Events of a run of cells that become shells, spheres again, and divide, each as a line for people.
std::vector<std::string> events_in_words(const Comm& comm) {
  if (!is_asked(comm)) return {};
  Model model = hybrid_model();
  model.types[0].cycle_duration = {900.0, 0.3};
  model.swaps.regions[0].until = 60.0;
  model.swaps.hold = 60.0;
  model.step.max_step = 15.0;
  auto simulation = Simulation::create(model, hybrid_tissue(model, comm), comm, 1);
  EXPECT_TRUE(simulation.ok());
  std::vector<std::string> out;
  const auto tell = [&](const std::vector<Event>& events) {
    for (const Event& event : events)
      out.push_back(std::to_string(event.time) + ' ' + std::to_string(static_cast<int>(event.kind)) + ' ' + event.cell.text() + ' ' +
                    event.first_daughter.text() + ' ' + event.second_daughter.text() + ' ' + text_of(event.reason, model));
  };
  const auto placed = (*simulation)->first_swaps();
  EXPECT_TRUE(placed.ok());
  if (placed.ok()) tell(*placed);
  for (int k = 0; k < 22; ++k) {
    const auto done = (*simulation)->step(1e6);
    EXPECT_TRUE(done.ok());
    if (!done.ok()) break;
    tell(done->events);
  }
  return out;
}

TEST(TissueOnRanks, TellsEventsWordForWordAsOnOne) {
  const std::vector<std::string> together = events_in_words(Comm(MPI_COMM_WORLD)), single = events_in_words(Comm(MPI_COMM_SELF));
  if (Comm(MPI_COMM_WORLD).is_root()) {
    EXPECT_EQ(together, single);
  }
  for (const char* words : {"region core", "outside", "reached its division volume"})
    EXPECT_TRUE(std::any_of(together.begin(), together.end(), [&](const std::string& line) { return line.ends_with(words); })) << words;
}

/// The pressure of a sphere's packing comes from all its neighbours, those of other ranks and shells, too.
TEST(TissueOnRanks, PacksWithTheSameBitsAsOnOne) {
  const Comm world(MPI_COMM_WORLD), alone(MPI_COMM_SELF);
  Model model = hybrid_model();
  model.types[0].sphere.packing =
      cbm::PackingCurve::through(std::vector<cbm::PackingKnot>{{0.005, 0.0}, {0.02, 0.05}, {0.05, 0.2}, {0.2, 0.5}}).value();
  expect_same(run(model, world, 40, 1), run(model, alone, 40, 1));
}

TEST(TissueOnRanks, WithNucleiLinksAndOsmosisHasTheSameBitsAsOnOne) {
  const Comm world(MPI_COMM_WORLD), alone(MPI_COMM_SELF);
  const Everything single = run(hybrid_model(true), alone, 25, 2);
  expect_same(run(hybrid_model(true), world, 25, 1), single);
  if (world.is_root()) {
    EXPECT_NE(single, run(hybrid_model(), alone, 25, 1)) << "the interior acts";
  }
}

/// Nuclei that are shells come with promotions, go with demotions, and move between ranks with their cells.
TEST(TissueOnRanks, WithNucleiThatAreShellsHasTheSameBitsAsOnOne) {
  const Comm world(MPI_COMM_WORLD), alone(MPI_COMM_SELF);
  Model model = hybrid_model(true);
  dcm::InteriorParameters& p = model.types[0].interior;
  p.nucleus_nodes = 42;
  p.nucleus_shell.spring_stiffness = 0.8;
  p.nucleus_shell.tension = 0.05;
  p.nucleus_shell.bulk_modulus = 10.0;
  const Everything single = run(model, alone, 25, 2);
  expect_same(run(model, world, 25, 1), single);
  if (world.is_root()) {
    EXPECT_NE(single, run(hybrid_model(true), alone, 25, 1)) << "they are no rigid ones";
  }
}

/// Why a step cannot be done is the same text on all ranks: that of the worst, of equals that of the first cell.
TEST(TissueOnRanks, TellTheWorstThatAnyOfThemHasFound) {
  const Comm world(MPI_COMM_WORLD);
  const int rank = world.rank(), last = world.size() - 1;
  const auto found = [&](double badness) {
    const CellId cell = CellId::founder(static_cast<std::uint64_t>(10 - rank));
    return worst_of_all_ranks({std::string(static_cast<std::size_t>(rank + 1), 'x'), cell, true, badness}, world);
  };
  const StepFault rising = found(rank), falling = found(-rank), equal = found(2.0);
  EXPECT_EQ(rising.what.size(), static_cast<std::size_t>(last + 1));
  EXPECT_EQ(rising.badness, last);
  EXPECT_EQ(falling.what.size(), 1u);
  EXPECT_EQ(falling.cell, CellId::founder(10));
  EXPECT_EQ(equal.cell, CellId::founder(static_cast<std::uint64_t>(10 - last)));
}

}  // namespace
}  // namespace morula
