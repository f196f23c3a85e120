#include "coupling/mechanics/mechanics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/parallel/threads.h"
#include "coupling/mechanics/contact_setup.h"

namespace morula {
namespace {

/// How far a body may go in one step before the step is refused: ghosts must reach that far (implicit_step.cpp).
constexpr double kCappedDepth = 5.0;      // overlap that the capped start can undo [µm]
constexpr double kCapWithoutStart = 0.1;  // δ after a promotion into too little room, where the study has no capped start [µm]

template <class T>
void give_back(std::vector<T>& vector) {
  std::vector<T>().swap(vector);
}

double step_margin(const Model& model) { return 2.0 * model.step.max_displacement * model.contact.range; }

}  // namespace

Mechanics::Mechanics(const Model& model, std::vector<RigidSurface> obstacles, ShapeLibrary& shapes, Comm comm, int threads)
    : model_(model),
      shapes_(shapes),
      comm_(comm),
      threads_(threads),
      contacts_(contact_settings(model, threads), std::move(obstacles), contact_materials(model), contact_material_count(model)),
      shells_(model),
      interior_(model),
      nuclei_(model, threads),
      spheres_(model, threads),
      face_tensions_(model),
      node_terms_(model) {
  for (const ContactPair& pair : model.pairs) has_regional_adhesion_ = has_regional_adhesion_ || !pair.regions.empty();
}

ContactScene Mechanics::contact_scene() const {
  return {scene_.bodies(), std::span(scene_.position()).first(scene_.nucleus_point()), scene_.topologies(), scene_.first_face(), &geometry_,
          scene_.marks()};
}

void Mechanics::prepare(const Tissue& tissue) {
  // Ghosts must be renewed when something has gone further than their reach allows for.
  const double slack = contacts_.settings().body_skin;
  bool renew = !scene_valid_ || (renew_soon_ && !evaluated_);
  if (!renew && comm_.size() > 1) {
    double most = 0.0;
    for (std::size_t i = 0; i < scene_start_.size(); ++i) {
      const Vec3d& now =
          i < tissue.shells.position.size() ? tissue.shells.position[i] : tissue.spheres.position[i - tissue.shells.position.size()];
      most = std::max(most, norm2(now - scene_start_[i]));
    }
    renew = most > 0.25 * slack * slack;
  }
  if (comm_.any(renew)) {
    auto timed = timer_.scope(Stage::kGhosts);
    const double reach = std::max(contacts_.settings().range, contacts_.settings().sphere_reach) + 2.0 * contacts_.settings().body_skin +
                         slack + 2.0 * step_margin(model_);
    scene_.build(tissue, model_.space, reach, shapes_, comm_);
    scene_valid_ = true;
    renew_soon_ = false;
    wear_ = 0.0;
    evaluated_ = contacts_current_ = false;
    scene_start_.clear();
    if (comm_.size() > 1) {
      scene_start_ = tissue.shells.position;
      scene_start_.insert(scene_start_.end(), tissue.spheres.position.begin(), tissue.spheres.position.end());
    }
    contacts_.reset();
    shells_.set_shells(tissue.shells);
    interior_.set_shells(tissue.shells, scene_.nucleus_point());
    nuclei_.set_shells(tissue, scene_.nuclear_node());
    force_.assign(scene_.point_count(), {});
    solution_.assign(scene_.point_count(), {});
    if (relaxing_)
      hold_all_but(relax_moves_);  // the new scene knows nothing of who is held
    else
      lay_out_system();
  }
  if (has_regional_adhesion_ && comm_.any(scene_.marks_differ(tissue))) {
    scene_.take_marks(tissue);
    evaluated_ = contacts_current_ = false;
  }
  if (!evaluated_) {
    const double cap = tissue.clock.capped ? (relaxing_                     ? relax_cap_
                                              : model_.step.start_cap > 0.0 ? model_.step.start_cap
                                                                            : kCapWithoutStart)
                                           : 0.0;
    const double depth = tissue.clock.capped ? (relaxing_ ? relax_depth_ : kCappedDepth) : 0.0;
    const double hold = relaxing_ ? relax_hold_ : 1.0;
    if (cap != contacts_.cap() || depth != contacts_.settings().depth || hold != contacts_.hold()) contacts_current_ = false;
    contacts_.set_cap(cap);
    contacts_.set_hold(hold);
    contacts_.set_depth(depth);
    if (!contacts_current_) {
      contacts_.set_offsets(tissue.obstacle_offset);
      scene_.take_positions(tissue);
    }
    scene_.take_radii(tissue);
    spheres_.update_sisters(scene_, tissue.clock.time);
    face_tensions_.set(tissue, std::max(tension_time_, tissue.clock.time));
    if (node_terms_.has_springs()) node_terms_.set_springs(tissue, comm_);
    evaluate(tissue, !contacts_current_);
  }
}

void Mechanics::lay_out_system() {
  FrictionSystem::Layout layout;
  layout.point_count = scene_.point_count();
  layout.owned.reserve(scene_.bodies().size() + interior_.nuclei().size());
  for (const ContactBody& body : scene_.bodies()) {
    if (body.shape == BodyShape::kSurface) layout.bodies.push_back({body.first_point, body.point_count});
    layout.owned.push_back(body.active());
  }
  for (const InteriorSystem::Nucleus& nucleus : interior_.nuclei()) layout.owned.push_back(scene_.bodies()[nucleus.shell].active());
  nuclei_.set_moving(scene_.bodies());
  nuclei_.for_all_points([&](std::uint32_t, bool moves) { layout.owned.push_back(moves); });
  if (comm_.size() > 1) layout.exchange = [this](std::span<Float4> vector) { scene_.exchange(vector); };
  system_.set_layout(std::move(layout), threads_);
  system_.set_shells(&shells_);
  system_.set_sphere_pairs(&spheres_.pairs());
  if (!interior_.empty()) system_.add_part(&interior_);
  if (!nuclei_.empty()) system_.add_part(&nuclei_);
  if (const AddedPart* friction = contacts_.own_friction()) system_.add_part(friction);
  system_.add_part(&held_);
}

void Mechanics::evaluate(const Tissue& tissue, bool moved) {
  if (moved) {
    auto timed = timer_.scope(Stage::kGhosts);
    scene_.exchange(scene_.position());
  }
  const ContactScene scene = contact_scene();
  {
    auto timed = timer_.scope(Stage::kInternal);
    if (moved)
      compute_node_geometry({scene_.topologies(), scene_.first_node(), scene_.first_face()},
                            std::span(std::as_const(scene_).position()).first(scene_.sphere_point()), geometry_);
    const auto held = nuclei_.evaluate_shells(tissue, scene_.position());
    shells_.evaluate(tissue.shells, scene_.position(), force_, held);
  }
  {
    auto timed = timer_.scope(Stage::kCandidates);
    if (comm_.any(contacts_.note_motion(scene))) {
      contacts_.rebuild(scene, model_.space);
      spheres_.set_pairs(scene_, contacts_, tissue);
      moved = true;
    }
  }
  auto timed = timer_.scope(Stage::kContacts);
  const bool with_spheres = contacts_.has_pairs(SurfacePairKind::kWithSphere);
  if (spheres_.packs()) find_packing(scene, with_spheres);
  if (moved || with_spheres) {
    if (moved) {
      // spheres alone add to force_ at once; they have no normals, and their contacts with shells are counted on the shells' faces
      gradient_.set_zero(scene_.shells() > 0 ? scene_.point_count() : 0, scene_.sphere_point(), scene_.face_count(), scene_.shells());
      contacts_.evaluate(scene, SurfacePairKind::kSurfaces, gradient_);
      if (with_spheres) surfaces_only_ = gradient_;
    } else {
      gradient_ = surfaces_only_;
    }
    if (with_spheres) contacts_.evaluate(scene, SurfacePairKind::kWithSphere, gradient_);
    const SurfaceList owned{scene_.topologies().first(scene_.owned_shells()), scene_.first_node(), scene_.first_face()};
    add_surface_forces(owned, scene_.position(), geometry_, {gradient_.face_energy, {}, gradient_.node_normal}, gradient_.force);
    note_memory();
    give_back(gradient_.node_normal);
  }
  parallel_for(threads_, force_.size(), [&](std::size_t i) {
    const Vec3d of_contacts = gradient_.force.empty() ? Vec3d{} : gradient_.force[i];
    if (i < scene_.owned_nodes())
      force_[i] += of_contacts;  // to those within the shells
    else
      force_[i] = of_contacts;
  });
  spent_ = false;
  spheres_.evaluate(scene_, contacts_, force_);
  const auto& internal = shells_.forces();
  if (!interior_.empty()) interior_.evaluate(tissue.shells, scene_.position(), force_);
  if (!nuclei_.empty()) nuclei_.evaluate(tissue, scene_.position(), internal.pressure, force_);

  OrderFreeSum sum;
  for (std::size_t i = 0; i < scene_.owned_shells(); ++i) sum.add(internal.energy[i]);
  face_tensions_.add_forces(tissue.shells, scene_.position(), force_, sum);
  node_terms_.add_forces(tissue.shells, scene_.position(), force_, sum);
  contacts_.add_energy(scene, sum);
  spheres_.add_energy(sum);
  interior_.add_energy(sum);
  nuclei_.add_energy(sum);
  energy_ = comm_.sum(sum);
  evaluated_ = contacts_current_ = true;
}

void Mechanics::find_packing(const ContactScene& scene, bool with_surfaces) {
  std::vector<Penetration> penetration(with_surfaces ? scene.bodies.size() : 0);
  if (with_surfaces) contacts_.find_penetration(scene, penetration);
  spheres_.find_packing(scene_, contacts_, penetration, comm_);
  contacts_.set_packing(spheres_.surface_pressure());
}

StepFault Mechanics::undo(std::span<const Vec3d> start, StepFault fault) {
  scene_.position().assign(start.begin(), start.end());
  spheres_.end_step();
  evaluated_ = contacts_current_ = false;
  return fault;
}

void Mechanics::begin_step(const Tissue& tissue, double dt) {
  auto timed = timer_.scope(Stage::kAssemble);
  most_bytes_ = 0;
  contacts_.begin_step(contact_scene());
  shells_.begin_step(tissue.shells, geometry_);
  interior_.begin_step(scene_.position(), geometry_);
  nuclei_.begin_step(tissue);
  shells_.set_node_friction(node_terms_.friction(tissue, geometry_));
  std::vector<float> friction(scene_.point_count() - scene_.sphere_point(), 0.0f);
  for (std::size_t i = 0; i < scene_.owned_spheres(); ++i) {
    const double r = tissue.spheres.radius[i];
    friction[i] = static_cast<float>(model_.types[tissue.spheres.type[i]].medium_friction * 4.0 * std::numbers::pi * r * r);
  }
  system_.set_point_friction(friction);
  held_.clear();
  for (const Anchor& anchor : anchors_)
    for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) held_.hold(anchor.node, axis, anchor.stiffness);
  spheres_.begin_step();
  // The last velocity is the solver's start; obstacles go where they will be at the end of the step.
  parallel_for(threads_, tissue.shells.velocity.size(), [&](std::size_t i) {
    const Vec3f& v = tissue.shells.velocity[i];
    solution_[i] = {v.x, v.y, v.z, 0.0f};
  });
  for (std::size_t i = 0; i < tissue.spheres.velocity.size(); ++i) {
    const Vec3f& v = tissue.spheres.velocity[i];
    solution_[scene_.sphere_point() + i] = {v.x, v.y, v.z, 0.0f};
  }
  interior_.start_from_cortex(solution_);
  nuclei_.start_with_cells(tissue, solution_);
  if (relaxing_) {
    std::fill(solution_.begin(), solution_.end(), Float4{});
    return;
  }
  std::vector<Vec3d> offsets = tissue.obstacle_offset;
  bool moving = false;
  for (std::size_t i = 0; i < model_.obstacles.size(); ++i) {
    offsets[i] += model_.obstacles[i].way(tissue.clock.time, tissue.clock.time + dt);
    moving = moving || model_.obstacles[i].moves();
  }
  if (moving) {
    contacts_.set_offsets(offsets);
    evaluate(tissue);
  }
}

