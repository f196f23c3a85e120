#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/rigid_surface.h"
#include "core/parallel/comm.h"
#include "coupling/model.h"
#include "coupling/tissue.h"

namespace morula {

/// R T at 310.15 K: an excess of 1 mM of solute is a pressure of 2.5787 kPa [fJ/amol].
inline constexpr double kGasEnergy = 2.578731;
/// A cavity whose walls are seen in less than this part of all directions has burst: its fluid has no pressure any more.
inline constexpr double kBurst = 0.5;

/// Find the faces of the lumens that are due, and measure all lumens: at the beginning of a step. Due is after Lumen::renewed, and as soon as the
/// faces that were found leave open a twentieth of the directions in which a wall was seen: cells that part have faces between them that were in
/// contact. Where so much of the walls is no face that it finds, as behind a rim, they are found in every step. A lumen that keeps its solute gets
/// its amount when it is first seen. A ray goes from `center` in every direction of a SightMap; faces of shells that show their outside and of
/// which at least half is seen bound the cavity, spheres that are seen (cavity_variables()), and `obstacles` (those of the study and the walls of the domain, as
/// Tissue::obstacle_offset has them). A cell that lies over `center` is left out. Collective.
void look_into_lumens(const Model& model, std::span<const RigidSurface> obstacles, Tissue& tissue, const Comm& comm);

/// Volume, area, cover and pressure of the lumens at the present positions and time. Collective.
///
/// With A_T n_T outward from the cells, c the centre and w = Σ Ω_T/(4π) the winding number of the faces about c (1 for any cavity that shells close):
/// V = (V_s − ⅓ Σ A_T n_T·(x_T − c))/(w + w_s), so that gaps count like their surroundings. V_s = ∫ r³/3 dΩ and w_s are those of the spheres, obstacles and
/// walls that were seen when the cavity was last looked into, and covered is the part of all directions in which anything was seen then; for faces that
/// are not found by sight it is w, and only shells count.
void measure_lumens(const Model& model, Tissue& tissue, const Comm& comm);

/// Pressure of the fluid of a lumen at a time [kPa]: 0 before it exists and after it has burst; else P·course, or R T n·course/V.
double lumen_pressure(const Lumen& lumen, const LumenState& state, double time);

/// Forces of the fluids on the nodes of all shells of the rank, added to `external` (by shell node): a third of P A_T (−n_T + ⟨n⟩) to each corner
/// of the faces of the cavity. ⟨n⟩ = (Σ A n − O)/Σ A is zero where the cavity is closed; across gaps it stands for the fluid's push on what is not there, so
/// that a cavity never drives the tissue: the net force is zero to rounding. O = ∫ n dA is that of the spheres, obstacles and walls that close it, which bear
/// P O themselves: a dome on a floor is lifted by it. Strengths as external loads: at `time`, on the shape of the step's start. Collective.
void add_lumen_forces(const Model& model, const Tissue& tissue, double time, const Comm& comm, std::span<Vec3d> external);

/// The same on the spheres of the rank [nN]: P ∫ n dA over what was seen of each. Empty: there are none in the walls.
std::vector<Vec3d> pushes_on_spheres(const Model& model, const Tissue& tissue, double time);

}  // namespace morula
