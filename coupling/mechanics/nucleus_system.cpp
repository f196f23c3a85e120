#include "coupling/mechanics/nucleus_system.h"

#include <algorithm>

#include "core/parallel/threads.h"
#include "coupling/mechanics/contact_setup.h"

namespace morula {
namespace {

std::vector<dcm::ShellParameters> nucleus_parameters(const Model& model) {
  std::vector<dcm::ShellParameters> out;
  for (const CellType& type : model.types) {
    out.push_back(type.interior.nucleus_shell);
    out.back().medium_friction = 0.0;  // what it rubs on is the cytoplasm
  }
  return out;
}

/// The range and repulsion of other surfaces; nothing holds the two together and nothing rubs (dcm.md §12).
std::vector<ContactMaterial> nucleus_material(const Model& model) {
  ContactMaterial material;
  material.law.adhesion = 0.0;
  material.law.range = model.contact.range;
  material.law.repulsion = model.contact.repulsion;
  return {material};
}

ContactSettings nucleus_contacts(const Model& model, int threads) {
  ContactSettings settings = contact_settings(model, threads);
  settings.range = model.contact.range;
  settings.sphere_reach = 0.0;
  settings.objective_friction = false;
  return settings;
}

}  // namespace

NucleusSystem::NucleusSystem(const Model& model, int threads)
    : model_(model), shells_(nucleus_parameters(model)), contacts_(nucleus_contacts(model, threads), {}, nucleus_material(model), 1) {}

const Topology* NucleusSystem::turned_around(const std::shared_ptr<const Topology>& topology) {
  auto& turned = turned_[topology];
  if (turned == nullptr) {
    std::vector<Triangle> faces(topology->faces().begin(), topology->faces().end());
    for (Triangle& t : faces) std::swap(t[1], t[2]);
    turned = Topology::build(topology->node_count(), std::move(faces)).value();
  }
  return turned.get();
}

void NucleusSystem::set_shells(const Tissue& tissue, std::uint32_t first_point) {
  const dcm::NuclearShells& nuclei = tissue.nuclei;
  first_point_ = first_point;
  node_count_ = nuclei.shells.node_count();
  items_.clear(), bodies_.clear(), topologies_.clear(), pairs_.clear();
  first_node_.assign(1, 0);
  first_face_.assign(1, 0);
  held_.assign(nuclei.size() > 0 ? tissue.shells.size() : 0, {});
  shells_.set_shells(nuclei.shells);
  contacts_.reset();
  const auto add_surface = [&](const Topology* topology) {
    ContactBody& body = bodies_.emplace_back();
    body.shape = BodyShape::kSurface;
    body.place = static_cast<std::uint32_t>(topologies_.size());
    body.first_point = first_node_.back();
    body.point_count = topology->node_count();
    topologies_.push_back(topology);
    first_node_.push_back(first_node_.back() + topology->node_count());
    first_face_.push_back(first_face_.back() + topology->face_count());
  };
  for (std::uint32_t n = 0; n < nuclei.size(); ++n) {
    Item& item = items_.emplace_back();
    item.shell = nuclei.owner[n];
    item.type = nuclei.shells.type[n];
    item.first_cell_point = tissue.shells.first_node[item.shell];
    item.cell_node_count = tissue.shells.first_node[item.shell + 1] - item.first_cell_point;
    item.first_point = first_point + nuclei.shells.first_node[n];
    item.node_count = nuclei.shells.first_node[n + 1] - nuclei.shells.first_node[n];
    const auto& shape = tissue.shells.shape[item.shell];
    item.cell_topology = shape->topology.get();
    item.topology = &nuclei.shells.topology(n);
    auto& links = links_[{shape, item.type}];
    if (!links)
      links = std::make_shared<const std::vector<dcm::InteriorLink>>(
          dcm::choose_nuclear_links(*shape, *nuclei.shells.shape[n], model_.types[item.type].interior));
    item.links = links;
    pairs_.emplace_back(2 * n, 2 * n + 1);
    add_surface(turned_around(shape->topology));
    add_surface(item.topology);
  }
  position_.assign(first_node_.back(), {});
}

void NucleusSystem::set_moving(std::span<const ContactBody> bodies) {
  for (std::size_t k = 0; k < items_.size(); ++k) {
    items_[k].moves = bodies[items_[k].shell].active();
    bodies_[2 * k].moves = bodies_[2 * k + 1].moves = items_[k].moves;
  }
}

dcm::NucleusView NucleusSystem::view(std::size_t k) const {
  const Item& item = items_[k];
  return {&model_.types[item.type].interior,     *item.links,     item.cell_topology, item.topology, part(std::span(position_), 2 * k),
          part(std::span(position_), 2 * k + 1), item.rest_volume};
}

std::span<const dcm::HeldVolume> NucleusSystem::evaluate_shells(const Tissue& tissue, std::span<const Vec3d> position) {
  if (empty()) return {};
  own_force_.resize(node_count_);
  shells_.evaluate(tissue.nuclei.shells, position.subspan(first_point_), own_force_);
  for (std::size_t k = 0; k < items_.size(); ++k)
    held_[items_[k].shell] = {shells_.forces().volume[k], model_.types[items_[k].type].interior.nucleus_fraction};
  return held_;
}

void NucleusSystem::evaluate(const Tissue& tissue, std::span<const Vec3d> position, std::span<const double> cell_pressure,
                             std::span<Vec3d> force) {
  for (std::size_t k = 0; k < items_.size(); ++k) {
    items_[k].rest_volume = tissue.shells.rest_volume[items_[k].shell];
    std::ranges::copy(of_cell(position, items_[k]), part(std::span(position_), 2 * k).begin());
    std::ranges::copy(of_nucleus(position, items_[k]), part(std::span(position_), 2 * k + 1).begin());
  }
  compute_node_geometry(surfaces(), position_, geometry_);
  const ContactScene scene = contact_scene();
  if (contacts_.note_motion(scene)) contacts_.rebuild(scene, pairs_);
  gradient_.set_zero(position_.size(), position_.size(), first_face_.back(), topologies_.size());
  contacts_.evaluate(scene, SurfacePairKind::kSurfaces, gradient_);
  add_surface_forces(surfaces(), position_, geometry_, {gradient_.face_energy, {}, gradient_.node_normal}, gradient_.force);
  parallel_for(omp_get_max_threads(), items_.size(), [&](std::size_t k) {
    Item& item = items_[k];
    const std::span<Vec3d> on_cell = part(std::span(gradient_.force), 2 * k), on_nucleus = part(std::span(gradient_.force), 2 * k + 1);
    item.energy = dcm::add_nuclear_link_forces(view(k), {on_cell, on_nucleus});
    dcm::add_cytosol_pressure(view(k), cell_pressure[item.shell], on_nucleus);
    const std::span<Vec3d> cell = of_cell(force, item), nucleus = of_nucleus(force, item);
    for (std::size_t i = 0; i < cell.size(); ++i) cell[i] += on_cell[i];
    for (std::size_t i = 0; i < nucleus.size(); ++i) nucleus[i] += on_nucleus[i] + own_force_[item.first_point - first_point_ + i];
  });
}

void NucleusSystem::add_energy(OrderFreeSum& sum) const {
  for (std::size_t k = 0; k < items_.size(); ++k) {
    sum.add(items_[k].energy);
    sum.add(shells_.forces().energy[k]);
  }
  if (!empty()) contacts_.add_energy(contact_scene(), sum);
}

std::optional<std::pair<std::uint32_t, std::string>> NucleusSystem::find_fault() const {
  for (std::size_t k = 0; k < items_.size(); ++k)
    if (const auto& fault = shells_.forces().fault[k]) return std::pair(items_[k].shell, "nucleus: " + dcm::describe(fault));
  return std::nullopt;
}

void NucleusSystem::begin_step(const Tissue& tissue) {
  if (empty()) return;
  contacts_.begin_step(contact_scene());
  SurfaceGeometry geometry;
  for (std::size_t k = 0; k < items_.size(); ++k) {
    const auto area = part(std::span<const double>(geometry_.node_area), 2 * k + 1);
    geometry.node_area.insert(geometry.node_area.end(), area.begin(), area.end());
  }
  shells_.begin_step(tissue.nuclei.shells, geometry);
  parallel_for(omp_get_max_threads(), items_.size(), [&](std::size_t k) {
    dcm::find_nuclear_friction(view(k), part(std::span<const double>(geometry_.node_area), 2 * k),
                               part(std::span<const double>(geometry_.node_area), 2 * k + 1), items_[k].friction);
  });
}

void NucleusSystem::add_step_friction(std::span<const Vec3d> start, std::span<const Vec3d> position, std::span<Vec3d> out,
                                      OrderFreeSum& quadratic) {
  if (empty()) return;
  shells_.add_step_friction(position.subspan(first_point_), out.subspan(first_point_), quadratic);
  std::vector<double> of_item(items_.size());
  parallel_for(omp_get_max_threads(), items_.size(), [&](std::size_t k) {
    const Item& item = items_[k];
    const auto way = [](std::span<const Vec3d> from, std::span<const Vec3d> to) {
      std::vector<Vec3d> d(to.begin(), to.end());
      for (std::size_t i = 0; i < d.size(); ++i) d[i] -= from[i];
      return d;
    };
    std::vector<Vec3d> cell = way(of_cell(start, item), of_cell(position, item));
    std::vector<Vec3d> nucleus = way(of_nucleus(start, item), of_nucleus(position, item));
    of_item[k] = dcm::add_nuclear_friction(view(k), item.friction, {cell, nucleus}, {of_cell(out, item), of_nucleus(out, item)});
  });
  for (const double q : of_item) quadratic.add(q);
}

void NucleusSystem::start_with_cells(const Tissue& tissue, std::span<Float4> velocity) const {
  for (const Item& item : items_) {
    std::vector<Vec3d> cell, nucleus;
    for (const Float4& v : of_cell(velocity, item)) cell.push_back({v.x, v.y, v.z});
    for (const Vec3f& v : std::span(tissue.nuclei.shells.velocity).subspan(item.first_point - first_point_, item.node_count))
      nucleus.push_back({v.x, v.y, v.z});
    dcm::move_with_cell(item.friction, cell, nucleus);
    for (std::uint32_t i = 0; i < item.node_count; ++i) {
      const Vec3d& v = nucleus[i];
      velocity[item.first_point + i] = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0.0f};
    }
  }
}