void Mechanics::assemble(const Tissue& tissue, double dt) {
  auto timed = timer_.scope(Stage::kAssemble);
  give_back(gradient_.force), give_back(geometry_.node_normal), give_back(geometry_.node_normal_length), give_back(geometry_.node_area);
  surfaces_only_ = {};
  const FaceQuadrature& quadrature = FaceQuadrature::with_points(contacts_.settings().points_per_face);
  const std::vector<ElementGroup> groups = contacts_.element_groups(contact_scene());
  shells_.set_node_stiffness(node_terms_.stiffness(scene_.position(), scene_.owned_nodes()));
  shells_.assemble(tissue.shells, scene_.position(), face_tensions_.on_top_of(gradient_.face_energy), dt,
                   edge_blocks_of(groups, scene_.bodies().size(), quadrature, static_cast<float>(dt)));
  interior_.assemble(scene_.position(), dt);
  nuclei_.assemble(tissue, scene_.position(), dt);
  held_.set_step(dt);
  system_.set_step(dt);
  system_.set_elements(groups, quadrature);
  find_clusters(tissue, groups);
  contacts_.make_room();
  give_back(gradient_.face_energy);
}

void Mechanics::drop_matrix() {
  note_memory();
  if (scene_.shells() == 0) return;  // spheres alone have no use for the room
  system_.drop_matrix();
  shells_.drop_matrix();
  nuclei_.drop_matrix();
}

