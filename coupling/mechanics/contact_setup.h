#pragma once
#include <vector>

#include "cbm/pair_forces.h"
#include "core/contact/contact_layer.h"
#include "core/result.h"
#include "coupling/model.h"

namespace morula {

/// Materials of the contact layer: cell types, obstacles, and one for the walls of the domain (no adhesion, no friction), in this order.
/// A (count × count) table; count = contact_material_count(model). Tensions of surfaces are those without marks, at a time [s].
std::vector<ContactMaterial> contact_materials(const Model& model, double time = 0.0);
[[nodiscard]] inline std::size_t contact_material_count(const Model& model) { return model.material_count() + 1; }

/// Obstacles of the study and a thick plate for every wall of the domain. Errors name the obstacle whose mesh is no closed
/// surface, or has more faces near one cell than a pair's lists can hold.
Result<std::vector<RigidSurface>> contact_obstacles(const Model& model);

/// How many surfaces contact_obstacles() makes: what `Tissue::obstacle_offset` has one entry each for.
[[nodiscard]] std::size_t contact_obstacle_count(const Model& model);

/// Contact of spheres with all materials: types, obstacles, and one more for walls, which neither adhere nor rub.
cbm::ContactTable sphere_contact_table(const Model& model);

/// The largest k_r of any pair of surfaces [kPa/µm].
[[nodiscard]] double stiffest_repulsion(const Model& model);

/// Ranges and skins of the contact layer for this model.
ContactSettings contact_settings(const Model& model, int threads);

}  // namespace morula
