#pragma once
#include <cstdint>
#include <vector>

#include "cbm/packing.h"
#include "cbm/partners.h"
#include "core/vec3.h"

namespace morula::cbm {

/// All spheres of a rank: what a checkpoint holds of them. Spheres come in the order of their cells.
struct Spheres {
  std::vector<Vec3d> position;      ///< [µm]
  std::vector<double> radius;       ///< [µm]
  std::vector<std::uint16_t> type;  ///< cell type
  std::vector<Vec3f> velocity;      ///< last solution, the solver's start [µm/s]
  /// Partners to which the sphere adheres (the JKR branch flag of the pair), sorted; both partners carry the entry.
  PartnerLists attached;

  [[nodiscard]] std::size_t size() const { return position.size(); }
};

/// Elastic parameters of a sphere, for the contact laws.
struct SphereParameters {
  double young = 0.45;     ///< E [kPa]
  double poisson = 0.4;    ///< ν
  bool adhesive = true;    ///< JKR; false: Hertz, spheres of this type do not adhere to spheres
  PackingCurve packing{};  ///< pressure by packing; empty: none
};

}  // namespace morula::cbm
