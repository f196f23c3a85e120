#include "coupling/settle_shells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/contact/contact_layer.h"
#include "core/parallel/pack.h"
#include "coupling/mechanics/relax.h"
#include "coupling/neighbourhoods.h"
#include "coupling/overlap.h"

namespace morula {
namespace {

/// How far a shell may bulge before its neighbourhood is too small, in units of its diameter.
constexpr double kFirstWay = 0.25, kLastWay = 4.0;
/// A new shell that is left this deep within a neighbour has no room [µm].
constexpr double kNoRoom = 0.5;

Reach reach_of(const Mechanics& mechanics, const Model& model) {
  const ContactSettings& contact = mechanics.contacts().settings();
  const auto packs = [](const CellType& type) { return !type.sphere.packing.empty(); };
  return {std::max(contact.range, contact.sphere_reach), kFirstWay, std::ranges::any_of(model.types, packs)};
}

/// The cells of a neighbourhood as a tissue of their own.
Tissue part_of(const Tissue& whole, std::vector<CellRecord> cells) {
  Tissue out;
  out.clock = whole.clock;
  out.cells = whole.cells.without_rows();
  out.obstacle_offset = whole.obstacle_offset;
  put_together(out, std::move(cells));
  return out;
}

/// What movers are allowed.
struct Room {
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

/// The movers find their shape; `part` is their neighbourhood, or this rank's part of it. Collective over the ranks of `mechanics`.
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
  const double overlap = mechanics.relax(part, moves);
  std::vector<CellId> here;
  auto bound = bounds.begin();
  for (const BodyOfRow& body : bodies_of(part.cells)) {
    if (!is_mover(body)) continue;
    out.went_beyond = out.went_beyond || !holds(*bound++, box_of(part, body));
    set_enclosed_volume(part.shells.topology(body.number), part.shells.nodes(body.number), part.shells.rest_volume[body.number]);
    out.cells.push_back(record_of(part, body));
    here.push_back(part.cells.rows[body.row].id);
  }
  std::ranges::sort(here);
  out.no_room = too_deep(mechanics, here, room.deepest);
  out.overlap_is_left = overlap > kOverlapAtRest && !comm.all(out.no_room.size() == here.size());
  return out;
}

/// A part of a message: the cells of a neighbourhood, by its number.
struct Header {
  std::uint64_t number, bytes;
};

void append(std::vector<std::byte>& mail, std::uint64_t number, std::span<const CellRecord> cells) {
  std::vector<std::byte> bytes;
  for (const CellRecord& cell : cells) append_bytes(cell, bytes);
  const std::vector<std::byte> header = pack(std::vector<Header>{{number, bytes.size()}});
  mail.insert(mail.end(), header.begin(), header.end());
  mail.insert(mail.end(), bytes.begin(), bytes.end());
}

/// visit(number, cells) for the parts of a message.
template <class Visit>
void for_parts(std::span<const std::byte> mail, ShapeLibrary& shapes, Visit&& visit) {
  while (!mail.empty()) {
    const Header header = unpack<Header>(mail.first(sizeof(Header)))[0];
    visit(header.number, read_records(mail.subspan(sizeof(Header), header.bytes), shapes));
    mail = mail.subspan(sizeof(Header) + header.bytes);
  }
}

/// All neighbourhoods of a tissue settle, each on one rank or on all. Nothing in the tissue changes.
class Settlements {
 public:
  Settlements(const Tissue& tissue, const Mechanics& mechanics, ShapeLibrary& shapes, const Comm& comm)
      : tissue_(tissue), mechanics_(mechanics), shapes_(shapes), comm_(comm) {
    for (const BodyOfRow& body : bodies_of(tissue.cells)) body_of_row_.push_back(body);
  }

  /// What has become of the movers of this rank. Collective.
  Outcome settle(std::span<const Neighbourhood> all, const Room& room);

 private:
  [[nodiscard]] std::vector<CellRecord> cells_of(const Neighbourhood& n) const {
    std::vector<CellRecord> out;
    for (const std::size_t row : n.rows) out.push_back(record_of(tissue_, body_of_row_[row]));
    return out;
  }
  /// Cells of neighbourhoods that settle on this rank, from other ranks.
  void collect(std::span<const Neighbourhood> all);
  /// Movers of other ranks go back to them.
  void return_cells(Outcome& out);

