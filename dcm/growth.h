#pragma once
#include <cstddef>
#include <span>

#include "dcm/shells.h"

namespace morula::dcm {

/// Let the stress-free membrane of a shell enclose V [µm³]: rest volume V, rest lengths scaled by (V/V_rest)^{1/3}, and with them the
/// reference metric and the rest areas of the faces by (V/V_rest)^{2/3}; rest angles stay (dcm.md §13). If only V0 grew, doubling it would leave a spurious tension √3 k (1 − 2^{−1/3}).
void set_rest_volume(Shells& shells, std::size_t shell, double rest_volume);

/// Turnover of the cortex during `dt` [s]: bonds that are replaced come in without stress, so that every rest length relaxes to the present
/// length, l0 ← l + (l0 − l) e^{−dt/τ}. The rate 1/τ is that of the shell's type; 0 changes nothing.
///
/// Exact at constant shape, for any dt: two steps of dt are one of 2 dt, the tension of a spring decays as e^{−t/τ}, and that of a
/// membrane likewise as long as its strain is small. Rest lengths of a face stay those of a triangle, being means of two triangles.
/// Rest angles, V0 and the rest volume do not turn over.
void turn_over(Shells& shells, const ShellMaterials& materials, double dt);

/// V0 at which a sphere of volume V under tension γ holds its size: V exp(2γ/(R K_V)), since the pressure −K_V ln(V/V0) then is the
/// Laplace pressure 2γ/R (dcm.md §4: T4.3). V [µm³], γ [nN/µm], K_V [kPa].
double pressure_free_reference(double volume, double tension, double bulk_modulus);

}  // namespace morula::dcm
