#include "coupling/mechanics/workspace.h"

#include <algorithm>
#include <utility>

#include "core/parallel/threads.h"

namespace morula {
namespace {

constexpr double kMostDepth = 5.0;        // overlap that is seen; the capped start can undo it [µm]
constexpr double kCapWithoutStart = 0.1;  // δ after a promotion into too little room, where the study has no capped start [µm]

template <class T>
void give_back_room(std::vector<T>& vector) {
  std::vector<T>().swap(vector);
}

/// How far a point may go in one step before the step is refused: ghosts must reach that far.
double step_margin(const Model& model) {
  static_assert(kFurthestPoint >= kFurtherThanAllowed / AllowedWays::kSphereCounts);
  return kFurthestPoint * allowed_ways(model).of_point;
}

bool has_regional_adhesion(const Model& model) {
  return std::any_of(model.pairs.begin(), model.pairs.end(), [](const ContactPair& pair) { return !pair.regions.empty(); });
}

ContactStrength strength_now(const Model& model, const Clock& clock, const Settling* settling) {
  ContactStrength out;
  if (settling != nullptr) out = settling->strength;
  if (!clock.capped)  // what a run may have is seen all the same, or forces would be those of where lists were made
    out.cap = 0.0, out.depth = std::min(model.limits.overlap, kMostDepth);
  else if (settling == nullptr)
    out.cap = model.step.start_cap > 0.0 ? model.step.start_cap : kCapWithoutStart, out.depth = kMostDepth;
  return out;
}

/// What is to be done with the scene; of several ranks that which needs most decides.
enum class SceneNeed { kNothing, kMend, kAnew };

/// Ghosts must be renewed when something has gone further than their reach allows for.
SceneNeed need_of_scene(const Workspace& work, const Tissue& tissue) {
  if (!work.age || (work.age->expected_skin_use > 1.0 && !work.known)) return SceneNeed::kAnew;
  if (work.age->cells_replaced) return SceneNeed::kMend;
  double most = 0.0;
  const std::vector<Vec3d>& start = work.age->start;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const std::size_t nodes = tissue.shells.position.size();
    most = std::max(most, norm2((i < nodes ? tissue.shells.position[i] : tissue.spheres.position[i - nodes]) - start[i]));
  }
  const double slack = work.terms.contacts->layer().settings().body_skin;
  return most > 0.25 * slack * slack ? SceneNeed::kAnew : SceneNeed::kNothing;
}

SceneNeed need_of_all(SceneNeed here, const Comm& comm) {
  return comm.size() == 1 ? here : static_cast<SceneNeed>(static_cast<int>(comm.max(static_cast<double>(here))));
}

/// Owned shells come first, owned spheres after the ghost shells.
std::vector<char> by_body_of_scene(const Scene& scene, std::span<const char> by_owned_body) {
  std::vector<char> out(scene.bodies().size(), 0);
  std::copy_n(by_owned_body.begin(), scene.owned_shells(), out.begin());
  std::copy(by_owned_body.begin() + static_cast<std::ptrdiff_t>(scene.owned_shells()), by_owned_body.end(),
            out.begin() + static_cast<std::ptrdiff_t>(scene.first_sphere()));
  return out;
}

/// The unknowns of the linear system: the bodies that move. Collective.
void lay_out_system(Workspace& work) {
  Scene& scene = work.scene;
  FrictionSystem::Layout layout;
  layout.point_count = scene.point_count();
  layout.owned.reserve(scene.bodies().size() + scene.inner().size());
  for (const ContactBody& body : scene.bodies()) {
    if (body.shape == BodyShape::kSurface) layout.bodies.push_back({body.first_point, body.point_count});
    layout.owned.push_back(body.active());
  }
  for (const Scene::Inner& inner : scene.inner())
    layout.owned.insert(layout.owned.end(), inner.point_count, scene.bodies()[inner.shell].active());
  if (work.setting.comm.size() > 1) layout.exchange = [&scene](std::span<Float4> vector) { scene.exchange(vector); };
  FrictionSystem& system = work.solver.system;
  system.set_layout(std::move(layout), work.setting.threads);
  system.set_shells(&work.terms.membranes->operator_part());
  system.set_sphere_pairs(&work.terms.spheres->pairs());
  for (const auto& term : work.terms.all) system.add_part(term.get());
}

void build_scene(Workspace& work, const Tissue& tissue, const Settling* settling, bool mend) {
  auto timed = work.timer.scope(Stage::kGhosts);
  const Model& model = work.setting.model;
  const ContactSettings& contact = work.terms.contacts->layer().settings();
  const double slack = contact.body_skin;
  const double reach = std::max(contact.range, contact.sphere_reach) + 2.0 * contact.body_skin + slack + 2.0 * step_margin(model);
  std::optional<BodyChanges> changes;
  if (mend)
    changes = work.scene.renew(tissue, model.space, reach, work.setting.shapes, work.setting.comm);
  else
    work.scene.build(tissue, model.space, reach, work.setting.shapes, work.setting.comm);
  if (changes) work.terms.contacts->layer().add_strays(*changes);
  if (settling != nullptr) work.scene.set_moving(by_body_of_scene(work.scene, settling->moves));
  if (mend)
    work.age->cells_replaced = false;  // what lists have of their skin goes on
  else
    work.age.emplace();
  work.known.reset();
  if (work.setting.comm.size() > 1) {
    work.age->start = tissue.shells.position;
    work.age->start.insert(work.age->start.end(), tissue.spheres.position.begin(), tissue.spheres.position.end());
  }
  const World world = work.world(tissue);
  for (const auto& term : work.terms.all) changes ? term->bodies_replaced(world, *changes) : term->bodies_changed(world);
  work.solver.velocity.assign(work.scene.point_count(), {});
  lay_out_system(work);
}

}  // namespace

