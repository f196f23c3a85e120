#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/parallel/comm.h"
#include "core/parallel/order_free_sum.h"
#include "core/vec3.h"
#include "coupling/mechanics/scene.h"
#include "dcm/shells.h"

namespace morula {

/// Nodes, shell by shell.
template <class Node>
struct NodesByShell {
  std::vector<Node> nodes;
  std::vector<std::uint32_t> shells, ends;  ///< shells that have nodes here, and where those of each end

  void add(std::uint32_t shell, const Node& node) {
    if (shells.empty() || shells.back() != shell) shells.push_back(shell), ends.push_back(0);
    nodes.push_back(node);
    ends.back() = static_cast<std::uint32_t>(nodes.size());
  }
  /// function(shell, node) in order.
  template <class F>
  void for_each(F&& function) const {
    std::size_t n = 0;
    for (std::size_t s = 0; s < shells.size(); ++s)
      for (; n < ends[s]; ++n) function(shells[s], nodes[n]);
  }
  [[nodiscard]] std::size_t memory() const {
    return nodes.capacity() * sizeof(Node) + (shells.capacity() + ends.capacity()) * sizeof(std::uint32_t);
  }
};

/// A node of marked faces.
struct MarkedNode {
  std::uint32_t node;
  double area;  ///< A: a third of the marked areas around it [µm²]
};

/// The owned nodes of faces with a mark, at the shells' positions.
NodesByShell<MarkedNode> marked_nodes(const dcm::Shells& shells, int mark);

/// Which owned shells move.
std::vector<char> moving_shells(const Scene& scene);

/// Of length 1; zero where there is none.
inline Vec3d direction(const Vec3d& from) {
  const double length = norm(from);
  return length > 0.0 ? from * (1.0 / length) : Vec3d{};
}

/// Σ terms(node) over the nodes of all ranks: in fixed order within a shell, order-free over shells. Collective.
template <std::size_t N, class Node, class Terms>
std::array<double, N> total(const NodesByShell<Node>& list, const Comm& comm, const Terms& terms) {
  std::array<OrderFreeSum, N> sums;
  std::size_t k = 0;
  for (const std::size_t end : list.ends) {
    std::array<double, N> of_shell{};
    for (; k < end; ++k) {
      const std::array<double, N> more = terms(list.nodes[k]);
      for (std::size_t n = 0; n < N; ++n) of_shell[n] += more[n];
    }
    for (std::size_t n = 0; n < N; ++n) sums[n].add(of_shell[n]);
  }
  std::array<double, N> out;
  comm.sum(sums, out);
  return out;
}

}  // namespace morula