void NucleusSystem::assemble(const Tissue& tissue, std::span<const Vec3d> position, double dt) {
  if (empty()) return;
  shells_.assemble(tissue.nuclei.shells, position.subspan(first_point_), {}, dt, {});
  const auto pairs = contacts_.pairs();
  parallel_for(omp_get_max_threads(), items_.size(), [&](std::size_t k) {
    Item& item = items_[k];
    dcm::assemble_nuclear_operator(view(k), item.friction, model_.types[item.type].shell.bulk_modulus, dt, item.matrix);
    for (std::size_t d = 0; d < 2; ++d)
      dcm::add_nuclear_contacts(pairs[k].present(d), *topologies_[2 * k + d], *topologies_[2 * k + 1 - d], d == 0,
                                contacts_.settings().points_per_face, dt, item.matrix);
  });
}

std::optional<NucleusState> NucleusSystem::of_shell(std::uint32_t shell) const {
  const auto found =
      std::lower_bound(items_.begin(), items_.end(), shell, [](const Item& item, std::uint32_t s) { return item.shell < s; });
  if (found == items_.end() || found->shell != shell) return std::nullopt;
  const auto k = static_cast<std::size_t>(found - items_.begin());
  const SurfacePair& pair = contacts_.pairs()[k];
  return NucleusState{pair.overlap, pair.area, shells_.forces().volume[k], shells_.forces().pressure[k]};
}

