#include "coupling/mechanics/common_way.h"

#include <cmath>

#include "core/parallel/bounded_sums.h"
#include "core/parallel/threads.h"

namespace morula {
namespace {

constexpr std::int64_t kFewest = 1000;
using Sums = BoundedSums<21>;

Sums::Terms terms_of(const Vec3d& x, const Vec3d& u) {
  return {x.x,       x.y,       x.z,       u.x,       u.y,       u.z,       x.x * x.x, x.x * x.y, x.x * x.z, x.y * x.y, x.y * x.z,
          x.z * x.z, x.x * u.x, x.y * u.x, x.z * u.x, x.x * u.y, x.y * u.y, x.z * u.y, x.x * u.z, x.y * u.z, x.z * u.z};
}

DriftSums drift_sums(double count, const Sums::Terms& t) {
  return {count,
          {t[0], t[1], t[2]},
          {t[3], t[4], t[5]},
          {t[6], t[7], t[8], t[9], t[10], t[11]},
          {{t[12], t[13], t[14]}, {t[15], t[16], t[17]}, {t[18], t[19], t[20]}}};
}

}  // namespace

CommonDrift common_way_of_spheres(const Workspace& work, const std::function<Vec3d(std::uint32_t)>& way_of_point) {
  const Scene& scene = work.scene;
  const Comm& comm = work.setting.comm;
  const std::size_t spheres = scene.owned_spheres();
  if (work.setting.model.space.any_periodic() || !work.setting.model.obstacles.empty()) return {};
  const std::int64_t count = comm.sum(static_cast<std::int64_t>(spheres));
  if (count < kFewest) return {};
  const int threads = work.setting.threads;
  const auto place = [&](std::size_t i) { return scene.position()[scene.sphere_point() + i]; };
  const auto way = [&](std::size_t i) { return way_of_point(static_cast<std::uint32_t>(scene.sphere_point() + i)); };
  const double furthest = std::sqrt(comm.max(parallel_max(threads, spheres, [&](std::size_t i) { return norm2(place(i)); })));
  const double most = std::sqrt(comm.max(parallel_max(threads, spheres, [&](std::size_t i) { return norm2(way(i)); })));
  const Sums none(terms_of({furthest, furthest, furthest}, {most, most, most}));
  return drift_of(
      drift_sums(static_cast<double>(count), totals_of(
                                                 none, threads, spheres, [&](std::size_t i) { return terms_of(place(i), way(i)); }, comm)));
}

}  // namespace morula
