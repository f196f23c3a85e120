#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "coupling/model.h"

namespace morula {

/// What a region of neighbours counts contacts from.
struct CountsFrom {
  enum class What : std::uint8_t { kRegion, kType, kObstacle } what = What::kRegion;
  std::size_t number = 0;  ///< among the regions, types or obstacles of the model
};

/// The one with this name: first of the regions `before` it, then of the types, then of the obstacles; none where nothing is called so.
std::optional<CountsFrom> counts_from(const Model& model, std::span<const Region> before, const std::string& name);

}  // namespace morula