std::size_t NucleusSystem::memory() const {
  if (empty()) return 0;
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t total = contacts_.memory() + shells_.memory() + gradient_.memory() + bytes(items_) + bytes(held_) + bytes(own_force_) +
                      bytes(bodies_) + bytes(position_) + bytes(geometry_.node_normal) + bytes(geometry_.node_normal_length) +
                      bytes(geometry_.node_area);
  for (const Item& item : items_)
    total += bytes(item.friction.share) + bytes(item.friction.arm) + bytes(item.friction.friction) + bytes(item.friction.nucleus_arm) +
             bytes(item.matrix.link) + bytes(item.matrix.contact) + bytes(item.matrix.cell_gradient) + bytes(item.matrix.nucleus_gradient);
  return total;
}

void NucleusSystem::add_product(std::span<const Float4> p, std::span<Float4> q) const {
  if (empty()) return;
  // The nodes of nuclei are in no other part, and have no friction as points: what is in q there is zero.
  shells_.multiply(0, shells_.batch_count(), p.subspan(first_point_), q.subspan(first_point_));
  parallel_for(omp_get_max_threads(), items_.size(), [&](std::size_t k) {
    const Item& item = items_[k];
    dcm::add_nuclear_product(view(k), item.matrix, of_cell(p, item), of_nucleus(p, item), of_cell(q, item), of_nucleus(q, item));
  });
}

void NucleusSystem::add_diagonal(std::span<SymMat3<float>> diagonal) const {
  if (empty()) return;
  shells_.add_diagonal(diagonal.subspan(first_point_));
  for (std::size_t k = 0; k < items_.size(); ++k)
    dcm::add_nuclear_diagonal(view(k), items_[k].matrix, of_cell(diagonal, items_[k]), of_nucleus(diagonal, items_[k]));
}

}  // namespace morula
