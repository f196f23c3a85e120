#include "core/mesh/surface_overlap.h"

#include <algorithm>
#include <memory>

#include "core/mesh/mesh_check.h"
#include "core/mesh/pseudonormal.h"
#include "core/mesh/triangle_tree.h"

namespace morula {

std::vector<SurfaceOverlap> find_overlaps(std::span<const TriangleMesh> surfaces) {
  struct Side {
    std::shared_ptr<const Topology> topology;
    std::unique_ptr<TriangleTree> tree;
  };
  std::vector<Side> sides(surfaces.size());
  std::vector<Box> box(surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    for (const Vec3d& p : surfaces[i].position) box[i].include(p);
  std::vector<SurfaceOverlap> out;
  for (std::size_t a = 0; a < surfaces.size(); ++a)
    for (std::size_t b = 0; b < surfaces.size(); ++b) {
      if (a == b || !box[a].overlaps(box[b])) continue;
      if (!sides[b].tree) {
        auto topology = Topology::build(static_cast<std::uint32_t>(surfaces[b].position.size()), surfaces[b].faces);
        if (!topology.ok()) continue;  // no closed surface: nothing is inside
        sides[b] = {std::move(topology).value(), std::make_unique<TriangleTree>(surfaces[b].position, surfaces[b].faces)};
      }
      std::vector<SurfaceOverlap> inside;
      for (std::uint32_t node = 0; node < surfaces[a].position.size(); ++node) {
        const Vec3d& p = surfaces[a].position[node];
        if (!box[b].contains(p)) continue;
        const auto nearest = sides[b].tree->nearest(p);
        const double depth = nearest ? -signed_distance(*sides[b].topology, surfaces[b].position, p, nearest->face, nearest->closest) : 0.0;
        if (depth > 0.0) inside.push_back({a, b, node, nearest->face, depth, p});
      }
      std::sort(inside.begin(), inside.end(),
                [](const SurfaceOverlap& l, const SurfaceOverlap& r) { return l.depth != r.depth ? l.depth > r.depth : l.node < r.node; });
      // Near a fold of the surface the side of a node is not to be trusted: it must be wound around, too.
      const auto deepest = std::find_if(inside.begin(), inside.end(), [&](const SurfaceOverlap& one) {
        return winding_number(surfaces[b].position, surfaces[b].faces, one.place) > 0.5;
      });
      if (deepest != inside.end()) out.push_back(*deepest);
    }
  return out;
}

}  // namespace morula
