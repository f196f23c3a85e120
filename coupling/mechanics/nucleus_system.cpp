#include "coupling/mechanics/nucleus_system.h"

#include <algorithm>

#include "core/parallel/threads.h"
#include "coupling/mechanics/contact_setup.h"
#include "coupling/mechanics/shell_faults.h"
#include "dcm/interior_noise.h"

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

NucleusSystem::NucleusSystem(const Model& model, Membranes& cells, int threads)
    : model_(model),
      cells_(cells),
      threads_(threads),
      shells_(nucleus_parameters(model)),
      contacts_(nucleus_contacts(model, threads), {}, nucleus_material(model), 1) {}

const Topology* NucleusSystem::turned_around(const std::shared_ptr<const Topology>& topology) {
  auto& turned = turned_[topology];
  if (turned == nullptr) {
    std::vector<Triangle> faces(topology->faces().begin(), topology->faces().end());
    for (Triangle& t : faces) std::swap(t[1], t[2]);
    turned = Topology::build(topology->node_count(), std::move(faces)).value();
  }
  return turned.get();
}

void NucleusSystem::bodies_changed(const World& world) {
  const Tissue& tissue = world.tissue;
  const dcm::NuclearShells& nuclei = tissue.nuclei;
  const std::uint32_t first_point = world.scene.nuclear_node();
  first_point_ = first_point;
  items_.clear(), surfaces_.body.clear(), surfaces_.topology.clear(), surfaces_.pairs.clear();
  surfaces_.first_node.assign(1, 0);
  surfaces_.first_face.assign(1, 0);
  held_.assign(nuclei.size() > 0 ? tissue.shells.size() : 0, {});
  shells_.set_shells(nuclei.shells, threads_);
  contacts_.reset();
  const auto add_surface = [&](const Topology* topology) {
    ContactBody& body = surfaces_.body.emplace_back();
    body.shape = BodyShape::kSurface;
    body.place = static_cast<std::uint32_t>(surfaces_.topology.size());
    body.first_point = surfaces_.first_node.back();
    body.point_count = topology->node_count();
    surfaces_.topology.push_back(topology);
    surfaces_.first_node.push_back(surfaces_.first_node.back() + topology->node_count());
    surfaces_.first_face.push_back(surfaces_.first_face.back() + topology->face_count());
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
    surfaces_.pairs.emplace_back(2 * n, 2 * n + 1);
    add_surface(turned_around(shape->topology));
    add_surface(item.topology);
  }
  surfaces_.position.assign(surfaces_.first_node.back(), {});
}

dcm::NucleusView NucleusSystem::view(std::size_t k) const {
  const Item& item = items_[k];
  return {&model_.types[item.type].interior,
          *item.links,
          item.cell_topology,
          item.topology,
          part(std::span(surfaces_.position), 2 * k),
          part(std::span(surfaces_.position), 2 * k + 1),
          item.rest_volume};
}

void NucleusSystem::measure(const World& world) {
  cells_.set_held({});
  if (empty()) return;
  own_force_.resize(shells_.point_count());
  shells_.evaluate(world.tissue.nuclei.shells, world.position().subspan(first_point_), own_force_);
  for (std::size_t k = 0; k < items_.size(); ++k)
    held_[items_[k].shell] = {shells_.forces().volume[k], model_.types[items_[k].type].interior.nucleus_fraction};
  cells_.set_held(held_);
}

void NucleusSystem::evaluate(const World& world, Forces& out) {
  if (empty()) return;
  for (std::size_t k = 0; k < items_.size(); ++k) {
    items_[k].rest_volume = world.tissue.shells.rest_volume[items_[k].shell];
    surfaces_.body[2 * k].moves = surfaces_.body[2 * k + 1].moves =
        world.scene.bodies()[items_[k].shell].active();  // nuclei are held with their cells
    std::ranges::copy(of_cell(world.position(), items_[k]), part(std::span(surfaces_.position), 2 * k).begin());
    std::ranges::copy(of_nucleus(world.position(), items_[k]), part(std::span(surfaces_.position), 2 * k + 1).begin());
  }
  compute_node_geometry(surfaces(), surfaces_.position, surfaces_.geometry);
  const ContactScene scene = contact_scene();
  if (contacts_.note_motion(scene)) contacts_.rebuild(scene, surfaces_.pairs);
  surfaces_.gradient.set_zero(surfaces_.position.size(), surfaces_.position.size(), surfaces_.first_face.back());
  contacts_.evaluate(scene, SurfacePairKind::kSurfaces, surfaces_.gradient);
  add_surface_forces(surfaces(), surfaces_.position, surfaces_.geometry,
                     {surfaces_.gradient.face_energy, {}, surfaces_.gradient.node_normal}, surfaces_.gradient.force);
  parallel_for(threads_, items_.size(), [&](std::size_t k) {
    Item& item = items_[k];
    const std::span<Vec3d> on_cell = part(std::span(surfaces_.gradient.force), 2 * k),
                           on_nucleus = part(std::span(surfaces_.gradient.force), 2 * k + 1);
    item.energy = dcm::add_nuclear_link_forces(view(k), {on_cell, on_nucleus});
    dcm::add_cytosol_pressure(view(k), cells_.found().pressure[item.shell], on_nucleus);
    const std::span<Vec3d> cell = of_cell(out.force, item), nucleus = of_nucleus(out.force, item);
    for (std::size_t i = 0; i < cell.size(); ++i) cell[i] += on_cell[i];
    for (std::size_t i = 0; i < nucleus.size(); ++i) nucleus[i] += on_nucleus[i] + own_force_[item.first_point - first_point_ + i];
  });
  for (std::size_t k = 0; k < items_.size(); ++k) {
    out.energy.add(items_[k].energy);
    out.energy.add(shells_.forces().energy[k]);
  }
  contacts_.add_energy(contact_scene(), out.energy);
}

