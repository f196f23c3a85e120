// What a step of life has asked for: daughters in place of mothers, and dead cells gone.
#include <algorithm>
#include <bitset>
#include <cmath>
#include <optional>

#include "cbm/partners.h"
#include "core/parallel/pack.h"
#include "core/parallel/threads.h"
#include "coupling/around_divisions.h"
#include "coupling/behaviours/division.h"
#include "coupling/behaviours/division_axis.h"
#include "coupling/behaviours/life.h"
#include "coupling/behaviours/shell_division.h"
#include "coupling/beside_nucleus.h"
#include "coupling/cell_record.h"
#include "coupling/overlap.h"
#include "coupling/settle_shells.h"
#include "coupling/simulation.h"
#include "coupling/surroundings.h"
#include "coupling/swaps.h"

namespace morula {
namespace {

/// Planes that a shell tries at one time.
constexpr std::uint64_t kTries = 4;
/// Neighbours farther away than this cannot be reached by a daughter [µm].
constexpr double kReach = 2.0;
/// Part of the overlap at which a run stops that daughters may begin with.
constexpr double kMostOfLimit = 0.75;

/// A cell that is to divide.
struct Mother {
  BodyOfRow body{};
  double late = 0.0;  ///< [s]
  CellRecord cell{};
};

std::vector<Mother> mothers_of(const Tissue& tissue, std::span<const DivisionOrder> orders) {
  std::vector<Mother> out;
  auto order = orders.begin();
  for (const BodyOfRow& body : bodies_of(tissue.cells)) {
    if (order == orders.end()) break;
    if (order->row != body.row) continue;
    out.push_back({body, order->late, record_of(tissue, body)});
    ++order;
  }
  return out;
}

/// Both daughters, or none where no plane served.
using Daughters = std::vector<CellRecord>;

Daughters divide_as_sphere(const CellRecord& mother, const DaughterRows& rows, const Vec3d& axis) {
  const SphereDivision bodies = divide_sphere({mother.sphere->position, mother.sphere->radius}, axis, rows.share);
  Daughters out(2);
  for (int which = 0; which < 2; ++which) {
    const SphereBody& body = which == 0 ? bodies.first : bodies.second;
    const auto& row = out[which].row = which == 0 ? rows.first : rows.second;
    const double grown = std::cbrt(row.target_volume / row.birth_volume);  // she was born within the step
    out[which].sphere = SphereRecord{body.position, body.radius * grown, mother.sphere->velocity,
                                     cbm::daughter_partners(mother.sphere->attached, (which == 0 ? rows.second : rows.first).id)};
  }
  return out;
}

/// V0 of a daughter that has the pressure of her mother where one of them has a nucleus that is a shell: what lies beside it counts.
void share_beside_nuclei(const CellRecord& mother, const CellType& type, const CellType& own, const CellState& row,
                         dcm::ShellRecord& shell) {
  if (!type.interior.has_nuclear_shell() && !own.interior.has_nuclear_shell()) return;
  const dcm::ShellRecord& whole = *mother.shell;
  const double beside = volume_beside_nucleus(type, volume_of(whole), whole.nuclear_shell ? volume_of(*whole.nuclear_shell) : 0.0);
  shell.reference_volume = whole.reference_volume * volume_beside_resting_nucleus(own, volume_of(shell), row.birth_volume) / beside;
}

Daughters divide_as_shell(const CellRecord& mother, const CellType& type, const AroundDivision& around, const DaughterRows& rows,
                          const ShellToDivide& what, std::uint32_t seed) {
  const CellAtDivision cell{mother.row, type, {mother.shell->position, mother.shell->shape->topology.get()}, around};
  for (std::uint64_t attempt = 0; attempt < kTries; ++attempt) {
    const Vec3d axis = division_axis(cell, seed, attempt);
    auto divided = divide_shell(what, axis, rows.share, {rows.first.birth_volume, rows.second.birth_volume});
    if (!divided.ok()) continue;
    Daughters out(2);
    for (std::size_t which = 0; which < 2; ++which) {
      const CellType& own = *what.type[which];
      CellState& row = out[which].row = which == 0 ? rows.first : rows.second;
      dcm::ShellRecord& shell = (*divided)[which];
      share_beside_nuclei(mother, type, own, row, shell);
      // A daughter keeps the pressure: V0 goes with the volume. Osmolytes are shared with the target volume, and water follows them.
      row.reference_excess =
          std::log(shell.reference_volume / free_reference_volume(row.birth_volume, own, deviation(row, own, Trait::kTension)));
      out[which].shell = std::move(shell);
    }
    return out;
  }
  return {};
}

/// Both daughters of a cell; `shape`: of the daughters of shells, by type.
Daughters divide(const Mother& dividing, const AroundDivision& around, const Model& model, const Tissue& tissue, const Mechanics& mechanics,
                 std::span<const std::shared_ptr<const ReferenceShape>> shape) {
  const auto& [body, late, mother] = dividing;
  const CellType& type = model.types[mother.row.type];
  const double share = division_share({mother.row, type}, model.seed);
  const DaughterRows rows = divide_row(mother.row, tissue.cells.variables, type, model.seed, tissue.clock.time, late, share, model.types);
  if (!body.is_shell) return divide_as_sphere(mother, rows, division_axis({mother.row, type, {}, around}, model.seed, 0));
  const Surroundings walls = surroundings_of(mechanics.scene(), model.space, body.number, kReach);
  const std::array<const CellType*, 2> become{&model.types[rows.first.type], &model.types[rows.second.type]};
  return divide_as_shell(mother, type, around, rows, {&*mother.shell, become, shape[mother.row.type], walls.surfaces}, model.seed);
}

/// A shell for which no plane of division served: it waits, and tries others later; said once.
void put_off(CellRow& mother, std::vector<Event>& events) {
  mother.draws += kTries;  // other planes the next time
  const auto division =
      std::ranges::find_if(events, [&](const Event& event) { return event.kind == EventKind::kDivision && event.cell == mother.id; });
  if (std::exchange(mother.phase, Phase::kWaiting) == Phase::kWaiting) {
    events.erase(division);
    return;
  }
  *division = {division->time, EventKind::kDivisionWaits, mother.id, {}, {}, {EventReason::Cause::kNoPlane}};
}

/// The divisions among events, by their mothers. Good until an event comes or goes.
class DivisionEvents {
 public:
  explicit DivisionEvents(std::span<Event> events) {
    for (Event& event : events)
      if (event.kind == EventKind::kDivision) by_mother_.push_back(&event);
    std::ranges::sort(by_mother_, {}, &Event::cell);
  }
  /// Null: she does not divide.
  [[nodiscard]] Event* of(CellId mother) const {
    const auto at = std::ranges::lower_bound(by_mother_, mother, {}, &Event::cell);
    return at != by_mother_.end() && (*at)->cell == mother ? *at : nullptr;
  }