std::optional<StepFault> Mechanics::find_fault() const {
  const auto& faults = shells_.forces().fault;
  for (std::size_t i = 0; i < faults.size(); ++i)
    if (faults[i]) return StepFault{dcm::describe(faults[i]), scene_.bodies()[i].id, true};
  if (const auto fault = nuclei_.find_fault()) return StepFault{fault->second, scene_.bodies()[fault->first].id, true};
  return std::nullopt;
}

void Mechanics::prepare_step(const Tissue& tissue) {
  if (comm_.any(flags_changed_ || spent_)) evaluated_ = flags_changed_ = false;
  prepare(tissue);
}

Result<StepReport, StepFault> Mechanics::step(Tissue& tissue, double dt, std::span<const Vec3d> external, std::span<const Anchor> anchors) {
  anchors_ = anchors;
  if (comm_.any(flags_changed_ || spent_)) evaluated_ = flags_changed_ = false;
  if (node_terms_.has_springs()) evaluated_ = false;  // their spheres are those of the step's start
  if (const double end = tissue.clock.time + dt; !relaxing_ && face_tensions_.vary() && end != tension_time_) {
    tension_time_ = end;
    evaluated_ = false;
  }
  prepare(tissue);
  return model_.step.integrator == Integrator::kImplicit ? implicit_step(tissue, dt, external) : explicit_step(tissue, dt, external);
}

