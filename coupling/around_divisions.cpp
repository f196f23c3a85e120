#include "coupling/around_divisions.h"

#include <utility>

#include "coupling/neighbourhoods.h"
#include "coupling/sensed_fields.h"

namespace morula {
namespace {

const CellType& type_of(const Model& model, const Tissue& tissue, const BodyOfRow& body) {
  return model.types[tissue.cells.rows[body.row].type];
}

/// The numbers of those with which(mother) among `mothers`.
template <class Which>
std::vector<std::size_t> choose(std::span<const BodyOfRow> mothers, const Which& which) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < mothers.size(); ++k)
    if (which(mothers[k])) out.push_back(k);
  return out;
}

void find_neighbours(const Model& model, const Tissue& tissue, Mechanics& mechanics, const Comm& comm, std::span<const BodyOfRow> mothers,
                     std::vector<AroundDivision>& out) {
  const std::vector<std::size_t> looking = choose(
      mothers, [&](const BodyOfRow& body) { return !body.is_shell && type_of(model, tissue, body).axis->spheres_look_at_neighbours; });
  if (!comm.any(!looking.empty())) return;
  std::vector<std::size_t> places;
  for (const std::size_t k : looking) places.push_back(mothers[k].place(tissue.shells.size()));
  auto found = mechanics.neighbours_of(tissue, places);
  for (std::size_t k = 0; k < looking.size(); ++k) out[looking[k]].neighbours = std::move(found[k]);
}

void find_surface(const Model& model, const Tissue& tissue, Mechanics& mechanics, const Comm& comm, std::span<const BodyOfRow> mothers,
                  std::vector<AroundDivision>& out) {
  const std::vector<std::size_t> looking =
      choose(mothers, [&](const BodyOfRow& body) { return type_of(model, tissue, body).axis->looks_at_surface; });
  if (!comm.any(!looking.empty())) return;
  const std::vector<OpenSides> open = mechanics.open_sides(tissue);
  for (const std::size_t k : looking) out[k].surface_normal = open[mothers[k].place(tissue.shells.size())].middle();
}

Status find_gradients(const Model& model, const Tissue& tissue, const Comm& comm, std::span<const BodyOfRow> mothers,
                      std::vector<AroundDivision>& out) {
  for (std::size_t field = 0; field < model.fields.size(); ++field) {
    const std::vector<std::size_t> looking = choose(
        mothers, [&](const BodyOfRow& body) { return type_of(model, tissue, body).axis_own.number("field") == static_cast<int>(field); });
    if (!comm.any(!looking.empty())) continue;
    std::vector<std::size_t> rows;
    std::vector<Vec3d> center(tissue.cells.size());
    for (const std::size_t k : looking) {
      rows.push_back(mothers[k].row);
      center[mothers[k].row] = center_of(tissue, mothers[k]);
    }
    MORULA_TRY_ASSIGN(const auto sensed, sense_field(model, tissue, field, rows, center, comm));
    for (std::size_t k = 0; k < looking.size(); ++k) out[looking[k]].gradient = sensed[k].gradient;
  }
  return {};
}

void find_geometry(const Model& model, const Tissue& tissue, const Mechanics& mechanics, std::span<const BodyOfRow> mothers,
                   std::vector<AroundDivision>& out) {
  for (std::size_t k = 0; k < mothers.size(); ++k) {
    const int number = type_of(model, tissue, mothers[k]).axis_own.number("geometry");
    if (number < 0) continue;
    const auto obstacle = static_cast<std::size_t>(number);
    const Vec3d from = center_of(tissue, mothers[k]) - tissue.obstacle_offset[obstacle];
    if (const auto nearest = mechanics.obstacles()[obstacle].tree->nearest(from)) out[k].to_geometry = nearest->closest.point - from;
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
