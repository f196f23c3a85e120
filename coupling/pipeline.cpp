#include <algorithm>
#include <cmath>
#include <optional>

#include "core/contact/float_rounding.h"
#include "core/parallel/threads.h"
#include "coupling/approaching_obstacles.h"
#include "coupling/behaviours/ask.h"
#include "coupling/loads/loads.h"
#include "coupling/lumens.h"
#include "coupling/sensed_fields.h"
#include "coupling/simulation.h"
#include "dcm/growth.h"
#include "fields/interval_control.h"

namespace morula {
namespace {

constexpr double kSmallestStep = 1e-4;        // below this a step is given up [s]
constexpr double kAtRest = 1e-2;              // displacement of a step, as a part of the allowed one, below which nothing is to be resolved
constexpr double kGrowthOfStep = 1.5;         // most a step grows from one to the next
constexpr std::uint64_t kReorderEvery = 200;  // steps between renewals of the canonical order: the same on any number of ranks
constexpr double kTolerableImbalance = 1.25;

/// The step that the controller wants, cut so that it lands on `land_on` without leaving a crumb.
double fit_step(double wanted, double time, double land_on) {
  const double left = land_on - time;
  if (left <= wanted * (1.0 + 1e-9)) return left;
  return left < 1.5 * wanted ? 0.5 * left : wanted;
}

/// When a step of dt ends: at `land_on` itself where it differs by rounding only.
double end_of_step(double dt, double time, double land_on) {
  const double end = dt == land_on - time ? land_on : time + dt;
  return std::abs(end - land_on) < 1e-9 * std::max(1.0, land_on) ? land_on : end;
}

bool is_fluid(const CellType& type) { return !dcm::has_elastic_surface(type.shell); }

constexpr double kDeep = 1.0;  // of an overlap that cells push each other out of at once [µm]

/// Why no step size works: cell, law and time. Collective.
Error refused(const Model& model, const Tissue& tissue, const StepFault& here, double dt, const Comm& comm) {
  const StepFault fault = worst_of_all_ranks(here, comm);
  const Clock& clock = tissue.clock;
  const bool spheres = comm.any(tissue.spheres.size() > 0), shells = comm.any(tissue.shells.size() > 0);
  const bool both_bodies = model.swaps.any() || (spheres && shells);
  char when[64];
  const bool early = clock.time < 3600.0;  // seconds say more than 2.981e-05 h
  std::snprintf(when, sizeof when, early ? " at %.4g s" : " at %.6g h", early ? clock.time : clock.time / 3600.0);
  const std::string message = fault.what + (fault.cell.valid() ? " (cell " + fault.cell.text() + ")" : "") + when;
  if (!fault.smaller_step_may_help && model.step.integrator == Integrator::kImplicit)
    return {ErrorKind::kPhysics, message,
            "no step is short enough for this: with the laws of the program it is a fault of the program, which this study and its last "
            "checkpoint show; else one of a law that was added"};
  return {ErrorKind::kPhysics, message,
          "the step was cut to " + std::to_string(dt) + " s without success; " +
              (clock.capped && model.step.start_cap > 0.0 ? "`numerics: {start_cap: auto}` or a smaller cap, "
               : model.limits.overlap > kDeep             ? "`numerics: {start_cap: auto}` where cells begin deep in each other, "
                                                          : "") +
              (model.loads.empty() ? "" : "smaller loads, or loads that grow slowly (`course`), ") +
              (both_bodies && std::ranges::any_of(model.types, is_fluid)
                   ? "an elastic cortex (`elastic: springs`) where shells are pressed among spheres, "
                   : "") +
              (std::ranges::any_of(model.types, [](const CellType& type) { return type.self_contact == 0.0; })
                   ? "`self_contact: auto` where cells are pressed thin, "
                   : "") +
              "weaker adhesion, more tension, a larger `shape_stiffness` or `fold_barrier`, "
              "or another number of nodes may help"};
}

/// The step after one of dt: towards the allowed displacement, more slowly where Newton had to work. `wanted`: the step that the controller had
/// wanted, if dt was only cut to land somewhere; else 0.
double next_step(const StepControl& control, double range, const StepReport& done, double dt, double wanted) {
  if (control.integrator == Integrator::kExplicitEuler) return control.max_step;
  const double allowed = control.max_displacement * range;
  double factor = std::min(kGrowthOfStep, 0.9 * allowed / std::max(done.way, 1e-12));
  // At rest on a kink of the contact energy every search is short, whatever the step: a smaller one would only stop the clock.
  const bool moving = done.way > kAtRest * allowed;
  if (done.halvings > 3 && moving) factor = std::min(factor, 0.5);
  return std::max(std::min(control.max_step, dt * std::max(factor, 0.2)), std::min(wanted, control.max_step));
}

/// Speed of the fastest cell as a whole in the last step [µm/s]: of a shell, the mean of its nodes. Collective.
double fastest_cell(const Tissue& tissue, const Comm& comm, int threads) {
  const std::size_t shells = tissue.shells.size();
  const double fastest = parallel_max(threads, shells + tissue.spheres.size(), [&](std::size_t b) {
    if (b >= shells) return norm2(to_double(tissue.spheres.velocity[b - shells]));
    const std::uint32_t first = tissue.shells.first_node[b], last = tissue.shells.first_node[b + 1];
    Vec3d sum{};
    for (std::uint32_t i = first; i < last; ++i) sum += to_double(tissue.shells.velocity[i]);
    return norm2(sum * (1.0 / (last - first)));
  });
  return std::sqrt(comm.max(fastest));
}

}  // namespace

Result<StepOutcome> Simulation::step(double land_on, const std::function<bool()>& give_up) {
  if (!(land_on > tissue_.clock.time))
    return Error{ErrorKind::kInput,
                 "a step cannot end at " + std::to_string(land_on) + " s: it is " + std::to_string(tissue_.clock.time) + " s already",
                 "a later time"};
  const StepPlan plan = plan_step(land_on);
  if (!give_up || plan.due_fields.empty()) return whole_step(plan, {});
  Tissue before = tissue_;  // small beside the workspaces of a step
  auto done = whole_step(plan, give_up);
  if (!done.ok() && done.error().kind == ErrorKind::kStoppedEarly) {
    tissue_ = std::move(before);
    mechanics_->bodies_changed();
  }
  return done;
}

Simulation::StepPlan Simulation::plan_step(double land_on) const {
  StepPlan plan;
  const Clock& clock = tissue_.clock;
  constexpr double kSameTime = 1e-12;  // a corner and an output that differ by rounding are one moment
  const double corner = next_corner(model_, clock.time * (1.0 + kSameTime));
  plan.land_on = corner < land_on * (1.0 - kSameTime) ? corner : land_on;
  double wanted = std::min(
      {clock.next_step, model_.step.max_step, longest_step_of_box(plan.land_on), longest_step_of_forces(model_, clock.time, plan.land_on)});
  const double until = std::min(clock.time + wanted, plan.land_on);
  wanted = std::min(wanted, longest_step_of_obstacles(model_, tissue_, mechanics_->obstacles(), until, threads_, comm_));
  plan.dt = fit_step(wanted, clock.time, plan.land_on);
  const double end = end_of_step(plan.dt, clock.time, plan.land_on);
  for (std::size_t f = 0; f < tissue_.fields.size(); ++f)
    if (end == plan.land_on || fields::is_due(tissue_.fields[f], end)) plan.due_fields.push_back(f);
  return plan;
}

Result<StepOutcome> Simulation::whole_step(const StepPlan& plan, const std::function<bool()>& give_up) {
  StepOutcome outcome;
  Clock& clock = tissue_.clock;
  before_step_.keep(tissue_);
  const double land_on = plan.land_on;
  double dt = plan.dt;
  const bool wanted_less = dt < clock.next_step;
  LifeReport life;
  std::optional<BodiesNow> bodies;
  if (look_at_bodies(model_.types)) bodies = BodiesNow{values(), centers()};
  std::vector<SensedField> sensed;
  if (any_senses_a_field(model_.types)) {
    MORULA_TRY_ASSIGN(sensed, sense_fields(model_, tissue_, centers(), comm_));
  }
  {
    auto timed = timer().scope(Stage::kBehaviours);
    look_into_lumens(model_, mechanics_->obstacles(), tissue_, comm_);
  }

  for (;; ++outcome.retries) {
    {  // behaviours: growth, cycle, death, migration
      auto timed = timer().scope(Stage::kBehaviours);
      life = live(tissue_.cells, model_.types, {model_.seed, clock.steps, clock.time + dt, dt, bodies ? &*bodies : nullptr, sensed});
      set_bodies_to_targets(dt);
    }
    carry_to(end_of_step(dt, clock.time, land_on));
    // mechanics: ghosts, candidates, contacts, forces, system, solve, advance
    const auto moved =
        mechanics_->step(tissue_, dt, external_forces(clock.time + dt, life.walk), grip_anchors(model_, tissue_, clock.time + dt));
    if (moved) {
      outcome.mechanics = *moved;
      break;
    }
    before_step_.restore(tissue_);
    carry_to(clock.time);
    mechanics_->parameters_changed();
    if (!moved.error().smaller_step_may_help || dt * 0.25 < kSmallestStep) return refused(model_, tissue_, moved.error(), dt, comm_);
    dt *= outcome.retries < 2 ? 0.5 : 0.25;
  }
  tissue_.ledger.drift += outcome.mechanics.motion.drift;
  tissue_.ledger.rotation += outcome.mechanics.motion.rotation;
  tissue_.ledger.way += outcome.mechanics.motion.way;
  clock.time = end_of_step(dt, clock.time, land_on);
  ++clock.steps;
  const double wanted = wanted_less && outcome.retries == 0 ? clock.next_step : 0.0;
  clock.next_step = next_step(model_.step, model_.contact.range, outcome.mechanics, dt, wanted);
  MORULA_TRY(after_mechanics(plan, dt, life, give_up, outcome));
  return outcome;
}

Status Simulation::after_mechanics(const StepPlan& plan, double dt, const LifeReport& life, const std::function<bool()>& give_up,
                                   StepOutcome& outcome) {
  wrap_cells();
  dcm::turn_over(tissue_.shells, mechanics_->shell_materials(), dt);
  dcm::turn_over(tissue_.nuclei.shells, mechanics_->nucleus_materials(), dt);
  average_pressures(dt);
  turn_polarities(tissue_.clock.steps - 1, dt);
  renew_faces(dt);
  renew_meshes(outcome.events);
  if (!tissue_.fields.empty()) {
    const double way = fastest_cell(tissue_, comm_, threads_) * dt;
    for (fields::Field& field : tissue_.fields) field.way += way;
  }
  MORULA_TRY(advance_fields(plan.due_fields, give_up, outcome));
  {
    auto timed = timer().scope(Stage::kBehaviours);
    MORULA_TRY(divide_and_remove(life, outcome.events));
  }
  const std::vector<Event> swapped = swap_bodies();
  outcome.events.insert(outcome.events.end(), swapped.begin(), swapped.end());
  tell_settled_exchanges(outcome.events);
  outcome.events = all_events(std::move(outcome.events));
  if (tissue_.clock.steps % kReorderEvery == 0) {
    renew_order(tissue_);
    mechanics_->bodies_changed();
    if (imbalance() > kTolerableImbalance) distribute();
  }
  return {};
}

}  // namespace morula
