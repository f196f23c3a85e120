#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "cbm/spheres.h"
#include "core/contact/regional_adhesion.h"
#include "core/mesh/topology.h"
#include "core/numbers/time_course.h"
#include "core/space/space.h"
#include "coupling/active_terms.h"
#include "coupling/behaviours/behaviour.h"
#include "coupling/behaviours/division_axis.h"
#include "coupling/behaviours/migration_law.h"
#include "coupling/behaviours/polarity_rule.h"
#include "coupling/cell_cycle.h"
#include "coupling/distribution.h"
#include "coupling/face_regions.h"
#include "coupling/fates.h"
#include "coupling/loads/load.h"
#include "coupling/regions/region.h"
#include "coupling/surface_law.h"
#include "coupling/traits.h"
#include "dcm/interior.h"
#include "dcm/shells.h"
#include "fields/field_spec.h"

namespace morula {

/// Osmotic control of the volume of a cell type (behaviours/osmosis.h).
struct Osmosis {
  double permeability = 0.0;  ///< L_p of water; 0: the volume is the target volume [µm/(s kPa)]
  double inactive = 0.3;      ///< f_b = V_b/V_t
  double inside = 300.0;      ///< c_i: osmolarity inside at the target volume [mM]
  double outside = 300.0;     ///< of the medium [mM]
  TimeCourse course;          ///< factor of `outside` over time; empty: 1
  int field = -1;             ///< whose concentration at the cell adds to `outside`, or -1

  [[nodiscard]] bool acts() const { return permeability > 0.0; }
};

/// Everything the step needs to know of a cell type, in internal units.
struct CellType {
  std::string name;
  Distribution radius{6.0, 0.0};  ///< of the cell at birth [µm]

  // life
  bool cycles = false;                            ///< grows and divides
  Distribution cycle_duration{18 * 3600.0, 0.0};  ///< from birth to twice the birth volume [s]
  CellCycle cycle;                                ///< what it goes through until then
  double inhibit_pressure = kNever;               ///< growth stops above this pressure [kPa]
  std::shared_ptr<const DivisionAxis> axis = random_axis();
  OwnValues axis_own{};                   ///< values of the axis' own keys
  double axis_spread = 0.0;               ///< s of division_axis() [rad]
  Distribution division_share{0.5, 0.0};  ///< part of the mother's volume that the daughter gets to which the axis points
  Fates fates;                            ///< types and polarities of the daughters
  bool shells_divide = true;              ///< by cut; else a shell at its division volume waits until it is a sphere
  double new_surface = 600.0;             ///< time in which the interface that a cut has made takes its tension [s]
  double apoptosis_time = 8 * 3600.0;     ///< τ_a of the shrinking V0 e^{−t/τ_a} [s]
  double removal_fraction = 0.1;          ///< removed below this fraction of the volume at death
  Migration migration;
  std::vector<CellBehaviour> behaviours;  ///< what its cells do beside these, in the order in which they act

  Osmosis osmosis;
  Fluctuations fluctuations;
  Protrusion protrusion;
  Polarity polarity;

  // friction
  double medium_friction = 0.1;       ///< γ_med per area: of a sphere, and for shells the lesser of normal and tangential [nN·s/µm³]
  double medium_normal_extra = 0.0;   ///< of shells: γ_n − γ_t per area where positive [nN·s/µm³]
  double medium_tangent_extra = 0.0;  ///< of shells: γ_t − γ_n per area where positive [nN·s/µm³]

