#pragma once
#include <cstdint>
#include <vector>

#include "core/vec3.h"

namespace morula {

/// What mechanics knows of each cell at the present positions, in the order of the rank's bodies (shells, then spheres).
struct BodyValues {
  std::vector<double> volume;  ///< [µm³]
  std::vector<double> area;    ///< [µm²]
  /// What the cell bears from outside, σ = (1/V) Σ_k (x_k − x) ⊗ f_k over the forces that neighbours, obstacles, walls and loads exert on it
  /// (fields_and_coupling.md, D; decision 0023), less what adhesion does to the tension of a shell's own surface (decision 0054); symmetric
  /// part, tension positive [kPa].
  std::vector<SymMat3<double>> stress;
  std::vector<double>
      stressed_volume;  ///< the V of this stress: a sphere's is what its bulk modulus leaves of its ball, a shell's has flat facets with spheres [µm³]
  std::vector<double> pressure;        ///< −tr σ/3, of shells and spheres alike [kPa]
  std::vector<double> inner_pressure;  ///< shells: −K_V ln(V/V0), which bears the cortex, too; spheres, which have none: the pressure [kPa]
  std::vector<double> contact_area;    ///< [µm²]
};

/// How a body touches a material.
struct Touch {
  double area = 0.0;  ///< [µm²]
  Vec3d normal{};     ///< of the contact, of length 1; its sign has no meaning
};

/// How a nucleus that is a shell stands in its cell.
struct NucleusState {
  double overlap = 0.0;       ///< deepest penetration of nucleus and cortex [µm]
  double contact_area = 0.0;  ///< of nucleus and cortex, of both surfaces [µm²]
  double volume = 0.0;        ///< [µm³]
  double pressure = 0.0;      ///< inside it [kPa]
};

/// Contacts of spheres with spheres that a rank counts, and those of them that are larger than their law allows for (cbm/sphere_range.h).
struct SphereRangeCount {
  std::int64_t contacts = 0, beyond = 0;
};

}  // namespace morula
