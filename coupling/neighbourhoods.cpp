#include "coupling/neighbourhoods.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <numeric>
#include <utility>

#include "core/contact/broad_phase.h"
#include "core/parallel/pack.h"
#include "coupling/swaps.h"

namespace morula {
namespace {

/// From so many movers on all ranks work on a neighbourhood that lies on several.
constexpr std::size_t kManyMovers = 32;

/// A box that others are looked for around, as all ranks know it: of a mover, or of a sphere beside one.
struct Seed {
  CellId id;
  Box box;
  std::uint32_t group = 0;  ///< movers: the rank; spheres beside: the mover
};

bool near(const Box& a, const Box& b, const Space& space) {
  const Vec3d between = space.nearest_image(b.center() - a.center()), room = (a.size() + b.size()) * 0.5;
  return std::abs(between.x) <= room.x && std::abs(between.y) <= room.y && std::abs(between.z) <= room.z;
}

/// Seeds of all ranks in the order of their ids.
std::vector<Seed> of_all_ranks(const std::vector<Seed>& mine, const Comm& comm) {
  std::vector<Seed> all = items_of_all_ranks(mine, comm);
  std::ranges::sort(all, [](const Seed& a, const Seed& b) { return a.id != b.id ? a.id < b.id : a.group < b.group; });
  return all;
}

/// found(seed, body) for all bodies of the tissue whose boxes overlap that of the seed. One walk over the bodies, which keeps those near to any.
template <class Found>
void for_bodies_near(std::span<const Seed> seeds, const Tissue& tissue, const Space& space, Found&& found) {
  if (seeds.empty()) return;
  Box all;
  for (const Seed& seed : seeds) all.include(seed.box);
  std::vector<BodyOfRow> candidates;
  std::vector<Box> boxes;
  for (const BodyOfRow& body : bodies_of(tissue.cells)) {
    const Box box = box_of(tissue, body);
    if (!near(all, box, space)) continue;
    candidates.push_back(body);
    boxes.push_back(box);
  }
  if (candidates.size() * seeds.size() < 100000) {
    for (std::uint32_t s = 0; s < seeds.size(); ++s)
      for (std::size_t k = 0; k < candidates.size(); ++k)
        if (near(seeds[s].box, boxes[k], space)) found(s, candidates[k], boxes[k]);
    return;
  }
  std::vector<Extent> extents;
  const auto add = [&](const Box& box) { extents.push_back({box, box.center(), 0.5 * norm(box.size())}); };
  for (const Seed& seed : seeds) add(seed.box);
  for (const Box& box : boxes) add(box);
  std::vector<std::uint32_t> place(extents.size());
  std::iota(place.begin(), place.end(), 0u);
  find_body_pairs_of(std::span(place).first(seeds.size()), extents, place, space, 1, [&](const BodyPair& pair) {
    const std::size_t k = pair.b - seeds.size();
    if (pair.b >= seeds.size()) found(pair.a, candidates[k], boxes[k]);
  });
}

/// Which movers are in one neighbourhood: each is known by the first of its group.
class Groups {
 public:
  explicit Groups(std::size_t count) : first_(count) { std::iota(first_.begin(), first_.end(), 0u); }
  std::uint32_t of(std::uint32_t a) {
    while (first_[a] != a) a = first_[a] = first_[first_[a]];
    return a;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = of(a), b = of(b);
    first_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> first_;
};

struct Pair {
  std::uint32_t first, second;
  friend auto operator<=>(const Pair&, const Pair&) = default;
};

/// A body of this rank that a mover may touch.
struct NearMover {
  std::size_t row;
  std::uint32_t mover;
  Box box;
  bool is_shell;
};

/// Joins what any rank has found.
void join_all(const std::vector<Pair>& mine, Groups& groups, const Comm& comm) {
  for (const auto& [a, b] : items_of_all_ranks(mine, comm)) groups.join(a, b);
}

/// The movers, in boxes that hold all that they may touch on their way.
std::vector<Seed> movers_of_all_ranks(const Tissue& tissue, std::span<const CellId> movers, const Reach& reach, const Comm& comm) {
  std::vector<Seed> out;
  for (const BodyOfRow& body : bodies_of(tissue.cells, rows_of(tissue.cells, movers))) {
    const Box box = box_of(tissue, body);
    out.push_back({tissue.cells.rows[body.row].id, box.inflated(reach.touch + reach.way * largest_edge(box)),
                   static_cast<std::uint32_t>(comm.rank())});
  }
  return of_all_ranks(out, comm);
}

}  // namespace

double largest_edge(const Box& box) {
  const Vec3d size = box.size();
  return std::max({size.x, size.y, size.z});
}

Vec3d center_of(const Tissue& tissue, const BodyOfRow& body) {
  return body.is_shell ? volume_centroid(tissue.shells.topology(body.number).faces(), tissue.shells.nodes(body.number))
                       : tissue.spheres.position[body.number];
}

Box box_of(const Tissue& tissue, const BodyOfRow& body) {
  Box out;
  if (body.is_shell) {
    for (const Vec3d& x : tissue.shells.nodes(body.number)) out.include(x);
    return out;
  }
  out.include(tissue.spheres.position[body.number]);
  return out.inflated(tissue.spheres.radius[body.number]);
}

std::vector<Neighbourhood> find_neighbourhoods(const Tissue& tissue, const Space& space, std::span<const CellId> movers, const Reach& reach,
                                               const Comm& comm) {
  const std::vector<Seed> seeds = movers_of_all_ranks(tissue, movers, reach, comm);
  // What a mover may touch. Two movers both may go towards each other.
  Groups groups(seeds.size());
  std::vector<NearMover> near_mover;
  for (std::uint32_t a = 0; a < seeds.size(); ++a)
    for (std::uint32_t b = a + 1; b < seeds.size(); ++b)
      if (near(seeds[a].box, seeds[b].box, space)) groups.join(a, b);
  for_bodies_near(seeds, tissue, space, [&](std::uint32_t s, const BodyOfRow& body, const Box& box) {
    near_mover.push_back({body.row, s, box, body.is_shell});
  });
  std::ranges::sort(near_mover, {}, [](const NearMover& n) { return std::pair(n.row, n.mover); });
  std::vector<Seed> beside;
  std::vector<Pair> joined;
  for (std::size_t n = 0; reach.packs && n < near_mover.size(); ++n) {
    const auto& [row, s, box, is_shell] = near_mover[n];
    if (is_shell) continue;
    if (n > 0 && near_mover[n - 1].row == row)
      joined.push_back({near_mover[n - 1].mover, s});
    else
      beside.push_back({tissue.cells.rows[row].id, box.inflated(reach.touch), s});
  }
  join_all(joined, groups, comm);
  const std::vector<Seed> all_beside = of_all_ranks(beside, comm);
  for_bodies_near(all_beside, tissue, space, [&](std::uint32_t s, const BodyOfRow& body, const Box& box) {
    near_mover.push_back({body.row, all_beside[s].group, box, body.is_shell});
  });

  std::vector<Neighbourhood> out;
  std::vector<std::size_t> number(seeds.size());
  for (std::uint32_t s = 0; s < seeds.size(); ++s) {
    if (groups.of(s) == s) {
      number[s] = out.size();
      out.emplace_back().owner = static_cast<int>(seeds[s].group);
    }
    number[s] = number[groups.of(s)];
    out[number[s]].movers.push_back(seeds[s].id);
  }
  for (const NearMover& n : near_mover) out[number[n.mover]].rows.push_back(n.row);
  std::vector<std::int64_t> elsewhere;
  for (Neighbourhood& here : out) {
    std::ranges::sort(here.rows);
    const auto last = std::ranges::unique(here.rows);
    here.rows.erase(last.begin(), last.end());
    elsewhere.push_back(here.owner != comm.rank() && !here.rows.empty() ? 1 : 0);
  }
  if (comm.size() > 1) comm.sum(elsewhere);
  for (std::size_t n = 0; n < out.size(); ++n) {
    out[n].on_one_rank = elsewhere[n] == 0;
    out[n].for_all_ranks = !out[n].on_one_rank && out[n].movers.size() >= kManyMovers;
  }
  return out;
}

namespace {

Neighbourhood whole_tissue(const Tissue& tissue, std::span<const CellId> movers, const Comm& comm) {
  Neighbourhood out;
  out.movers = ids_of_all_ranks({movers.begin(), movers.end()}, comm);
  out.rows.resize(tissue.cells.size());
  std::iota(out.rows.begin(), out.rows.end(), std::size_t{0});
  out.on_one_rank = comm.size() == 1;
  out.for_all_ranks = !out.on_one_rank;
  return out;
}

}  // namespace

bool everybody_has_a_part(const Model& model) { return !model.apical_springs.empty(); }

std::vector<Neighbourhood> neighbourhoods_of(const Tissue& tissue, const Model& model, const ContactSettings& contact,
                                             std::span<const CellId> movers, double way, const Comm& comm) {
  if (everybody_has_a_part(model)) return {whole_tissue(tissue, movers, comm)};
  const bool packs = std::ranges::any_of(model.types, [](const CellType& type) { return !type.sphere.packing.empty(); });
  return find_neighbourhoods(tissue, model.space, movers, {std::max(contact.range, contact.sphere_reach), way, packs}, comm);
}

}  // namespace morula
