#pragma once
#include <algorithm>

#include "core/cell_id.h"

namespace morula {

/// A surface that is new where it touches that of its sister: W goes there from the sum of their tensions at that time to what it is elsewhere, as
/// newness_of_interface() fades.
struct SisterBond {
  CellId cell;       ///< one of the sisters
  double age = 0.0;  ///< since the cut, of both [s]

  friend bool operator==(const SisterBond&, const SisterBond&) = default;
};

/// How new a surface that a division has made is at an age [s] ≥ 0: 1 at birth, from there evenly to 0 within `fading` [s]; 0 where that is 0.
inline double newness_of_interface(double age, double fading) { return fading > 0.0 ? std::clamp(1.0 - age / fading, 0.0, 1.0) : 0.0; }

}  // namespace morula
