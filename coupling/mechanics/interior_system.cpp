#include "coupling/mechanics/interior_system.h"

#include "core/parallel/threads.h"

namespace morula {

void InteriorSystem::set_shells(const dcm::Shells& shells, std::uint32_t first_point) {
  items_.clear();
  nuclei_.clear();
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
    if (item.has_nucleus) {
      item.nucleus = first_point + static_cast<std::uint32_t>(nuclei_.size());
      nuclei_.push_back({item.nucleus, s});
    }
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

void InteriorSystem::evaluate(const dcm::Shells& shells, std::span<const Vec3d> position, std::span<Vec3d> force) {
  parallel_for(omp_get_max_threads(), items_.size(), [&](std::size_t k) {
    Item& item = items_[k];
    item.rest_volume = shells.rest_volume[item.shell];
    item.energy = dcm::add_interior_forces(view(item, position), force.subspan(item.first_node, item.node_count),
                                           item.has_nucleus ? &force[item.nucleus] : nullptr);
  });
}

void InteriorSystem::add_energy(OrderFreeSum& sum) const {
  for (const Item& item : items_) sum.add(item.energy.energy);
}

dcm::InteriorEnergy InteriorSystem::of_shell(std::uint32_t shell) const {
  for (const Item& item : items_)
    if (item.shell == shell) return item.energy;
  return {};
}

std::size_t InteriorSystem::memory() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t total = bytes(items_) + bytes(nuclei_);
  for (const Item& item : items_)
    total += bytes(item.friction.share) + bytes(item.friction.nucleus_direction) + bytes(item.friction.cortex_direction) +
             bytes(item.matrix.share) + bytes(item.matrix.nucleus_block) + bytes(item.matrix.cortex_block) + bytes(item.matrix.contact);
  return total;
}

void InteriorSystem::begin_step(std::span<const Vec3d> position, const SurfaceGeometry& geometry) {
  parallel_for(omp_get_max_threads(), items_.size(), [&](std::size_t k) {
    Item& item = items_[k];
    dcm::find_interior_friction(view(item, position), std::span(geometry.node_area).subspan(item.first_node, item.node_count),
                                item.friction);
  });
}

void InteriorSystem::add_step_friction(std::span<const Vec3d> start, std::span<const Vec3d> position, std::span<Vec3d> out,
                                       OrderFreeSum& quadratic) {
  std::vector<double> part(items_.size());
  parallel_for(omp_get_max_threads(), items_.size(), [&](std::size_t k) {
    const Item& item = items_[k];
    std::vector<Vec3d> way(item.node_count);
    for (std::uint32_t i = 0; i < item.node_count; ++i) way[i] = position[item.first_node + i] - start[item.first_node + i];
    const Vec3d nucleus_way = item.has_nucleus ? position[item.nucleus] - start[item.nucleus] : Vec3d{};
    part[k] = dcm::add_interior_friction(view(item, position), item.friction, way, item.has_nucleus ? &nucleus_way : nullptr,
                                         out.subspan(item.first_node, item.node_count), item.has_nucleus ? &out[item.nucleus] : nullptr);
  });
  for (const double q : part) quadratic.add(q);
}

void InteriorSystem::assemble(std::span<const Vec3d> position, double dt) {
  parallel_for(omp_get_max_threads(), items_.size(),
               [&](std::size_t k) { dcm::assemble_interior(view(items_[k], position), items_[k].friction, dt, items_[k].matrix); });
}

void InteriorSystem::start_from_cortex(std::span<Float4> velocity) const {
  for (const Item& item : items_) {
    if (!item.has_nucleus) continue;
    Vec3d mean;
    for (std::uint32_t i = item.first_node; i < item.first_node + item.node_count; ++i)
      mean += Vec3d{velocity[i].x, velocity[i].y, velocity[i].z};
    mean *= 1.0 / item.node_count;
    velocity[item.nucleus] = {static_cast<float>(mean.x), static_cast<float>(mean.y), static_cast<float>(mean.z), 0.0f};
  }
}

void InteriorSystem::add_product(std::span<const Float4> p, std::span<Float4> q) const {
  parallel_for(omp_get_max_threads(), items_.size(), [&](std::size_t k) {
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