void Mechanics::finish(Tissue& tissue, double dt, StepReport& report) {
  auto timed = timer_.scope(Stage::kAdvance);
  const double rate = 1.0 / dt;
  const auto velocity = [&](std::size_t point, const Vec3d& start) { return to_float((scene_.position()[point] - start) * rate); };
  parallel_for(threads_, tissue.shells.velocity.size(),
               [&](std::size_t i) { tissue.shells.velocity[i] = velocity(i, tissue.shells.position[i]); });
  for (std::size_t i = 0; i < tissue.spheres.velocity.size(); ++i)
    tissue.spheres.velocity[i] = velocity(scene_.sphere_point() + i, tissue.spheres.position[i]);
  for (std::size_t i = 0; i < tissue.nuclei.shells.velocity.size(); ++i)
    tissue.nuclei.shells.velocity[i] = velocity(scene_.nuclear_node() + i, tissue.nuclei.shells.position[i]);
  report.motion = common_motion(tissue);
  scene_.give_positions(tissue);
  if (!relaxing_) {
    for (std::size_t i = 0; i < model_.obstacles.size(); ++i)
      tissue.obstacle_offset[i] += model_.obstacles[i].way(tissue.clock.time, tissue.clock.time + dt);
    flags_changed_ = comm_.any(spheres_.update_attached(scene_, contacts_, tissue));
  }
  spheres_.end_step();
  contacts_.end_step();
  nuclei_.end_step();
  // Where there are ghosts, a list of pairs that would wear out within the next step is made together with them, before that step: else
  // the list is made in the middle of the step, and the ghosts soon after.
  renew_soon_ = comm_.size() > 1 && comm_.any(2.0 * contacts_.wear() - wear_ > 1.0);
  wear_ = contacts_.wear();
  report.energy = energy_;
  report.overlap = deepest_overlap();
  if (tissue.clock.capped && report.overlap < 0.1) tissue.clock.capped = false;
  if (relaxing_) evaluated_ = false;
}

