#include "coupling/around_divisions.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "coupling/neighbourhoods.h"
#include "coupling/sensed_fields.h"

namespace morula {
namespace {

const CellType& type_of(const Model& model, const Tissue& tissue, const BodyOfRow& body) {
  return model.types[tissue.cells.rows[body.row].type];
}

/// The numbers of those with which(type, body) among `mothers`; nothing where no mother of any rank is one. Of a model without such types nothing is asked
/// of other ranks. Collective.
template <class Which>
std::optional<std::vector<std::size_t>> choose(const Model& model, const Tissue& tissue, const Comm& comm,
                                               std::span<const BodyOfRow> mothers, const Which& which) {
  const auto may_look = [&](const CellType& type) { return which(type, false) || which(type, true); };
  if (std::ranges::none_of(model.types, may_look)) return std::nullopt;
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < mothers.size(); ++k)
    if (which(type_of(model, tissue, mothers[k]), mothers[k].is_shell)) out.push_back(k);
  if (!comm.any(!out.empty())) return std::nullopt;
  return out;
}

void find_neighbours(const Model& model, const Tissue& tissue, Mechanics& mechanics, const Comm& comm, std::span<const BodyOfRow> mothers,
                     std::vector<AroundDivision>& out) {
  const auto looking = choose(model, tissue, comm, mothers,
                              [](const CellType& type, bool is_shell) { return !is_shell && type.axis->spheres_look_at_neighbours; });
  if (!looking) return;
  std::vector<std::size_t> places;
  for (const std::size_t k : *looking) places.push_back(mothers[k].place(tissue.shells.size()));
  auto found = mechanics.neighbours_of(tissue, places);
  for (std::size_t k = 0; k < looking->size(); ++k) out[(*looking)[k]].neighbours = std::move(found[k]);
}

void find_surface(const Model& model, const Tissue& tissue, Mechanics& mechanics, const Comm& comm, std::span<const BodyOfRow> mothers,
                  std::vector<AroundDivision>& out) {
  const auto looking = choose(model, tissue, comm, mothers, [](const CellType& type, bool) { return type.axis->looks_at_surface; });
  if (!looking) return;
  const std::vector<OpenSides> open = mechanics.open_sides(tissue);
  for (const std::size_t k : *looking) out[k].surface_normal = open[mothers[k].place(tissue.shells.size())].middle();
}

Status find_gradients(const Model& model, const Tissue& tissue, const Comm& comm, std::span<const BodyOfRow> mothers,
                      std::vector<AroundDivision>& out) {
  for (std::size_t field = 0; field < model.fields.size(); ++field) {
    const auto looking = choose(model, tissue, comm, mothers,
                                [field](const CellType& type, bool) { return type.axis_own.number("field") == static_cast<int>(field); });
    if (!looking) continue;
    std::vector<std::size_t> rows;
    std::vector<Vec3d> center;
    for (const std::size_t k : *looking) {
      rows.push_back(mothers[k].row);
      center.push_back(center_of(tissue, mothers[k]));
    }
    MORULA_TRY_ASSIGN(const auto sensed, sense_field(model, tissue, field, rows, center, comm));
    for (std::size_t k = 0; k < looking->size(); ++k) out[(*looking)[k]].gradient = sensed[k].gradient;
  }
  return {};
}

void find_geometry(const Model& model, const Tissue& tissue, const Mechanics& mechanics, std::span<const BodyOfRow> mothers,
                   std::vector<AroundDivision>& out) {
  for (std::size_t k = 0; k < mothers.size(); ++k) {
    const int number = type_of(model, tissue, mothers[k]).axis_own.number("geometry");
    if (number < 0) continue;
    const auto obstacle = static_cast<std::size_t>(number);
    const RigidSurface& surface = mechanics.obstacles()[obstacle];
    const Vec3d center = center_of(tissue, mothers[k]), offset = tissue.obstacle_offset[obstacle];
    double least = std::numeric_limits<double>::infinity();
    for_images(surface, offset, model.space, model.space.box, [&](const SurfaceImage& image) {
      const Vec3d from = center - (offset + image.shift);
      const auto nearest = surface.tree->nearest(from);
      if (!nearest || nearest->closest.distance2 >= least) return;
      least = nearest->closest.distance2;
      out[k].to_geometry = nearest->closest.point - from;
    });
  }
}

}  // namespace

Result<std::vector<AroundDivision>> look_around(const Model& model, const Tissue& tissue, Mechanics& mechanics, const Comm& comm,
                                                std::span<const BodyOfRow> mothers) {
  std::vector<AroundDivision> out(mothers.size());
  find_neighbours(model, tissue, mechanics, comm, mothers, out);
  find_surface(model, tissue, mechanics, comm, mothers, out);
  MORULA_TRY(find_gradients(model, tissue, comm, mothers, out));
  find_geometry(model, tissue, mechanics, mothers, out);
  return out;
}

}  // namespace morula
