#include "coupling/still_to_come.h"

#include <algorithm>
#include <cmath>

#include "cbm/division_ramp.h"
#include "coupling/behaviours/growth.h"
#include "coupling/behaviours/osmosis.h"
#include "coupling/loads/loads.h"
#include "coupling/swaps.h"

namespace morula {
namespace {

constexpr double kRounding = 1e-9;  // part of a volume
constexpr double kEased = 1e-3;     // part of a volume, or of a face in contact, that is too little to wait for

bool any_obstacle_moves(const Model& model) {
  return std::ranges::any_of(model.obstacles, [](const ObstacleSpec& o) { return norm2(o.velocity) > 0.0; });
}

bool any_tension_swings(const Model& model) {
  for (const CellType& type : model.types)
    for (const TensionRegion& region : type.regional_tension.regions)
      if (region.period > 0.0 && region.amplitude != 0.0) return true;
  return false;
}

bool any_region_begins_or_ends(const Model& model, double time) {
  return std::ranges::any_of(model.swaps.regions,
                             [time](const Region& r) { return r.from > time || (r.until > time && r.until < kNever); });
}

bool grows(const CellRow& row, const CellType& type) {
  return type.cycles && row.phase == Phase::kGrowing && (!type.cycle.phases.empty() || may_grow(row, type));
}

/// What cells of a type answer to though nothing moves, such as a field, which is never known to stand still.
std::vector<std::string> answers_to(const Model& model, const CellType& type) {
  std::vector<std::string> out;
  if (type.osmosis.acts() && type.osmosis.field >= 0) out.emplace_back("fields that cells answer to");
  for (const CellBehaviour& behaviour : type.behaviours)
    if (behaviour.may_act()) out.emplace_back(behaviour.what->awaited);
  for (const Region& region : model.swaps.regions)
    if (region.shape->awaited != nullptr) out.emplace_back(region.shape->awaited);
  for (const Trigger& trigger : model.swaps.triggers)
    if (trigger.compares() && trigger.value->awaited != nullptr) out.emplace_back(trigger.value->awaited);
  return out;
}

bool is_driven(const CellType& type) {
  return type.migration.acts() || type.fluctuations.energy > 0.0 || (type.protrusion.force > 0.0 && !type.polarity.rules.empty());
}

/// Water flows in or out of any cell of this rank. Collective.
bool any_water_flows(const Model& model, const Tissue& tissue, Mechanics& mechanics) {
  if (std::ranges::none_of(model.types, [](const CellType& type) { return type.osmosis.acts(); })) return false;
  const BodyValues body = mechanics.values(tissue);
  for (const BodyOfRow& owned : bodies_of(tissue.cells)) {
    const CellType& type = model.types[tissue.cells.rows[owned.row].type];
    const std::size_t b = owned.place(tissue.shells.size());
    if (!type.osmosis.acts()) continue;
    const OsmoticCell cell = osmotic_cell(tissue.cells.state(owned.row), type, tissue.clock.time, body.area[b], body.inner_pressure[b]);
    if (std::abs(osmotic_volume(cell) / body.volume[b] - 1.0) > kEased) return true;
  }
  return false;
}

/// The lateral tension of any face of this rank still follows its contact. Collective.
bool any_lateral_tension_follows(const Model& model, const Tissue& tissue, Mechanics& mechanics) {
  if (std::ranges::none_of(model.types, [](const CellType& type) { return type.regional_tension.eases_contact(); })) return false;
  std::vector<char> cells(model.material_count(), 0);
  std::fill_n(cells.begin(), model.types.size(), 1);
  const std::vector<float> now = mechanics.contact_of_faces(tissue, cells);
  std::size_t face = 0;
  for (std::size_t s = 0; s < tissue.shells.size(); ++s) {
    const std::vector<float>& eased = tissue.shells.faces_of(s).contact;
    for (std::size_t f = 0; f < eased.size(); ++f)
      if (std::abs(eased[f] - now[face + f]) > kEased) return true;
    face += tissue.shells.topology(s).face_count();
  }
  return false;
}

}  // namespace

std::vector<std::string> still_to_come(const Model& model, const Tissue& tissue, Mechanics& mechanics, std::span<const Vec3d> center,
                                       const Comm& comm) {
  const double time = tissue.clock.time;
  std::vector<std::string> out;
  const auto add = [&](bool comes, const char* what) {
    if (comm.any(comes)) out.emplace_back(what);
  };
  const auto any_cell = [&](auto&& of_row) {
    for (std::size_t k = 0; k < tissue.cells.size(); ++k)
      if (of_row(k, tissue.cells.rows[k], model.types[tissue.cells.rows[k].type])) return true;
    return false;
  };
  const OptionalColumns& optional = tissue.cells.optional;
  add(next_corner(model, time) < kNever, "a course over time");
  add(any_obstacle_moves(model), "an obstacle that moves");
  add(any_tension_swings(model), "a tension that swings");
  add(any_region_begins_or_ends(model, time), "a region that begins or ends");
  const LookedAt looked = look_for_swaps(model, tissue, center, mechanics, comm);
  std::vector<double> caps;
  if (std::ranges::any_of(model.types, [](const CellType& type) { return type.sphere.packing.last() > 0.0; }))
    caps = mechanics.as_balls(tissue).caps;
  add(swaps_wait(model, tissue, looked.bodies(center), caps, comm), "an exchange of bodies");
  add(tissue.clock.capped, "the end of the capped start");
  add(any_cell(
          [&](std::size_t k, const CellRow& row, const CellType&) { return optional.inflation_left[k] > kRounding * row.target_volume; }),
      "inflation");
  add(any_cell([](std::size_t, const CellRow& row, const CellType& type) { return grows(row, type); }), "growth");
  add(any_cell([](std::size_t, const CellRow& row, const CellType&) {
        return row.phase == Phase::kWaiting && row.body == BodyKind::kSphere && row.id.can_divide();
      }),
      "a division");
  add(any_cell([](std::size_t, const CellRow& row, const CellType&) { return row.phase == Phase::kDying; }), "the end of dying cells");
  add(any_cell([time](std::size_t, const CellRow& row, const CellType&) {
        return row.id.generation() > 0 && row.body == BodyKind::kSphere && !cbm::sisters_have_parted(row.birth_time, time);
      }),
      "young sisters");
  add(any_cell([&](std::size_t k, const CellRow&, const CellType& type) {
        return !type.osmosis.acts() && std::abs(optional.reference_excess[k]) > kEased;
      }),
      "easing after an exchange of bodies");
  for (const CellType& type : model.types)
    for (const std::string& what : answers_to(model, type))
      if (std::ranges::find(out, what) == out.end())
        add(any_cell([&](std::size_t, const CellRow&, const CellType& own) { return &own == &type; }), what.c_str());
  add(any_cell([](std::size_t, const CellRow& row, const CellType& type) { return row.phase != Phase::kDying && is_driven(type); }),
      "cells that drive themselves");
  add(any_water_flows(model, tissue, mechanics), "water that flows");
  add(any_lateral_tension_follows(model, tissue, mechanics), "tensions that follow contact");
  return out;
}

}  // namespace morula
