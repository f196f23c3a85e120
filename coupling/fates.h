#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace morula {

/// What two daughters may become, and how often.
struct Fate {
  double share = 0.0;                   ///< of all divisions of the type
  std::array<std::uint16_t, 2> type{};  ///< of the first daughter, to which the axis points, and of the second
};

/// What daughters have of their mother's polarity.
enum class DaughterPolarity : std::uint8_t { kKept, kMirrored, kNew };

/// What becomes of the daughters of a type; of divisions that no fate has they are both as she was.
struct Fates {
  std::vector<Fate> all{};
  DaughterPolarity polarity = DaughterPolarity::kKept;
};

}  // namespace morula
