#pragma once
#include <cstddef>

#include "dcm/shells.h"

namespace morula::dcm {

/// Let the stress-free membrane of a shell enclose V [µm³]: rest volume V, rest lengths scaled by (V/V_rest)^{1/3}; rest angles stay
/// (dcm.md §13). If only V0 grew, doubling it would leave a spurious tension √3 k (1 − 2^{−1/3}).
void set_rest_volume(Shells& shells, std::size_t shell, double rest_volume);

/// V0 at which a sphere of volume V under tension γ holds its size: V exp(2γ/(R K_V)), since the pressure −K_V ln(V/V0) then is the
/// Laplace pressure 2γ/R (dcm.md §4: T4.3). V [µm³], γ [nN/µm], K_V [kPa].
double pressure_free_reference(double volume, double tension, double bulk_modulus);

}  // namespace morula::dcm