  // bodies
  BodyKind initial_body = BodyKind::kSphere;
  std::uint32_t shell_nodes = 162;
  cbm::SphereParameters sphere;
  dcm::ShellParameters shell;
  dcm::InteriorParameters interior;  ///< of a shell
  RegionalTension regional_tension;  ///< of shells; empty: shell.tension everywhere
  Traits traits;                     ///< in which its cells differ
  double renew_mesh_below = 0.0;     ///< of shells: their nodes are spread evenly when a face has less quality than this; 0: never
  bool own_mesh = false;             ///< of shells: where that is not enough they get connectivity of their own
  double self_contact = 0.0;         ///< of shells: distance at which a surface touches itself; 0: it passes through itself [µm]
};

/// Contact of two materials. Cell types come first, obstacles after them.
struct ContactPair {
  double adhesion = 0.0;                               ///< W per contact area of the pair [nN/µm]
  double normal_friction = 50.0;                       ///< γ_n per contact area [nN·s/µm³]
  double tangential_friction = 50.0;                   ///< γ_t per contact area [nN·s/µm³]
  std::shared_ptr<const SurfaceLaw> law = tent_law();  ///< traction between surfaces (decision 0018)
  double range = 0.0;                                  ///< c; 0: that of ContactNumerics [µm]
  double repulsion = 0.0;                              ///< k_r; 0: that of ContactNumerics [kPa/µm]
  LawValues own{};                                     ///< values of the law's own keys
  std::vector<AdhesionRule> regions{};  ///< W by the marks of the faces, first material first; the first that holds; else `adhesion`
};

/// Numbers of the traction law, for pairs that have none of their own.
struct ContactNumerics {
  double range = 0.5;               ///< c; no pair has a smaller one [µm]
  double repulsion = 100.0;         ///< k_r [kPa/µm]
  int points_per_face = 3;          ///< interior quadrature points, 3 or 4
  double skin = 0.5;                ///< of the candidate lists [µm]
  bool objective_friction = false;  ///< contacts do not rub when both surfaces turn together (core/contact/objective_friction.h)
};

/// A rigid obstacle.
struct ObstacleSpec {
  std::string name;
  std::vector<Vec3d> position;
  std::vector<Triangle> faces;
  bool inside = false;    ///< cells live inside the closed surface
  Vec3d velocity{};       ///< prescribed translation [µm/s]
  Vec3d direction{};      ///< of `distance`, of length 1
  TimeCourse distance{};  ///< how far it has gone along `direction`, beside `velocity`; empty: nowhere [µm]

  [[nodiscard]] bool moves() const { return norm2(velocity) > 0.0 || !distance.empty(); }
  /// Way from one time to another [µm].
  [[nodiscard]] Vec3d way(double from, double to) const {
    Vec3d out = velocity * (to - from);
    if (!distance.empty()) out += direction * (distance.at(to) - distance.at(from));
    return out;
  }
};

struct Swaps {
  std::vector<Region> regions;
  std::vector<Trigger> triggers;
  std::uint64_t max_shells = std::numeric_limits<std::uint64_t>::max();
  double hold = 600.0;  ///< of regions [s]
  /// A sphere that becomes a shell among shells, or with others, begins with the room that its ball has between theirs (decision 0059).
  bool gradual = true;
  bool by_fate = false;  ///< some daughters are of a type with another body than their mother's
  /// Whether any cell may exchange its body.
  [[nodiscard]] bool any() const { return by_fate || !regions.empty() || !triggers.empty(); }
};

enum class Integrator : std::uint8_t { kImplicit, kExplicitEuler };

struct StepControl {
  Integrator integrator = Integrator::kImplicit;
  double initial_step = 1.0;      ///< [s]
  double max_step = 60.0;         ///< [s]
  double max_displacement = 0.3;  ///< allowed displacement of a step in units of the contact range c (of shell nodes and spheres)
  int max_newton = 3;
  double newton_stop = 0.2;  ///< stop when the nonlinear residual is below this part of the force
  double obstacle_stop =
      0.01;  ///< nor before that of cells where obstacles and loads that hold move is below this part of the forces there
  double first_tolerance = 1e-2;  ///< of the linear solve
  double later_tolerance = 0.1;   ///< of the later solves of a step
  double start_cap = 0.0;         ///< δ of the capped start: traction not above k_r δ until the overlap is below 0.1 µm; 0: no cap [µm]
};

/// Limits that stop a run (or warn when a part of them is reached).
struct Limits {
  double overlap = 0.3;         ///< deepest penetration between shells, or of a shell and an obstacle [µm]
  double volume_error = 0.02;   ///< relative
  double field_balance = 1e-6;  ///< relative
};

/// The physics of a run: everything that the step reads and nothing that it writes.
struct Model {
  std::uint32_t seed = 1;
  Space space;            ///< that of the study; in a Simulation, which keeps it so, the one of the present time
  TimeCourse box_volume;  ///< volume of a box that is periodic along all axes over that of the study; empty: it stays
  std::vector<CellType> types;
  std::vector<ObstacleSpec> obstacles;
  std::vector<CellLoad> loads;
  std::vector<std::string> mark_names;  ///< of the marks of faces, by number
  std::vector<FaceMark> marks;
  std::vector<Lumen> lumens;
  std::vector<ApicalSpring> apical_springs;
  std::vector<ContactPair> pairs;  ///< (materials × materials), symmetric; materials = types then obstacles
  ContactNumerics contact;
  std::vector<fields::FieldSpec> fields;
  Swaps swaps;
  StepControl step;
  Limits limits;

  [[nodiscard]] std::size_t material_count() const { return types.size() + obstacles.size(); }
  [[nodiscard]] const ContactPair& pair(std::size_t a, std::size_t b) const { return pairs[a * material_count() + b]; }
};

}  // namespace morula
