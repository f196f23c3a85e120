#pragma once
#include "coupling/model.h"

namespace morula {

/// The volume whose logarithm over V0 gives the pressure of a shell of this volume: where its nucleus is a shell what lies beside it, over the part that it
/// leaves at rest (dcm/internal_forces.h, HeldVolume); else the volume itself [µm³].
inline double volume_beside_nucleus(const CellType& type, double volume, double nuclear_volume) {
  return type.interior.has_nuclear_shell() ? (volume - nuclear_volume) / (1.0 - type.interior.nucleus_fraction) : volume;
}
/// The same beside a nucleus at rest in a cell of this target volume [µm³].
inline double volume_beside_resting_nucleus(const CellType& type, double volume, double target_volume) {
  return volume_beside_nucleus(type, volume, type.interior.nucleus_fraction * target_volume);
}

}  // namespace morula
