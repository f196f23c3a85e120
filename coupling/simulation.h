#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/parallel/partition.h"
#include "coupling/balance.h"
#include "coupling/before_step.h"
#include "coupling/events.h"
#include "coupling/mechanics/mechanics.h"
#include "coupling/model.h"
#include "coupling/tissue.h"
#include "fields/field_solver.h"

namespace morula {

struct CellRecord;

/// What one step did.
struct StepOutcome {
  StepReport mechanics;
  int retries = 0;                             ///< steps that were refused and tried again, smaller
  std::vector<Event> events;                   ///< of all ranks, in the order (time, kind, cell)
  std::vector<fields::IntervalReport> fields;  ///< of those that were integrated
};

/// A tissue that runs: its state, its model, and the workspaces. One step is Simulation::step (coupling/pipeline.cpp).
class Simulation {
 public:
  /// Takes the tissue over: distributes it over the ranks and makes the workspaces. Errors: an obstacle that is no closed surface.
  static Result<std::unique_ptr<Simulation>> create(Model model, Tissue tissue, const Comm& comm, int threads);

  /// One step, not beyond `land_on` [s], which is yet to come (else kInput); lands there exactly when it is near. kPhysics when no step size works: the message names cell, law
  /// and time; the tissue is that before the step. A step may be broken off between two steps of the integration of a field, which can take
  /// long: `give_up` is asked there, by all ranks together, and true is kStoppedEarly with the tissue as it was before the step. Collective.
  Result<StepOutcome> step(double land_on, const std::function<bool()>& give_up = {});

  /// Swaps that regions and triggers ask for at the very beginning; then spheres that touch adhere. Collective.
  Result<std::vector<Event>> first_swaps();

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const Tissue& tissue() const { return tissue_; }
  [[nodiscard]] const Comm& comm() const { return comm_; }
  [[nodiscard]] Mechanics& mechanics() { return *mechanics_; }
  [[nodiscard]] StageTimer& timer() { return mechanics_->timer(); }
  [[nodiscard]] BodyValues values() { return mechanics_->values(tissue_); }
  [[nodiscard]] std::vector<Vec3d> centers() const;  ///< of the cells, by row
  /// What will still happen by itself if nothing moves any more (coupling/still_to_come.h). Collective.
  [[nodiscard]] std::vector<std::string> still_to_come() const;
  [[nodiscard]] double imbalance() const { return morula::imbalance(tissue_, comm_); }

 private:
  Simulation(Model model, Tissue tissue, const Comm& comm, int threads);
  /// The box of a time, and all places with it (coupling/changing_box.h).
  void carry_to(double time);
  /// Longest step that the box allows for from now on, which ends at `until` at the latest [s]. Collective where the box changes.
  [[nodiscard]] double longest_step_of_box(double until) const;
  /// What is known of a step before it begins.
  struct StepPlan {
    double land_on = 0.0;                 ///< the study's moment, or the next corner of what is prescribed over time [s]
    double dt = 0.0;                      ///< wanted; the mechanics may shorten it [s]
    std::vector<std::size_t> due_fields;  ///< to be integrated after it
  };
  [[nodiscard]] StepPlan plan_step(double land_on) const;
  Result<StepOutcome> whole_step(const StepPlan& plan, const std::function<bool()>& give_up);
  /// What follows when the cells have moved for dt: the surfaces, the fields that are due, what life asks for, exchanges of bodies. Collective.
  Status after_mechanics(const StepPlan& plan, double dt, const struct LifeReport& life, const std::function<bool()>& give_up,
                         StepOutcome& outcome);
  void distribute();
  void set_bodies_to_targets(double dt);
  [[nodiscard]] std::vector<Vec3d> forces_on_cells(double time);
  /// Migration and external loads at a time, by shell node, then by sphere. Implicit in time, explicit in shape: strengths are those of the
  /// step's end, directions and areas those of its start, and the step holds them as dead loads.
  [[nodiscard]] std::vector<Vec3d> external_forces(double time, std::span<const Vec3d> walk);
  /// Forces of the migrating cells, by shell node, then by sphere.
  void add_crawling(std::span<const Vec3d> walk, std::span<Vec3d> external);
  /// Protrusions of the shells, by shell node.
  void add_protrusions(std::span<Vec3d> external);
  /// Polarities after the step with this number.
  void turn_polarities(std::uint64_t step, double dt);
  void average_pressures(double dt);
  /// After a step: marks that follow their cells, the eased contact of the faces, the lumens.
  void renew_faces(double dt);
  void renew_lumens(double dt);
  /// The cells as fields see them, at the present positions.
  [[nodiscard]] std::vector<fields::CellSource> field_sources() const;
  /// Those of a plan, up to the present; the others wait (fields/interval_control.h).
  Status advance_fields(std::span<const std::size_t> due, const std::function<bool()>& give_up, StepOutcome& outcome);
  /// Cells become shells or spheres as regions and triggers ask for (coupling/exchange.cpp). Collective.
  std::vector<Event> swap_bodies();
  /// After a step: what became of the neighbours of the cells that exchanged their bodies a while ago. Collective.
  void tell_settled_exchanges(std::vector<Event>& events);
  /// Shells with a face of too little quality get an even mesh on the same surface (coupling/mesh_renewal.cpp). Collective.
  void renew_meshes(std::vector<Event>& events);
  /// What a step of life has asked for (coupling/divisions.cpp): daughters in place of mothers, and dead cells gone. Collective.
  Status divide_and_remove(const struct LifeReport& life, std::vector<Event>& events);
  /// The daughters of cut shells settle; those that would still begin so deep within others that the run might stop are taken back, and their mothers put
  /// off: gives how many of this rank. Collective.
  std::int64_t settle_cuts(std::span<const CellRecord> mothers, std::vector<Event>& events);
  /// Partners of a mother become partners of her daughters, also on other ranks. `events` are those of this rank. Collective.
  void rename_partners(const std::vector<Event>& events);
  void wrap_cells();
  [[nodiscard]] std::vector<Event> all_events(std::vector<Event> mine) const;

  Model model_;
  Box box_of_study_;
  Tissue tissue_;
  Comm comm_;
  int threads_;
  ShapeLibrary shapes_;
  Partition partition_;
  std::unique_ptr<Mechanics> mechanics_;
  fields::FieldSolver field_solver_;
  BeforeStep before_step_;
};

}  // namespace morula
