// Cells exchange their bodies: a step's regions and triggers are obeyed.
#include <algorithm>
#include <cmath>

#include "core/ball.h"
#include "coupling/cell_record.h"
#include "coupling/exchange_effects.h"
#include "coupling/face_marks.h"
#include "coupling/settle_shells.h"
#include "coupling/simulation.h"
#include "coupling/swaps.h"

namespace morula {
namespace {

double volume_of_body(const CellRecord& cell) { return cell.sphere ? ball_volume(cell.sphere->radius) : volume_of(*cell.shell); }

/// Cells just promoted that found no room (`back`, sorted) become again the spheres they were; their events say so.
void take_back(Tissue& tissue, std::vector<CellRecord> before, std::span<const CellId> back, std::vector<Event>& events) {
  const auto goes_back = [&](CellId id) { return std::binary_search(back.begin(), back.end(), id); };
  std::erase_if(before, [&](const CellRecord& cell) { return !goes_back(cell.row.id); });
  for (CellRecord& cell : before) cell.row.last_swap_time = tissue.clock.time;
  replace_cells(tissue, rows_of(tissue.cells, back), std::move(before));
  for (Event& event : events) {
    if (event.kind != EventKind::kPromotion || !goes_back(event.cell)) continue;
    event.kind = EventKind::kWarning;
    event.reason.no_room = true;
    event.exchange.reset();
  }
}

/// Shells that would be packed more tightly as spheres than the law of these goes stay shells, and are asked again when their hold is over. Says whether there
/// are any.
bool put_off_tight(std::span<const SwapOrder> orders, const ExchangeWatch& watch, const Model& model, Tissue& tissue) {
  bool any = false;
  for (const SwapOrder& order : orders) {
    const CellRow& row = tissue.cells.rows[order.row];
    if (order.to != BodyKind::kSphere || !is_too_tight_for_a_sphere(row, model.types[row.type], watch.caps_of(row.id))) continue;
    tissue.cells.optional.last_swap_time.set(order.row, tissue.clock.time, tissue.cells.size());
    any = true;
  }
  return any;
}

/// What becomes of cells that exchange their bodies.
struct Exchanged {
  std::vector<CellRecord> now;     ///< in the order of the orders
  std::vector<CellRecord> before;  ///< of the promoted, should they find no room
  std::vector<CellId> promoted;
  std::vector<Event> events;
};

Exchanged exchange_bodies(std::span<const SwapOrder> orders, std::span<const BodyOfRow> bodies, const ExchangeWatch& watch,
                          const Model& model, const Tissue& tissue, ShapeLibrary& shapes) {
  Exchanged out;
  const double time = tissue.clock.time;
  for (std::size_t k = 0; k < orders.size(); ++k) {
    CellRecord& cell = out.now.emplace_back(record_of(tissue, bodies[k]));
    const bool up = orders[k].to == BodyKind::kShell;
    const CellType& type = model.types[cell.row.type];
    const double pressure = cell.row.pressure, had = volume_of_body(cell), as_shell = up ? volume_under_pressure(had, pressure, type) : had;
    double later = 0.0;
    if (up) {
      out.before.push_back(cell);
      const double to_come = model.swaps.gradual ? watch.room_to_come_of(cell.row.id, had - as_shell) : 0.0;
      later = promote(cell, type, pressure, time, shapes, model.seed, to_come);
      out.promoted.push_back(cell.row.id);
    } else {
      demote(cell, type, time);
    }
    const double as_sphere = (up ? had : volume_of_body(cell)) - watch.caps_of(cell.row.id);
    Event event{time, up ? EventKind::kPromotion : EventKind::kDemotion, cell.row.id, {}, {}, orders[k].reason};
    event.exchange =
        ExchangeEffect{.became_shell = up, .volume = had, .room = up ? as_shell - as_sphere : as_sphere - as_shell, .later = later};
    out.events.push_back(std::move(event));
  }
  return out;
}

}  // namespace

std::vector<Event> Simulation::swap_bodies() {
  auto timed = timer().scope(Stage::kCoupling);
  const std::vector<Vec3d> center = centers();
  const LookedAt looked = look_for_swaps(model_, tissue_, center, *mechanics_, comm_);
  const bool may_stay = tissue_.clock.steps > 0;  // at the very beginning cells become what the study says
  std::vector<SwapOrder> orders;
  ExchangeWatch watch;
  do {
    orders = choose_swaps(model_, tissue_, looked.bodies(center), comm_);
    if (!comm_.any(!orders.empty())) return {};
    watch = watch_exchanges(model_, tissue_, orders, *mechanics_, shapes_, comm_);
  } while (may_stay && comm_.any(put_off_tight(orders, watch, model_, tissue_)));
  std::vector<CellId> leaving;
  for (const SwapOrder& order : orders)
    if (order.to == BodyKind::kSphere) leaving.push_back(tissue_.cells.rows[order.row].id);
  leaving = ids_of_all_ranks(leaving, comm_);
  std::vector<std::pair<CellId, CellId>> touching;
  if (!leaving.empty()) touching = mechanics_->touching(tissue_, leaving);
  std::vector<std::size_t> rows;
  for (const SwapOrder& order : orders) rows.push_back(order.row);
  Exchanged done = exchange_bodies(orders, bodies_of(tissue_.cells, rows), watch, model_, tissue_, shapes_);
  replace_cells(tissue_, rows, std::move(done.now));
  attach_touching(tissue_, touching);  // what adhered as a shell goes on adhering
  attach_touching(done.before, touching);
  mark_new_shells(model_, tissue_);
  if (comm_.any(!done.promoted.empty())) {
    std::ranges::sort(done.promoted);
    auto shaping = timer().scope(Stage::kShapes);
    const Settled settled = settle_shells(tissue_, *mechanics_, model_, shapes_, comm_, done.promoted, may_stay);
    if (!settled.no_room.empty()) take_back(tissue_, std::move(done.before), settled.no_room, done.events);
    tissue_.clock.capped = tissue_.clock.capped || settled.overlap_is_left;
  }
  mechanics_->cells_replaced();
  if (may_stay) tell_exchanges(watch, tissue_, *mechanics_, shapes_, comm_, done.events);
  std::int64_t ups = 0, downs = 0;
  for (const Event& event : done.events) {
    ups += event.kind == EventKind::kPromotion;
    downs += event.kind == EventKind::kDemotion;
  }
  tissue_.ledger.promotions += static_cast<std::uint64_t>(comm_.sum(ups));
  tissue_.ledger.demotions += static_cast<std::uint64_t>(comm_.sum(downs));
  return std::move(done.events);
}

Result<std::vector<Event>> Simulation::first_swaps() {
  mechanics_->attach(tissue_);  // rules look at what cells touch
  // and at what presses them, which is no rise at the beginning (of a run, not where one goes on); what a capped start parts says nothing
  const bool begins = tissue_.clock.steps == 0 && tissue_.ledger.promotions + tissue_.ledger.demotions == 0;
  if (begins && !tissue_.clock.capped) average_pressures(kNever);
  std::vector<Event> events = swap_bodies();
  OptionalColumn<double>& last_swap = tissue_.cells.optional.last_swap_time;
  for (std::size_t i = 0; i < tissue_.cells.size(); ++i)
    if (last_swap[i] == tissue_.clock.time) last_swap.set(i, OptionalValues().last_swap_time);  // being placed is no exchange
  mechanics_->attach(tissue_);
  return all_events(std::move(events));
}

}  // namespace morula
