#pragma once
#include "core/vec3.h"

namespace morula::dcm {

/// Damper along a mesh edge: force on node i −γ_int t tᵀ (v_i − v_j), and the opposite on j; t is the unit direction of the edge.
///
/// With the spring of the same edge it is a Kelvin–Voigt element with time γ_int/k. Acting along the edge only, it resists no rigid
/// motion, so that it exerts neither net force nor torque (an isotropic damper would resist rotation). γ_int is per edge and does not
/// depend on the mesh: a lattice of equilateral triangles has the surface shear viscosity (√3/4) γ_int. Source: Van Liedekerke et al.
/// 2020, doi:10.1007/s10237-019-01204-7.
///
/// γ_int [nN·s/µm].
template <class Real>
struct EdgeDamper {
  Real damping;  // γ_int

  Vec3<Real> force(const Vec3<Real>& t, const Vec3<Real>& relative_velocity) const noexcept {
    return t * (-(damping * dot(t, relative_velocity)));
  }
  SymMat3<Real> friction(const Vec3<Real>& t) const noexcept { return outer(damping, t); }
};

/// Damper of an edge in all directions: force on node i −γ_iso (v_i − v_j), and the opposite on j. It conserves momentum, but resists rigid
/// rotation: a spinning cell feels a torque that nothing exerts (dcm.md §1). For comparison with models that have it.
///
/// γ_iso [nN·s/µm].
template <class Real>
struct IsotropicDamper {
  Real damping;  // γ_iso

  Vec3<Real> force(const Vec3<Real>& relative_velocity) const noexcept { return relative_velocity * -damping; }
  SymMat3<Real> friction() const noexcept { return isotropic(damping); }
};

}  // namespace morula::dcm
