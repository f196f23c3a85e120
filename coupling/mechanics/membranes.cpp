#include "coupling/mechanics/membranes.h"

#include <algorithm>

#include "coupling/mechanics/body_factors.h"
#include "coupling/mechanics/shell_faults.h"

namespace morula {

void Membranes::bodies_changed(const World& world) {
  const auto owned = world.scene.bodies().first(world.scene.owned_shells());
  std::vector<char> moves;
  if (!std::ranges::all_of(owned, &ContactBody::active))
    for (const ContactBody& body : owned) moves.push_back(body.active());
  shells_.set_shells(world.tissue.shells, world.threads, moves);
  const auto deviations = [&](Trait trait) { return deviations_of_shells(world.model, world.tissue.cells, trait); };
  shells_.set_deviations(world.tissue.shells, deviations(Trait::kTension), deviations(Trait::kStiffness));
  held_ = {};
}

void Membranes::evaluate(const World& world, Forces& out) {
  shells_.evaluate(world.tissue.shells, world.position(), out.force, held_);
  for (const double energy : shells_.forces().energy) out.energy.add(energy);
}

std::optional<StepFault> Membranes::fault(const World& world) const {
  return first_fault(shells_.forces().fault, [&](std::size_t i) { return world.scene.bodies()[i].id; });
}

void Membranes::begin_step(const World& world, StepStart&) { shells_.begin_step(world.tissue.shells, world.geometry); }

void Membranes::add_friction(const World&, const Way& way, std::span<Vec3d> out, OrderFreeSum& quadratic) {
  if (way.moved) shells_.add_step_friction(way.position, out, quadratic);
}

void Membranes::add_noise(const World& world, const Noise& noise, std::span<Vec3d> force) const {
  const Random random(noise.seed, RandomStream::kFluctuationOfNodes);
  const dcm::Shells& shells = world.tissue.shells;
  const std::vector<SymMat3<double>> blocks = nodes_.at(world.tissue, world.geometry);
  for (std::size_t k = 0; k < shells.size(); ++k) {
    const double energy = world.model.types[shells.type[k]].fluctuations.energy;
    if (energy == 0.0) continue;
    const std::uint32_t first = shells.first_node[k], count = shells.first_node[k + 1] - first;
    const ShellNoise s{
        shells_.materials().of(shells, k), shells.topology(k), world.scene.bodies()[k].id, noise.strength(energy), shells.nodes(k),
        force.subspan(first, count)};
    for (std::uint32_t i = 0; i < count; ++i) {
      const double area = world.geometry.node_area[first + i];
      const Vec3d numbers = normal_vector(random, s.cell, noise.draw(i));
      // Across the surface and along it there may be different friction.
      const double base = s.law.medium_friction * area;
      const Vec3d n = world.geometry.node_normal[first + i];
      const double along = blocks.empty() ? 0.0 : dot(n, blocks[first + i] * n);
      const double trace = blocks.empty() ? 0.0 : blocks[first + i].xx + blocks[first + i].yy + blocks[first + i].zz;
      s.force[i] += along_and_across(numbers, n, base + std::max(0.0, 0.5 * (trace - along)), base + along) * s.strength;
    }
    add_edge_noise(s, noise);
    add_bulk_noise(s, noise, world.geometry.volume[k]);
  }
}

void Membranes::build(const World& world, double dt, const Assembly& assembly, const EdgeBlockSource& edges) {
  shells_.assemble(world.tissue.shells, world.position(), assembly.face_energy, dt, edges, assembly.node_block);
}

}  // namespace morula
