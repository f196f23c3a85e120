#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/mesh/topology.h"

namespace morula {

/// A shape as bytes, for another rank: an icosphere of the library by its number of nodes, any other whole.
void append_shape(const ReferenceShape& shape, std::vector<std::byte>& out);

/// The shape at the front of the bytes, bit for bit; `bytes` then begins after it. A shape that the library knows is the library's own object.
/// Precondition: written by append_shape().
std::shared_ptr<const ReferenceShape> read_shape(std::span<const std::byte>& bytes, ShapeLibrary& library);

}  // namespace morula
