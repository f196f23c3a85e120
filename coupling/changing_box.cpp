#include "coupling/changing_box.h"

#include <cmath>
#include <optional>

#include "coupling/regions/region.h"

namespace morula {

Box box_at(const Box& of_study, const TimeCourse& volume, double time) {
  if (volume.empty()) return of_study;
  const Vec3d center = of_study.center(), half = of_study.size() * (0.5 * std::cbrt(volume.at(time)));
  return {center - half, center + half};
}

void carry(Tissue& tissue, const Box& from, const Box& to) {
  const Vec3d center = from.center(), there = to.center();
  const double stretch = to.size().x / from.size().x;
  const auto move = [&](Vec3d& p) { p = there + (p - center) * stretch; };
  for (Vec3d& p : tissue.spheres.position) move(p);
  for (Vec3d& p : tissue.shells.position) move(p);
  for (Vec3d& p : tissue.nuclei.shells.position) move(p);
  for (std::optional<Vec3d>& nucleus : tissue.shells.nucleus)
    if (nucleus) move(*nucleus);
}

double longest_carried_step(const TimeCourse& volume, double time, double until, double radius, double allowed) {
  const double now = volume.at(time), change = std::abs(volume.at(until) - now);
  return change > 0.0 ? 3.0 * allowed * now / (radius * change) * (until - time) : kNever;
}

}  // namespace morula
