#pragma once
#include <cmath>
#include <map>
#include <utility>

#include "results/snapshot.h"

namespace morula::scenarios::test {

/// Unit icosphere: an icosahedron whose faces are split in four `levels` times.
inline std::pair<std::vector<Vec3d>, std::vector<Triangle>> icosphere(int levels) {
  const double t = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vec3d> x{{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                       {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
  std::vector<Triangle> faces{{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                              {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                              {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (Vec3d& p : x) p = normalized(p);
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(x.size()));
      if (fresh) x.push_back(normalized(x[a] + x[b]));
      return place->second;
    };
    std::vector<Triangle> finer;
    for (const Triangle& f : faces) {
      const auto a = middle(f[0], f[1]), b = middle(f[1], f[2]), c = middle(f[2], f[0]);
      for (const Triangle& g : {Triangle{f[0], a, c}, Triangle{f[1], b, a}, Triangle{f[2], c, b}, Triangle{a, b, c}}) finer.push_back(g);
    }
    faces = std::move(finer);
  }
  return {x, faces};
}

inline void add_sphere(Snapshot& snapshot, const Vec3d& center, double radius) {
  Snapshot::Cell cell;
  cell.id = CellId::founder(snapshot.cells.size() + 1);
  cell.centroid = center;
  cell.radius = radius;
  snapshot.cells.push_back(cell);
}

/// A round shell with 2562 nodes.
inline void add_shell(Snapshot& snapshot, const Vec3d& center, double radius) {
  const auto [x, faces] = icosphere(4);
  add_sphere(snapshot, center, radius);
  snapshot.cells.back().body = BodyKind::kShell;
  if (snapshot.topologies.empty()) snapshot.topologies.push_back(faces);
  snapshot.shells.push_back({static_cast<std::uint32_t>(snapshot.cells.size() - 1), static_cast<std::uint32_t>(snapshot.nodes.size()),
                             static_cast<std::uint32_t>(x.size()), 0});
  for (const Vec3d& p : x) snapshot.nodes.push_back(center + p * radius);
}

}  // namespace morula::scenarios::test
