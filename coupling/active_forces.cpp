#include <algorithm>
#include <map>
#include <optional>

#include "coupling/behaviours/migration.h"
#include "coupling/behaviours/polarity.h"
#include "coupling/loads/loads.h"
#include "coupling/lumens.h"
#include "coupling/protrusion.h"
#include "coupling/simulation.h"

namespace morula {
namespace {

/// What is left of a force along a surface; nothing where the body does not touch it.
Vec3d along_surface(const Vec3d& force, const Touch& touch) {
  if (!(touch.area > 0.0)) return {};
  return force - touch.normal * dot(force, touch.normal);
}

using Touches = std::map<int, std::vector<Touch>>;  ///< of all bodies, by material
constexpr int kAnyObstacle = -1;                    // as Migration::substrate

/// Touch of all bodies with each of some materials, or with any obstacle. Collective.
template <class MaterialOf>
Touches find_touches(const Model& model, const Tissue& tissue, Mechanics& mechanics, MaterialOf&& material_of) {
  Touches out;
  if (model.obstacles.empty()) return out;
  for (const CellType& type : model.types) {
    const std::optional<int> material = material_of(type);
    if (!material || out.contains(*material)) continue;
    std::vector<char> materials(model.material_count(), 0);
    if (*material == kAnyObstacle)
      std::fill(materials.begin() + static_cast<std::ptrdiff_t>(model.types.size()), materials.end(), 1);
    else
      materials[static_cast<std::size_t>(*material)] = 1;
    out[*material] = mechanics.touch_of_bodies(tissue, materials);
  }
  return out;
}

Touches touches_of_protrusions(const Model& model, const Tissue& tissue, Mechanics& mechanics) {
  return find_touches(model, tissue, mechanics, [](const CellType& type) {
    return type.protrusion.substrate >= 0 ? std::optional(type.protrusion.substrate) : std::nullopt;
  });
}

/// Nodes of faces in contact with a material, by node of the rank's shells.
std::vector<char> nodes_in_touch(const Model& model, const Tissue& tissue, Mechanics& mechanics, int material) {
  std::vector<char> materials(model.material_count(), 0);
  materials[static_cast<std::size_t>(material)] = 1;
  const std::vector<float> part = mechanics.contact_of_faces(tissue, materials);
  std::vector<char> out(tissue.shells.node_count(), 0);
  std::size_t face = 0;
  for (std::size_t s = 0; s < tissue.shells.size(); ++s)
    for (const Triangle& t : tissue.shells.topology(s).faces())
      if (part[face++] > 0.0f)
        for (const std::uint32_t node : t) out[tissue.shells.first_node[s] + node] = 1;
  return out;
}

}  // namespace

std::vector<Vec3d> Simulation::forces_on_cells(double time) {
  const auto touch = touches_of_protrusions(model_, tissue_, *mechanics_);
  std::vector<Vec3d> shells, spheres;
  const OptionalColumns& optional = tissue_.cells.optional;
  for (const BodyOfRow& owned : bodies_of(tissue_.cells)) {
    const std::size_t i = owned.row, body = owned.place(tissue_.shells.size());
    const bool is_shell = owned.is_shell;
    const CellRow& row = tissue_.cells.rows[i];
    const CellType& type = model_.types[row.type];
    Vec3d force = body_force(model_, row.type, time);
    if (!is_shell && type.protrusion.force > 0.0 && !type.protrusion.internal) {  // a sphere has no front: the force is that of the whole
      Vec3d direction = optional.polarity[i];
      double size = type.protrusion.force;
      if (type.protrusion.substrate >= 0) {
        const Touch& on = touch.at(type.protrusion.substrate)[body];
        direction = along_surface(direction, on);
        if (type.protrusion.contact_area > 0.0) size *= std::min(1.0, on.area / type.protrusion.contact_area);
      }
      if (norm2(direction) > 0.0) force += normalized(direction) * size;
    }
    (is_shell ? shells : spheres).push_back(force);
  }
  shells.insert(shells.end(), spheres.begin(), spheres.end());
  return shells;
}

void Simulation::add_crawling(std::span<const Vec3d> walk, std::span<Vec3d> external) {
  const auto walks = [](const CellType& type) { return type.migration.acts(); };
  if (std::ranges::none_of(model_.types, walks)) return;  // not by `walk`: a rank may have no cell
  const Touches touch = find_touches(model_, tissue_, *mechanics_, [&](const CellType& type) {
    return walks(type) ? std::optional(type.migration.substrate) : std::nullopt;
  });
  std::vector<Vec3d> velocity(tissue_.cells.size());
  for (const BodyOfRow& owned : bodies_of(tissue_.cells)) {
    const std::size_t i = owned.row, body = owned.place(tissue_.shells.size());
    const CellType& type = model_.types[tissue_.cells.rows[i].type];
    if (!walks(type)) continue;
    const auto found = touch.find(type.migration.substrate);
    const Touch on = found != touch.end() ? found->second[body] : Touch{};
    velocity[body] = crawling_velocity(walk[i], on.area > 0.0, on.normal, type.migration.substrate >= 0);
  }
  mechanics_->add_crawling(tissue_, velocity, external);
}

void Simulation::add_protrusions(std::span<Vec3d> external) {
  const auto active = [](const CellType& type) { return type.protrusion.force > 0.0; };
  if (std::none_of(model_.types.begin(), model_.types.end(), active)) return;
  const auto touch = touches_of_protrusions(model_, tissue_, *mechanics_);
  std::map<int, std::vector<char>> nodes;
  for (const CellType& type : model_.types)
    if (const int m = type.protrusion.substrate; active(type) && m >= 0 && !nodes.contains(m))
      nodes[m] = nodes_in_touch(model_, tissue_, *mechanics_, m);
  for (const auto [i, is_shell, s] : bodies_of(tissue_.cells)) {
    const CellRow& row = tissue_.cells.rows[i];
    if (!is_shell) continue;
    const Protrusion& law = model_.types[row.type].protrusion;
    if (law.force == 0.0) continue;
    const std::uint32_t first = tissue_.shells.first_node[s], count = tissue_.shells.first_node[s + 1] - first;
    double size = law.force;
    const Vec3d polarity = tissue_.cells.optional.polarity[i];
    Vec3d direction = polarity;
    Footing footing;
    if (law.substrate >= 0) {
      const Touch& on = touch.at(law.substrate)[s];
      direction = along_surface(direction, on);
      if (law.contact_area > 0.0) size *= std::min(1.0, on.area / law.contact_area);
      footing = {std::span(nodes.at(law.substrate)).subspan(first, count), on.normal};
    }
    (void)add_protrusion(law, tissue_.shells.topology(s), std::as_const(tissue_.shells).nodes(s), polarity, footing, direction, size,
                         external.subspan(first, count));
  }
}

std::vector<Vec3d> Simulation::external_forces(double time, std::span<const Vec3d> walk) {
  std::vector<Vec3d> out = mechanics_->spread(tissue_, forces_on_cells(time));
  add_surface_loads(model_, tissue_, time, LoadsThat::kDoNotFollow, out);
  add_lumen_forces(model_, tissue_, time, comm_, out);
  const std::vector<Vec3d> of_fluid = pushes_on_spheres(model_, tissue_, time);
  for (std::size_t i = 0; i < of_fluid.size(); ++i) out[tissue_.shells.node_count() + i] += of_fluid[i];
  add_protrusions(out);
  add_crawling(walk, out);
  return out;
}

void Simulation::turn_polarities(std::uint64_t step, double dt) {
  OptionalColumn<Vec3d>& polarity = tissue_.cells.optional.polarity;
  if (polarity.empty()) return;
  for (const auto [i, is_shell, number] : bodies_of(tissue_.cells)) {
    const CellRow& row = tissue_.cells.rows[i];
    const CellType& type = model_.types[row.type];
    TurningCell cell{.id = row.id, .random = Random(model_.seed, RandomStream::kPolarity), .step = step, .dt = dt};
    if (!is_shell) {
      const Vec3f& v = tissue_.spheres.velocity[number];
      cell.velocity = {v.x, v.y, v.z};
    } else if (type.polarity.looks_at_velocity()) {
      const std::uint32_t first = tissue_.shells.first_node[number], last = tissue_.shells.first_node[number + 1];
      for (std::uint32_t n = first; n < last; ++n) {
        const Vec3f& v = tissue_.shells.velocity[n];
        cell.velocity += Vec3d{v.x, v.y, v.z};
      }
    }
    polarity.set(i, next_polarity(polarity[i], cell, type));
  }
}

}  // namespace morula
