#include "core/mesh/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace morula {
namespace {

constexpr std::uint32_t kLeafFaces = 4;
/// Splitting at the median halves the number of faces: 2^32 faces are 32 levels deep.
constexpr std::size_t kStack = 64;

double distance2_to_box(const Vec3d& p, const Box& box) {
  const double dx = std::max({box.low.x - p.x, p.x - box.high.x, 0.0});
  const double dy = std::max({box.low.y - p.y, p.y - box.high.y, 0.0});
  const double dz = std::max({box.low.z - p.z, p.z - box.high.z, 0.0});
  return dx * dx + dy * dy + dz * dz;
}

}  // namespace

TriangleTree::TriangleTree(std::span<const Vec3d> position, std::span<const Triangle> faces)
    : position_(position.begin(), position.end()), faces_(faces.begin(), faces.end()), order_(faces.size()) {
  std::vector<Vec3d> centers(faces_.size());
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    order_[f] = f;
    centers[f] = box_of(f).center();
  }
  nodes_.reserve(faces_.size());
  if (!faces_.empty()) build(0, static_cast<std::uint32_t>(faces_.size()), centers);
  const Box all = bounds();
  if (!all.empty())
    for (std::size_t axis = 0; axis < 3; ++axis)
      rounding_ = std::max({rounding_, 1e-14 * std::abs(all.low[axis]), 1e-14 * std::abs(all.high[axis])});
}

Box TriangleTree::box_of(std::uint32_t face) const {
  Box box;
  for (const std::uint32_t node : faces_[face]) {
    assert(node < position_.size());
    box.include(position_[node]);
  }
  return box;
}

void TriangleTree::build(std::uint32_t begin, std::uint32_t end, std::span<const Vec3d> centers) {
  const std::size_t self = nodes_.size();
  nodes_.emplace_back();
  Box box, box_of_centers;
  for (std::uint32_t n = begin; n < end; ++n) {
    box.include(box_of(order_[n]));
    box_of_centers.include(centers[order_[n]]);
  }
  nodes_[self].box = box;
  if (end - begin <= kLeafFaces) {
    nodes_[self].begin = begin;
    nodes_[self].count = end - begin;
    return;
  }
  const Vec3d size = box_of_centers.size();
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  // Ties by face number: the two halves are the same on every machine.
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](std::uint32_t a, std::uint32_t b) {
    return centers[a][axis] != centers[b][axis] ? centers[a][axis] < centers[b][axis] : a < b;
  });
  build(begin, middle, centers);
  nodes_[self].begin = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end, centers);
}

void TriangleTree::faces_in(const Box& box, std::vector<std::uint32_t>& found) const {
  found.clear();
  if (nodes_.empty()) return;
  std::array<std::uint32_t, kStack> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t number = stack[--depth];
    const Node& node = nodes_[number];
    if (!node.box.overlaps(box)) continue;
    if (node.count == 0) {
      stack[depth++] = node.begin;
      stack[depth++] = number + 1;
      continue;
    }
    for (std::uint32_t n = node.begin; n < node.begin + node.count; ++n)
      if (box_of(order_[n]).overlaps(box)) found.push_back(order_[n]);
  }
  std::sort(found.begin(), found.end());
}

std::vector<std::uint32_t> TriangleTree::faces_in(const Box& box) const {
  std::vector<std::uint32_t> found;
  faces_in(box, found);
  return found;
}

std::optional<NearestFace> TriangleTree::nearest(const Vec3d& p, double cutoff) const {
  if (nodes_.empty() || !(cutoff >= 0.0)) return std::nullopt;
  std::optional<NearestFace> best;
  double best2 = cutoff * cutoff;
  // Boxes are left out only when rounding cannot bring their faces to a tie with the best one.
  const double margin = rounding_ + 1e-14 * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const auto limit2 = [&] {
    const double limit = std::sqrt(best2) * (1.0 + 1e-12) + margin;
    return limit * limit;
  };
  double prune2 = limit2();

  struct Waiting {
    std::uint32_t node;
    double distance2;
  };
  std::array<Waiting, kStack> stack;
  std::size_t depth = 0;
  stack[depth++] = {0, distance2_to_box(p, nodes_[0].box)};
  while (depth > 0) {
    const Waiting next = stack[--depth];
    if (next.distance2 > prune2) continue;
    const Node& node = nodes_[next.node];
    if (node.count == 0) {
      Waiting nearer{next.node + 1, distance2_to_box(p, nodes_[next.node + 1].box)};
      Waiting farther{node.begin, distance2_to_box(p, nodes_[node.begin].box)};
      if (farther.distance2 < nearer.distance2) std::swap(nearer, farther);
      stack[depth++] = farther;
      stack[depth++] = nearer;
      continue;
    }
    for (std::uint32_t n = node.begin; n < node.begin + node.count; ++n) {
      const std::uint32_t face = order_[n];
      const auto& [a, b, c] = faces_[face];
      const ClosestPoint closest = closest_point_on_triangle(p, position_[a], position_[b], position_[c]);
      const bool better =
          best ? closest.distance2 < best2 || (closest.distance2 == best2 && face < best->face) : closest.distance2 <= best2;
      if (!better) continue;
      best = NearestFace{face, closest};
      best2 = closest.distance2;
      prune2 = limit2();
    }
  }
  return best;
}

}  // namespace morula
