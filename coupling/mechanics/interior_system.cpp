#include "coupling/mechanics/interior_system.h"

#include <algorithm>

#include "core/parallel/threads.h"
#include "dcm/interior_noise.h"

namespace morula {

void InteriorSystem::bodies_changed(const World& world) {
  const dcm::Shells& shells = world.tissue.shells;
  std::uint32_t next_nucleus = world.scene.nucleus_point();
  threads_ = world.threads;
  items_.clear();
  for (std::uint32_t s = 0; s < shells.size(); ++s) {
    const std::uint16_t type = shells.type[s];
    const dcm::InteriorParameters& parameters = model_.types[type].interior;
    if (!parameters.acts()) continue;
    Item& item = items_.emplace_back();
    item.shell = s;
    item.first_node = shells.first_node[s];
    item.node_count = shells.first_node[s + 1] - shells.first_node[s];
    item.topology = shells.shape[s]->topology.get();
    item.parameters = &parameters;
    item.has_nucleus = shells.nucleus_of(s) != nullptr;
    if (item.has_nucleus) item.nucleus = next_nucleus++;
    auto& links = links_[{shells.shape[s], type}];
    if (!links) links = std::make_shared<const dcm::InteriorLinks>(dcm::choose_links(*shells.shape[s], parameters));
    item.links = links;
  }
}

dcm::InteriorView InteriorSystem::view(const Item& item, std::span<const Vec3d> position) const {
  dcm::InteriorView out;
  out.parameters = item.parameters;
  out.links = item.links.get();
  out.topology = item.topology;
  if (!position.empty()) {
    out.node = position.subspan(item.first_node, item.node_count);
    if (item.has_nucleus) out.nucleus = &position[item.nucleus];
  }
  out.rest_volume = item.rest_volume;
  out.repulsion = model_.contact.repulsion;
  out.points_per_face = model_.contact.points_per_face;
  return out;
}

void InteriorSystem::evaluate(const World& world, Forces& out) {
  parallel_for(threads_, items_.size(), [&](std::size_t k) {
    Item& item = items_[k];
    item.rest_volume = world.tissue.shells.rest_volume[item.shell];
    item.energy = dcm::add_interior_forces(view(item, world.position()), out.force.subspan(item.first_node, item.node_count),
                                           item.has_nucleus ? &out.force[item.nucleus] : nullptr);
  });
  for (const Item& item : items_) out.energy.add(item.energy.energy);
}

dcm::InteriorEnergy InteriorSystem::of_shell(std::uint32_t shell) const {
  const auto found = std::ranges::lower_bound(items_, shell, {}, &Item::shell);
  return found != items_.end() && found->shell == shell ? found->energy : dcm::InteriorEnergy{};
}

std::size_t InteriorSystem::memory() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t total = bytes(items_);
  for (const Item& item : items_)
    total += bytes(item.friction.share) + bytes(item.friction.nucleus_direction) + bytes(item.friction.cortex_direction) +
             bytes(item.matrix.share) + bytes(item.matrix.nucleus_block) + bytes(item.matrix.cortex_block) + bytes(item.matrix.contact);
  return total;
}

void InteriorSystem::begin_step(const World& world, StepStart& start) {
  parallel_for(threads_, items_.size(), [&](std::size_t k) {
    Item& item = items_[k];
    dcm::find_interior_friction(view(item, world.position()), std::span(world.geometry.node_area).subspan(item.first_node, item.node_count),
                                item.friction);
  });
  for (const Item& item : items_) {
    if (!item.has_nucleus) continue;
    Vec3d mean;
    for (const Float4& v : start.velocity.subspan(item.first_node, item.node_count)) mean += to_double(v);
    mean *= 1.0 / item.node_count;
    start.velocity[item.nucleus] = {static_cast<float>(mean.x), static_cast<float>(mean.y), static_cast<float>(mean.z), 0.0f};
  }
}

void InteriorSystem::add_friction(const World&, const Way& way, std::span<Vec3d> out, OrderFreeSum& quadratic) {
  if (!way.moved) return;
  std::vector<double> part(items_.size());
  parallel_for(threads_, items_.size(), [&](std::size_t k) {
    const Item& item = items_[k];
    std::vector<Vec3d> of_nodes(item.node_count);
    for (std::uint32_t i = 0; i < item.node_count; ++i) of_nodes[i] = way.position[item.first_node + i] - way.start[item.first_node + i];
    const Vec3d of_nucleus = item.has_nucleus ? way.position[item.nucleus] - way.start[item.nucleus] : Vec3d{};
    part[k] = dcm::add_interior_friction(view(item, way.position), item.friction, of_nodes, item.has_nucleus ? &of_nucleus : nullptr,
                                         out.subspan(item.first_node, item.node_count), item.has_nucleus ? &out[item.nucleus] : nullptr);
  });
  for (const double q : part) quadratic.add(q);
}

void InteriorSystem::add_noise(const World& world, const Noise& noise, std::span<Vec3d> force) const {
  for (const Item& item : items_) {
    const double energy = model_.types[world.tissue.shells.type[item.shell]].fluctuations.energy;
    if (energy == 0.0) continue;
    const dcm::InteriorView cell = view(item, world.position());
    std::vector<double> numbers = noise.normals(world.scene.bodies()[item.shell].id, kDrawsOfInterior, dcm::interior_factor_count(cell));
    for (double& number : numbers) number *= noise.strength(energy);
    dcm::add_interior_noise(cell, item.friction, numbers, force.subspan(item.first_node, item.node_count),
                            item.has_nucleus ? &force[item.nucleus] : nullptr);
  }
}

void InteriorSystem::assemble(const World& world, double dt, Assembly&) {
  parallel_for(threads_, items_.size(),
               [&](std::size_t k) { dcm::assemble_interior(view(items_[k], world.position()), items_[k].friction, dt, items_[k].matrix); });
}

void InteriorSystem::add_product(std::span<const Float4> p, std::span<Float4> q) const {
  parallel_for(threads_, items_.size(), [&](std::size_t k) {
    const Item& item = items_[k];
    dcm::add_interior_product(view(item, {}), item.matrix, p.subspan(item.first_node, item.node_count),
                              q.subspan(item.first_node, item.node_count), item.has_nucleus ? &p[item.nucleus] : nullptr,
                              item.has_nucleus ? &q[item.nucleus] : nullptr);
  });
}

void InteriorSystem::add_diagonal(std::span<SymMat3<float>> diagonal) const {
  for (const Item& item : items_)
    dcm::add_interior_diagonal(view(item, {}), item.matrix, diagonal.subspan(item.first_node, item.node_count),
                               item.has_nucleus ? &diagonal[item.nucleus] : nullptr);
}

}  // namespace morula
