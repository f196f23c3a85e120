#include "coupling/approaching_obstacles.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/ball.h"
#include "core/parallel/threads.h"
#include "coupling/neighbourhoods.h"

namespace morula {
namespace {

constexpr double kDepth = 0.1;    // of the radius: so much deeper may an obstacle come within a step
constexpr double kKept = 0.5;     // of its distance from the centre, which it keeps
constexpr double kLeast = 0.05;   // of the radius: so far it may go at any rate, where a cell lies in it already
constexpr int kMostStrides = 64;  // along an obstacle that slides past; the step then ends there

double distance_of(const RigidSurface& surface, const Vec3d& p, double cutoff) {
  const auto near = surface.tree->nearest(p, cutoff);
  return near ? std::sqrt(near->closest.distance2) : cutoff;
}

/// How far a surface may go along `direction`, up to `most`, until it is nearer to p than the ball around p allows: in strides that no point of it can cross [µm].
double free_way(const RigidSurface& surface, const Vec3d& p, double radius, const Vec3d& direction, double most) {
  double distance = distance_of(surface, p, radius + most);
  const double touch = std::min(radius, distance);
  const double nearest = std::max(touch - kDepth * radius, kKept * touch);
  double way = 0.0;
  for (int k = 0; k < kMostStrides; ++k) {
    const double stride = distance - nearest;
    if (stride <= 1e-3 * radius) return std::max(way, kLeast * radius);
    way += stride;
    if (way >= most) return most;
    distance = distance_of(surface, p - direction * way, radius + (most - way));
  }
  return way;
}

}  // namespace

double longest_step_of_obstacles(const Model& model, const Tissue& tissue, std::span<const RigidSurface> obstacles, double until,
                                 int threads, const Comm& comm) {
  if (std::ranges::none_of(model.obstacles, &ObstacleSpec::moves)) return kNever;
  const double now = tissue.clock.time;
  double out = kNever;
  std::vector<BodyOfRow> bodies;
  for (const BodyOfRow& body : bodies_of(tissue.cells)) bodies.push_back(body);
  for (std::size_t o = 0; o < model.obstacles.size(); ++o) {  // walls of the domain come after them, and stand
    const Vec3d way = model.obstacles[o].way(now, until);
    const double length = norm(way);
    if (!(length > 0.0)) continue;
    const Vec3d direction = way * (1.0 / length);
    const double left_over = parallel_max(threads, bodies.size(), [&](std::size_t k) {  // of the way, what this cell forbids
      const double radius = ball_radius(tissue.cells.rows[bodies[k].row].target_volume);
      if (length <= kLeast * radius) return 0.0;
      const Vec3d center = center_of(tissue, bodies[k]);
      const Box around = Box{center, center}.inflated(radius + length);
      double free = length;
      for_images(obstacles[o], tissue.obstacle_offset[o], model.space, around, [&](const SurfaceImage& image) {
        free = std::min(free, free_way(obstacles[o], center - (tissue.obstacle_offset[o] + image.shift), radius, direction, length));
      });
      return length - free;
    });
    if (left_over > 0.0) out = std::min(out, (until - now) * (1.0 - left_over / length));
  }
  return comm.min(out);
}

}  // namespace morula
