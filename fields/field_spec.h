#pragma once
#include <array>
#include <string>
#include <vector>

namespace morula::fields {

/// What holds at one face of the domain for one concentration.
struct FaceCondition {
  enum class Kind { kValue, kNoFlux } kind = Kind::kNoFlux;
  double value = 0.0;  ///< concentration on the face [mM]
};

/// Uptake by one cell: rate · c/(K_m + c), and 0 where the rate is 0.
struct UptakeSpec {
  double rate = 0.0;             ///< V_max [amol/s per cell]
  double half_saturation = 0.0;  ///< K_m [mM]
};

/// One diffusing concentration: ∂c/∂t = D ∇²c − λ c − uptake (physics: fields_and_coupling.md, A).
struct FieldSpec {
  std::string name;
  double diffusion = 0.0;                                ///< D [µm²/s]
  double decay = 0.0;                                    ///< λ [1/s]
  double initial = 0.0;                                  ///< [mM]
  double voxel = 0.0;                                    ///< wanted voxel size h [µm]; the domain is divided evenly, h never larger
  double relative_tolerance = 1e-4;                      ///< of the integrator
  std::array<std::array<FaceCondition, 2>, 3> boundary;  ///< axis, then low and high face; ignored on periodic axes
  std::vector<UptakeSpec> uptake;                        ///< by cell type
};

}  // namespace morula::fields
