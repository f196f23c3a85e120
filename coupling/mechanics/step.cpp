#include "coupling/mechanics/step.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel/threads.h"

namespace morula {
namespace {

/// The last velocities of shells and spheres: where the solver starts.
void start_from_last_velocities(Workspace& work, const Tissue& tissue) {
  std::vector<Float4>& out = work.solver.velocity;
  parallel_for(work.setting.threads, tissue.shells.velocity.size(), [&](std::size_t i) {
    const Vec3f& v = tissue.shells.velocity[i];
    out[i] = {v.x, v.y, v.z, 0.0f};
  });
  parallel_for(work.setting.threads, tissue.spheres.velocity.size(), [&](std::size_t i) {
    const Vec3f& v = tissue.spheres.velocity[i];
    out[work.scene.sphere_point() + i] = {v.x, v.y, v.z, 0.0f};
  });
}

bool fluctuates(const Model& model) {
  return std::any_of(model.types.begin(), model.types.end(), [](const CellType& type) { return type.fluctuations.energy > 0.0; });
}

/// All terms freeze their friction.
void freeze_friction(Workspace& work, const Tissue& tissue) {
  const World world = work.world(tissue);
  StepStart start{work.solver.system.clear_point_friction(work.scene.point_count() - work.scene.sphere_point()), work.solver.velocity};
  for (const auto& term : work.terms.all) term->begin_step(world, start);
}

void add_random_forces(Workspace& work, const Tissue& tissue, double dt, std::span<Vec3d> force) {
  const World world = work.world(tissue);
  const Noise noise{work.setting.model.seed, tissue.clock.steps, dt};
  for (const auto& term : work.terms.all) term->add_noise(world, noise, force);
}

void find_clusters(Workspace& work, const World& world, std::span<const ElementGroup> groups) {
  std::vector<std::vector<std::uint32_t>> joined;
  for (const auto& term : work.terms.all) term->add_joined(world, joined);
  work.solver.clusters.find(work.scene, groups, work.terms.spheres->pairs(), joined, work.setting.threads, work.setting.comm);
}

/// What obstacles and walls hold, with a step of dt.
void find_held_points(Workspace& work, std::span<const ElementGroup> groups, const FaceQuadrature& quadrature, double dt) {
  const Scene& scene = work.scene;
  std::vector<HeldPoint>& held = work.solver.held;
  held.clear();
  for (const ElementGroup& group : groups) add_held_points(group, quadrature, static_cast<float>(dt), held);
  for (const RigidPairElement& e : work.terms.spheres->pairs().rigid) {
    const auto body = static_cast<std::uint32_t>(scene.first_sphere() + e.sphere);
    if (!scene.bodies()[body].active()) continue;
    const Vec3d n{e.n[0], e.n[1], e.n[2]};
    const double along = e.axial + dt * static_cast<double>(e.stiffness);
    held.push_back({body, scene.bodies()[body].first_point, isotropic(static_cast<double>(e.isotropic)) + outer(along, n)});
  }
}

/// Whether loads that hold cells are elsewhere at the end of a step than at its start. Collective.
bool springs_move(const Workspace& work, std::span<const Anchor> at_end, std::span<const Anchor> at_start) {
  const auto holds = [](const CellLoad& load) { return load.what->holds(); };
  return std::ranges::any_of(work.setting.model.loads, holds) && work.setting.comm.any(!std::ranges::equal(at_end, at_start));
}

/// Norm of these forces of terms together with all that acts from outside while springs are those [nN]. Collective.
double norm_of_forces(const Workspace& work, const Tissue& tissue, const StepTask& task, std::span<const Anchor> springs,
                      std::vector<Vec3d> force) {
  const OwnedPoints points = work.points();
  points.for_all([&](std::uint32_t i) { force[i] += work.external_on(task, i); });
  Grips grips;
  grips.set_anchors(springs);
  const World world = work.world(tissue);
  StepStart not_asked{};
  grips.begin_step(world, not_asked);
  OrderFreeSum no_work;
  grips.add_outside({world.position(), world.position(), false}, -1.0, force, no_work);  // it adds −Δt times their forces
  return std::sqrt(points.dot(force, force));
}

}  // namespace

AssembledMatrix::AssembledMatrix(Workspace& work, const Tissue& tissue, double dt) : work_(work) {
  auto timed = work.timer.scope(Stage::kAssemble);
  work.geometry.give_back();
  const World world = work.world(tissue);
  Assembly assembly;
  for (const auto& term : work.terms.all) term->assemble(world, dt, assembly);
  const ContactLayer& layer = work.terms.contacts->layer();
  const FaceQuadrature& quadrature = FaceQuadrature::with_points(layer.settings().points_per_face);
  work.terms.membranes->build(world, dt, assembly,
                              edge_blocks_of(assembly.contacts, work.scene.bodies().size(), quadrature, static_cast<float>(dt)));
  work.solver.system.set_step(dt);
  work.solver.system.set_elements(assembly.contacts, quadrature);
  find_clusters(work, world, assembly.contacts);
  find_held_points(work, assembly.contacts, quadrature, dt);
  work.terms.contacts->make_room();
}

AssembledMatrix::~AssembledMatrix() {
  work_.note_memory();
  if (work_.scene.shells() == 0) return;  // spheres alone have no use for the room
  work_.solver.system.drop_matrix();
  for (const auto& term : work_.terms.all) term->drop_matrix();
}

Result<SolveReport, SolveFault> AssembledMatrix::solve(std::span<const Vec3d> right, double tolerance, int max_iterations) && {
  auto timed = work_.timer.scope(Stage::kSolve);
  const std::span<Float4> to = work_.solver.system.right_hand_side();
  work_.points().for_all([&](std::uint32_t i) {
    to[i] = {static_cast<float>(right[i].x), static_cast<float>(right[i].y), static_cast<float>(right[i].z), 0.0f};
  });
  MORULA_TRY_ASSIGN(const SolveReport report,
                    work_.solver.system.solve(work_.solver.velocity, tolerance, max_iterations, work_.setting.comm));
  conserve_momentum(work_, right);
  return report;
}

Evaluation begin_step(Workspace& work, const Tissue& tissue, StepTask& task, Evaluation now) {
  auto timed = work.timer.scope(Stage::kAssemble);
  work.most_bytes = 0;
  work.terms.grips->set_anchors(task.anchors);
  work.terms.following->set_on(task.settling == nullptr);
  start_from_last_velocities(work, tissue);
  freeze_friction(work, tissue);
  if (task.settling != nullptr) {
    std::fill(work.solver.velocity.begin(), work.solver.velocity.end(), Float4{});
    return now;
  }
  if (fluctuates(work.setting.model)) {
    std::vector<Vec3d> force(work.scene.point_count());
    work.points().for_all([&](std::uint32_t i) { force[i] = work.external_on(task, i); });
    add_random_forces(work, tissue, task.dt, force);
    task.by_point = std::move(force);
  }
  std::vector<Vec3d> offsets = tissue.obstacle_offset;
  for (std::size_t i = 0; i < work.setting.model.obstacles.size(); ++i)
    offsets[i] += work.setting.model.obstacles[i].way(tissue.clock.time, tissue.clock.time + task.dt);
  const bool obstacles_move = !std::ranges::equal(offsets, work.terms.contacts->layer().offsets());
  const std::vector<Anchor> before = grip_anchors(work.setting.model, tissue, tissue.clock.time);
  if (!obstacles_move && !springs_move(work, task.anchors, before)) return now;
  task.forces_before = norm_of_forces(work, tissue, task, before, now.force);
  if (!obstacles_move) return now;
  work.terms.contacts->set_offsets(offsets);
  return evaluate(work, tissue, std::move(now.force));
}

std::vector<Vec3d> random_forces(Workspace& work, const Tissue& tissue, double dt) {
  std::vector<Vec3d> force(work.scene.point_count());
  if (!fluctuates(work.setting.model)) return force;
  freeze_friction(work, tissue);
  add_random_forces(work, tissue, dt, force);
  for (const auto& term : work.terms.all) term->abandon_step();
  return force;
}

Residual residual_of(Workspace& work, const Tissue& tissue, const StepTask& task, std::span<const Vec3d> start, Evaluation now,
                     bool moved) {
  auto timed = work.timer.scope(Stage::kAdvance);
  const double dt = task.dt;
  const OwnedPoints points = work.points();
  const World world = work.world(tissue);
  const Way way{start, world.position(), moved};
  std::vector<Vec3d>& force = now.force;
  points.for_all([&](std::uint32_t i) {  // −Δt (F + external), to which Γ_n d is added
    force[i] = (force[i] + work.external_on(task, i)) * -dt;
  });
  OrderFreeSum sums[2];  // dᵀΓ_n d, work of what is external
  for (const auto& term : work.terms.all) term->add_outside(way, dt, force, sums[1]);
  for (const auto& term : work.terms.all) term->add_friction(world, way, force, sums[0]);
  std::vector<OrderFreeSum> works(static_cast<std::size_t>(points.threads));
  points.for_bodies([&](std::size_t t, const ContactBody& body) {
    double done = 0.0;
    for (std::uint32_t i = body.first_point; i < body.first_point + body.point_count; ++i) {
      done += dot(work.external_on(task, i), way.position[i] - start[i]);
      force[i] *= -1.0 / dt;
    }
    works[t].add(done);
  });
  for (const OrderFreeSum& done : works) sums[1] += done;
  points.for_inner([&](std::uint32_t i) {
    sums[1].add(dot(work.external_on(task, i), way.position[i] - start[i]));
    force[i] *= -1.0 / dt;
  });
  double totals[2];
  work.setting.comm.sum(sums, totals);
  return {now.energy, now.energy - totals[1] + totals[0] / (2.0 * dt), std::move(now.force)};
}

void finish_step(Workspace& work, Tissue& tissue, const StepTask& task, double energy, StepReport& report) {
  auto timed = work.timer.scope(Stage::kAdvance);
  const Scene& scene = work.scene;
  const Comm& comm = work.setting.comm;
  const double rate = 1.0 / task.dt;
  const auto velocity = [&](std::size_t point, const Vec3d& start) { return to_float((scene.position()[point] - start) * rate); };
  parallel_for(work.setting.threads, tissue.shells.velocity.size(),
               [&](std::size_t i) { tissue.shells.velocity[i] = velocity(i, tissue.shells.position[i]); });
  parallel_for(work.setting.threads, tissue.spheres.velocity.size(),
               [&](std::size_t i) { tissue.spheres.velocity[i] = velocity(scene.sphere_point() + i, tissue.spheres.position[i]); });
  for (std::size_t i = 0; i < tissue.nuclei.shells.velocity.size(); ++i)
    tissue.nuclei.shells.velocity[i] = velocity(scene.nuclear_node() + i, tissue.nuclei.shells.position[i]);
  report.motion = common_motion(work, tissue);
  scene.give_positions(tissue);
  StepEnd end{tissue, task.settling == nullptr};
  if (end.clock_runs)
    for (std::size_t i = 0; i < work.setting.model.obstacles.size(); ++i)
      tissue.obstacle_offset[i] += work.setting.model.obstacles[i].way(tissue.clock.time, tissue.clock.time + task.dt);
  const World world = work.world(tissue);
  for (const auto& term : work.terms.all) term->end_step(world, end);
  // Where there are ghosts, a list of pairs that would wear out within the next step is made together with them, before that step: else
  // the list is made in the middle of the step, and the ghosts soon after.
  const double used = work.terms.contacts->layer().skin_used();
  if (comm.size() > 1) work.age->expected_skin_use = comm.max(2.0 * used - work.age->skin_used);
  work.age->skin_used = used;
  report.energy = energy;
  report.overlap = deepest_overlap(work);
  if (tissue.clock.capped && report.overlap < 0.1) tissue.clock.capped = false;
  if (end.clock_runs) work.known = Known{energy, std::nullopt};
}

StepFault undo_step(Workspace& work, std::span<const Vec3d> start, StepFault fault) {
  work.scene.move_points([&](std::span<Vec3d> x) { std::copy(start.begin(), start.end(), x.begin()); });
  for (const auto& term : work.terms.all) term->abandon_step();
  return fault;
}

Result<StepReport, StepFault> advance(Workspace& work, Tissue& tissue, StepTask task) {
  const double end = tissue.clock.time + task.dt;
  const auto varies = [](const auto& term) { return term->varies_with_time(); };
  if (task.settling == nullptr && std::exchange(work.prescribed_time, end) != end &&
      work.setting.comm.any(std::ranges::any_of(work.terms.all, varies)))
    work.known.reset();
  (void)prepare_step(work, tissue, task.settling);
  Evaluation now{work.known->energy, std::move(*work.known->force)};
  work.known.reset();  // whatever comes of the step, the tissue will be another
  now = begin_step(work, tissue, task, std::move(now));
  return work.setting.model.step.integrator == Integrator::kImplicit ? implicit_step(work, tissue, task, std::move(now))
                                                                     : explicit_step(work, tissue, task, std::move(now));
}

}  // namespace morula