std::optional<StepFault> NucleusSystem::fault(const World& world) const {
  auto fault = first_fault(shells_.forces().fault, [&](std::size_t k) { return world.scene.bodies()[items_[k].shell].id; });
  if (fault) fault->what = "nucleus: " + fault->what;
  return fault;
}

std::optional<CellId> NucleusSystem::crossed(const World&, std::span<const Vec3d>) const {
  const SurfacePair* pair = empty() ? nullptr : contacts_.crossed(contact_scene(), {});
  if (pair == nullptr) return std::nullopt;
  return contact_scene().bodies[pair->a].id;
}

void NucleusSystem::begin_step(const World& world, StepStart& start) {
  if (empty()) return;
  contacts_.begin_step(contact_scene());
  SurfaceGeometry geometry;
  for (std::size_t k = 0; k < items_.size(); ++k) {
    const auto area = part(std::span<const double>(surfaces_.geometry.node_area), 2 * k + 1);
    geometry.node_area.insert(geometry.node_area.end(), area.begin(), area.end());
  }
  shells_.begin_step(world.tissue.nuclei.shells, geometry);
  parallel_for(threads_, items_.size(), [&](std::size_t k) {
    dcm::find_nuclear_friction(view(k), part(std::span<const double>(surfaces_.geometry.node_area), 2 * k),
                               part(std::span<const double>(surfaces_.geometry.node_area), 2 * k + 1), items_[k].friction);
  });
  start_with_cells(world.tissue, start.velocity);
}

void NucleusSystem::add_friction(const World&, const Way& way, std::span<Vec3d> out, OrderFreeSum& quadratic) {
  if (empty() || !way.moved) return;
  shells_.add_step_friction(way.position.subspan(first_point_), out.subspan(first_point_), quadratic);
  std::vector<double> of_item(items_.size());
  parallel_for(threads_, items_.size(), [&](std::size_t k) {
    const Item& item = items_[k];
    const auto from_to = [](std::span<const Vec3d> from, std::span<const Vec3d> to) {
      std::vector<Vec3d> d(to.begin(), to.end());
      for (std::size_t i = 0; i < d.size(); ++i) d[i] -= from[i];
      return d;
    };
    std::vector<Vec3d> cell = from_to(of_cell(way.start, item), of_cell(way.position, item));
    std::vector<Vec3d> nucleus = from_to(of_nucleus(way.start, item), of_nucleus(way.position, item));
    of_item[k] = dcm::add_nuclear_friction(view(k), item.friction, {cell, nucleus}, {of_cell(out, item), of_nucleus(out, item)});
  });
  for (const double q : of_item) quadratic.add(q);
}

void NucleusSystem::add_noise(const World& world, const Noise& noise, std::span<Vec3d> force) const {
  for (std::size_t k = 0; k < items_.size(); ++k) {
    const Item& item = items_[k];
    const double energy = model_.types[item.type].fluctuations.energy;
    if (energy == 0.0) continue;
    const CellId cell = world.scene.bodies()[item.shell].id;
    const ShellNoise own{shells_.materials().of(world.tissue.nuclei.shells, k),
                         *item.topology,
                         cell,
                         noise.strength(energy),
                         of_nucleus(world.position(), item),
                         of_nucleus(force, item),
                         kDrawsOfNuclearShell};
    add_edge_noise(own, noise);
    add_bulk_noise(own, noise, shells_.forces().volume[k]);
    std::vector<double> numbers = noise.normals(cell, kDrawsOfNucleus, dcm::nuclear_factor_count(view(k)));
    for (double& number : numbers) number *= own.strength;
    dcm::add_nuclear_noise(view(k), item.friction, numbers, {of_cell(force, item), of_nucleus(force, item)});
  }
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

void NucleusSystem::assemble(const World& world, double dt, Assembly&) {
  if (empty()) return;
  shells_.assemble(world.tissue.nuclei.shells, world.position().subspan(first_point_), {}, dt, {}, {});
  const auto pairs = contacts_.pairs();
  parallel_for(threads_, items_.size(), [&](std::size_t k) {
    Item& item = items_[k];
    dcm::assemble_nuclear_operator(view(k), item.friction, model_.types[item.type].shell.bulk_modulus, dt, item.matrix);
    for (std::size_t d = 0; d < 2; ++d)
      dcm::add_nuclear_contacts(pairs[k].present(d), *surfaces_.topology[2 * k + d], *surfaces_.topology[2 * k + 1 - d], d == 0,
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
  std::size_t total = contacts_.memory() + shells_.memory() + surfaces_.gradient.memory() + bytes(items_) + bytes(held_) +
                      bytes(own_force_) + bytes(surfaces_.body) + bytes(surfaces_.position) + bytes(surfaces_.geometry.node_normal) +
                      bytes(surfaces_.geometry.node_normal_length) + bytes(surfaces_.geometry.node_area);
  for (const Item& item : items_)
    total += bytes(item.friction.share) + bytes(item.friction.arm) + bytes(item.friction.friction) + bytes(item.friction.nucleus_arm) +
             bytes(item.matrix.link) + bytes(item.matrix.contact) + bytes(item.matrix.cell_gradient) + bytes(item.matrix.nucleus_gradient);
  return total;
}

void NucleusSystem::add_product(std::span<const Float4> p, std::span<Float4> q) const {
  if (empty()) return;
  // The nodes of nuclei are in no other part, and have no friction as points: what is in q there is zero.
  shells_.multiply(0, shells_.batch_count(), p.subspan(first_point_), q.subspan(first_point_));
  parallel_for(threads_, items_.size(), [&](std::size_t k) {
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
