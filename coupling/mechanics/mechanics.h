#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/contact/rigid_surface.h"
#include "core/mesh/topology.h"
#include "core/parallel/comm.h"
#include "core/result.h"
#include "coupling/loads/grips.h"
#include "coupling/mechanics/as_balls.h"
#include "coupling/mechanics/step_report.h"
#include "coupling/mechanics/told.h"
#include "coupling/model.h"
#include "coupling/open_sides.h"
#include "coupling/stage_timer.h"
#include "coupling/tissue.h"

namespace morula {

class ContactLayer;
class Scene;
struct Workspace;

/// The mechanics of a tissue: forces, energies and the implicit step over shells and spheres together (time_stepping.md §1, §8, §9).
///
/// A workspace: everything in it can be rebuilt from the Tissue, and rebuilding it never changes a result.
class Mechanics {
 public:
  Mechanics(const Model& model, RigidSurfaces obstacles, ShapeLibrary& shapes, Comm comm, int threads);
  /// The mechanics of another tissue of the same model, between the same obstacles.
  [[nodiscard]] Mechanics for_another_tissue(Comm comm) const;
  ~Mechanics();
  Mechanics(Mechanics&&) noexcept;

  /// Obstacles of the study and walls of the domain, where they were at time 0 (Tissue::obstacle_offset).
  [[nodiscard]] std::span<const RigidSurface> obstacles() const;

  /// Cells were added, removed, moved between ranks, or changed their body: everything is collected again at the next use.
  void bodies_changed();
  /// A few cells were added or removed, or changed their body or their place; all others are where the last step left them, in the same order. The
  /// scene is built again at the next use, and lists are mended.
  void cells_replaced();
  /// Numbers that shape the forces (reference volumes, rest lengths, radii) were changed; positions were not.
  void parameters_changed();

  /// One step of length dt under the given external forces (see external_size()) [nN] and the random forces of cells that fluctuate. On
  /// success the tissue holds the new positions and velocities; on a fault it is unchanged. Collective.
  /// `anchors`: springs on owned shell nodes and spheres, held implicitly at their places of the step's end.
  Result<StepReport, StepFault> step(Tissue& tissue, double dt, std::span<const Vec3d> external, std::span<const Anchor> anchors = {});

  /// Forces on whole cells (by owned body: shells, then spheres) as `external`: on a shell spread over its nodes by their area (dcm.md §11).
  std::vector<Vec3d> spread(const Tissue& tissue, std::span<const Vec3d> by_body);

  /// Let the owned bodies with moves[body] != 0 find their shape between all others, which are held in place (fields_and_coupling.md, D). First
  /// they are let out of overlap: no adhesion and no friction, a traction capped at a value that grows from 0.1 kPa to 10 kPa. Then adhesion and
  /// friction come in, and they settle, near to where they were (decision 0088). The clock stands still. Gives the deepest overlap of the moved bodies that is left [µm]; beyond
  /// kOverlapAtRest they found no room, and need the capped start to go on. Held shells take no part but by their surfaces. Collective.
  double relax(Tissue& tissue, std::span<const char> moves);

  /// Let the owned bodies with moves[body] != 0 go on between all others, which are held in place, in steps of their own: until one as long as `step` [s]
  /// takes no point further than is allowed, or sixty are done. The clock stands still. Collective.
  void move_alone(Tissue& tissue, std::span<const char> moves, double step);

  /// Which owned cells touch which of `these` (sorted), or are one of `these` and touch whom: pairs (owned cell, partner) with contact area in the
  /// surface contacts at the tissue's positions, sorted. An obstacle is the partner CellId(number + 1). Collective.
  std::vector<std::pair<CellId, CellId>> touching(const Tissue& tissue, std::span<const CellId> these);

  /// Lets scene() be that of the tissue's present positions. Collective.
  void update_scene(const Tissue& tissue);

  /// Energy of all terms at the tissue's positions, of all ranks [nN·µm]; scene() is that of them then. Collective.
  double energy(const Tissue& tissue);
  /// The same where parameters are what they were at the last step or look(): nothing is found again that is known. Collective.
  double known_energy(const Tissue& tissue);

  /// Which part of every owned face (in the order of the shells) is in contact with cells or obstacles of the materials with
  /// with_material[material] != 0, at the tissue's positions; 0 to 1, with the taper of contact friction at the rim. Collective.
  std::vector<float> contact_of_faces(const Tissue& tissue, std::span<const char> with_material);

  /// How many contacts away every owned body (shells, then spheres) is from the nearest of some: of these `start` has the number to begin with,
  /// of all others kFarAway, which stays where there are more than `most`. Spheres touch where they adhere or overlap, and what a shell touches is
  /// nearer than half of the contact's range. The same on any ranks. Collective.
  std::vector<std::uint32_t> contact_steps(const Tissue& tissue, std::span<const std::uint32_t> start, std::uint32_t most);
  static constexpr std::uint32_t kFarAway = 1u << 30;