  const Tissue& tissue_;
  const Mechanics& mechanics_;
  ShapeLibrary& shapes_;
  const Comm& comm_;
  std::vector<BodyOfRow> body_of_row_;
  std::map<std::uint64_t, std::vector<CellRecord>> guests_;  ///< by neighbourhood
  std::map<CellId, int> home_;                               ///< ranks of the guests
};

void Settlements::collect(std::span<const Neighbourhood> all) {
  Mail mail;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (!all[k].for_all_ranks && all[k].owner != comm_.rank() && !all[k].rows.empty()) append(mail[all[k].owner], k, cells_of(all[k]));
  for (const auto& [rank, bytes] : comm_.exchange(std::move(mail)))
    for_parts(bytes, shapes_, [&, from = rank](std::uint64_t number, std::vector<CellRecord> cells) {
      for (const CellRecord& cell : cells) home_.emplace(cell.row.id, from);
      std::ranges::move(cells, std::back_inserter(guests_[number]));
    });
}

void Settlements::return_cells(Outcome& out) {
  constexpr std::uint64_t kHasRoom = 0, kHasNoRoom = 1;
  Mail mail;
  std::vector<CellRecord> mine;
  for (CellRecord& cell : out.cells) {
    const auto home = home_.find(cell.row.id);
    if (home == home_.end()) {
      mine.push_back(std::move(cell));
      continue;
    }
    const bool no_room = std::ranges::find(out.no_room, cell.row.id) != out.no_room.end();
    append(mail[home->second], no_room ? kHasNoRoom : kHasRoom, std::span(&cell, 1));
  }
  out.cells = std::move(mine);
  std::erase_if(out.no_room, [&](CellId id) { return home_.contains(id); });
  for (const auto& [rank, bytes] : comm_.exchange(std::move(mail)))
    for_parts(bytes, shapes_, [&](std::uint64_t kind, std::vector<CellRecord> cells) {
      if (kind == kHasNoRoom) out.no_room.push_back(cells[0].row.id);
      out.cells.push_back(std::move(cells[0]));
    });
}

Outcome Settlements::settle(std::span<const Neighbourhood> all, const Room& room) {
  Outcome out;
  const auto add = [&](Outcome of_one) {
    std::ranges::move(of_one.cells, std::back_inserter(out.cells));
    out.no_room.insert(out.no_room.end(), of_one.no_room.begin(), of_one.no_room.end());
    out.overlap_is_left = out.overlap_is_left || of_one.overlap_is_left;
    out.went_beyond = out.went_beyond || of_one.went_beyond;
  };
  const bool across = std::ranges::any_of(all, [](const Neighbourhood& n) { return !n.on_one_rank; });
  if (across) collect(all);
  Mechanics alone = mechanics_.for_another_tissue(Comm());
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k].for_all_ranks) {
      Mechanics together = mechanics_.for_another_tissue(comm_);
      Tissue part = part_of(tissue_, cells_of(all[k]));
      add(settle_part(part, all[k].movers, room, together, comm_));
    } else if (all[k].owner == comm_.rank()) {
      std::vector<CellRecord> cells = cells_of(all[k]);
      std::ranges::move(guests_[k], std::back_inserter(cells));
      Tissue part = part_of(tissue_, std::move(cells));
      add(settle_part(part, all[k].movers, room, alone, Comm()));
    }
  }
  if (across) return_cells(out);
  out.overlap_is_left = comm_.any(out.overlap_is_left);
  out.went_beyond = comm_.any(out.went_beyond);
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

}  // namespace

Settled settle_shells(Tissue& tissue, const Mechanics& mechanics, const Model& model, ShapeLibrary& shapes, const Comm& comm,
                      std::span<const CellId> fresh, bool may_go_back) {
  Outcome outcome;
  const double deepest = may_go_back ? kNoRoom : std::numeric_limits<double>::infinity();
  for (Reach reach = reach_of(mechanics, model);; reach.way *= 2.0) {
    // A spring of marked faces goes to the middle of all of them.
    const bool all_have_a_part = !model.apical_springs.empty();
    const std::vector<Neighbourhood> neighbourhoods =
        all_have_a_part ? std::vector{whole_tissue(tissue, fresh, comm)} : find_neighbourhoods(tissue, model.space, fresh, reach, comm);
    outcome = Settlements(tissue, mechanics, shapes, comm).settle(neighbourhoods, {reach.way, deepest});
    if (!outcome.went_beyond || all_have_a_part || reach.way >= kLastWay) break;
  }
  std::ranges::sort(outcome.cells, {}, [](const CellRecord& cell) { return cell.row.id; });
  for (const BodyOfRow& body : bodies_of(tissue.cells)) {
    const CellId id = tissue.cells.rows[body.row].id;
    if (!body.is_shell || !std::ranges::binary_search(fresh, id)) continue;
    const auto found = std::ranges::lower_bound(outcome.cells, id, {}, [](const CellRecord& cell) { return cell.row.id; });
    take_shape(tissue, body.number, *found->shell);
  }
  std::ranges::sort(outcome.no_room);
  return {std::move(outcome.no_room), outcome.overlap_is_left};
}

void set_enclosed_volume(const Topology& topology, std::span<Vec3d> nodes, double volume) {
  const Vec3d center = volume_centroid(topology.faces(), nodes);
  const double scale = std::cbrt(volume / enclosed_volume(topology.faces(), nodes, center));
  for (Vec3d& p : nodes) p = center + (p - center) * scale;
}

}  // namespace morula
