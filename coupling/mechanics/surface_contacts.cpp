#include "coupling/mechanics/surface_contacts.h"

#include <algorithm>
#include <iterator>

#include "core/contact/float_rounding.h"
#include "core/parallel/threads.h"
#include "coupling/mechanics/body_factors.h"
#include "coupling/mechanics/contact_setup.h"

namespace morula {
namespace {

template <class T>
void give_back(std::vector<T>& vector) {
  std::vector<T>().swap(vector);
}

/// The shells of this rank whose surface to their sister may be new; sorted by cell.
std::vector<SisterBond> new_interfaces(const Model& model, const Tissue& tissue, double time) {
  double longest = 0.0;
  for (const CellType& type : model.types) longest = std::max(longest, type.new_surface);
  std::vector<SisterBond> out;
  for (const CellRow& row : tissue.cells.rows)
    if (const double age = time - row.birth_time; row.body == BodyKind::kShell && row.parent.valid() && age < longest)
      out.push_back({row.id, age});
  std::ranges::sort(out, {}, &SisterBond::cell);
  return out;
}

}  // namespace

ContactScene contact_scene(const Scene& scene, const SurfaceGeometry& geometry) {
  return {scene.bodies(), std::span(scene.position()).first(scene.nucleus_point()), scene.topologies(), scene.first_face(), &geometry,
          scene.marks()};
}

SurfaceContacts::SurfaceContacts(const Model& model, RigidSurfaces obstacles, int threads)
    : threads_(threads),
      layer_(contact_settings(model, threads), std::move(obstacles), contact_materials(model), contact_material_count(model)) {
  const auto vary = [](const CellType& type) { return type.regional_tension.lateral_adheres && type.regional_tension.varies(); };
  tensions_vary_ = std::ranges::any_of(model.types, vary);
}

void SurfaceContacts::look_for_new_surfaces(const World& world) {
  const auto may_be_new = [](const CellType& type) { return type.cycles && type.shells_divide && type.new_surface > 0.0; };
  bonds_age_ = std::ranges::any_of(world.model.types, may_be_new) && world.comm.any(world.scene.shells() > 0);
}

void SurfaceContacts::take_own_factors(const World& world) {
  layer_.set_own_factors(
      {factors_of_bodies(world, Trait::kTension), factors_of_bodies(world, Trait::kStiffness), factors_of_bodies(world, Trait::kAdhesion)});
}

void SurfaceContacts::bodies_changed(const World& world) {
  look_for_new_surfaces(world);
  take_own_factors(world);
  layer_.reset();
  forget();
}

void SurfaceContacts::bodies_replaced(const World& world, const BodyChanges& changes) {
  look_for_new_surfaces(world);
  take_own_factors(world);
  const bool with_spheres = layer_.has_pairs(SurfacePairKind::kWithSphere);
  again_ = touched_by(changes);
  layer_.mend(contact_scene(world), world.model.space, changes);
  shapes_of_lists_.assign(world.scene.shapes().begin(), world.scene.shapes().end());
  const bool holds = found_at_ == changes.positions_number && !layer_.is_stale() && !layer_.is_at_step_start() &&
                     with_spheres == layer_.has_pairs(SurfacePairKind::kWithSphere);
  std::size_t faces = 0;  // of closed surfaces without holes
  for (std::size_t i = 0; i < changes.shells_before; ++i) faces += 2 * (changes.before[i].point_count - 2);
  holds&& faces == gradient_.face_energy.size() ? carry_found(world, changes) : forget();
}

std::vector<char> SurfaceContacts::touched_by(const BodyChanges& changes) const {
  std::vector<char> out(changes.was.size(), 0);
  const auto mark = [&](std::uint32_t before) {
    if (before < changes.now.size() && changes.now[before] != BodyChanges::kNone) out[changes.now[before]] = 1;
  };
  for (std::uint32_t i = 0; i < again_.size(); ++i)
    if (again_[i]) mark(i);
  if (layer_.is_stale()) return out;
  for (const SurfacePair& pair : layer_.pairs()) {
    if (pair.rigid || (pair.present(0).empty() && pair.present(1).empty())) continue;
    if (changes.now[pair.a] == BodyChanges::kNone) mark(pair.b);
    if (changes.now[pair.b] == BodyChanges::kNone) mark(pair.a);
  }
  return out;
}

void SurfaceContacts::carry_found(const World& world, const BodyChanges& changes) {
  const Scene& scene = world.scene;
  std::vector<char> fresh(changes.was.size(), 0);
  for (const std::uint32_t i : changes.fresh) fresh[i] = again_[i] = 1;
  for (const SurfacePair& pair : layer_.pairs())
    if (!pair.rigid && (fresh[pair.a] || fresh[pair.b])) again_[pair.a] = again_[pair.b] = 1;
  std::vector<std::uint32_t> old_face{0};  // where the faces of the old surfaces began
  for (std::size_t i = 0; i < changes.shells_before; ++i) old_face.push_back(old_face.back() + 2 * (changes.before[i].point_count - 2));
  const auto carry = [&](ContactGradient& gradient) {
    ContactGradient out;
    out.set_zero(scene.shells() > 0 ? scene.point_count() : 0, gradient.node_normal.empty() ? 0 : scene.sphere_point(), scene.face_count());
    for (std::size_t i = 0; i < scene.shells(); ++i) {
      const std::uint32_t was = changes.was[i];
      if (again_[i] || was == BodyChanges::kNone) continue;
      const ContactBody &before = changes.before[was], &now = scene.bodies()[i];
      std::copy_n(gradient.force.begin() + before.first_point, now.point_count, out.force.begin() + now.first_point);
      if (!gradient.node_normal.empty())
        std::copy_n(gradient.node_normal.begin() + before.first_point, now.point_count, out.node_normal.begin() + now.first_point);
      std::copy_n(gradient.face_energy.begin() + old_face[was], scene.topologies()[i]->face_count(),
                  out.face_energy.begin() + scene.first_face()[i]);
      std::copy_n(gradient.told_area.begin() + old_face[was], scene.topologies()[i]->face_count(),
                  out.told_area.begin() + scene.first_face()[i]);
    }
    gradient = std::move(out);
  };
  carry(gradient_);
  if (layer_.has_pairs(SurfacePairKind::kWithSphere)) carry(surfaces_only_);
  found_at_ = scene.positions_number();
}

void SurfaceContacts::parameters_changed(const World& world) {
  std::vector<SisterBond> bonds;
  if (bonds_age_) bonds = new_interfaces(world.model, world.tissue, world.time);
  const bool same_bonds = bonds == layer_.sister_bonds();
  const auto has_regions = [](const CellType& type) { return !type.regional_tension.empty(); };  // of others it is that of the start
  if (tensions_vary_ || (!same_bonds && std::ranges::any_of(world.model.types, has_regions)))
    layer_.take_tensions(contact_materials(world.model, world.time));
  if (tensions_vary_) forget();
  if (same_bonds) return;
  std::vector<SisterBond> changed;
  const auto before = [](const SisterBond& a, const SisterBond& b) { return a.cell != b.cell ? a.cell < b.cell : a.age < b.age; };
  std::ranges::set_symmetric_difference(bonds, layer_.sister_bonds(), std::back_inserter(changed), before);
  again_.resize(world.scene.bodies().size(), 0);
  for (std::uint32_t i = 0; i < world.scene.shells(); ++i) {
    const auto at = std::ranges::lower_bound(changed, world.scene.bodies()[i].id, {}, &SisterBond::cell);
    if (at != changed.end() && at->cell == world.scene.bodies()[i].id) again_[i] = 1;
  }
  layer_.set_sister_bonds(std::move(bonds));
}

void SurfaceContacts::set_strength(const ContactStrength& strength) {
  if (strength == ContactStrength{layer_.cap(), layer_.settings().depth, layer_.bonding()}) return;
  layer_.set_cap(strength.cap);
  layer_.set_bonding(strength.bonding);
  layer_.set_depth(strength.depth);
  forget();
}

bool SurfaceContacts::set_offsets(std::span<const Vec3d> offsets) {
  if (std::ranges::equal(offsets, layer_.offsets())) return false;
  layer_.set_offsets(offsets);
  forget();
  return true;
}

void SurfaceContacts::measure(const World& world) {
  const ContactScene scene = contact_scene(world);
  if (!world.comm.any(layer_.note_motion(scene))) return;
  layer_.rebuild(scene, world.model.space);
  shapes_of_lists_.assign(world.scene.shapes().begin(), world.scene.shapes().end());
  ++list_number_;
  forget();
}

void SurfaceContacts::evaluate(const World& world, Forces& out) {
  const ContactScene scene = contact_scene(world);
  const bool with_spheres = layer_.has_pairs(SurfacePairKind::kWithSphere), known = found_at_ == world.scene.positions_number();
  if (!known) {
    again_.clear();
    // spheres alone add to the forces at once; they have no normals, and their contacts with shells are counted on the shells' faces
    gradient_.set_zero(world.scene.shells() > 0 ? world.scene.point_count() : 0, world.scene.sphere_point(), world.scene.face_count());
    layer_.evaluate(scene, SurfacePairKind::kSurfaces, gradient_);
    if (with_spheres) surfaces_only_ = gradient_;
  } else {
    if (!again_.empty()) evaluate_again(world, with_spheres);
    if (with_spheres) gradient_ = surfaces_only_;
  }
  if (with_spheres) layer_.evaluate(scene, SurfacePairKind::kWithSphere, gradient_);
  if (!known || with_spheres) {
    const SurfaceList owned{world.scene.topologies().first(world.scene.owned_shells()), world.scene.first_node(), world.scene.first_face(),
                            threads_};
    add_surface_forces(owned, world.position(), world.geometry, {gradient_.face_energy, {}, gradient_.node_normal}, gradient_.force);
    given_back_ = gradient_.node_normal.capacity() * sizeof(Vec3d);
    give_back(gradient_.node_normal);
    found_at_ = world.scene.positions_number();
  }
  parallel_for(threads_, gradient_.force.size(), [&](std::size_t i) { out.force[i] += gradient_.force[i]; });
  layer_.add_energy(scene, out.energy);
}

void SurfaceContacts::evaluate_again(const World& world, bool with_spheres) {
  const Scene& scene = world.scene;
  ContactGradient& gradient = with_spheres ? surfaces_only_ : gradient_;
  gradient.node_normal.resize(scene.sphere_point());
  std::vector<const Topology*> owned(scene.topologies().begin(),
                                     scene.topologies().begin() + static_cast<std::ptrdiff_t>(scene.owned_shells()));
  for (std::size_t i = 0; i < scene.shells(); ++i) {
    if (!again_[i]) {
      if (i < owned.size()) owned[i] = nullptr;
      continue;
    }
    const ContactBody& body = scene.bodies()[i];
    std::fill_n(gradient.force.begin() + body.first_point, body.point_count, Vec3d{});
    std::fill_n(gradient.node_normal.begin() + body.first_point, body.point_count, Vec3d{});
    std::fill_n(gradient.face_energy.begin() + scene.first_face()[i], scene.topologies()[i]->face_count(), 0.0);
    std::fill_n(gradient.told_area.begin() + scene.first_face()[i], scene.topologies()[i]->face_count(), 0.0f);
  }
  layer_.evaluate_of(again_, contact_scene(world), SurfacePairKind::kSurfaces, gradient);
  again_.clear();
  if (with_spheres) return;  // what areas and normals do comes with that of the spheres
  add_surface_forces({owned, scene.first_node(), scene.first_face(), threads_}, world.position(), world.geometry,
                     {gradient.face_energy, {}, gradient.node_normal}, gradient.force);
  give_back(gradient.node_normal);
}

std::optional<CellId> SurfaceContacts::crossed(const World& world, std::span<const Vec3d> start) const {
  const SurfacePair* pair = layer_.crossed(contact_scene(world), start);
  if (pair == nullptr) return std::nullopt;
  return world.scene.bodies()[pair->a].id;
}

void SurfaceContacts::begin_step(const World& world, StepStart&) { layer_.begin_step(contact_scene(world)); }

void SurfaceContacts::assemble(const World& world, double, Assembly& out) {
  give_back(gradient_.force);  // the matrix takes its place
  surfaces_only_ = {};
  given_back_ = 0;
  forget();
  out.contacts = layer_.element_groups(contact_scene(world));
  out.face_energy = gradient_.face_energy;
}

void SurfaceContacts::make_room() {
  layer_.make_room();
  give_back(gradient_.face_energy);
}

std::size_t SurfaceContacts::memory() const { return layer_.memory() + gradient_.memory() + surfaces_only_.memory() + given_back_; }

void ContactFriction::add_friction(const World& world, const Way& way, std::span<Vec3d> out, OrderFreeSum& quadratic) {
  contacts_.layer().add_step_friction(contact_scene(world), way.start, way.moved, out, quadratic);
}

void ContactFriction::add_product(std::span<const Float4> p, std::span<Float4> q) const {
  if (const ObjectiveFriction* friction = contacts_.layer().own_friction()) friction->add_product(p, q);
}

void ContactFriction::add_outside_balance(std::span<const Float4> velocity, std::span<OutsideBalance> by_body) const {
  const ObjectiveFriction* const friction = contacts_.layer().own_friction();
  if (friction == nullptr) return;  // within the element groups
  friction->for_elements_on_obstacles([&](const ObjectiveElement& e) {
    const Vec3d u = e.jump([&](std::uint32_t i) { return Vec3d{velocity[i].x, velocity[i].y, velocity[i].z}; });
    by_body[e.body[0]].missing -= e.drag(u);
    by_body[e.body[0]].resistance += isotropic(static_cast<double>(e.across)) + outer(static_cast<double>(e.along), to_double(e.n));
  });
}

void ContactFriction::add_diagonal(std::span<SymMat3<float>> diagonal) const {
  if (const ObjectiveFriction* friction = contacts_.layer().own_friction()) friction->add_diagonal(diagonal);
}

}  // namespace morula
