#pragma once
#include "core/random/philox.h"

namespace morula::calibrate {

/// Random numbers of a fit. Its seed is its own, so that these numbers may be those of other streams of a run.
inline constexpr auto kStartStream = static_cast<RandomStream>(0x66697401);     ///< where the searches for E and W begin
inline constexpr auto kResampleStream = static_cast<RandomStream>(0x66697402);  ///< experiments that a sample of the bootstrap is made of

}  // namespace morula::calibrate
