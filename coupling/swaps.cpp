#include "coupling/swaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "cbm/division_ramp.h"
#include "cbm/pair_forces.h"
#include "core/ball.h"
#include "core/parallel/pack.h"
#include "core/random/rotation.h"
#include "coupling/beside_nucleus.h"
#include "coupling/who_is_in.h"
#include "dcm/growth.h"

namespace morula {
namespace {

constexpr double kLeastPart = 0.5;  ///< of its ball, that a new shell has in any case

struct Wish {
  BodyKind body;
  double hold;
  EventReason reason;
  double beyond = 0.0;  ///< Urgency::beyond
};

/// What body a cell is to have: the first region it is in decides, then the triggers, then what it was at the start.
Wish wish(const Model& model, const CellView& cell, std::size_t i, const SwapBodies& bodies, std::span<const Vec3d> center_of_region) {
  const CellRow& row = cell.row();
  const bool shell = row.body == BodyKind::kShell;
  using Cause = EventReason::Cause;
  std::uint32_t number = 0;
  for (const Region& region : model.swaps.regions) {
    const EventReason reason{Cause::kRegion, false, number};
    const Vec3d from = bodies.center[i] - center_of_region[number++];
    if (!region.exists_at(cell.time())) continue;
    const Standing stands = standing(model, reason.number, cell, i, from, bodies.contacts);
    if (stands.is_in()) return {region.body, model.swaps.hold, reason, -stands.outside};
  }
  double hold = model.swaps.regions.empty() ? 0.0 : model.swaps.hold;  // the longest of the rules that may have made the cell what it is
  number = 0;
  for (const Trigger& trigger : model.swaps.triggers) {
    const EventReason reason{Cause::kTrigger, false, number++};
    if (trigger.type >= 0) {
      if (row.type == trigger.type) return {BodyKind::kShell, trigger.hold, reason};
      continue;
    }
    hold = std::max(hold, trigger.hold);
    if (!trigger.phase.empty()) {
      if (cell.phase_name() == trigger.phase) return {BodyKind::kShell, trigger.hold, reason};
      continue;
    }
    if (trigger.value->looks_at_body && bodies.values == nullptr) continue;  // nothing is known of bodies before a run
    const double value = trigger.value->of(trigger, cell);
    const double threshold = shell ? trigger.demote : trigger.promote;
    const bool wants = trigger.promote_above ? value > threshold : value < threshold;
    if (wants) return {BodyKind::kShell, trigger.hold, reason, std::abs(value - threshold)};
  }
  return {row.own_body, hold, {Cause::kOutside}};
}

/// Where the rule behind a wish stands in the study: regions, triggers, none.
std::uint64_t place_of_rule(const Swaps& swaps, const EventReason& reason) {
  using Cause = EventReason::Cause;
  if (reason.cause == Cause::kRegion) return reason.number;
  return swaps.regions.size() + (reason.cause == Cause::kTrigger ? reason.number : swaps.triggers.size());
}

/// Whether a cell has not parted from its sister yet: until then the pair is neither two balls nor two shells at rest.
bool is_dividing(const CellRow& row, double time) { return row.id.generation() > 0 && !cbm::sisters_have_parted(row.birth_time, time); }

}  // namespace

CellView SwapBodies::view(const Model& model, const Tissue& tissue, const BodyOfRow& body) const {
  CellView out(tissue.cells, body.row, model.types[tissue.cells.rows[body.row].type], tissue.clock.time);
  if (values != nullptr) out.set_body(*values, body.place(tissue.shells.size()), center[body.row]);
  if (balls != nullptr) out.set_ball(*balls, body.place(tissue.shells.size()));
  return out;
}

std::vector<CellId> ids_of_all_ranks(const std::vector<CellId>& mine, const Comm& comm) {
  std::vector<CellId> out = items_of_all_ranks(mine, comm);
  std::sort(out.begin(), out.end());
  return out;
}

bool look_at_bodies(const Swaps& swaps) {
  return std::ranges::any_of(swaps.triggers, [](const Trigger& t) { return t.compares() && t.value->looks_at_body; });
}

LookedAt look_for_swaps(const Model& model, const Tissue& tissue, std::span<const Vec3d> center, Mechanics& mechanics, const Comm& comm) {
  LookedAt out;
  out.contacts = contacts_from_regions(model, tissue, center, mechanics, comm);
  if (!look_at_bodies(model.swaps)) return out;
  out.values = mechanics.values(tissue);
  out.balls = mechanics.as_balls(tissue);
  return out;
}

std::vector<SwapOrder> choose_swaps(const Model& model, const Tissue& tissue, const SwapBodies& bodies, const Comm& comm) {
  const std::span<const Vec3d> center = bodies.center;
  if (!model.swaps.any()) return {};
  const std::vector<Vec3d> center_of_region = centers_of_regions(model, tissue, center, comm);
  std::vector<SwapOrder> orders;
  std::int64_t shells = 0;
  for (const BodyOfRow& body : bodies_of(tissue.cells)) {
    const std::size_t i = body.row;
    const CellRow& row = tissue.cells.rows[i];
    if (row.body == BodyKind::kShell) ++shells;
    if (row.phase == Phase::kDying || is_dividing(row, tissue.clock.time)) continue;
    const Wish wanted = wish(model, bodies.view(model, tissue, body), i, bodies, center_of_region);
    const double since = tissue.clock.time - tissue.cells.optional.last_swap_time[i];
    if (wanted.body == row.body || since < wanted.hold || since == 0.0) continue;  // nobody is asked twice at a time
    orders.push_back({i, wanted.body, wanted.reason, {place_of_rule(model.swaps, wanted.reason), wanted.beyond, row.id}});
  }
  shells = comm.sum(shells);
  const std::int64_t cells = comm.sum(static_cast<std::int64_t>(tissue.cells.size()));

  // The most urgent first, under the cap of shells and the number of swaps a step.
  std::vector<Urgency> up, down;
  for (const SwapOrder& order : orders) (order.to == BodyKind::kShell ? up : down).push_back(order.urgency);
  const auto of_all_ranks = [&](const std::vector<Urgency>& mine) {
    std::vector<Urgency> all = items_of_all_ranks(mine, comm);
    std::ranges::sort(all, std::less<>{});
    return all;
  };
  const std::vector<Urgency> all_up = of_all_ranks(up), all_down = of_all_ranks(down);
  const auto most =
      tissue.clock.steps == 0 ? static_cast<std::size_t>(cells) : static_cast<std::size_t>(std::max<std::int64_t>(1, cells / 100));
  const std::size_t downs = std::min(all_down.size(), most);
  const auto free_places =
      static_cast<std::int64_t>(std::min<std::uint64_t>(model.swaps.max_shells, 1ull << 40)) - shells + static_cast<std::int64_t>(downs);
  const std::size_t ups =
      std::min({all_up.size(), most - std::min(most, downs), static_cast<std::size_t>(std::max<std::int64_t>(0, free_places))});
  std::erase_if(orders, [&](const SwapOrder& order) {
    const auto& all = order.to == BodyKind::kShell ? all_up : all_down;
    const std::size_t allowed = order.to == BodyKind::kShell ? ups : downs;
    return static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), order.urgency) - all.begin()) >= allowed;
  });
  return orders;
}

