#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/cell_id.h"
#include "coupling/overlap.h"
#include "coupling/simulation.h"

namespace morula {

/// Numbers of the whole tissue at one moment; the same bits on every rank and on any number of ranks.
struct Measures {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();  ///< what is said of bodies where there are none
  double time = 0.0;                                                         ///< [s]
  std::int64_t cells = 0, spheres = 0, shells = 0, nodes = 0;
  std::vector<std::int64_t> of_type;  ///< by cell type
  double total_volume = 0.0;          ///< of the bodies [µm³]
  double box_volume = 0.0;            ///< of the domain [µm³]
  double spheroid_radius = 0.0;  ///< R = √(5/3) R_g, R_g² = Σ V_i (|c_i − c̄|² + 3/5 r_i²) / Σ V_i: exact for a ball of any cells [µm]
  double largest_extent = 0.0;       ///< of the farthest point of a cell from the tissue's centre [µm]
  double mean_pressure = 0.0;        ///< over cells [kPa]
  double shell_pressure = kNone;     ///< over shells [kPa]
  double inner_pressure = kNone;     ///< mean over shells [kPa]
  Extreme pressure;                  ///< [kPa]
  double mean_contact_area = 0.0;    ///< per cell [µm²]
  double energy = 0.0;               ///< [nN·µm]
  double nucleus_clearance = kNone;  ///< least distance of a node of a nucleus that is a shell from its cortex, < 0 outside [µm]
  Extreme overlap;                   ///< deepest penetration of a surface (not of two spheres) [µm]
  Extreme drawn_out;                 ///< longest edge of a shell without elasticity over its mean one, where there are spheres, too; else 0
  /// |V_i − V_i^law| / V_i^law of the worst cell. V^law is built from the cell's row alone: target volume V_t and what is left of an
  /// exchange of bodies x; V_t e^x for a sphere, V_t exp(2γ/(R K_V) + x − p/K_V) for a shell of inner pressure p (dcm.md: p = −K_V ln(V/V0)).
  /// Rounding, unless growth, division or a swap lost volume on the way from the row to the body.
  Extreme volume_error;
  double total_volume_error = 0.0;  ///< |Σ V_i − Σ V_i^law| / Σ V_i^law
  double packing = 0.0;  ///< largest φ of a sphere over the end of its type's calibrated range; 0: no type has one (cbm/packing.h)
  CellId packing_cell;   ///< which
  std::int64_t packed_beyond = 0;               ///< spheres beyond the calibrated range
  std::int64_t sphere_contacts = 0;             ///< contacts of two spheres
  std::int64_t contacts_beyond = 0;             ///< those larger than their law allows for (cbm/sphere_range.h)
  double mean_outside = kNone;                  ///< outside_law of the spheres (AsBalls)
  double most_outside = kNone;                  ///< of a sphere
  std::int64_t spheres_outside = 0;             ///< spheres with an outside_law above 1
  std::vector<Vec3d> obstacle_force;            ///< of all cells on each obstacle [nN]
  std::vector<LumenState> lumens;               ///< by lumen of the model
  std::vector<Vec3d> grip_force;                ///< of each load that is a grip on its cells; 0 for other loads [nN]
  std::vector<double> mean_field, least_field;  ///< by field, over voxels [mM]
  std::int64_t outside_fields = 0;              ///< cells whose centre lies beyond a face of the domain, where there are fields
  /// |A − A_0 + taken + decayed − inflow| / max(A, A_0, taken, decayed, |inflow|) since time 0, A the amount in the field; by field.
  std::vector<double> field_balance;
};

/// Collective.
Measures measure(Simulation& simulation);

/// What happened since the last output.
struct Interval {
  std::uint64_t steps = 0;
  double time = 0.0;  ///< stepped [s]
  std::uint64_t newton = 0, linear = 0, retries = 0;
  double worst_overlap = 0.0;  ///< of any step [µm]

  void add(const StepOutcome& outcome);
};

}  // namespace morula