 private:
  std::vector<Event*> by_mother_;
};

/// Tells the volumes of a division, and what the daughters are.
void note_daughters(const CellRow& mother, const Daughters& daughters, Event& event) {
  event.volume = mother.target_volume;
  for (std::size_t which = 0; which < 2; ++which) {
    event.birth_volume[which] = daughters[which].row.birth_volume;
    event.birth_type[which] = daughters[which].row.type;
  }
}

/// Tells by how much the divisions of these shells raised the energy.
void note_energy_rise(std::span<const CellRecord> mothers, double rise, std::vector<Event>& events) {
  const DivisionEvents divisions(events);
  for (const CellRecord& mother : mothers) divisions.of(mother.row.id)->energy_rise = rise;
}

}  // namespace

Status Simulation::divide_and_remove(const LifeReport& life, std::vector<Event>& events) {
  events.insert(events.end(), life.events.begin(), life.events.end());
  const std::vector<Mother> mothers = mothers_of(tissue_, life.divisions);
  const bool cuts = comm_.any(std::ranges::any_of(mothers, [](const Mother& mother) { return mother.body.is_shell; }));
  std::vector<BodyOfRow> bodies;
  for (const Mother& mother : mothers) bodies.push_back(mother.body);
  MORULA_TRY_ASSIGN(const std::vector<AroundDivision> around, look_around(model_, tissue_, *mechanics_, comm_, bodies));
  std::vector<Daughters> daughters(mothers.size());
  std::vector<std::shared_ptr<const ReferenceShape>> shape;  // of the daughters, by type
  double energy = 0.0;                                       // before the cuts
  if (cuts) {
    energy = mechanics_->energy(tissue_);
    for (const CellType& type : model_.types) shape.push_back(shapes_.icosphere(type.shell_nodes).value());
  }
  std::optional<StageTimer::Scope> shaping;
  shaping.emplace(timer(), Stage::kShapes);
  parallel_for(threads_, mothers.size(),
               [&](std::size_t k) { daughters[k] = divide(mothers[k], around[k], model_, tissue_, *mechanics_, shape); });

  shaping.reset();
  std::vector<std::size_t> gone = life.removals;
  std::vector<CellRecord> fresh;
  std::vector<CellRecord> cut;  // mothers that were shells
  std::int64_t divisions = 0, deaths = 0;
  const DivisionEvents division(events);
  for (std::size_t k = 0; k < mothers.size(); ++k) {
    if (daughters[k].empty()) continue;
    ++divisions;
    note_daughters(mothers[k].cell.row, daughters[k], *division.of(mothers[k].cell.row.id));
    gone.push_back(mothers[k].body.row);
    if (mothers[k].body.is_shell) cut.push_back(mothers[k].cell);
    for (CellRecord& daughter : daughters[k]) {
      if (daughter.shell) place_nucleus(*daughter.shell, model_.types[daughter.row.type], shapes_);
      fresh.push_back(std::move(daughter));
    }
  }
  for (std::size_t k = 0; k < mothers.size(); ++k)
    if (daughters[k].empty()) put_off(tissue_.cells.rows[mothers[k].body.row], events);
  if (!gone.empty()) {
    std::sort(gone.begin(), gone.end());
    replace_cells(tissue_, gone, std::move(fresh));
    mechanics_->cells_replaced();
  }
  if (cuts) {
    note_energy_rise(cut, mechanics_->energy(tissue_) - energy, events);
    divisions -= settle_cuts(cut, events);
  }
  rename_partners(events);  // before anybody looks at bodies
  for (const Event& event : life.events) deaths += event.kind == EventKind::kDeath;
  tissue_.ledger.divisions += static_cast<std::uint64_t>(comm_.sum(divisions));
  tissue_.ledger.deaths += static_cast<std::uint64_t>(comm_.sum(deaths));
  return {};
}

std::int64_t Simulation::settle_cuts(std::span<const CellRecord> mothers, std::vector<Event>& events) {
  std::vector<CellId> daughters;
  for (const CellRecord& mother : mothers)
    for (const int which : {0, 1}) daughters.push_back(mother.row.id.daughter(which));
  std::ranges::sort(daughters);
  {
    auto finding = timer().scope(Stage::kShapes);
    settle_daughters(tissue_, *mechanics_, model_, shapes_, comm_, daughters, tissue_.clock.next_step);
  }
  mechanics_->cells_replaced();
  (void)mechanics_->energy(tissue_);  // finds the contacts
  const std::vector<CellId> deep = too_deep(*mechanics_, daughters, kMostOfLimit * model_.limits.overlap);
  mechanics_->cells_replaced();  // what it knows is with partners that have not their new names yet
  std::vector<CellRecord> back;
  std::vector<CellId> undone;
  for (const CellRecord& mother : mothers) {
    const CellId pair[2] = {mother.row.id.daughter(0), mother.row.id.daughter(1)};
    if (std::ranges::none_of(pair, [&](CellId id) { return std::ranges::binary_search(deep, id); })) continue;
    undone.insert(undone.end(), {pair[0], pair[1]});
    put_off(back.emplace_back(mother).row, events);
  }
  const auto number = static_cast<std::int64_t>(back.size());
  if (!undone.empty()) {
    std::ranges::sort(undone);
    replace_cells(tissue_, rows_of(tissue_.cells, undone), std::move(back));
  }
  return number;
}

void Simulation::rename_partners(const std::vector<Event>& events) {
  std::vector<Event> divisions;
  std::ranges::copy_if(events, std::back_inserter(divisions), [](const Event& event) { return event.kind == EventKind::kDivision; });
  divisions = items_of_all_ranks(divisions, comm_);
  if (divisions.empty()) return;
  std::ranges::sort(divisions, {}, &Event::cell);
  const auto division_of = [&](CellId mother) {
    const auto at = std::ranges::lower_bound(divisions, mother, {}, &Event::cell);
    return at != divisions.end() && at->cell == mother ? &*at : nullptr;
  };
  std::bitset<1024> seen;  // most ids are told from those of mothers by a few bits
  const auto few_bits = [](CellId id) { return static_cast<std::size_t>((id.bits() * 0x9E3779B97F4A7C15u) >> 54); };
  for (const Event& event : divisions) seen.set(few_bits(event.cell));
  const auto has_mother = [&](std::span<const CellId> partners) {
    return std::ranges::any_of(partners, [&](CellId id) { return seen.test(few_bits(id)) && division_of(id) != nullptr; });
  };
  cbm::PartnerLists& lists = tissue_.spheres.attached;
  const auto renamed = gather<std::size_t>(threads_, lists.size(), [&](std::size_t i, std::vector<std::size_t>& out) {
    if (has_mother(lists[i])) out.push_back(i);
  });
  cbm::Partners before, partners;
  for (const std::size_t i : renamed) {
    before.assign(lists[i].begin(), lists[i].end());
    partners = before;
    for (const CellId partner : before)
      if (const Event* event = division_of(partner)) cbm::replace_partner(partners, partner, event->first_daughter, event->second_daughter);
    lists.set(i, partners);
  }
}

}  // namespace morula
