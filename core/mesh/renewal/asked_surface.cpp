#include "core/mesh/renewal/asked_surface.h"

#include <algorithm>
#include <cmath>

#include "core/mesh/pseudonormal.h"

namespace morula {
namespace {

ClosestPoint closest_on(const SurfaceView& surface, const Vec3d& p, std::uint32_t face) {
  const auto& [a, b, c] = surface.topology->faces()[face];
  return closest_point_on_triangle(p, surface.position[a], surface.position[b], surface.position[c]);
}

}  // namespace

NearestFace walk_to_nearest(const SurfaceView& surface, const Vec3d& p, std::uint32_t start) {
  const Topology& topology = *surface.topology;
  NearestFace best{start, closest_on(surface, p, start)};
  for (;;) {
    NearestFace next = best;
    const auto try_face = [&](std::uint32_t face) {
      if (const ClosestPoint closest = closest_on(surface, p, face); closest.distance2 < next.closest.distance2) next = {face, closest};
    };
    const auto feature = static_cast<std::size_t>(best.closest.feature);
    if (best.closest.feature == TriangleFeature::kFace) return best;
    if (best.closest.feature < TriangleFeature::kVertex0) {
      const Edge& edge = topology.edges()[topology.face_edges()[best.face][feature - static_cast<std::size_t>(TriangleFeature::kEdge0)]];
      try_face(edge.left == best.face ? edge.right : edge.left);
    } else {
      const std::uint32_t node = topology.faces()[best.face][feature - static_cast<std::size_t>(TriangleFeature::kVertex0)];
      for (const std::uint32_t face : topology.faces_of_node(node)) try_face(face);
    }
    // Nearer by more than rounding, so that the walk comes to an end.
    if (!(next.closest.distance2 < best.closest.distance2 * (1.0 - 1e-12))) return best;
    best = next;
  }
}

Result<AskedSurface> AskedSurface::build(const TriangleMesh& mesh) {
  MORULA_TRY_ASSIGN(auto topology, Topology::build(static_cast<std::uint32_t>(mesh.position.size()), mesh.faces));
  return AskedSurface(std::move(topology), mesh.position);
}

AskedSurface::AskedSurface(std::shared_ptr<const Topology> topology, std::vector<Vec3d> position)
    : AskedSurface(SurfaceView{position, topology.get()}) {
  owned_ = std::move(topology);
}

AskedSurface::AskedSurface(const SurfaceView& surface)
    : topology_(surface.topology),
      position_(surface.position.begin(), surface.position.end()),
      tree_(surface.position, surface.topology->faces()) {
  normals_.reserve(faces().size());
  for (const Triangle& face : faces()) {
    normals_.push_back(unit_face_normal(face, position_));
    area_ += 0.5 * norm(cross(position_[face[1]] - position_[face[0]], position_[face[2]] - position_[face[0]]));
  }
}

NearestFace AskedSurface::nearest(const Vec3d& p, std::uint32_t near) const {
  const NearestFace walked = walk(p, near);
  const auto found = tree_.nearest(p, std::sqrt(walked.closest.distance2) * (1.0 + 1e-12));
  return found ? *found : walked;
}

std::vector<SurfaceSample> sample_surface(const SurfaceView& surface, double spacing, bool nodes_and_edges) {
  const Topology& topology = *surface.topology;
  std::vector<SurfaceSample> out;
  for (std::uint32_t f = 0; f < topology.face_count(); ++f) {
    const auto& [na, nb, nc] = topology.faces()[f];
    const Vec3d a = surface.position[na], ab = surface.position[nb] - a, ac = surface.position[nc] - a;
    const double longest2 = std::max({norm2(ab), norm2(ac), norm2(ac - ab)});
    const int parts = std::max(1, static_cast<int>(std::ceil(std::sqrt(longest2) / spacing)));
    const double area = 0.5 * norm(cross(ab, ac)) / (parts * parts), step = 1.0 / (3.0 * parts);
    const auto add = [&](int i, int j) { out.push_back({a + ab * (i * step) + ac * (j * step), f, area}); };
    for (int i = 0; i < parts; ++i)
      for (int j = 0; i + j < parts; ++j) {
        add(3 * i + 1, 3 * j + 1);
        if (i + j + 1 < parts) add(3 * i + 2, 3 * j + 2);
      }
  }
  if (!nodes_and_edges) return out;
  for (std::uint32_t n = 0; n < topology.node_count(); ++n) out.push_back({surface.position[n], topology.faces_of_node(n)[0], 0.0});
  for (const Edge& edge : topology.edges()) out.push_back({(surface.position[edge.i] + surface.position[edge.j]) * 0.5, edge.left, 0.0});
  return out;
}

SurfaceDistance surface_distance(const AskedSurface& first, const AskedSurface& second, double spacing) {
  double squares = 0.0, areas = 0.0;
  const auto one_way = [&](const AskedSurface& from, const AskedSurface& to) {
    double largest2 = 0.0;
    std::uint32_t hint = 0;
    for (const SurfaceSample& sample : sample_surface(from.view(), spacing, true)) {
      const NearestFace foot = to.nearest(sample.point, hint);
      hint = foot.face;
      largest2 = std::max(largest2, foot.closest.distance2);
      squares += sample.area * foot.closest.distance2;
      areas += sample.area;
    }
    return std::sqrt(largest2);
  };
  SurfaceDistance out;
  out.from = one_way(first, second);
  out.to = one_way(second, first);
  out.rms = std::sqrt(squares / areas);
  return out;
}

Result<SurfaceAmongWalls> SurfaceAmongWalls::of(const SurfaceView& surface, std::span<const SurfaceView> walls) {
  const auto faces = surface.topology->faces();
  const Vec3d center = volume_centroid(faces, surface.position);
  const double volume = enclosed_volume(faces, surface.position, center);
  if (!(volume > 0.0) || !std::isfinite(volume))
    return Error{ErrorKind::kInput, "the surface encloses no volume", "its faces must point outwards"};
  return SurfaceAmongWalls{AskedSurface(surface), {walls.begin(), walls.end()}, center, volume};
}

std::vector<const AskedSurface*> SurfaceAmongWalls::walls() const {
  std::vector<const AskedSurface*> out;
  for (const AskedSurface& one : around) out.push_back(&one);
  return out;
}

}  // namespace morula
