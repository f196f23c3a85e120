#include "core/mesh/surface_geometry.h"

#include <algorithm>

#include "core/mesh/lane_surface.h"
#include "core/parallel/threads.h"

namespace morula {
namespace {

struct Workspace {
  LaneVector<double> position, face_normal, face_area, node_normal, node_area, node_length;
  LaneVector<double> gradient_face, gradient_face_normal, gradient_node, node_gradient;

  static void fit(LaneVector<double>& array, std::size_t size) {
    if (array.size() < size) array.resize(size);
  }
};

double* doubles(Vec3d* v) { return &v->x; }
const double* doubles(const Vec3d* v) { return &v->x; }

/// Total area and volume of every lane to the output; lanes are summed face by face in the order of the Topology.
template <int W>
void block_geometry(const LaneBlock& block, const SurfaceList& surfaces, std::span<const Vec3d> position, SurfaceGeometry& out,
                    Workspace& ws) noexcept {
  using Real = Lane<double, W>;
  const Topology& topology = *block.topology;
  const std::size_t nodes = topology.node_count(), faces = topology.face_count();
  Workspace::fit(ws.position, nodes * 3 * W);
  Workspace::fit(ws.node_length, nodes * W);
  Workspace::fit(ws.face_normal, faces * 3 * W);
  Workspace::fit(ws.face_area, faces * W);
  ws.node_normal.assign(nodes * 3 * W, 0.0);
  ws.node_area.assign(nodes * W, 0.0);
  double *const x = ws.position.data(), *const normal = ws.node_normal.data(), *const node_area = ws.node_area.data();
  load_relative_positions<W>(block, lane_pointers<W>(doubles(position.data()), block, surfaces.first_node, 3), x);

  Real volume(0.0), area_sum(0.0);
  const auto triangles = topology.faces();
  for (std::size_t f = 0; f < faces; ++f) {
    const Triangle& t = triangles[f];
    const auto x0 = load_vec3<double, W>(x, t[0]);
    const auto twice = cross(load_vec3<double, W>(x, t[1]) - x0, load_vec3<double, W>(x, t[2]) - x0);
    const Real length = norm(twice);
    const Real area = length * 0.5;
    store_vec3<double, W>(ws.face_normal.data(), f, twice * (Real(1.0) / length));
    area.store(ws.face_area.data() + f * W);
    area_sum += area;
    volume += dot(x0, twice);
    const auto vector_area = twice * Real(0.5);
    for (const std::uint32_t node : t) {
      add_vec3<double, W>(normal, node, vector_area);
      (load_scalar<double, W>(node_area, node) + area * (1.0 / 3.0)).store(node_area + node * W);
    }
  }
  for (std::size_t i = 0; i < nodes; ++i) {
    const auto sum = load_vec3<double, W>(normal, i);
    const Real length = norm(sum);
    length.store(ws.node_length.data() + i * W);
    store_vec3<double, W>(normal, i, sum * (Real(1.0) / length));
  }
  if (!out.face_area.empty()) {
    store_lanes<W, double>(ws.face_area.data(), faces, lane_pointers<W>(out.face_area.data(), block, surfaces.first_face));
    store_lanes<W, double>(ws.face_normal.data(), 3 * faces,
                           lane_pointers<W>(doubles(out.face_normal.data()), block, surfaces.first_face, 3));
  }
  store_lanes<W, double>(normal, 3 * nodes, lane_pointers<W>(doubles(out.node_normal.data()), block, surfaces.first_node, 3));
  store_lanes<W, double>(ws.node_length.data(), nodes, lane_pointers<W>(out.node_normal_length.data(), block, surfaces.first_node));
  store_lanes<W, double>(node_area, nodes, lane_pointers<W>(out.node_area.data(), block, surfaces.first_node));
  for (int lane = 0; lane < block.count; ++lane) {
    out.volume[block.member[lane]] = volume[lane] * (1.0 / 6.0);
    out.area[block.member[lane]] = area_sum[lane];
  }
}

template <int W>
void block_forces(const LaneBlock& block, const SurfaceList& surfaces, std::span<const Vec3d> position, const SurfaceGeometry& geometry,
                  const SurfaceGradient& gradient, std::span<Vec3d> force, Workspace& ws) noexcept {
  using Real = Lane<double, W>;
  const Topology& topology = *block.topology;
  const std::size_t nodes = topology.node_count(), faces = topology.face_count();
  for (LaneVector<double>* array : {&ws.position, &ws.node_normal, &ws.gradient_node, &ws.node_gradient})
    Workspace::fit(*array, nodes * 3 * W);
  Workspace::fit(ws.gradient_face_normal, faces * 3 * W);
  Workspace::fit(ws.gradient_face, faces * W);
  Workspace::fit(ws.node_length, nodes * W);

  const auto by_face = [&](const double* array, std::size_t stride, LaneVector<double>& out) {
    load_lanes<W, double>(lane_pointers<W>(array, block, surfaces.first_face, stride), faces * stride, out.data());
  };
  const auto by_node = [&](const double* array, std::size_t stride, LaneVector<double>& out) {
    load_lanes<W, double>(lane_pointers<W>(array, block, surfaces.first_node, stride), nodes * stride, out.data());
  };
  load_relative_positions<W>(block, lane_pointers<W>(doubles(position.data()), block, surfaces.first_node, 3), ws.position.data());
  by_node(doubles(geometry.node_normal.data()), 3, ws.node_normal);
  by_node(geometry.node_normal_length.data(), 1, ws.node_length);
  by_face(gradient.face_area.data(), 1, ws.gradient_face);
  if (gradient.face_normal.empty())
    std::fill_n(ws.gradient_face_normal.data(), faces * 3 * W, 0.0);
  else
    by_face(doubles(gradient.face_normal.data()), 3, ws.gradient_face_normal);
  by_node(doubles(gradient.node_normal.data()), 3, ws.gradient_node);

  double* const g = ws.gradient_node.data();  // ½ ∂E/∂G_v
  for (std::size_t i = 0; i < nodes; ++i) {
    const auto n = load_vec3<double, W>(ws.node_normal.data(), i);
    const auto h = load_vec3<double, W>(g, i);
    store_vec3<double, W>(g, i, (h - n * dot(n, h)) * (Real(0.5) / load_scalar<double, W>(ws.node_length.data(), i)));
  }
  double* const out = ws.node_gradient.data();
  by_node(&std::as_const(*force.data()).x, 3, ws.node_gradient);
  const double* const x = ws.position.data();
  const auto triangles = topology.faces();
  for (std::size_t f = 0; f < faces; ++f) {
    const Triangle& t = triangles[f];
    const auto x0 = load_vec3<double, W>(x, t[0]), x1 = load_vec3<double, W>(x, t[1]), x2 = load_vec3<double, W>(x, t[2]);
    const auto twice = cross(x1 - x0, x2 - x0);
    const Real inverse = Real(1.0) / norm(twice);  // 1 / (2 A)
    const auto n = twice * inverse;
    const auto h = load_vec3<double, W>(ws.gradient_face_normal.data(), f);
    const auto w = (load_vec3<double, W>(g, t[0]) + load_vec3<double, W>(g, t[1]) + load_vec3<double, W>(g, t[2])) +
                   n * (load_scalar<double, W>(ws.gradient_face.data(), f) * 0.5) + (h - n * dot(n, h)) * inverse;
    const auto f0 = cross(x2 - x1, w), f1 = cross(x0 - x2, w);
    add_vec3<double, W>(out, t[0], f0);
    add_vec3<double, W>(out, t[1], f1);
    add_vec3<double, W>(out, t[2], -(f0 + f1));
  }
  store_lanes<W, double>(out, 3 * nodes, lane_pointers<W>(doubles(force.data()), block, surfaces.first_node, 3));
}

/// Run `kernel<W>(block, workspace)` for every block, in parallel.
template <class Kernel>
void for_each_block(int threads, std::span<const LaneBlock> blocks, const Kernel& kernel) {
  parallel_for_with<Workspace>(threads, blocks.size(), [&](std::size_t b, Workspace& ws) {
    switch (blocks[b].lanes) {
      case 8:
        return kernel.template operator()<8>(blocks[b], ws);
      case 4:
        return kernel.template operator()<4>(blocks[b], ws);
      default:
        return kernel.template operator()<1>(blocks[b], ws);
    }
  });
}

}  // namespace

namespace {

void compute(const SurfaceList& surfaces, std::span<const LaneBlock> blocks, std::span<const Vec3d> position, bool with_faces,
             SurfaceGeometry& geometry) {
  const std::size_t count = surfaces.topology.size();
  const std::size_t faces = !with_faces || count == 0 ? 0 : surfaces.first_face[count];
  geometry.face_area.resize(faces);
  geometry.face_normal.resize(faces);
  geometry.node_normal.assign(position.size(), Vec3d{});
  geometry.node_normal_length.assign(position.size(), 0.0);
  geometry.node_area.assign(position.size(), 0.0);
  geometry.volume.resize(count);
  geometry.area.resize(count);
  for_each_block(surfaces.threads, blocks,
                 [&]<int W>(const LaneBlock& block, Workspace& ws) { block_geometry<W>(block, surfaces, position, geometry, ws); });
}

}  // namespace

void compute_surface_geometry(const SurfaceList& surfaces, std::span<const LaneBlock> blocks, std::span<const Vec3d> position,
                              SurfaceGeometry& geometry) {
  compute(surfaces, blocks, position, true, geometry);
}

void compute_surface_geometry(const SurfaceList& surfaces, std::span<const Vec3d> position, SurfaceGeometry& geometry) {
  compute(surfaces, group_by_topology(surfaces.topology), position, true, geometry);
}

void compute_node_geometry(const SurfaceList& surfaces, std::span<const Vec3d> position, SurfaceGeometry& geometry) {
  compute(surfaces, group_by_topology(surfaces.topology), position, false, geometry);
}

void add_surface_forces(const SurfaceList& surfaces, std::span<const LaneBlock> blocks, std::span<const Vec3d> position,
                        const SurfaceGeometry& geometry, const SurfaceGradient& gradient, std::span<Vec3d> force) {
  for_each_block(surfaces.threads, blocks, [&]<int W>(const LaneBlock& block, Workspace& ws) {
    block_forces<W>(block, surfaces, position, geometry, gradient, force, ws);
  });
}

void add_surface_forces(const SurfaceList& surfaces, std::span<const Vec3d> position, const SurfaceGeometry& geometry,
                        const SurfaceGradient& gradient, std::span<Vec3d> force) {
  add_surface_forces(surfaces, group_by_topology(surfaces.topology), position, geometry, gradient, force);
}

}  // namespace morula
