#pragma once
#include <cstdint>

namespace morula::scenarios {

/// Length of a text of which nothing is to be cut.
inline constexpr std::uint64_t kWholeText = UINT64_MAX;

/// How long the texts of a run were when a checkpoint was written [bytes]: what stands beyond came later.
struct TextLengths {
  std::uint64_t events = kWholeText, log = kWholeText;
};

}  // namespace morula::scenarios
