#include "core/mesh/mesh_sides.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

namespace morula {
namespace {

/// Sets that can be united; the lowest member represents its set.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t of(std::uint32_t member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = of(a);
    b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

bool names_a_node_twice(const Triangle& face) { return face[0] == face[1] || face[1] == face[2] || face[2] == face[0]; }

}  // namespace

MeshSides::MeshSides(std::span<const Triangle> faces) : face_count_(faces.size()) {
  std::vector<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, bool>> all;
  all.reserve(3 * faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    if (names_a_node_twice(faces[f])) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = faces[f][c], b = faces[f][(c + 1) % 3];
      all.emplace_back(std::min(a, b), std::max(a, b), f, a < b);
    }
  }
  std::ranges::sort(all);
  sides_.reserve(all.size());
  for (const auto& [low, high, face, forward] : all) sides_.push_back({face, forward});
  for (std::size_t begin = 0; begin < all.size();) {
    std::size_t end = begin;
    const std::uint32_t low = std::get<0>(all[begin]), high = std::get<1>(all[begin]);
    while (end < all.size() && std::get<0>(all[end]) == low && std::get<1>(all[end]) == high) ++end;
    edges_.push_back({low, high, std::span<const Side>(sides_).subspan(begin, end - begin)});
    begin = end;
  }
}

std::vector<MeshSides::Border> MeshSides::borders(std::uint32_t node_count) const {
  Sets nodes(node_count);
  for (const Edge& edge : edges_)
    if (edge.sides.size() == 1) nodes.unite(edge.low, edge.high);
  std::map<std::uint32_t, Border> by_lowest_node;
  for (const Edge& edge : edges_) {
    if (edge.sides.size() != 1) continue;
    Border& border = by_lowest_node[nodes.of(edge.low)];
    border.nodes.insert(border.nodes.end(), {edge.low, edge.high});
    border.faces.push_back(edge.sides[0].face);
    ++border.edge_count;
  }
  std::vector<Border> out;
  const auto make_unique = [](std::vector<std::uint32_t>& list) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  };
  for (auto& [node, border] : by_lowest_node) {
    make_unique(border.nodes);
    make_unique(border.faces);
    out.push_back(std::move(border));
  }
  return out;
}

std::vector<MeshSides::PinchedNode> MeshSides::pinched_nodes(std::uint32_t node_count) const {
  // Every (node, face) is a member; faces at an edge are united at both of its nodes.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> corners;
  for (const Edge& edge : edges_)
    for (const Side& side : edge.sides)
      for (const std::uint32_t node : {edge.low, edge.high}) corners.emplace_back(node, side.face);
  std::ranges::sort(corners);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  const auto member = [&](std::uint32_t node, std::uint32_t face) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(corners, std::pair(node, face)) - corners.begin());
  };
  Sets fans(corners.size());
  for (const Edge& edge : edges_)
    for (std::size_t n = 1; n < edge.sides.size(); ++n)
      for (const std::uint32_t node : {edge.low, edge.high}) fans.unite(member(node, edge.sides[0].face), member(node, edge.sides[n].face));

  std::vector<PinchedNode> out;
  std::size_t begin = 0;
  for (std::uint32_t node = 0; node < node_count; ++node) {
    std::size_t end = begin;
    bool pinched = false;
    for (; end < corners.size() && corners[end].first == node; ++end)
      pinched |= fans.of(static_cast<std::uint32_t>(end)) != fans.of(static_cast<std::uint32_t>(begin));
    if (pinched) {
      out.push_back({node, {}});
      for (std::size_t n = begin; n < end; ++n) out.back().faces.push_back(corners[n].second);
    }
    begin = end;
  }
  return out;
}

OrientedParts orient_parts(const MeshSides& sides, std::span<const Triangle> faces) {
  struct Neighbour {
    std::uint32_t face;
    bool opposed;  ///< walks along the common edge in the same direction
  };
  std::vector<std::vector<Neighbour>> neighbours(faces.size());
  std::vector<char> whole(faces.size(), 1);
  for (std::uint32_t f = 0; f < faces.size(); ++f) whole[f] = !names_a_node_twice(faces[f]);
  for (const MeshSides::Edge& edge : sides.edges()) {
    if (edge.sides.size() != 2) {
      for (const MeshSides::Side& side : edge.sides) whole[side.face] = 0;
      continue;
    }
    const auto &a = edge.sides[0], &b = edge.sides[1];
    neighbours[a.face].push_back({b.face, a.forward == b.forward});
    neighbours[b.face].push_back({a.face, a.forward == b.forward});
  }

  OrientedParts out;
  constexpr auto kNone = static_cast<std::uint32_t>(-1);
  out.part.assign(faces.size(), kNone);
  out.flipped.assign(faces.size(), 0);
  for (std::uint32_t start = 0; start < faces.size(); ++start) {
    if (out.part[start] != kNone) continue;
    const std::uint32_t part = out.count++;
    out.closed.push_back(1);
    out.part[start] = part;
    std::vector<std::uint32_t> members = {start};
    std::size_t against = 0;
    bool orientable = true;
    for (std::size_t n = 0; n < members.size(); ++n) {
      const std::uint32_t face = members[n];
      against += static_cast<std::size_t>(out.flipped[face]);
      if (!whole[face]) out.closed[part] = 0;
      for (const Neighbour& next : neighbours[face]) {
        const char wanted = static_cast<char>(out.flipped[face] != static_cast<char>(next.opposed));
        if (out.part[next.face] == kNone) {
          out.part[next.face] = part;
          out.flipped[next.face] = wanted;
          members.push_back(next.face);
        } else if (orientable && out.flipped[next.face] != wanted) {
          orientable = false;
          out.contradictions.emplace_back(face, next.face);
        }
      }
    }
    if (!orientable) out.closed[part] = 0;
    const bool swap = 2 * against > members.size();
    for (const std::uint32_t face : members)
      out.flipped[face] = static_cast<char>(orientable && out.flipped[face] != static_cast<char>(swap));
  }

  std::vector<char> listed(faces.size(), 0);
  for (std::uint32_t start = 0; start < faces.size(); ++start) {
    if (!out.flipped[start] || listed[start]) continue;
    std::vector<std::uint32_t> patch = {start};
    listed[start] = 1;
    for (std::size_t n = 0; n < patch.size(); ++n)
      for (const Neighbour& next : neighbours[patch[n]])
        if (out.flipped[next.face] && !listed[next.face]) {
          listed[next.face] = 1;
          patch.push_back(next.face);
        }
    std::ranges::sort(patch);
    out.flipped_patches.push_back(std::move(patch));
  }
  return out;
}

}  // namespace morula
