#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace morula {

/// Pairs of faces (lower number first, in increasing order) that meet elsewhere than in the nodes and edges they share: they cross, touch or are
/// folded onto each other. Decided by exact predicates, so that rounding neither hides nor invents a crossing.
/// Faces with a repeated node or exactly without area, and pairs with the same three nodes, are left out: other checks name them.
/// Stops after `most` pairs. Precondition: indices valid, coordinates finite.
std::vector<std::pair<std::uint32_t, std::uint32_t>> find_self_intersections(std::span<const Vec3d> position,
                                                                             std::span<const Triangle> faces, std::size_t most);

/// A face with the places of its corners [µm].
struct PlacedFace {
  Triangle node;
  std::array<Vec3d, 3> corner;
};

/// Whether two faces meet elsewhere than in the nodes and edges they share, as find_self_intersections() tells it.
bool faces_meet(const PlacedFace& a, const PlacedFace& b);

/// True when the corners lie exactly on one line (or in one point). Precondition: finite coordinates.
bool exactly_collinear(const Vec3d& a, const Vec3d& b, const Vec3d& c);

}  // namespace morula
