#pragma once
#include <cstdint>

namespace morula {

/// How many values of a column a body has: one, or one for each of its nodes, edges or faces.
enum class Domain : std::uint8_t { kBody, kNode, kEdge, kFace };

/// Which bodies have values of a column.
enum class Fill : std::uint8_t {
  kAll,        ///< every body, as many as the domain says
  kAllOrNone,  ///< a body has as many as the domain says, or none, which stands for the usual value
  kAny,        ///< every body has a list of any length
};

}  // namespace morula