bool is_too_tight_for_a_sphere(const CellRow& row, const CellType& type, double caps) {
  const double last = type.sphere.packing.last();
  return last > 0.0 && caps > last * row.target_volume;
}

bool swaps_wait(const Model& model, const Tissue& tissue, const SwapBodies& bodies, std::span<const double> caps, const Comm& comm) {
  const std::span<const Vec3d> center = bodies.center;
  if (!model.swaps.any()) return false;
  const std::vector<Vec3d> center_of_region = centers_of_regions(model, tissue, center, comm);
  bool up = false, down = false;
  std::int64_t shells = 0;
  for (const BodyOfRow& body : bodies_of(tissue.cells)) {
    const std::size_t i = body.row;
    const CellRow& row = tissue.cells.rows[i];
    if (row.body == BodyKind::kShell) ++shells;
    if (row.phase == Phase::kDying) continue;
    const BodyKind wanted = wish(model, bodies.view(model, tissue, body), i, bodies, center_of_region).body;
    if (wanted == row.body) continue;
    if (wanted == BodyKind::kShell)
      up = true;
    else if (caps.empty() || !is_too_tight_for_a_sphere(row, model.types[row.type], caps[body.place(tissue.shells.size())]))
      down = true;
  }
  const bool has_place = static_cast<std::uint64_t>(comm.sum(shells)) < model.swaps.max_shells;
  return comm.any(down || (up && has_place));
}

namespace {

/// visit(column of shells, column of spheres) for what goes over at an exchange of bodies (dcm/shells.h).
template <class Visit>
void for_each_shared_column(Visit&& visit) {
  dcm::for_each_shell_column([&]<class Shell>(const Shell& shell) {
    if constexpr (Shell::kDomain == Domain::kNode) {
      if (shell.rules.on_new_mesh == OnNewMesh::kMade) return;
      cbm::for_each_sphere_column([&]<class Sphere>(const Sphere& sphere) {
        if constexpr (std::is_same_v<typename Shell::Value, typename Sphere::Value>)
          if (std::string_view(shell.name) == sphere.name) visit(shell, sphere);
      });
    }
  });
}

}  // namespace

