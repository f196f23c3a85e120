#include "coupling/mechanics/surface_contacts.h"

#include <algorithm>

#include "core/parallel/threads.h"
#include "coupling/behaviours/shell_division.h"
#include "coupling/mechanics/contact_setup.h"

namespace morula {
namespace {

template <class T>
void give_back(std::vector<T>& vector) {
  std::vector<T>().swap(vector);
}

/// Adhesion of the shells of this rank to their sisters, as long as the surface between them is new; sorted by cell.
std::vector<SisterBond> new_interfaces(const Model& model, const Tissue& tissue, double time) {
  std::vector<SisterBond> out;
  for (const CellRow& row : tissue.cells.rows) {
    if (row.body != BodyKind::kShell) continue;
    const CellType& type = model.types[row.type];
    const double newness = newness_of_surface(row, type, time), own = model.pair(row.type, row.type).adhesion;
    if (newness > 0.0) out.push_back({row.id, own + newness * (2.0 * type.shell.tension - own)});
  }
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
      layer_(contact_settings(model, threads), std::move(obstacles), contact_materials(model), contact_material_count(model)) {}

void SurfaceContacts::bodies_changed(const World& world) {
  const auto may_be_new = [](const CellType& type) { return type.cycles && type.shells_divide && type.new_surface > 0.0; };
  bonds_age_ = std::ranges::any_of(world.model.types, may_be_new) && world.comm.any(world.scene.shells() > 0);
  layer_.reset();
  forget();
}

void SurfaceContacts::parameters_changed(const World& world) {
  std::vector<SisterBond> bonds;
  if (bonds_age_) bonds = new_interfaces(world.model, world.tissue, world.time);
  if (bonds == layer_.sister_bonds()) return;
  layer_.set_sister_bonds(std::move(bonds));
  forget();
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
    // spheres alone add to the forces at once; they have no normals, and their contacts with shells are counted on the shells' faces
    gradient_.set_zero(world.scene.shells() > 0 ? world.scene.point_count() : 0, world.scene.sphere_point(), world.scene.face_count(),
                       world.scene.shells());
    layer_.evaluate(scene, SurfacePairKind::kSurfaces, gradient_);
    if (with_spheres) surfaces_only_ = gradient_;
  } else if (with_spheres) {
    gradient_ = surfaces_only_;
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

bool SurfaceContacts::crossed(const World& world, std::span<const Vec3d> start) const {
  return layer_.crossed(contact_scene(world), start) != nullptr;
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

void ContactFriction::add_diagonal(std::span<SymMat3<float>> diagonal) const {
  if (const ObjectiveFriction* friction = contacts_.layer().own_friction()) friction->add_diagonal(diagonal);
}

}  // namespace morula
