#include "core/mesh/self_intersection.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Intersections_3/Segment_3_Triangle_3.h>
#include <CGAL/Intersections_3/Triangle_3_Triangle_3.h>

#include <algorithm>

#include "core/mesh/triangle_tree.h"

namespace morula {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

Point exact(const Vec3d& p) { return {p.x, p.y, p.z}; }

/// Two faces with their corners turned so that the shared nodes come first, in the same order in both.
struct FacePair {
  std::array<Point, 3> a, b;
  int shared = 0;
};

FacePair arranged(const PlacedFace& a, const PlacedFace& b) {
  std::array<std::size_t, 3> first{}, second{};  // corners of both, shared ones first
  std::size_t shared = 0;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t d = 0; d < 3; ++d)
      if (a.node[c] == b.node[d]) first[shared] = c, second[shared] = d, ++shared;
  const auto rest = [&](std::array<std::size_t, 3>& corners) {
    std::size_t n = shared;
    for (std::size_t c = 0; c < 3; ++c)
      if (std::find(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(shared), c) ==
          corners.begin() + static_cast<std::ptrdiff_t>(shared))
        corners[n++] = c;
  };
  rest(first);
  rest(second);
  FacePair out;
  out.shared = static_cast<int>(shared);
  for (std::size_t c = 0; c < 3; ++c) {
    out.a[c] = exact(a.corner[first[c]]);
    out.b[c] = exact(b.corner[second[c]]);
  }
  return out;
}

bool meet_elsewhere(const FacePair& pair) {
  const auto& [a, b, shared] = pair;
  const Kernel::Triangle_3 triangle_a(a[0], a[1], a[2]), triangle_b(b[0], b[1], b[2]);
  if (shared == 0) return CGAL::do_intersect(triangle_a, triangle_b);
  // What two convex faces with a common node share besides it reaches the side opposite to that node in one of them.
  if (shared == 1)
    return CGAL::do_intersect(Kernel::Segment_3(a[1], a[2]), triangle_b) || CGAL::do_intersect(Kernel::Segment_3(b[1], b[2]), triangle_a);
  // Two faces at an edge share more than it only when folded flat onto each other.
  if (shared == 2)
    return CGAL::orientation(a[0], a[1], a[2], b[2]) == CGAL::COPLANAR &&
           CGAL::coplanar_orientation(a[0], a[1], a[2], b[2]) == CGAL::POSITIVE;
  return false;
}

bool is_collinear(const PlacedFace& face) { return exactly_collinear(face.corner[0], face.corner[1], face.corner[2]); }

}  // namespace

bool faces_meet(const PlacedFace& a, const PlacedFace& b) { return !is_collinear(a) && !is_collinear(b) && meet_elsewhere(arranged(a, b)); }

bool exactly_collinear(const Vec3d& a, const Vec3d& b, const Vec3d& c) { return CGAL::collinear(exact(a), exact(b), exact(c)); }

std::vector<std::pair<std::uint32_t, std::uint32_t>> find_self_intersections(std::span<const Vec3d> position,
                                                                             std::span<const Triangle> faces, std::size_t most) {
  std::vector<char> usable(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f)
    usable[f] = !exactly_collinear(position[faces[f][0]], position[faces[f][1]], position[faces[f][2]]);

  const auto placed = [&](std::uint32_t f) {
    return PlacedFace{faces[f], {position[faces[f][0]], position[faces[f][1]], position[faces[f][2]]}};
  };
  const TriangleTree tree(position, faces);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  std::vector<std::uint32_t> near;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    if (!usable[f]) continue;
    Box box;
    for (const std::uint32_t node : faces[f]) box.include(position[node]);
    tree.faces_in(box, near);
    for (const std::uint32_t other : near) {
      if (other <= f || !usable[other] || !meet_elsewhere(arranged(placed(f), placed(other)))) continue;
      if (found.size() == most) return found;
      found.emplace_back(f, other);
    }
  }
  return found;
}

}  // namespace morula
