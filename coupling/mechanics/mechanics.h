#pragma once
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/contact/contact_layer.h"
#include "core/friction/friction_system.h"
#include "core/mesh/topology.h"
#include "core/parallel/comm.h"
#include "core/parallel/threads.h"
#include "coupling/grips.h"
#include "coupling/mechanics/face_tensions.h"
#include "coupling/mechanics/free_clusters.h"
#include "coupling/mechanics/held_nodes.h"
#include "coupling/mechanics/interior_system.h"
#include "coupling/mechanics/node_terms.h"
#include "coupling/mechanics/nucleus_system.h"
#include "coupling/mechanics/scene.h"
#include "coupling/mechanics/shell_system.h"
#include "coupling/mechanics/sphere_contacts.h"
#include "coupling/model.h"
#include "coupling/stage_timer.h"
#include "coupling/tissue.h"

namespace morula {

/// Why a step could not be done as asked.
struct StepFault {
  std::string what;
  CellId cell;  ///< where, if known
  bool smaller_step_may_help = true;
};

/// How a tissue moved as a whole in a step, every point weighted by its friction with the medium. Forces between cells leave drift and
/// rotation as they are, but for friction between cells, which turns them where it feels common rotations (core/contact/objective_friction.h).
struct TissueMotion {
  Vec3d drift;     ///< Σ γ d/Σ γ [µm]
  Vec3d rotation;  ///< θ with (Σ γ (|r|² I − r rᵀ)) θ = Σ r × γ d, r from the centre Σ γ x/Σ γ [rad]; 0 in periodic domains
  double way = 0.0;  ///< Σ γ |d|/Σ γ [µm]
};

struct StepReport {
  double step = 0.0;  ///< done [s]
  int newton = 0;     ///< iterations
  int linear_iterations = 0;
  int halvings = 0;           ///< of the way that a search took, at most
  double displacement = 0.0;  ///< largest of any point [µm]
  double energy = 0.0;        ///< at the end [nN·µm]
  double allowed_rise = 0.0;  ///< rise of Φ that the freeze rule let pass [nN·µm]
  double overlap = 0.0;       ///< deepest penetration of a surface [µm]
  int crossings = 0;          ///< searches cut short because a surface of this rank would have passed through another
  TissueMotion motion;
};

/// What mechanics knows of each cell at the present positions, in the order of the rank's bodies (shells, then spheres).
struct BodyValues {
  std::vector<double> volume;  ///< [µm³]
  std::vector<double> area;    ///< [µm²]
  /// What the cell bears from outside, σ = (1/V) Σ_k (x_k − x) ⊗ f_k over the forces that neighbours, obstacles, walls and loads exert on it
  /// (fields_and_coupling.md, D; decision 0023); symmetric part, tension positive [kPa].
  std::vector<SymMat3<double>> stress;
  std::vector<double> pressure;        ///< −tr σ/3, of shells and spheres alike [kPa]
  std::vector<double> inner_pressure;  ///< shells: −K_V ln(V/V0), which bears the cortex, too; spheres, which have none: the pressure [kPa]
  std::vector<double> contact_area;    ///< [µm²]
};

/// How a body touches a material.
struct Touch {
  double area = 0.0;  ///< [µm²]
  Vec3d normal{};     ///< of the contact, of length 1; its sign has no meaning
};

/// The mechanics of a tissue: forces, energies and the implicit step over shells and spheres together (time_stepping.md §1, §8, §9).
///
/// A workspace: everything in it can be rebuilt from the Tissue, and rebuilding it never changes a result.
class Mechanics {
 public:
  Mechanics(const Model& model, std::vector<RigidSurface> obstacles, ShapeLibrary& shapes, Comm comm, int threads);

  /// Cells were added, removed, moved between ranks, or changed their body: everything is collected again at the next use.
  void bodies_changed() { scene_valid_ = false; }
  /// Numbers that shape the forces (reference volumes, rest lengths, radii) were changed; positions were not.
  void parameters_changed() { evaluated_ = false; }

  /// One step of length dt under the given external forces (owned shell nodes, then owned spheres) [nN]. On success the tissue holds
  /// the new positions and velocities; on a fault it is unchanged. Collective.
  /// `anchors`: springs on owned shell nodes, held implicitly at their places of the step's end.
  Result<StepReport, StepFault> step(Tissue& tissue, double dt, std::span<const Vec3d> external, std::span<const Anchor> anchors = {});

  /// Forces on whole cells (by owned body: shells, then spheres) as `external`: on a shell spread over its nodes by their area (dcm.md §11).
  std::vector<Vec3d> spread(const Tissue& tissue, std::span<const Vec3d> by_body);

