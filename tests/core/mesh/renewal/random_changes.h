#pragma once
#include <gtest/gtest.h>

#include <optional>

#include "core/mesh/remesh.h"
#include "core/mesh/renewal/change_guard.h"
#include "core/mesh/renewal/local_changes.h"
#include "core/mesh/self_intersection.h"
#include "tests/core/mesh/renewal/deformed_shapes.h"

namespace morula {

/// A random deformed sphere of 42 or 162 nodes.
inline TestSurface random_surface(std::mt19937_64& engine) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double stretch = 1.0 + 1.5 * unit(engine), height = 0.3 * unit(engine), phase = 6.0 * unit(engine);
  return moved_sphere(unit(engine) < 0.5 ? 1 : 2, [&](const Vec3d& x) {
    const double bump = 1.0 + height * std::sin(3.0 * x.x + phase) * std::cos(2.5 * x.y - phase);
    return Vec3d{x.x * stretch, x.y / std::sqrt(stretch), x.z / std::sqrt(stretch)} * bump;
  });
}

/// Any change at any edge.
inline std::optional<MeshChange> random_change(const LiveMesh& mesh, std::mt19937_64& engine) {
  const auto edges = mesh.edges();
  const auto [a, b] = edges[engine() % edges.size()];
  const Vec3d pa = mesh.position(a), pb = mesh.position(b), middle = (pa + pb) * 0.5;
  switch (engine() % 4) {
    case 0:
      return split_edge(mesh, a, b);
    case 1:
      return flip_edge(mesh, a, b);
    case 2:
      return collapse_edge(mesh, a, b, middle);
    default:
      return slide_node(mesh, a, pa + (pb - pa) * 0.2);
  }
}

/// V − E + F of a mesh whose every edge has two faces.
inline int euler_number(const TriangleMesh& mesh) {
  const int faces = static_cast<int>(mesh.faces.size());
  return static_cast<int>(mesh.position.size()) - faces * 3 / 2 + faces;
}

inline double volume_of(const TriangleMesh& mesh) {
  return enclosed_volume(mesh.faces, mesh.position, volume_centroid(mesh.faces, mesh.position));
}

/// Random changes, where nothing is against them, on as many random surfaces, and what must hold of each result. How many changes were made.
inline std::size_t check_random_sequences(int sequences, std::uint64_t seed) {
  constexpr int kTries = 60;
  std::mt19937_64 engine(seed);
  std::size_t made = 0;
  for (int sequence = 0; sequence < sequences; ++sequence) {
    SCOPED_TRACE(sequence);
    const TestSurface start = random_surface(engine);
    const AskedSurface surface(start.view());
    if (!find_self_intersections(start.position, start.topology->faces(), 1).empty()) continue;
    const double area = surface.area();
    ChangeGuard guard(surface, {}, {.edge = edge_of_nodes(area, start.topology->node_count()), .area_change = 0.01});
    LiveMesh mesh(start.view());
    for (int k = 0; k < kTries; ++k) {
      const auto change = random_change(mesh, engine);
      if (!change) continue;
      EXPECT_LE(std::abs(volume_change(mesh, *change)), 1e-12 * start.volume()) << "of one change";
      if (guard.judge(mesh, *change) != ChangeRefusal::kNone) continue;
      guard.made();
      mesh.apply(*change);
      ++made;
    }
    const TriangleMesh end = mesh.mesh();
    EXPECT_EQ(end.position.size(), mesh.node_count());
    const auto topology = Topology::build(static_cast<std::uint32_t>(end.position.size()), end.faces);
    EXPECT_TRUE(topology.ok()) << "closed, oriented, every node with one ring";
    EXPECT_EQ(euler_number(end), 2) << "no handles, one piece";
    EXPECT_NEAR(volume_of(end) / start.volume(), 1.0, 1e-10) << "of all changes";
    EXPECT_LE(std::abs(surface_area(end) / area - 1.0), 0.0101);
    EXPECT_NEAR(surface_area(end) - area, guard.area_change(), 1e-9 * area);
    EXPECT_TRUE(find_self_intersections(end.position, end.faces, 1).empty());
    EXPECT_GE(least_quality(end.faces, end.position), std::min(0.2, least_quality(start.topology->faces(), start.position)) - 1e-12);
  }
  return made;
}

}  // namespace morula
