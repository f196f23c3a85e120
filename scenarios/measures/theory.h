#pragma once
#include "core/result.h"

namespace morula::scenarios::theory {

/// Spherical caps of a cell with a surface tension everywhere (liquid-like), its volume held: what the angle of contact gives.
/// angle: between the contact plane and the free surface, 0 for a sphere that touches (dcm.md §8).
/// R/R0 = (4/(2 + 3c − c³))^(1/3), c = cos(angle).
struct Cap {
  double angle = 0.0;           ///< [rad]
  double radius = 1.0;          ///< R/R0
  double contact_radius = 0.0;  ///< R sin(angle)/R0
  double height = 2.0;          ///< R (1 + c)/R0
  double pressure = 2.0;        ///< p R0/γ = 2 R0/R
  double contact_part = 0.0;    ///< contact area over the whole surface of the cell
};
Cap cap_of_angle(double cosine);
/// Two equal cells: cos(angle) = 1 − W/(2γ). W: adhesion energy per contact area of the pair.
inline Cap doublet(double adhesion, double tension) { return cap_of_angle(1.0 - adhesion / (2.0 * tension)); }
/// Part of the surface of such a cell that is nearer to its mirror image than `gap` (over R0): its contact, and the free surface beside it until it is
/// that far from the other's cap or, where the two open by more than a right angle, from the line where they part. With half the range of contact
/// this is the contact area that a run tells (decision 0026; the ramp of the points changes it by 2e-5).
double part_nearer_than(const Cap& cap, double gap);
/// A cell on a rigid plane: cos(angle) = 1 − W/γ.
inline Cap on_plane(double adhesion, double tension) { return cap_of_angle(1.0 - adhesion / tension); }

/// Strains of an elastic sphere under the outward normal traction s0 cos²θ, small strains: with Y the two-dimensional Young modulus, ν the
/// Poisson ratio of the surface, γ its tension, K the bulk modulus: u2 = (2/3) s0 / (4Y/((5 + ν) R²) + 4γ/R²),
/// u0 = (s0/3) / (2Y/((1 − ν) R²) − 2γ/R² + 3K/R). For K = γ = 0 it is Guck et al. 2001 (doi:10.1016/S0006-3495(01)75740-2):
/// u = R² s0/(4Y) [(5 + ν) cos²θ − 1 − ν]. Holds below strains of about 8 %.
struct Stretch {
  double axial = 0.0;       ///< (u0 + u2)/R
  double transverse = 0.0;  ///< (u0 − u2/2)/R
};
Stretch stretched_sphere(double peak_stress, double radius, double modulus, double poisson, double tension, double bulk_modulus);

/// A drop of tension γ pressed between two parallel plates that it does not wet, its volume held: the free surface has constant mean
/// curvature and meets the plates tangentially. With a the contact radius, b the radius at the equator:
/// r sin ψ = (p/2γ)(r² − a²), p = 2γ b/(b² − a²), force F = p π a² (Fischer-Friedrich et al. 2014, doi:10.1038/srep06213, solve it for γ).
struct PressedDrop {
  double contact_radius = 0.0;  ///< a/R0
  double equator = 1.0;         ///< b/R0
  double pressure = 2.0;        ///< p R0/γ
  double force = 0.0;           ///< F/(γ R0)
};
/// height: of the gap over R0, between 0.05 and 2 (a sphere).
PressedDrop pressed_drop(double height);

/// Largest pull |F|/(πRW) that two elastic spheres bear, in the theory of Maugis 1992 (doi:10.1016/0021-9797(92)90285-T) of a constant
/// adhesive stress σ0: between 2 (DMT, small λ) and 3/2 (JKR, large λ). λ = 2σ0 (R/(πWK²))^(1/3), K = 4E*/3.
double maugis_pull_off(double lambda);

/// Suction above which a cell with a surface tension has no rest in a pipette: its projection is a hemisphere, dp = 2γ (1/Rp − 1/Rc). Rc, the
/// radius of the part outside, follows from the volume: a sphere less the cap that its opening of radius Rp cuts off, and the hemisphere.
double critical_aspiration(double tension, double pipette_radius, double cell_radius);

}  // namespace morula::scenarios::theory