std::vector<Vec3d> Mechanics::spread(const Tissue& tissue, std::span<const Vec3d> by_body) {
  prepare(tissue);
  std::vector<Vec3d> out(external_size(tissue));
  const std::size_t shells = scene_.owned_shells();
  for (std::size_t i = 0; i < shells; ++i) {
    if (norm2(by_body[i]) == 0.0) continue;
    const ContactBody& body = scene_.bodies()[i];
    for (std::uint32_t n = body.first_point; n < body.first_point + body.point_count; ++n)
      out[n] = by_body[i] * (geometry_.node_area[n] / geometry_.area[i]);
  }
  std::copy(by_body.begin() + static_cast<std::ptrdiff_t>(shells), by_body.end(), out.begin() + scene_.owned_nodes());
  return out;
}

double Mechanics::deepest_overlap() const {
  const SurfacePair* worst = contacts_.deepest(contact_scene());
  return comm_.max(worst != nullptr ? worst->overlap : 0.0);
}

std::vector<std::pair<CellId, CellId>> Mechanics::touching(const Tissue& tissue, std::span<const CellId> these) {
  prepare(tissue);
  const auto bodies = scene_.bodies();
  const auto wanted = [&](CellId id) { return std::binary_search(these.begin(), these.end(), id); };
  std::vector<std::pair<CellId, CellId>> out;
  for (const SurfacePair& pair : contacts_.pairs()) {
    if (!(pair.area > 0.0) || pair.with_itself()) continue;
    const ContactBody& a = bodies[pair.a];
    const CellId partner = pair.rigid ? CellId(pair.b + 1) : bodies[pair.b].id;
    if (!wanted(a.id) && (pair.rigid || !wanted(partner))) continue;
    if (a.owned) out.emplace_back(a.id, partner);
    if (!pair.rigid && bodies[pair.b].owned) out.emplace_back(partner, a.id);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());  // images of periodic neighbours
  return out;
}

double Mechanics::energy_and_forces(const Tissue& tissue, std::vector<Vec3d>& force) {
  evaluated_ = false;
  prepare(tissue);
  force.assign(force_.begin(), force_.begin() + scene_.owned_nodes());
  const auto first = force_.begin() + scene_.sphere_point();
  force.insert(force.end(), first, first + static_cast<std::ptrdiff_t>(scene_.owned_spheres()));
  return energy_;
}

std::size_t Mechanics::bytes_now() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return contacts_.memory() + shells_.memory() + interior_.memory() + nuclei_.memory() + spheres_.memory() + system_.memory() +
         clusters_.memory() + scene_.memory() + bytes(force_) + bytes(solution_) + gradient_.memory() + surfaces_only_.memory() +
         bytes(geometry_.face_area) + bytes(geometry_.face_normal) + bytes(geometry_.node_normal) + bytes(geometry_.node_normal_length) +
         bytes(geometry_.node_area) + bytes(scene_start_);
}

}  // namespace morula
