#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/friction/friction_system.h"
#include "core/mesh/surface_geometry.h"
#include "core/parallel/comm.h"
#include "core/parallel/order_free_sum.h"
#include "coupling/mechanics/noise.h"
#include "coupling/mechanics/outside_balance.h"
#include "coupling/mechanics/scene.h"
#include "coupling/mechanics/step_report.h"
#include "coupling/model.h"
#include "coupling/stage_timer.h"
#include "coupling/tissue.h"

namespace morula {

/// What a term sees: the numbers of the study, the tissue, and the points of the rank where a search for the step's end has them.
///
/// During a step the tissue is that of the step's start, apart from what grows with time, which is set before the step begins.
struct World {
  const Model& model;
  const Tissue& tissue;
  const Scene& scene;               ///< bodies, ghosts too, and the present positions of all points
  const SurfaceGeometry& geometry;  ///< of the shells at these positions: areas and normals of nodes, volumes
  const Comm& comm;
  int threads = 1;    ///< of this rank
  double time = 0.0;  ///< what is prescribed over time is that of this time: the end of the step, or the present [s]

  [[nodiscard]] std::span<const Vec3d> position() const { return scene.position(); }
};

/// The way of all points from the start of a step to the present positions.
struct Way {
  std::span<const Vec3d> start, position;  ///< by point [µm]
  bool moved = true;                       ///< false: the points are still at the start; obstacles may have moved all the same
};

/// Forces by point, and the energies that they come from.
struct Forces {
  std::span<Vec3d> force;  ///< [nN]
  OrderFreeSum energy;     ///< of this rank [fJ]
};

/// What is found when a step begins and holds until its end, beside what terms keep for themselves.
struct StepStart {
  std::span<float> point_friction;  ///< with the medium, of the bodies of one point and of nuclei, from Scene::sphere_point() on [nN·s/µm]
  std::span<Float4> velocity;       ///< where the first linear solve starts, by point; the shells' and spheres' last velocities [µm/s]
};

/// The tissue at the end of a step, which is still that of its start where no term writes.
struct StepEnd {
  Tissue& tissue;
  bool clock_runs = true;  ///< false: cells settle while the time stands still, and nobody attaches or parts
};

/// What terms give to the matrix at some positions where another part applies it together with its own.
struct Assembly {
  std::vector<SymMat3<double>> node_block;  ///< Γ + Δt K of single nodes of owned shells, or empty: none [nN·s/µm]
  std::span<const double> face_energy;      ///< ∂E/∂A by face of owned shells beside the shells' own laws, or empty: none [nN/µm]
  std::vector<ElementGroup> contacts;       ///< of surfaces
};

/// Something that acts on points. The step knows nothing else (coupling/mechanics/terms.h has the list, decision 0034).
///
/// A term has an energy E, friction Γ that is frozen while a step goes on, and a positive semi-definite stiffness K̃ near ∂²E/∂x²; a step
/// finds the lowest E(x) − f·d + dᵀΓd/(2Δt) by Newton's method with the matrix Γ + Δt K̃ (time_stepping.md §8). What a term does not have,
/// it leaves out. A virtual call stands for a whole term: loops over elements, lanes and threads lie within.
///
/// The order of calls: bodies_changed() or bodies_replaced(), then for each evaluation parameters_changed() if anything has, measure(), evaluate(); in a step
/// begin_step(), then add_friction() after every evaluation, assemble() and products, and at last end_step() or abandon_step().
class Term : public AddedPart {
 public:
  /// Bodies have come or gone, or ghosts were renewed: make the lists anew. Collective.
  virtual void bodies_changed(const World&) {}
  /// The same where most bodies stay what and where they were: lists may be mended. Between steps. Collective.
  virtual void bodies_replaced(const World& world, const BodyChanges&) { bodies_changed(world); }
  /// Numbers of the tissue that shape the energy (radii, rest lengths, the time) may have changed. Collective.
  virtual void parameters_changed(const World&) {}
  /// Whether the energy depends on the time itself.
  [[nodiscard]] virtual bool varies_with_time() const { return false; }

  /// Before any term adds forces: what other terms ask of this one at the present positions. Collective.
  virtual void measure(const World&) {}
  /// Adds −∂E/∂x of owned points, and E.
  virtual void evaluate(const World&, Forces&) {}
  /// What makes the present positions impossible; after evaluate().
  [[nodiscard]] virtual std::optional<StepFault> fault(const World&) const { return std::nullopt; }
  /// A cell whose surface has passed through another on the way from `start`, if there is one; after evaluate().
  [[nodiscard]] virtual std::optional<CellId> crossed(const World&, std::span<const Vec3d> /*start*/) const { return std::nullopt; }

  /// A step begins at the present positions: freeze the friction, Γ = Σ G Gᵀ.
  virtual void begin_step(const World&, StepStart&) {}
  /// Adds Γ d of the owned points to `out` [nN·s], and dᵀΓd to the sum.
  virtual void add_friction(const World&, const Way&, std::span<Vec3d> /*out*/, OrderFreeSum& /*quadratic*/) {}
  /// Adds the random forces that belong to this friction, from its factors G, to all points that it acts on: only those of owned points count
  /// [nN]. After begin_step(); obstacles are where they were then.
  virtual void add_noise(const World&, const Noise&, std::span<Vec3d> /*force*/) const {}
  /// Adds −Δt times the forces of what stands outside of the tissue to `out` [nN·s], and what it has given since the start to the sum [fJ].
  virtual void add_outside(const Way&, double /*dt*/, std::span<Vec3d> /*out*/, OrderFreeSum& /*work*/) {}
  /// Adds, for each of its parts, the owned bodies that do forces upon each other though no contact is between them. As many lists on every rank.
  virtual void add_joined(const World&, std::vector<std::vector<std::uint32_t>>& /*bodies*/) const {}
  /// The step has come to its end: what it leaves in the tissue beside positions. Collective.
  virtual void end_step(const World&, StepEnd&) {}
  /// The step was taken back.
  virtual void abandon_step() {}

  /// The part of Γ + Δt K̃ at the present positions, for the products below or into `out`; until drop_matrix().
  virtual void assemble(const World&, double /*dt*/, Assembly& /*out*/) {}
  virtual void drop_matrix() {}
  /// Takes what the matrix of something outside of the tissue does at these velocities by point from what is missing, by body, and adds its resistance
  /// to a common motion; of active bodies.
  virtual void add_outside_balance(std::span<const Float4> /*velocity*/, std::span<OutsideBalance> /*by_body*/) const {}
  [[nodiscard]] bool empty() const override { return true; }
  void add_product(std::span<const Float4>, std::span<Float4>) const override {}
  void add_diagonal(std::span<SymMat3<float>>) const override {}

  [[nodiscard]] virtual std::size_t memory() const { return 0; }          ///< of workspaces [bytes]
  [[nodiscard]] virtual Stage stage() const { return Stage::kInternal; }  ///< to which the time of evaluate() is counted
};

}  // namespace morula
