#include "coupling/settle_shells.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "core/contact/contact_layer.h"
#include "coupling/gathered_parts.h"
#include "coupling/mechanics/relax.h"
#include "coupling/neighbourhoods.h"
#include "coupling/overlap.h"

namespace morula {
namespace {

/// How far a shell may bulge before its neighbourhood is too small, in units of its diameter.
constexpr double kFirstWay = 0.25, kLastWay = 4.0;
/// A new shell that is left this deep within a neighbour has no room: it would end a run at the usual limit [µm].
constexpr double kNoRoom = Limits().overlap;

/// Moves the owned bodies with moves[body] != 0 of a part; gives their overlap [µm].
using Move = std::function<double(Mechanics&, Tissue&, std::span<const char>)>;

/// What movers do, and what they are allowed.
struct Room {
  Move move;
  double way = 0.0;      ///< of their surfaces, in units of their boxes
  double deepest = 0.0;  ///< overlap with which they stay what they are [µm]
};

/// What has become of a neighbourhood, or of the cells that a rank has of it.
struct Outcome {
  std::vector<CellRecord> cells;  ///< the movers
  std::vector<CellId> no_room;
  bool overlap_is_left = false;
  bool went_beyond = false;  ///< a mover went further than the neighbourhood allows for
};

bool holds(const Box& box, const Box& other) { return box.contains(other.low) && box.contains(other.high); }

double enclosed_volume_of(const Tissue& part, std::size_t shell) {
  const auto faces = part.shells.topology(shell).faces();
  const auto nodes = part.shells.nodes(shell);
  return enclosed_volume(faces, nodes, volume_centroid(faces, nodes));
}

/// New shells find their shape, at the volume with which they begin.
double find_shapes(Mechanics& mechanics, Tissue& part, std::span<const char> moves) {
  std::vector<double> volume(part.shells.size());
  for (std::size_t s = 0; s < volume.size(); ++s)
    if (moves[s] != 0) volume[s] = enclosed_volume_of(part, s);
  const double overlap = mechanics.relax(part, moves);
  for (std::size_t s = 0; s < volume.size(); ++s)
    if (moves[s] != 0) set_enclosed_volume(part.shells.topology(s), part.shells.nodes(s), volume[s]);
  return overlap;
}

/// The movers go their way; `part` is their neighbourhood, or this rank's part of it. Collective over the ranks of `mechanics`.
Outcome settle_part(Tissue& part, std::span<const CellId> movers, const Room& room, Mechanics& mechanics, const Comm& comm) {
  const auto is_mover = [&](const BodyOfRow& body) { return std::ranges::binary_search(movers, part.cells.rows[body.row].id); };
  std::vector<char> moves(part.cells.size(), 0);
  std::vector<Box> bounds;
  for (const BodyOfRow& body : bodies_of(part.cells)) {
    if (!is_mover(body)) continue;
    moves[body.place(part.shells.size())] = 1;
    const Box box = box_of(part, body);
    bounds.push_back(box.inflated(room.way * largest_edge(box)));
  }
  Outcome out;
  const double overlap = room.move(mechanics, part, moves);
  std::vector<CellId> here;
  auto bound = bounds.begin();
  for (const BodyOfRow& body : bodies_of(part.cells)) {
    if (!is_mover(body)) continue;
    out.went_beyond = out.went_beyond || !holds(*bound++, box_of(part, body));
    out.cells.push_back(record_of(part, body));
    here.push_back(part.cells.rows[body.row].id);
  }
  std::ranges::sort(here);
  out.no_room = too_deep(mechanics, here, room.deepest);
  out.overlap_is_left = overlap > kOverlapAtRest && !comm.all(out.no_room.size() == here.size());
  return out;
}

/// All neighbourhoods settle; gives what has become of the movers of this rank. Collective.
Outcome settle_all(const GatheredParts& parts, const Room& room, const Comm& comm) {
  Outcome out;
  std::vector<GatheredParts::Returned> cells;
  parts.visit([&](std::span<const CellId> movers, Tissue& part, Mechanics& mechanics, const Comm& together) {
    Outcome of_one = settle_part(part, movers, room, mechanics, together);
    for (CellRecord& cell : of_one.cells) {
      const bool no_room = std::ranges::binary_search(of_one.no_room, cell.row.id);
      cells.push_back({std::move(cell), no_room});
    }
    out.overlap_is_left = out.overlap_is_left || of_one.overlap_is_left;
    out.went_beyond = out.went_beyond || of_one.went_beyond;
  });
  for (GatheredParts::Returned& one : parts.send_home(std::move(cells))) {
    if (one.marked) out.no_room.push_back(one.cell.row.id);
    out.cells.push_back(std::move(one.cell));
  }
  out.overlap_is_left = comm.any(out.overlap_is_left);
  out.went_beyond = comm.any(out.went_beyond);
  return out;
}

/// The shell of a cell takes the place and the velocity that it has in the record.
void take_shape(Tissue& tissue, std::size_t shell, const ShellRecord& from) {
  const auto copy = [](dcm::Shells& shells, std::size_t number, const ShellRecord& record) {
    std::ranges::copy(record.position, shells.nodes(number).begin());
    std::ranges::copy(record.velocity, shells.velocity.begin() + shells.first_node[number]);
  };
  copy(tissue.shells, shell, from);
  if (from.nucleus) tissue.shells.nucleus[shell] = from.nucleus;
  if (from.nuclear_shell) copy(tissue.nuclei.shells, tissue.nuclei.of_shell(shell), *from.nuclear_shell);
}

/// Neighbourhoods are made larger until no mover leaves what is allowed for; then the movers of the tissue take the shapes that they have found. Collective.
Outcome move_in_neighbourhoods(Tissue& tissue, const Mechanics& mechanics, const Model& model, ShapeLibrary& shapes, const Comm& comm,
                               std::span<const CellId> movers, Room room) {
  Outcome outcome;
  for (;; room.way *= 2.0) {
    const std::vector<Neighbourhood> all = neighbourhoods_of(tissue, model, mechanics.contacts().settings(), movers, room.way, comm);
    outcome = settle_all(GatheredParts(tissue, all, mechanics, shapes, comm), room, comm);
    if (!outcome.went_beyond || everybody_has_a_part(model) || room.way >= kLastWay) break;
  }
  std::ranges::sort(outcome.cells, {}, [](const CellRecord& cell) { return cell.row.id; });
  for (const BodyOfRow& body : bodies_of(tissue.cells)) {
    const CellId id = tissue.cells.rows[body.row].id;
    if (!body.is_shell || !std::ranges::binary_search(movers, id)) continue;
    const auto found = std::ranges::lower_bound(outcome.cells, id, {}, [](const CellRecord& cell) { return cell.row.id; });
    take_shape(tissue, body.number, *found->shell);
  }
  std::ranges::sort(outcome.no_room);
  return outcome;
}

}  // namespace

Settled settle_shells(Tissue& tissue, const Mechanics& mechanics, const Model& model, ShapeLibrary& shapes, const Comm& comm,
                      std::span<const CellId> fresh, bool may_go_back) {
  const bool many = comm.sum(static_cast<std::int64_t>(fresh.size())) >= kGroup;
  Outcome outcome = move_in_neighbourhoods(
      tissue, mechanics, model, shapes, comm, fresh,
      {find_shapes, many ? 2.0 * kFirstWay : kFirstWay, may_go_back ? kNoRoom : std::numeric_limits<double>::infinity()});
  return {std::move(outcome.no_room), outcome.overlap_is_left};
}

void settle_daughters(Tissue& tissue, const Mechanics& mechanics, const Model& model, ShapeLibrary& shapes, const Comm& comm,
                      std::span<const CellId> daughters, double step) {
  const Move move = [step](Mechanics& alone, Tissue& part, std::span<const char> moves) {
    alone.move_alone(part, moves, step);
    return 0.0;
  };
  move_in_neighbourhoods(tissue, mechanics, model, shapes, comm, daughters, {move, kFirstWay, std::numeric_limits<double>::infinity()});
}

void set_enclosed_volume(const Topology& topology, std::span<Vec3d> nodes, double volume) {
  const Vec3d center = volume_centroid(topology.faces(), nodes);
  const double scale = std::cbrt(volume / enclosed_volume(topology.faces(), nodes, center));
  for (Vec3d& p : nodes) p = center + (p - center) * scale;
}

}  // namespace morula