AllowedWays allowed_ways(const Model& model) {
  constexpr double kFarPoint = 3.0;
  const double of_body = model.step.max_displacement * model.contact.range;
  return {of_body, std::max(of_body, std::min(kFarPoint * of_body, model.contact.range))};
}

void NodeGeometry::update(Scene& scene, int threads, StageTimer& timer) {
  if (at_ == scene.positions_number()) return;
  {
    auto timed = timer.scope(Stage::kGhosts);
    scene.renew_ghost_positions();
  }
  auto timed = timer.scope(Stage::kInternal);
  compute_node_geometry({scene.topologies(), scene.first_node(), scene.first_face(), threads},
                        std::span(scene.position()).first(scene.sphere_point()), geometry_);
  at_ = scene.positions_number();
}

void NodeGeometry::give_back() {
  give_back_room(geometry_.node_normal), give_back_room(geometry_.node_normal_length), give_back_room(geometry_.node_area);
  at_.reset();
}

std::size_t NodeGeometry::memory() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return bytes(geometry_.face_area) + bytes(geometry_.face_normal) + bytes(geometry_.node_normal) + bytes(geometry_.node_normal_length) +
         bytes(geometry_.node_area);
}

World Workspace::world(const Tissue& tissue) const {
  return {setting.model, tissue, scene, geometry.now(), setting.comm, setting.threads, std::max(prescribed_time, tissue.clock.time)};
}

std::size_t Workspace::external_place(std::uint32_t point) const {
  const std::size_t nodes = scene.owned_nodes();
  if (point >= scene.nucleus_point()) return point - scene.nucleus_point() + nodes + scene.owned_spheres();
  return point >= nodes ? point - scene.sphere_point() + nodes : point;
}

Vec3d Workspace::external_on(const StepTask& task, std::uint32_t point) const {
  if (!task.by_point.empty()) return task.by_point[point];
  const std::size_t place = external_place(point);
  return place < task.external.size() ? task.external[place] : Vec3d{};
}

std::size_t Workspace::bytes_now() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t total = solver.system.memory() + solver.clusters.memory() + scene.memory() + scene.point_count() * sizeof(Vec3d) +
                      bytes(solver.velocity) + bytes(solver.held) + geometry.memory() + (age ? bytes(age->start) : 0);
  for (const auto& term : terms.all) total += term->memory();
  return total;
}

Evaluation evaluate(Workspace& work, const Tissue& tissue, std::vector<Vec3d> room) {
  work.geometry.update(work.scene, work.setting.threads, work.timer);
  const World world = work.world(tissue);
  for (const auto& term : work.terms.all) {
    auto timed = work.timer.scope(term.get() == work.terms.contacts ? Stage::kCandidates : term->stage());
    term->measure(world);
  }
  room.resize(work.scene.point_count());
  std::fill(room.begin() + work.scene.owned_nodes(), room.end(), Vec3d{});  // those of owned shells are the membranes' to write
  Forces out{room, {}};
  for (const auto& term : work.terms.all) {
    auto timed = work.timer.scope(term->stage());
    term->evaluate(world, out);
  }
  work.note_memory();
  return {work.setting.comm.sum(out.energy), std::move(room)};
}

void prepare_scene(Workspace& work, const Tissue& tissue, const Settling* settling) {
  const Comm& comm = work.setting.comm;
  const SceneNeed need = need_of_all(need_of_scene(work, tissue), comm);
  if (need != SceneNeed::kNothing) build_scene(work, tissue, settling, need == SceneNeed::kMend && settling == nullptr);
  if (has_regional_adhesion(work.setting.model) && comm.any(work.scene.marks_differ(tissue))) {
    work.scene.take_marks(tissue, mark_bytes(work.setting.model.mark_names.size()));
    work.terms.contacts->forget();
    work.known.reset();
  }
}

const Known& prepare(Workspace& work, const Tissue& tissue, const Settling* settling) {
  prepare_scene(work, tissue, settling);
  if (work.known) return *work.known;
  work.terms.contacts->set_strength(strength_now(work.setting.model, tissue.clock, settling));
  work.terms.contacts->set_offsets(tissue.obstacle_offset);
  work.scene.take_radii(tissue);
  const World world = work.world(tissue);
  for (const auto& term : work.terms.all) term->parameters_changed(world);
  Evaluation now = evaluate(work, tissue, {});
  return work.known.emplace(Known{now.energy, std::move(now.force)});
}

const Known& prepare_step(Workspace& work, const Tissue& tissue, const Settling* settling) {
  if (work.setting.comm.any(work.known && !work.known->force)) work.known.reset();
  return prepare(work, tissue, settling);
}

std::optional<StepFault> find_fault(const Workspace& work, const Tissue& tissue) {
  const World world = work.world(tissue);
  for (const auto& term : work.terms.all)
    if (auto fault = term->fault(world)) return fault;
  return std::nullopt;
}

std::optional<CellId> find_crossed(const Workspace& work, const Tissue& tissue, std::span<const Vec3d> start) {
  const World world = work.world(tissue);
  for (const auto& term : work.terms.all)
    if (const auto cell = term->crossed(world, start)) return cell;
  return std::nullopt;
}

double deepest_overlap(const Workspace& work) {
  const SurfacePair* worst = work.terms.contacts->layer().deepest(contact_scene(work.scene, work.geometry.now()));
  return work.setting.comm.max(worst != nullptr ? worst->overlap : 0.0);
}

}  // namespace morula
