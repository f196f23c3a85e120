#pragma once
#include "core/vec3.h"

namespace morula::dcm {

/// Friction against the medium: force on a node −γ_med a v, isotropic, a the node's share of the surface (a third of the areas of the
/// faces around it). Source: Van Liedekerke et al. 2020, doi:10.1007/s10237-019-01204-7 (friction with the extracellular matrix, per
/// area).
///
/// γ_med [nN·s/µm³], a [µm²]; coefficient [nN·s/µm].
template <class Real>
struct MediumFriction {
  Real per_area;  // γ_med

  Real coefficient(Real node_area) const noexcept { return per_area * node_area; }
};

}  // namespace morula::dcm