double free_reference_volume(double target_volume, const CellType& type, double deviation) {
  return dcm::pressure_free_reference(target_volume, type.shell.tension * (1.0 + deviation), type.shell.bulk_modulus);
}

double volume_under_pressure(double ball, double pressure, const CellType& type) {
  if (type.osmosis.acts()) return ball;
  return std::max(kLeastPart * ball, cbm::pressed_volume(pressure, ball, type.shell.bulk_modulus));
}

double promote(CellRecord& cell, const CellType& type, double pressure, double time, ShapeLibrary& shapes, std::uint32_t seed,
               double left_out) {
  const SphereRecord& sphere = *cell.sphere;
  const double ball = ball_volume(sphere.radius), pressed = volume_under_pressure(ball, pressure, type);
  const double volume = std::max(kLeastPart * ball, pressed - left_out);
  // −K_V ln(V/V0) = p + 2γ/R: the shell pushes back as hard as the sphere was pushed, or pulls where it was pulled.
  const double deviation = morula::deviation(cell.row, type, Trait::kTension);
  const double to_come = (pressed - volume) * (ball / pressed);
  double reference = free_reference_volume(ball - to_come, type, deviation);
  if (type.osmosis.acts())
    reference *= volume_beside_resting_nucleus(type, ball, cell.row.target_volume) / ball * std::exp(pressure / type.shell.bulk_modulus);
  ShellRecord shell = spherical_shell(shapes.icosphere(type.shell_nodes).value(), sphere.position, volume, reference);
  shell.rest_volume = cell.row.target_volume;  // stress-free at the size of the cell, as in every step
  shell.rest_length = free_rest_lengths(*shell.shape, shell.rest_volume);
  const Rotation turn = random_rotation(Random(seed, RandomStream::kOrientation), cell.row.id, 0);
  for (Vec3d& p : shell.position) p = sphere.position + turn * (p - sphere.position);
  for_each_shared_column([&]<class Column>(const Column& of_nodes, const auto& of_sphere) {
    of_nodes.give(shell, std::vector<typename Column::Value>(shell.position.size(), of_sphere.values(sphere)[0]));
  });
  place_nucleus(shell, type, shapes);
  cell.row.reference_excess = std::log(reference / free_reference_volume(cell.row.target_volume, type, deviation));
  cell.row.last_swap_time = time;
  cell.row.body = BodyKind::kShell;
  cell.shell = std::move(shell);
  cell.sphere.reset();
  return to_come;
}

void demote(CellRecord& cell, const CellType& type, double time) {
  const ShellRecord& shell = *cell.shell;
  SphereRecord sphere;
  sphere.position = cell.center();
  if (type.osmosis.acts()) cell.row.reference_excess = std::log(volume_of(shell) / cell.row.target_volume);
  sphere.radius = ball_radius(cell.row.target_volume * std::exp(cell.row.reference_excess));
  for_each_shared_column(
      [&](const auto& of_nodes, const auto& of_sphere) { of_sphere.give(sphere, std::array{mean_of(of_nodes.values(shell))}); });
  cell.row.last_swap_time = time;
  cell.row.body = BodyKind::kSphere;
  cell.sphere = std::move(sphere);
  cell.shell.reset();
}

namespace {

using TouchingPairs = std::span<const std::pair<CellId, CellId>>;

TouchingPairs pairs_of(CellId id, TouchingPairs touching) {
  const auto first = std::lower_bound(touching.begin(), touching.end(), std::pair(id, CellId()));
  const auto last = std::find_if(first, touching.end(), [id](const auto& pair) { return pair.first != id; });
  return touching.subspan(static_cast<std::size_t>(first - touching.begin()), static_cast<std::size_t>(last - first));
}

void add_partners(TouchingPairs pairs, cbm::Partners& attached) {
  for (const auto& pair : pairs) {
    const auto place = std::lower_bound(attached.begin(), attached.end(), pair.second);
    if (place == attached.end() || *place != pair.second) attached.insert(place, pair.second);
  }
}

}  // namespace

void attach_touching(std::span<CellRecord> cells, TouchingPairs touching) {
  for (CellRecord& cell : cells)
    if (cell.sphere) add_partners(pairs_of(cell.row.id, touching), cell.sphere->attached);
}

void attach_touching(Tissue& tissue, TouchingPairs touching) {
  if (touching.empty()) return;
  cbm::PartnerLists& lists = tissue.spheres.attached;
  cbm::Partners partners;
  for (const BodyOfRow& body : bodies_of(tissue.cells)) {
    if (body.is_shell) continue;
    const auto pairs = pairs_of(tissue.cells.rows[body.row].id, touching);
    if (pairs.empty()) continue;
    partners.assign(lists[body.number].begin(), lists[body.number].end());
    add_partners(pairs, partners);
    lists.set(body.number, partners);
  }
}

}  // namespace morula
