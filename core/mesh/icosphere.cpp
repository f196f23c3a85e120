#include "core/mesh/icosphere.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <numbers>
#include <utility>

#include "core/mesh/node_order.h"

namespace morula {
namespace {

TriangleMesh icosahedron() {
  constexpr double g = std::numbers::phi;
  TriangleMesh mesh;
  mesh.position = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.faces = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                {3, 9, 4},  {3, 4, 2}, {3, 2, 6}, {3, 6, 8},  {3, 8, 9},   {4, 9, 5}, {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (Vec3d& x : mesh.position) x = normalized(x);
  return mesh;
}

/// Each face into four; the new nodes are the midpoints of the edges, moved out to the sphere.
TriangleMesh subdivided(const TriangleMesh& coarse) {
  TriangleMesh fine;
  fine.position = coarse.position;
  fine.faces.reserve(4 * coarse.faces.size());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> midpoint_of_edge;
  const auto midpoint = [&](std::uint32_t a, std::uint32_t b) {
    const auto [place, is_new] = midpoint_of_edge.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(fine.position.size()));
    if (is_new) fine.position.push_back(normalized(coarse.position[a] + coarse.position[b]));
    return place->second;
  };
  for (const auto& [a, b, c] : coarse.faces) {
    const std::uint32_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
    fine.faces.insert(fine.faces.end(), {Triangle{a, ab, ca}, Triangle{b, bc, ab}, Triangle{c, ca, bc}, Triangle{ab, bc, ca}});
  }
  return fine;
}

}  // namespace

TriangleMesh make_icosphere(int level) {
  assert(level >= 0 && level <= 10);
  TriangleMesh mesh = icosahedron();
  for (int i = 0; i < level; ++i) mesh = subdivided(mesh);
  return with_near_neighbour_order(mesh);
}

Result<std::shared_ptr<const ReferenceShape>> ShapeLibrary::icosphere(std::uint32_t nodes) {
  constexpr std::array<std::uint32_t, 4> kNodes = {42, 162, 642, 2562};
  for (std::size_t i = 0; i < kNodes.size(); ++i) {
    if (kNodes[i] != nodes) continue;
    if (!icospheres_[i]) {
      TriangleMesh mesh = make_icosphere(static_cast<int>(i) + 1);
      MORULA_TRY_ASSIGN(auto topology, Topology::build(nodes, std::move(mesh.faces)));
      auto known = std::make_shared<ReferenceShape>(*make_reference_shape(std::move(topology), std::move(mesh.position)));
      known->icosphere_nodes = nodes;
      icospheres_[i] = std::move(known);
    }
    return icospheres_[i];
  }
  return Error{ErrorKind::kInput, "there is no icosphere with " + std::to_string(nodes) + " nodes", "choose 42, 162, 642 or 2562 nodes"};
}

}  // namespace morula
