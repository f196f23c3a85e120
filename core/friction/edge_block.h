#pragma once
#include <cstdint>
#include <functional>
#include <span>

namespace morula {

/// A symmetric 3×3 block xx xy xz yy yz zz, and two numbers that nobody reads: one register.
struct alignas(32) EdgeBlock {
  float m[8] = {};
};

/// Fills the blocks that contacts add to the edges of a body (zero before); false when there are none.
using EdgeBlockSource = std::function<bool(std::uint32_t body, std::span<EdgeBlock> edges)>;

}  // namespace morula
