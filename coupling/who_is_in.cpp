#include "coupling/who_is_in.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/space/images.h"
#include "coupling/regions/counts_from.h"
#include "coupling/tissue_middle.h"

namespace morula {
namespace {

bool needs_center(const Swaps& swaps) {
  return std::any_of(swaps.regions.begin(), swaps.regions.end(), [](const Region& r) { return r.follow_tissue; });
}

/// Of the images nearest to the middle of the tissue. Collective.
Vec3d tissue_centroid(const Space& space, std::span<const Vec3d> center, const Comm& comm) {
  const Vec3d middle = tissue_middle(space, center, {}, comm).at;
  OrderFreeSum sums[4];
  for (const Vec3d& c : center) {
    const Vec3d from = space.nearest_image(c - middle);
    sums[0].add(from.x);
    sums[1].add(from.y);
    sums[2].add(from.z);
    sums[3].add(1.0);
  }
  double total[4];
  comm.sum(sums, total);
  return total[3] > 0.0 ? middle + Vec3d{total[0], total[1], total[2]} * (1.0 / total[3]) : Vec3d{};
}

/// How many times as long as at time 0 a domain with a course is: regions are carried along with it, as cells are, their size, too.
double stretch_of_box(const Model& model, double time) { return std::cbrt(model.box_volume.at(time)); }

/// Of the images of a place along the periodic axes that which is deepest in the region, or nearest to it.
double distance_outside(const Region& region, const Vec3d& from, const Space& space, double stretch) {
  const auto distance = [&](const Vec3d& place) { return stretch * region.shape->distance(region, place * (1.0 / stretch)); };
  if (!region.shape->repeats || !space.any_periodic()) return distance(from);
  const Vec3d near = space.nearest_image(from);  // what a region follows may have gone round the domain
  double least = std::numeric_limits<double>::infinity();
  for_boxes_around(space, [&](const Vec3d& shift) { least = std::min(least, distance(near + shift)); });
  return least;
}

}  // namespace

std::vector<Vec3d> centers_of_regions(const Model& model, const Tissue& tissue, std::span<const Vec3d> center, const Comm& comm) {
  const Vec3d of_tissue = needs_center(model.swaps) ? tissue_centroid(model.space, center, comm) : Vec3d{};
  const double stretch = stretch_of_box(model, tissue.clock.time);
  const Vec3d middle = model.space.box.center();
  std::vector<Vec3d> out;
  for (const Region& region : model.swaps.regions) {
    // the same bits as in the study where nothing is stretched
    out.push_back(region.follow_tissue ? region.center * stretch + of_tissue : region.center + (region.center - middle) * (stretch - 1.0));
    if (region.obstacle >= 0) out.back() += model.obstacles[static_cast<std::size_t>(region.obstacle)].way(0.0, tissue.clock.time);
  }
  return out;
}

Standing standing(const Model& model, std::size_t number, const CellView& cell, std::size_t i, const Vec3d& from,
                  std::span<const std::vector<std::uint32_t>> contacts) {
  const Region& region = model.swaps.regions[number];
  Standing out{kNever, 1.0};  // one contact
  if (region.shape->of_cell != nullptr)
    out = region.shape->of_cell(region, cell);
  else if (region.shape->has_border())
    out = {distance_outside(region, from, model.space, stretch_of_box(model, cell.time())), region.margin};
  else if (number < contacts.size() && !contacts[number].empty())
    out.outside = contacts[number][i] - region.contacts;
  if (cell.row().body != region.body) out.margin = 0.0;
  return out;
}

namespace {

/// Numbers of contacts with which the bodies of a rank begin that a region counts from (Mechanics::contact_steps()). `before`: contacts of the regions
/// before it. Collective.
std::vector<std::uint32_t> where_counting_begins(const Model& model, const Tissue& tissue, std::span<const Vec3d> center,
                                                 std::span<const Vec3d> center_of_region, std::size_t number,
                                                 std::span<const std::vector<std::uint32_t>> before, Mechanics& mechanics) {
  using What = CountsFrom::What;
  const std::vector<Region>& regions = model.swaps.regions;
  std::vector<std::uint32_t> out(tissue.shells.size() + tissue.spheres.size(), Mechanics::kFarAway);
  if (regions[number].shape->counts == CountsContacts::kFromSurface) {
    const std::vector<OpenSides> open = mechanics.open_sides(tissue);
    for (std::size_t i = 0; i < out.size(); ++i)
      if (open[i].any()) out[i] = 0;
    return out;
  }
  const CountsFrom from = *counts_from(model, std::span(regions).first(number), regions[number].values.name("of"));
  if (from.what == What::kObstacle) {
    std::vector<char> with_material(model.types.size() + model.obstacles.size(), 0);
    with_material[model.types.size() + from.number] = 1;
    const std::vector<Touch> touch = mechanics.touch_of_bodies(tissue, with_material);
    for (std::size_t i = 0; i < out.size(); ++i)
      if (touch[i].area > 0.0) out[i] = 1;
    return out;
  }
  const auto begins = [&](const CellRow& row, std::size_t i) {
    if (row.phase == Phase::kDying) return false;
    if (from.what == What::kType) return row.type == from.number;
    const CellView cell(tissue.cells, i, model.types[row.type], tissue.clock.time);
    return regions[from.number].exists_at(tissue.clock.time) &&
           standing(model, from.number, cell, i, center[i] - center_of_region[from.number], before).is_in();
  };
  for (const BodyOfRow& body : bodies_of(tissue.cells))
    if (begins(tissue.cells.rows[body.row], body.row)) out[body.place(tissue.shells.size())] = 0;
  return out;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> contacts_from_regions(const Model& model, const Tissue& tissue, std::span<const Vec3d> center,
                                                              Mechanics& mechanics, const Comm& comm) {
  const std::vector<Region>& regions = model.swaps.regions;
  if (std::ranges::none_of(regions, [](const Region& region) { return region.shape->counts != CountsContacts::kNo; })) return {};
  const std::vector<Vec3d> center_of_region = centers_of_regions(model, tissue, center, comm);
  std::vector<std::vector<std::uint32_t>> out(regions.size());
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (regions[r].shape->counts == CountsContacts::kNo || !regions[r].exists_at(tissue.clock.time)) continue;
    const std::vector<std::uint32_t> start = where_counting_begins(model, tissue, center, center_of_region, r, out, mechanics);
    const std::vector<std::uint32_t> steps = mechanics.contact_steps(tissue, start, static_cast<std::uint32_t>(regions[r].contacts) + 1);
    out[r].resize(tissue.cells.size());
    for (const BodyOfRow& body : bodies_of(tissue.cells)) out[r][body.row] = steps[body.place(tissue.shells.size())];
  }
  return out;
}

}  // namespace morula
