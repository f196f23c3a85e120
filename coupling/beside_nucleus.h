#pragma once
#include "coupling/model.h"

namespace morula {

/// The volume whose logarithm over V0 gives the pressure of a shell of this volume: where its nucleus is a shell what lies beside it, over the part that it
/// leaves at rest (dcm/internal_forces.h, HeldVolume); else the volume itself [µm³].
inline double volume_beside_nucleus(const CellType& type, double volume, double target_volume) {
  if (!type.interior.has_nuclear_shell()) return volume;
  const double part = type.interior.nucleus_fraction;
  return (volume - part * target_volume) / (1.0 - part);
}

}  // namespace morula
