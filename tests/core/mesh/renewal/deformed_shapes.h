#pragma once
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "core/mesh/icosphere.h"
#include "core/mesh/renewal/surface_view.h"

namespace morula {

/// A closed surface of a test.
struct TestSurface {
  std::shared_ptr<const Topology> topology;
  std::vector<Vec3d> position;
  [[nodiscard]] SurfaceView view() const { return {position, topology.get()}; }
  [[nodiscard]] TriangleMesh mesh() const { return {position, {topology->faces().begin(), topology->faces().end()}}; }
  [[nodiscard]] double volume() const { return enclosed_volume(topology->faces(), position, volume_centroid(topology->faces(), position)); }
};

/// An icosphere of radius 7 µm, each of whose nodes is moved by `moved`; level 2: 162 nodes, 3: 642.
template <class Moved>
TestSurface moved_sphere(int level, const Moved& moved) {
  TriangleMesh mesh = make_icosphere(level);
  TestSurface out;
  for (const Vec3d& x : mesh.position) out.position.push_back(moved(x) * 7.0);
  const auto nodes = static_cast<std::uint32_t>(mesh.position.size());
  out.topology = Topology::build(nodes, std::move(mesh.faces)).value();
  return out;
}

inline TestSurface sphere(int level) {
  return moved_sphere(level, [](const Vec3d& x) { return x; });
}
inline TestSurface ellipsoid(int level, const Vec3d& axes) {
  return moved_sphere(level, [&](const Vec3d& x) { return Vec3d{x.x * axes.x, x.y * axes.y, x.z * axes.z}; });
}
/// Waves of this height on the sphere, in places that `phase` chooses.
inline TestSurface bumpy(int level, double height, double phase) {
  return moved_sphere(level, [&](const Vec3d& x) {
    return x * (1.0 + height * std::sin(3.0 * x.x + phase) * std::cos(2.5 * x.y - phase) * std::cos(2.0 * x.z + 2.0 * phase));
  });
}
/// A sphere between two plates: flat above and below height ±h of its radius, and as much wider. The edges of its flat parts lie in planes.
inline TestSurface flattened(int level, double h) {
  return moved_sphere(level, [&](const Vec3d& x) {
    const double widen = 1.0 / std::sqrt(h);
    return Vec3d{x.x * widen, x.y * widen, std::clamp(1.6 * x.z, -1.0, 1.0) * h};
  });
}
/// Two balls with a neck of this radius between them (of 1), along z.
inline TestSurface dumbbell(int level, double neck) {
  return moved_sphere(level, [&](const Vec3d& x) {
    const double z = x.z, waist = neck + (1.0 - neck) * std::min(1.0, 2.0 * std::abs(z));
    return Vec3d{x.x * waist, x.y * waist, 1.8 * z};
  });
}

inline Vec3d random_direction(std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  Vec3d d;
  do d = {normal(engine), normal(engine), normal(engine)};
  while (!(norm(d) > 1e-3));
  return normalized(d);
}

}  // namespace morula