  /// From the middles of some owned bodies (by place: shells, then spheres) to those of all that they touch, as in contact_steps(), by increasing id
  /// [µm]. The same on any ranks. Collective.
  std::vector<std::vector<Vec3d>> neighbours_of(const Tissue& tissue, std::span<const std::size_t> places);

  /// In which directions the owned bodies (shells, then spheres) lie at the surface of the tissue: OpenSides::outward() of what they touch. The same on
  /// any ranks. Collective.
  std::vector<OpenSides> open_sides(const Tissue& tissue);

  /// How every owned body (shells, then spheres) touches the materials with with_material[material] != 0; spheres: obstacles only. Collective.
  std::vector<Touch> touch_of_bodies(const Tissue& tissue, std::span<const char> with_material);

  /// Adds to `external` the forces that move every owned body with a velocity (shells, then spheres) [µm/s] against all friction with what is no
  /// cell: Γ v on each point, Γ its friction with the medium and that of its contacts with obstacles, along their surface. A body that touches no
  /// other cell moves so as a whole, without turning (cbm.md §1, rigid co-motion); what friction with neighbours takes is not made up for.
  /// Collective.
  void add_crawling(const Tissue& tissue, std::span<const Vec3d> velocity, std::span<Vec3d> external);

  /// The random forces of a step of dt [s] that would begin now, as step() draws them, in the order of `external` [nN]: ⟨f fᵀ⟩ = (2 k_B T/Δt) Γ
  /// with the friction Γ of every term, drawn factor by factor of Γ = Σ G Gᵀ (dcm.md §10), so that what acts between points has no net force.
  /// Between two types k_B T is the mean of theirs. Random numbers are those of (cell, step, factor). Collective.
  std::vector<Vec3d> random_forces(const Tissue& tissue, double dt);

  /// Spheres that touch adhere from the beginning: their flags at the tissue's positions, before anything is told of them. Collective.
  void attach(Tissue& tissue);

  /// What mechanics knows of each cell at the tissue's present positions and time. Collective.
  BodyValues values(const Tissue& tissue);
  /// The pressures alone.
  std::vector<double> pressures(const Tissue& tissue);

  /// Force of all cells on each obstacle, friction left out [nN]. Collective; the same on every rank.
  std::vector<Vec3d> obstacle_forces(const Tissue& tissue);

  /// The cells as the laws of spheres see them, whatever their bodies are, at the tissue's present positions and time. Collective.
  AsBalls as_balls(const Tissue& tissue);

  /// Contacts of spheres that this rank counts, and those beyond the range of their law. After values(), pressures() or a step.
  [[nodiscard]] SphereRangeCount contacts_beyond_range() const;

  /// How tightly the owned spheres are packed, φ (cbm.md §3); 0 where no type has a pressure of packing. After values(), pressures() or a step.
  [[nodiscard]] std::vector<double> packing() const;

  /// Number of external force entries for this tissue: owned shell nodes, owned spheres, then the points within shells: rigid nuclei, and the
  /// nodes of those that are shells. These last may be left out.
  [[nodiscard]] static std::size_t external_size(const Tissue& tissue);

  /// Energy and forces at the tissue's positions, for tests: forces in the order of `external`.
  double energy_and_forces(const Tissue& tissue, std::vector<Vec3d>& force);

  /// The sum of the forces of all terms on the points of each owned body (shells, then spheres) at the tissue's positions [nN]. Collective.
  std::vector<Vec3d> net_forces(const Tissue& tissue);
  /// The same where only those on the owned bodies with wanted[body] != 0 count: contacts of two others are not looked at. Collective.
  std::vector<Vec3d> net_forces_on(const Tissue& tissue, std::span<const char> wanted);

  /// Parameters of the single-cell mechanics of the owned shells.
  [[nodiscard]] dcm::ShellMaterials shell_materials() const;
  /// The same of nuclei that are shells.
  [[nodiscard]] dcm::ShellMaterials nucleus_materials() const;
  [[nodiscard]] StageTimer& timer();
  [[nodiscard]] const ContactLayer& contacts() const;
  [[nodiscard]] const Scene& scene() const;
  /// What the rigid nucleus of an owned shell feels at the present positions.
  [[nodiscard]] dcm::InteriorEnergy interior_of(std::uint32_t shell) const;
  /// How the nucleus of an owned shell stands at the present positions, if it is a shell.
  [[nodiscard]] std::optional<NucleusState> nucleus_of(std::uint32_t shell) const;
  /// Forces on the nodes of the nuclei that are shells, in their order, as energy_and_forces() found them.
  [[nodiscard]] std::span<const Vec3d> forces_on_nuclei() const;
  [[nodiscard]] double deepest_overlap() const;
  /// Bytes of all workspaces of this rank: the most at any time of the last step.
  [[nodiscard]] std::size_t memory() const;

 private:
  /// Everything at the tissue's positions and time, as values() tells it.
  void look(const Tissue& tissue);

  std::unique_ptr<Workspace> work_;
};

}  // namespace morula
