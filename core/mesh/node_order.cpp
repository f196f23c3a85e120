#include "core/mesh/node_order.h"

#include <algorithm>

namespace morula {
namespace {

/// Neighbours of every node in increasing order.
std::vector<std::vector<std::uint32_t>> neighbours_of_nodes(std::uint32_t node_count, std::span<const Triangle> faces) {
  std::vector<std::vector<std::uint32_t>> neighbours(node_count);
  for (const Triangle& face : faces)
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t a = face[static_cast<std::size_t>(c)], b = face[static_cast<std::size_t>((c + 1) % 3)];
      neighbours[a].push_back(b);
      neighbours[b].push_back(a);
    }
  for (auto& list : neighbours) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return neighbours;
}

}  // namespace

std::vector<std::uint32_t> near_neighbour_order(std::uint32_t node_count, std::span<const Triangle> faces) {
  const auto neighbours = neighbours_of_nodes(node_count, faces);
  const auto by_degree = [&](std::uint32_t a, std::uint32_t b) {
    return neighbours[a].size() != neighbours[b].size() ? neighbours[a].size() < neighbours[b].size() : a < b;
  };
  std::vector<std::uint32_t> starts(node_count);
  for (std::uint32_t node = 0; node < node_count; ++node) starts[node] = node;
  std::ranges::sort(starts, by_degree);

  std::vector<std::uint32_t> visited_in_order;
  visited_in_order.reserve(node_count);
  std::vector<char> seen(node_count, 0);
  for (const std::uint32_t start : starts) {
    if (seen[start]) continue;
    seen[start] = 1;
    visited_in_order.push_back(start);
    for (std::size_t head = visited_in_order.size() - 1; head < visited_in_order.size(); ++head) {
      std::vector<std::uint32_t> next;
      for (const std::uint32_t node : neighbours[visited_in_order[head]])
        if (!seen[node]) next.push_back(node);
      std::ranges::sort(next, by_degree);
      for (const std::uint32_t node : next) {
        seen[node] = 1;
        visited_in_order.push_back(node);
      }
    }
  }

  std::vector<std::uint32_t> new_number(node_count);
  for (std::uint32_t i = 0; i < node_count; ++i) new_number[visited_in_order[i]] = node_count - 1 - i;
  return new_number;
}

TriangleMesh with_near_neighbour_order(const TriangleMesh& mesh) {
  const auto new_number = near_neighbour_order(static_cast<std::uint32_t>(mesh.position.size()), mesh.faces);
  TriangleMesh out{std::vector<Vec3d>(mesh.position.size()), mesh.faces};
  for (std::size_t node = 0; node < mesh.position.size(); ++node) out.position[new_number[node]] = mesh.position[node];
  for (Triangle& face : out.faces) {
    for (std::uint32_t& node : face) node = new_number[node];
    std::ranges::rotate(face, std::ranges::min_element(face));
  }
  std::ranges::sort(out.faces);
  return out;
}

}  // namespace morula
