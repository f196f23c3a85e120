#include "coupling/exchange_effects.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "cbm/laws/sphere_caps.h"
#include "core/ball.h"
#include "core/parallel/pack.h"
#include "coupling/gathered_parts.h"
#include "coupling/simulation.h"

namespace morula {
namespace {

constexpr double kBeside = 1.2;  // of the sum of the radii: nearest neighbours of any packing, and not the next

/// How far around an exchange one looks, in units of the size of the cell: what is beside it, of cells that are not much larger than itself.
constexpr double kAround = 0.25;

/// A neighbour as all ranks hear of it once the bodies are exchanged.
struct Told {
  WatchedNeighbour watched;
  double force_change = 0.0;  ///< [nN]
};

/// A cell as the ball that it is, or would be.
struct CellBall {
  CellId id;
  Vec3d center;
  double radius = 0.0;
};

CellBall ball_of(const Tissue& part, const BodyOfRow& body) {
  const CellRow& row = part.cells.rows[body.row];
  return {row.id, record_of(part, body).center(), body.is_shell ? ball_radius(row.target_volume) : part.spheres.radius[body.number]};
}

/// Who is a shell in a part when these have exchanged their bodies, by id. Collective.
std::vector<CellBall> shells_to_be(const Tissue& part, std::span<const CellId> exchange, const Comm& comm) {
  std::vector<CellBall> out;
  for (const BodyOfRow& body : bodies_of(part.cells))
    if (body.is_shell != std::ranges::binary_search(exchange, part.cells.rows[body.row].id)) out.push_back(ball_of(part, body));
  out = items_of_all_ranks(out, comm);
  std::ranges::sort(out, {}, &CellBall::id);
  return out;
}

/// What a ball loses behind the planes in which it meets the others [µm³]. Daughters exchange when they have parted (swaps.cpp).
double caps_with(std::span<const CellBall> others, const CellBall& ball, const Space& space) {
  double out = 0.0;
  for (const CellBall& other : others) {
    if (other.id == ball.id) continue;
    const double distance = norm(space.nearest_image(other.center - ball.center));
    if (distance < ball.radius + other.radius) out += cbm::sphere_caps(ball.radius, other.radius, distance).volume_a;
  }
  return out;
}

/// The forces on the neighbours of exchanges in a part. Collective over the ranks of `mechanics`.
std::map<CellId, Vec3d> forces_on(std::span<const ExchangeWatch::Beside> beside, const Tissue& part, Mechanics& mechanics) {
  std::map<CellId, Vec3d> out;
  for (const ExchangeWatch::Beside& one : beside) out[one.neighbour] = {};
  std::vector<char> wanted(part.cells.size(), 0);
  for (const BodyOfRow& body : bodies_of(part.cells)) wanted[body.place(part.shells.size())] = out.contains(part.cells.rows[body.row].id);
  const std::vector<Vec3d> force = mechanics.net_forces_on(part, wanted);
  for (const BodyOfRow& body : bodies_of(part.cells))
    if (const std::size_t place = body.place(part.shells.size()); wanted[place]) out[part.cells.rows[body.row].id] = force[place];
  return out;
}

/// `watched` in groups of the same exchange: function(first, last).
template <class Items, class Key, class F>
void for_each_exchange(const Items& items, Key&& key, F&& function) {
  for (std::size_t first = 0, last = 0; first < items.size(); first = last) {
    while (last < items.size() && key(items[last]) == key(items[first])) ++last;
    function(first, last);
  }
}

/// Of the cells of these events.
void tell_own_ways(const ExchangeWatch& watch, const Tissue& tissue, std::span<Event> events) {
  std::map<CellId, ExchangeEffect*> told;
  for (Event& event : events)
    if (event.exchange) told[event.cell] = &*event.exchange;
  std::vector<CellId> ids;
  for (const auto& [id, effect] : told) ids.push_back(id);
  for (const BodyOfRow& body : bodies_of(tissue.cells, rows_of(tissue.cells, ids))) {
    const CellId id = tissue.cells.rows[body.row].id;
    told.at(id)->own_way = watch.way_of(id, record_of(tissue, body).center());
  }
}

}  // namespace

ExchangeWatch::Exchanging ExchangeWatch::of(CellId id) const {
  const auto found = std::ranges::lower_bound(exchanging, id, {}, &Exchanging::id);
  return found != exchanging.end() && found->id == id ? *found : Exchanging{};
}

double ExchangeWatch::caps_of(CellId id) const { return of(id).caps; }

double ExchangeWatch::way_of(CellId id, const Vec3d& to) const {
  const Exchanging from = of(id);
  return norm(to - from.place) / from.radius;
}

double ExchangeWatch::room_to_come_of(CellId id, double pressed) const {
  return std::max(0.0, of(id).among_shells - std::max(0.0, pressed));
}

ExchangeWatch watch_exchanges(const Model& model, const Tissue& tissue, std::span<const SwapOrder> orders, const Mechanics& mechanics,
                              ShapeLibrary& shapes, const Comm& comm) {
  std::vector<CellId> exchanging;
  for (const SwapOrder& order : orders) exchanging.push_back(tissue.cells.rows[order.row].id);
  std::ranges::sort(exchanging);
  ExchangeWatch out;
  out.around = neighbourhoods_of(tissue, model, mechanics.contacts().settings(), exchanging, kAround, comm);
  GatheredParts(tissue, out.around, mechanics, shapes, comm)
      .visit([&](std::span<const CellId> cells, Tissue& part, Mechanics& alone, const Comm& together) {
        const std::vector<double> caps = alone.as_balls(part).caps;
        const std::vector<CellBall> shells = shells_to_be(part, cells, together);
        std::vector<ExchangeWatch::Exchanging> of_part;
        for (const BodyOfRow& body : bodies_of(part.cells)) {
          const CellRow& row = part.cells.rows[body.row];
          if (!std::ranges::binary_search(cells, row.id)) continue;
          const double among_shells = body.is_shell ? 0.0 : caps_with(shells, ball_of(part, body), model.space);
          of_part.push_back(
              {row.id, record_of(part, body).center(), ball_radius(row.target_volume), caps[body.place(part.shells.size())], among_shells});
        }
        out.exchanging.insert(out.exchanging.end(), of_part.begin(), of_part.end());
        of_part = items_of_all_ranks(of_part, together);
        std::ranges::sort(of_part, {}, &ExchangeWatch::Exchanging::id);
        std::vector<ExchangeWatch::Beside> beside;
        for (const BodyOfRow& body : bodies_of(part.cells)) {
          const CellRow& row = part.cells.rows[body.row];
          if (std::ranges::binary_search(cells, row.id)) continue;
          const double radius = ball_radius(row.target_volume);
          const Vec3d center = record_of(part, body).center();
          for (const ExchangeWatch::Exchanging& other : of_part)
            if (norm(model.space.nearest_image(other.place - center)) < kBeside * (radius + other.radius))
              beside.push_back({other.id, row.id, center, radius, {}});
        }
        const std::map<CellId, Vec3d> force = forces_on(beside, part, alone);
        for (ExchangeWatch::Beside& one : beside) {
          one.force = force.at(one.neighbour);
          out.beside.push_back(one);
        }
      });
  out.exchanging = items_of_all_ranks(out.exchanging, comm);
  std::ranges::sort(out.exchanging, {}, &ExchangeWatch::Exchanging::id);
  return out;
}

void tell_exchanges(const ExchangeWatch& watch, Tissue& tissue, const Mechanics& mechanics, ShapeLibrary& shapes, const Comm& comm,
                    std::vector<Event>& events) {
  tell_own_ways(watch, tissue, events);
  std::vector<Told> all;
  GatheredParts(tissue, watch.around, mechanics, shapes, comm)
      .visit([&](std::span<const CellId> cells, Tissue& part, Mechanics& alone, const Comm&) {
        std::vector<ExchangeWatch::Beside> beside;  // one may be beside cells of two neighbourhoods
        for (const ExchangeWatch::Beside& one : watch.beside)
          if (std::ranges::binary_search(cells, one.exchanged)) beside.push_back(one);
        const std::map<CellId, Vec3d> now = forces_on(beside, part, alone);
        for (const ExchangeWatch::Beside& one : beside)
          all.push_back(
              {{one.exchanged, one.neighbour, tissue.clock.time, 0, 0.0, one.place, one.radius}, norm(now.at(one.neighbour) - one.force)});
      });
  all = items_of_all_ranks(all, comm);
  std::ranges::sort(all, {}, [](const Told& t) { return std::pair(t.watched.exchanged, t.watched.neighbour); });
  // What an exchange is, its own rank knows; one that found no room is none.
  struct Known {
    CellId id;
    std::uint64_t is_promotion;
    double room;
  };
  std::vector<Known> known;
  for (const Event& event : events)
    if (event.exchange) known.push_back({event.cell, event.kind == EventKind::kPromotion ? 1u : 0u, event.exchange->room});
  known = items_of_all_ranks(known, comm);
  std::ranges::sort(known, {}, &Known::id);
  for_each_exchange(
      all, [](const Told& t) { return t.watched.exchanged; },
      [&](std::size_t first, std::size_t last) {
        const CellId id = all[first].watched.exchanged;
        const auto what = std::ranges::lower_bound(known, id, {}, &Known::id);
        if (what == known.end() || what->id != id) return;
        ExchangeEffect effect;
        for (std::size_t k = first; k < last; ++k) {
          all[k].watched.is_promotion = what->is_promotion;
          all[k].watched.room = what->room;
          tissue.watched.push_back(all[k].watched);
          effect.largest_force = std::max(effect.largest_force, all[k].force_change);
          effect.mean_force += all[k].force_change / static_cast<double>(last - first);
        }
        for (Event& event : events) {
          if (event.cell != id || !event.exchange) continue;
          event.exchange->neighbours = static_cast<std::uint32_t>(last - first);
          event.exchange->largest_force = effect.largest_force, event.exchange->mean_force = effect.mean_force;
        }
      });
}

void Simulation::tell_settled_exchanges(std::vector<Event>& events) {
  std::vector<WatchedNeighbour>& watched = tissue_.watched;
  const double time = tissue_.clock.time;
  const auto end = std::ranges::find_if(watched, [time](const WatchedNeighbour& w) { return time - w.since < kExchangeSettles; });
  if (end == watched.begin()) return;
  const std::span<const WatchedNeighbour> due(watched.begin(), end);
  std::map<CellId, Vec3d> place;
  for (const WatchedNeighbour& one : due) place.emplace(one.neighbour, Vec3d{});
  std::set<CellId> here;
  const std::vector<Vec3d> center = centers();
  for (std::size_t i = 0; i < tissue_.cells.size(); ++i)
    if (const auto found = place.find(tissue_.cells.rows[i].id); found != place.end()) found->second = center[i], here.insert(found->first);
  struct Way {
    std::uint64_t number;
    double part;
  };
  std::vector<Way> ways;
  for (std::size_t k = 0; k < due.size(); ++k)
    if (here.contains(due[k].neighbour))
      ways.push_back({k, norm(model_.space.nearest_image(place.at(due[k].neighbour) - due[k].from)) / due[k].radius});
  ways = items_of_all_ranks(ways, comm_);
  std::ranges::sort(ways, {}, &Way::number);
  const auto exchange_of = [&](const Way& way) { return std::pair(due[way.number].since, due[way.number].exchanged); };
  for_each_exchange(ways, exchange_of, [&](std::size_t first, std::size_t last) {
    if (!comm_.is_root()) return;
    const WatchedNeighbour& one = due[ways[first].number];
    ExchangeEffect effect{.neighbours = static_cast<std::uint32_t>(last - first), .became_shell = one.is_promotion != 0, .room = one.room};
    for (std::size_t k = first; k < last; ++k) {
      effect.largest_way = std::max(effect.largest_way, ways[k].part);
      effect.mean_way += ways[k].part / static_cast<double>(last - first);
    }
    using Cause = EventReason::Cause;
    const EventReason reason{one.is_promotion != 0 ? Cause::kBecameShell : Cause::kBecameSphere};
    events.push_back({time, EventKind::kExchangeSettled, one.exchanged, {}, {}, reason});
    events.back().exchange = effect;
  });
  watched.erase(watched.begin(), end);
}

}  // namespace morula
