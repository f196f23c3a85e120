#include "coupling/surroundings.h"

namespace morula {
namespace {

std::span<const Vec3d> nodes_of(const Scene& scene, std::size_t shell) {
  return std::span(scene.position()).subspan(scene.first_node()[shell], scene.first_node()[shell + 1] - scene.first_node()[shell]);
}

Box box_of(std::span<const Vec3d> nodes) {
  Box out;
  for (const Vec3d& x : nodes) out.include(x);
  return out;
}

}  // namespace

Surroundings surroundings_of(const Scene& scene, const Space& space, std::size_t shell, double reach) {
  Surroundings out;
  const Box own = box_of(nodes_of(scene, shell)).inflated(reach);
  for (std::size_t other = 0; other < scene.shells(); ++other) {
    if (other == shell) continue;
    const auto nodes = nodes_of(scene, other);
    const Box box = box_of(nodes);
    const Vec3d away = box.center() - own.center(), shift = space.nearest_image(away) - away;
    if (!own.overlaps({box.low + shift, box.high + shift})) continue;
    if (norm2(shift) == 0.0) {
      out.surfaces.push_back({nodes, scene.topologies()[other]});
      continue;
    }
    std::vector<Vec3d>& moved = out.moved.emplace_back();
    for (const Vec3d& x : nodes) moved.push_back(x + shift);
    out.surfaces.push_back({moved, scene.topologies()[other]});
  }
  return out;
}

void add_obstacles(std::span<const RigidSurface> obstacles, std::span<const Vec3d> offset, const Space& space, std::span<const Vec3d> shell,
                   double reach, Surroundings& around) {
  const Box own = box_of(shell).inflated(reach);
  for (std::size_t o = 0; o < obstacles.size(); ++o)
    for_images(obstacles[o], offset[o], space, own, [&](const SurfaceImage& image) {
      const Box box = obstacles[o].tree->bounds();
      const Vec3d way = offset[o] + image.shift;
      if (!own.overlaps({box.low + way, box.high + way})) return;
      std::vector<Vec3d>& moved = around.moved.emplace_back(obstacles[o].position);
      for (Vec3d& x : moved) x += way;
      around.surfaces.push_back({moved, obstacles[o].topology.get()});
    });
}

}  // namespace morula
