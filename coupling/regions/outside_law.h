#pragma once
#include <memory>

#include "coupling/regions/region.h"

namespace morula {

/// How far a cell as a sphere is beyond the range of its laws (AsBalls).
std::shared_ptr<const TriggerValue> outside_law_value();

}  // namespace morula
