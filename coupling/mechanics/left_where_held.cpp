#include "coupling/mechanics/left_where_held.h"

#include <cmath>

namespace morula {

double left_where_held(const Workspace& work, const Tissue& tissue, std::span<const Vec3d> residual) {
  const Scene& scene = work.scene;
  const ContactLayer& layer = work.terms.contacts->layer();
  const std::vector<Vec3d> ways = layer.obstacle_ways();
  const auto has_moved = [&](std::uint32_t obstacle) { return norm2(ways[obstacle]) > 0.0; };
  std::vector<char> touched(scene.bodies().size(), 0), held(scene.bodies().size(), 0);
  OrderFreeSum squares[2];  // of the residual, of the forces
  for (const SurfacePair& pair : layer.pairs())
    if (pair.rigid && scene.bodies()[pair.a].owned && has_moved(pair.b) && norm2(pair.push) > 0.0) touched[pair.a] = 1;
  work.terms.spheres->for_pushed_obstacles([&](std::uint32_t sphere, std::uint32_t obstacle, const Vec3d& force) {
    if (!has_moved(obstacle) || norm2(force) == 0.0) return;
    touched[scene.first_sphere() + sphere] = 1;
    squares[1].add(norm2(force));
  });
  work.terms.grips->for_springs(work.world(tissue), [&](std::uint32_t body, const Vec3d& pull) {
    if (scene.bodies()[body].active()) held[body] = 1, squares[1].add(norm2(pull));
  });
  const std::vector<Vec3d>& of_surfaces = work.terms.contacts->found().force;
  for (std::size_t b = 0; b < touched.size(); ++b) {
    const ContactBody& body = scene.bodies()[b];
    if ((touched[b] == 0 && held[b] == 0) || !body.active()) continue;
    for (std::uint32_t i = body.first_point; i < body.first_point + body.point_count; ++i) {
      squares[0].add(norm2(residual[i]));
      if (touched[b] != 0 && body.shape == BodyShape::kSurface) squares[1].add(norm2(of_surfaces[i]));
    }
  }
  double totals[2];
  work.setting.comm.sum(squares, totals);
  return totals[1] > 0.0 ? std::sqrt(totals[0] / totals[1]) : 0.0;
}

}  // namespace morula