  /// Let the owned bodies with moves[body] != 0 find their shape between all others, which are held in place (fields_and_coupling.md, D). First
  /// they are let out of overlap: no adhesion and no friction, a traction capped at a value that grows from 0.1 kPa to 10 kPa. Then adhesion and
  /// friction come in, and they settle. The clock stands still; where overlap is left (no room), the capped start is on when it goes on.
  /// Collective; ranks without such bodies take part.
  Status relax(Tissue& tissue, std::span<const char> moves);

  /// Which owned cells touch which of `these` (sorted), or are one of `these` and touch whom: pairs (owned cell, partner) with contact area in the
  /// surface contacts at the tissue's positions, sorted. An obstacle is the partner CellId(number + 1). Collective.
  std::vector<std::pair<CellId, CellId>> touching(const Tissue& tissue, std::span<const CellId> these);

  /// Which part of every owned face (in the order of the shells) is in contact with cells or obstacles of the materials with
  /// with_material[material] != 0, at the tissue's positions; 0 to 1, with the taper of contact friction at the rim. Collective.
  std::vector<float> contact_of_faces(const Tissue& tissue, std::span<const char> with_material);

  /// How every owned body (shells, then spheres) touches the materials with with_material[material] != 0; spheres: obstacles only. Collective.
  std::vector<Touch> touch_of_bodies(const Tissue& tissue, std::span<const char> with_material);

  /// Adds to `external` the forces that move every owned body with a velocity (shells, then spheres) [µm/s] against all friction with what is no
  /// cell: Γ v on each point, Γ its friction with the medium and that of its contacts with obstacles, along their surface. A body that touches no
  /// other cell moves so as a whole, without turning (cbm.md §1, rigid co-motion); what friction with neighbours takes is not made up for.
  /// Collective.
  void add_crawling(const Tissue& tissue, std::span<const Vec3d> velocity, std::span<Vec3d> external);

  /// Random forces of a step of dt [s] on all owned points, added to `external` [nN]: ⟨f fᵀ⟩ = (2 k_B T/Δt) Γ with the friction Γ of the
  /// tissue's positions, element by element (dcm.md §10), so that what acts between points has no net force. Between two types
  /// k_B T is the mean of theirs. Random numbers are those of (cell, step, element). Collective.
  void add_fluctuations(const Tissue& tissue, double dt, std::span<Vec3d> external);

  /// Spheres that touch adhere from the beginning: their flags at the tissue's positions, before anything is told of them. Collective.
  void attach(Tissue& tissue);

  /// What mechanics knows of each cell at the tissue's present positions and time. Collective.
  BodyValues values(const Tissue& tissue);
  /// The pressures alone.
  std::vector<double> pressures(const Tissue& tissue);

  /// Force of all cells on each obstacle, friction left out [nN]. Collective; the same on every rank.
  std::vector<Vec3d> obstacle_forces(const Tissue& tissue);

  /// Contacts of spheres that this rank counts, and those beyond the range of their law. After values(), pressures() or a step.
  [[nodiscard]] SphereContacts::RangeCount contacts_beyond_range() const { return spheres_.count_beyond_range(scene_, contacts_); }

  /// How tightly the owned spheres are packed, φ (cbm.md §3); 0 where no type has a pressure of packing. After values(), pressures() or a step.
  [[nodiscard]] std::vector<double> packing() const;

  /// Number of external force entries for this tissue: owned shell nodes, then owned spheres.
  [[nodiscard]] static std::size_t external_size(const Tissue& tissue) { return tissue.shells.node_count() + tissue.spheres.size(); }

  /// Energy and forces at the tissue's positions, for tests: forces in the order of `external`.
  double energy_and_forces(const Tissue& tissue, std::vector<Vec3d>& force);

