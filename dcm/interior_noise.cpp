#include "dcm/interior_noise.h"

#include <cmath>

namespace morula::dcm {

std::size_t interior_factor_count(const InteriorView& cell) {
  return (cell.nucleus != nullptr ? 3 + cell.links->nucleus.size() : 0) + cell.links->cortex.size();
}

void add_interior_noise(const InteriorView& cell, const InteriorFriction& friction, std::span<const double> normal, std::span<Vec3d> force,
                        Vec3d* nucleus_force) {
  std::size_t next = 0;
  if (cell.nucleus != nullptr) {
    const Vec3d drag = Vec3d{normal[0], normal[1], normal[2]} * std::sqrt(friction.drag);
    next = 3;
    *nucleus_force += drag;
    for (std::size_t i = 0; i < force.size(); ++i) force[i] -= drag * friction.share[i];
    const double root = std::sqrt(cell.parameters->nucleus_links.damping);
    for (std::size_t k = 0; k < cell.links->nucleus.size(); ++k) {
      const Vec3d pull = friction.nucleus_direction[k] * (root * normal[next++]);
      force[cell.links->nucleus[k].i] += pull;
      *nucleus_force -= pull;
    }
  }
  const double root = std::sqrt(cell.parameters->cortex_links.damping);
  for (std::size_t k = 0; k < cell.links->cortex.size(); ++k) {
    const Vec3d pull = friction.cortex_direction[k] * (root * normal[next++]);
    force[cell.links->cortex[k].i] += pull;
    force[cell.links->cortex[k].j] -= pull;
  }
}

std::size_t nuclear_factor_count(const NucleusView& view) { return 3 * view.nucleus.size() + view.links.size(); }

void add_nuclear_noise(const NucleusView& view, const NuclearFriction& friction, std::span<const double> normal, NucleusVectors force) {
  Vec3d sum, torque;
  for (std::size_t i = 0; i < view.nucleus.size(); ++i) {
    const Vec3d drag = Vec3d{normal[3 * i], normal[3 * i + 1], normal[3 * i + 2]} * std::sqrt(friction.friction[i]);
    force.nucleus[i] += drag;
    sum += drag;
    torque += cross(friction.nucleus_arm[i], drag);
  }
  // The opposite goes to the cortex as it does in add_nuclear_friction(): the transpose of the nearest rigid motion.
  const Vec3d twist = friction.inverse_inertia * torque;
  for (std::size_t k = 0; k < view.cell.size(); ++k) force.cell[k] -= (sum + cross(twist, friction.arm[k])) * friction.share[k];
  const double root = std::sqrt(view.parameters->nucleus_links.damping);
  for (std::size_t k = 0; k < view.links.size(); ++k) {
    const Vec3d pull = friction.direction[k] * (root * normal[3 * view.nucleus.size() + k]);
    force.cell[view.links[k].i] += pull;
    force.nucleus[view.links[k].j] -= pull;
  }
}

}  // namespace morula::dcm
