#include "coupling/gathered_parts.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/parallel/pack.h"

namespace morula {
namespace {

/// What a message is made of: a number and some cells.
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

/// visit(number, cells) for all of a message.
template <class Visit>
void read_all(std::span<const std::byte> mail, ShapeLibrary& shapes, Visit&& visit) {
  while (!mail.empty()) {
    const Header header = unpack<Header>(mail.first(sizeof(Header)))[0];
    visit(header.number, read_records(mail.subspan(sizeof(Header), header.bytes), shapes));
    mail = mail.subspan(sizeof(Header) + header.bytes);
  }
}

}  // namespace

GatheredParts::GatheredParts(const Tissue& tissue, std::span<const Neighbourhood> all, const Mechanics& mechanics, ShapeLibrary& shapes,
                             const Comm& comm)
    : tissue_(tissue), all_(all), mechanics_(mechanics), shapes_(shapes), comm_(comm) {
  std::vector<std::size_t> rows;
  for (const Neighbourhood& n : all) rows.insert(rows.end(), n.rows.begin(), n.rows.end());
  std::ranges::sort(rows);
  const auto repeated = std::ranges::unique(rows);
  rows.erase(repeated.begin(), repeated.end());
  bodies_ = bodies_of(tissue.cells, rows);
  across_ = std::ranges::any_of(all, [](const Neighbourhood& n) { return !n.on_one_rank; });
  if (!across_) return;
  Mail mail;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (!all[k].for_all_ranks && all[k].owner != comm.rank() && !all[k].rows.empty()) append(mail[all[k].owner], k, cells_of(all[k]));
  for (const auto& [rank, bytes] : comm.exchange(std::move(mail)))
    read_all(bytes, shapes, [&, from = rank](std::uint64_t number, std::vector<CellRecord> cells) {
      for (const CellRecord& cell : cells) home_.emplace(cell.row.id, from);
      std::ranges::move(cells, std::back_inserter(guests_[number]));
    });
}

std::vector<CellRecord> GatheredParts::cells_of(const Neighbourhood& n) const {
  std::vector<CellRecord> out;
  out.reserve(n.rows.size());
  for (const std::size_t row : n.rows) out.push_back(record_of(tissue_, *std::ranges::lower_bound(bodies_, row, {}, &BodyOfRow::row)));
  return out;
}

Tissue GatheredParts::part_of(std::size_t number) const {
  std::vector<CellRecord> cells = cells_of(all_[number]);
  if (const auto guests = guests_.find(number); guests != guests_.end()) std::ranges::copy(guests->second, std::back_inserter(cells));
  Tissue out;
  out.clock = tissue_.clock;
  out.cells = tissue_.cells.without_rows();
  out.obstacle_offset = tissue_.obstacle_offset;
  put_together(out, std::move(cells));
  return out;
}

void GatheredParts::visit(const Visit& visit) const {
  Mechanics alone = mechanics_.for_another_tissue(Comm());
  for (std::size_t k = 0; k < all_.size(); ++k) {
    if (all_[k].for_all_ranks) {
      Mechanics together = mechanics_.for_another_tissue(comm_);
      Tissue part = part_of(k);
      visit(all_[k].movers, part, together, comm_);
    } else if (all_[k].owner == comm_.rank()) {
      Tissue part = part_of(k);
      alone.bodies_changed();
      visit(all_[k].movers, part, alone, Comm());
    }
  }
}

std::vector<GatheredParts::Returned> GatheredParts::send_home(std::vector<Returned> cells) const {
  if (!across_) return cells;
  std::vector<Returned> out;
  Mail mail;
  for (Returned& one : cells) {
    const auto home = home_.find(one.cell.row.id);
    if (home == home_.end())
      out.push_back(std::move(one));
    else
      append(mail[home->second], one.marked ? 1 : 0, std::span(&one.cell, 1));
  }
  for (const auto& [rank, bytes] : comm_.exchange(std::move(mail)))
    read_all(bytes, shapes_, [&](std::uint64_t marked, std::vector<CellRecord> of_one) {
      out.push_back({std::move(of_one[0]), marked != 0});
    });
  return out;
}

}  // namespace morula