  /// Parameters of the single-cell mechanics by cell type.
  [[nodiscard]] std::span<const dcm::ShellParameters> shell_parameters() const { return shells_.parameters(); }
  /// The same of nuclei that are shells.
  [[nodiscard]] std::span<const dcm::ShellParameters> nucleus_parameters() const { return nuclei_.parameters(); }
  [[nodiscard]] StageTimer& timer() { return timer_; }
  [[nodiscard]] const ContactLayer& contacts() const { return contacts_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  /// What the rigid nucleus of an owned shell feels at the present positions.
  [[nodiscard]] dcm::InteriorEnergy interior_of(std::uint32_t shell) const { return interior_.of_shell(shell); }
  /// How the nucleus of an owned shell stands at the present positions, if it is a shell.
  [[nodiscard]] std::optional<NucleusState> nucleus_of(std::uint32_t shell) const { return nuclei_.of_shell(shell); }
  /// Forces on the nodes of the nuclei that are shells, in their order, as energy_and_forces() found them.
  [[nodiscard]] std::span<const Vec3d> forces_on_nuclei() const { return std::span(force_).subspan(scene_.nuclear_node()); }
  [[nodiscard]] double deepest_overlap() const;
  /// Bytes of all workspaces of this rank: the most at any time of the last step.
  [[nodiscard]] std::size_t memory() const { return std::max(most_bytes_, bytes_now()); }

 private:
  struct Trial;  // a point of the line search
  void prepare(const Tissue& tissue);
  /// As prepare(), and friction is that of the tissue's positions: that of the step which begins there.
  void prepare_step(const Tissue& tissue);
  /// Energy and forces at the scene's positions; `moved`: positions differ from those of the last call.
  void evaluate(const Tissue& tissue, bool moved = true);
  /// Back to the step's start after a fault.
  StepFault undo(std::span<const Vec3d> start, StepFault fault);
  [[nodiscard]] std::size_t bytes_now() const;
  void note_memory() { most_bytes_ = std::max(most_bytes_, bytes_now()); }
  /// Everything at the tissue's positions and time, as values() tells it.
  void look(const Tissue& tissue);
  [[nodiscard]] std::vector<SymMat3<double>> stresses_of_shells(const Tissue& tissue) const;
  [[nodiscard]] std::vector<double> pressures_from(const Tissue& tissue, std::span<const SymMat3<double>> of_shells,
                                                   std::span<const SphereTouch> touches) const;
  /// Pressures of the spheres by their packing, for all that press on them.
  void find_packing(const ContactScene& scene, bool with_surfaces);
  void begin_step(const Tissue& tissue, double dt);
  void hold_all_but(std::span<const char> moves);
  void find_clusters(const Tissue& tissue, std::span<const ElementGroup> groups);
  void add_shell_noise(const Tissue& tissue, double dt, std::span<Vec3d> external) const;
  void add_sphere_noise(const Tissue& tissue, double dt, std::span<Vec3d> external) const;
  void add_contact_noise(const Tissue& tissue, double dt, std::span<Vec3d> external) const;
  void lay_out_system();
  /// `moved`: false at the step's start, where nothing has rubbed yet but obstacles that move.
  [[nodiscard]] double friction_residual(std::span<const Vec3d> start, std::span<const Vec3d> external, double dt, bool moved = true);
  /// The residual becomes the right side of the system.
  void give_residual();
  /// After a linear solve: give every cluster that is free of the outside the common velocity that it lacks (FreeClusters).
  void conserve_momentum();
  /// Way of the tissue as a whole from the tissue's positions, at the start of the step, to the scene's. Collective.
  [[nodiscard]] TissueMotion common_motion(const Tissue& tissue) const;
  struct Direction;
  /// Hold the nodes that a full step along `direction` took over a kink: its residual, in force_, drives them back. Says whether there are any.
  bool hold_driven_back(const Direction& direction);
  [[nodiscard]] std::optional<StepFault> find_fault() const;
  Result<StepReport, StepFault> implicit_step(Tissue& tissue, double dt, std::span<const Vec3d> external);
  Result<StepReport, StepFault> explicit_step(Tissue& tissue, double dt, std::span<const Vec3d> external);
  /// The matrix, in the place of what only forces need: after this, the next evaluate() is one with `moved`.
  void assemble(const Tissue& tissue, double dt);
  void drop_matrix();
  void finish(Tissue& tissue, double dt, StepReport& report);
  [[nodiscard]] ContactScene contact_scene() const;
  /// Where the external force of an owned point is; nuclei have none.
  [[nodiscard]] Vec3d external_on(std::span<const Vec3d> external, std::uint32_t point) const {
    if (point >= scene_.nucleus_point()) return {};
    return external[point < scene_.owned_nodes() ? point : point - scene_.sphere_point() + scene_.owned_nodes()];
  }
  /// `function(point)` for the nuclei of shells that move, and for the nodes of those that are shells.
  template <class F>
  void for_nuclei(F&& function) const {
    for (const InteriorSystem::Nucleus& nucleus : interior_.nuclei())
      if (scene_.bodies()[nucleus.shell].active()) function(nucleus.point);
    nuclei_.for_points(function);
  }
  /// `function(thread, body)` for the bodies that are active; neighbours go to one thread.
  template <class F>
  void for_active_bodies(F&& function) const {
    const auto bodies = scene_.bodies();
    const auto threads = static_cast<std::size_t>(threads_);
    on_each_thread(threads_, [&](std::size_t t) {
      for (std::size_t k = bodies.size() * t / threads; k < bodies.size() * (t + 1) / threads; ++k)
        if (bodies[k].active()) function(t, bodies[k]);
    });
  }
  template <class F>
  void for_owned_points(F&& function) const {
    for_nuclei(function);
    for_active_bodies([&](std::size_t, const ContactBody& body) {
      for (std::uint32_t i = body.first_point; i < body.first_point + body.point_count; ++i) function(i);
    });
  }
  /// Largest norm of vector(point) over owned points; not a number wins.
  template <class Vector>
  [[nodiscard]] double largest_of(const Vector& vector) const {
    const auto more = [](double here, double most) { return !(here <= most) && !std::isnan(most); };
    std::vector<double> by_thread(static_cast<std::size_t>(threads_), 0.0);
    for_active_bodies([&](std::size_t t, const ContactBody& body) {
      double most = by_thread[t];
      for (std::uint32_t i = body.first_point; i < body.first_point + body.point_count; ++i)
        if (const double here = norm2(vector(i)); more(here, most)) most = here;
      by_thread[t] = most;
    });
    double most = 0.0;
    for (const double here : by_thread)
      if (more(here, most)) most = here;
    for_nuclei([&](std::uint32_t i) { most = std::max(most, norm2(vector(i))); });
    return std::sqrt(comm_.max(most));
  }
  template <class Vectors>
  [[nodiscard]] double largest(const Vectors& by_point) const {
    return largest_of([&](std::uint32_t i) { return by_point[i]; });
  }
  /// Largest way from `start` [µm].
  [[nodiscard]] double furthest(std::span<const Vec3d> start) const {
    return largest_of([&](std::uint32_t i) { return scene_.position()[i] - start[i]; });
  }
  template <class Vectors>
  [[nodiscard]] double dot(const std::vector<Vec3d>& a, const Vectors& b) const {
    std::vector<OrderFreeSum> sums(static_cast<std::size_t>(threads_));
    for_active_bodies([&](std::size_t t, const ContactBody& body) {
      double part = 0.0;
      for (std::uint32_t i = body.first_point; i < body.first_point + body.point_count; ++i) part += morula::dot(a[i], b[i]);
      sums[t].add(part);
    });
    for (std::size_t t = 1; t < sums.size(); ++t) sums[0] += sums[t];
    for_nuclei([&](std::uint32_t i) { sums[0].add(morula::dot(a[i], b[i])); });
    return comm_.sum(sums[0]);
  }

  const Model& model_;
  ShapeLibrary& shapes_;
  Comm comm_;
  int threads_;
  StageTimer timer_;

  Scene scene_;
  bool scene_valid_ = false;
  bool has_regional_adhesion_ = false;
  bool renew_soon_ = false;         ///< the next evaluation for new parameters is a good time to renew ghosts and pairs
  double wear_ = 0.0;               ///< of the list of pairs, at the end of the last step
  bool evaluated_ = false;          ///< energy and forces belong to the scene's positions and the tissue's parameters
  double relax_cap_ = 0.0;          ///< δ while cells relax in place [µm]
  double relax_depth_ = 0.0;        ///< overlap that is seen meanwhile [µm]
  double relax_hold_ = 1.0;         ///< part of adhesion and contact friction that acts meanwhile
  bool relaxing_ = false;           ///< obstacles and flags stand still
  bool flags_changed_ = false;      ///< spheres attached or parted at the end of the last step: forces are to be found anew
  std::vector<char> relax_moves_;   ///< which owned bodies move meanwhile
  bool contacts_current_ = false;   ///< geometry and surface contacts belong to the scene's positions
  std::vector<Vec3d> scene_start_;  ///< owned positions when the ghosts were found
  ContactLayer contacts_;
  ContactGradient gradient_;       ///< of all contacts of surfaces
  ContactGradient surfaces_only_;  ///< without the pairs with a sphere; kept only where there are any
  SurfaceGeometry geometry_;
  ShellSystem shells_;
  InteriorSystem interior_;
  NucleusSystem nuclei_;
  SphereContacts spheres_;
  FaceTensions face_tensions_;
  NodeTerms node_terms_;
  double tension_time_ = 0.0;  ///< of the tensions that vary [s]
  FrictionSystem system_;

  double energy_ = 0.0;              ///< at the present positions, without external work
  std::vector<Vec3d> force_;         ///< by point; friction_residual() makes the residual of it: force + external − Γ_n d/Δt
  bool spent_ = false;               ///< force_ holds a residual: evaluate() before the next step
  std::span<const Anchor> anchors_;  ///< of the present step
  double friction_energy_ = 0.0;     ///< dᵀΓ_n d
  std::vector<Float4> solution_;
  HeldNodes held_;              ///< in the present step
  FreeClusters clusters_;       ///< of the present matrix
  std::size_t most_bytes_ = 0;  ///< at any time of the present step
};

}  // namespace morula
