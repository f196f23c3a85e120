#pragma once
#include <cmath>
#include <numbers>
#include <ostream>
#include <random>
#include <vector>

#include "core/mesh/surface_geometry.h"
#include "core/mesh/topology.h"
#include "dcm/blocks.h"
#include "dcm/builtin.h"
#include "dcm/internal_forces.h"
#include "dcm/shell_friction.h"
#include "dcm/shells.h"

namespace morula::dcm {

/// Names of parametrised tests in the runner's list.
inline void PrintTo(const ShellLaw& law, std::ostream* out) { *out << law.info.name; }

}  // namespace morula::dcm

namespace morula::dcm::testing {

inline double sphere_volume(double radius) { return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; }

inline std::shared_ptr<const ReferenceShape> icosphere(std::uint32_t nodes) {
  static ShapeLibrary library;
  return library.icosphere(nodes).value();
}

/// Append a shell: its reference shape at the rest volume, moved to `center`.
inline void add_shell(Shells& shells, std::shared_ptr<const ReferenceShape> shape, double volume, Vec3d center = {},
                      std::uint16_t type = 0) {
  const double size = std::cbrt(volume);
  for (const Vec3d& x : shape->position) shells.position.push_back(center + size * x);
  for (const double length : shape->edge_length) shells.rest_length.push_back(size * length);
  shells.velocity.resize(shells.position.size());
  shells.first_node.push_back(static_cast<std::uint32_t>(shells.position.size()));
  shells.first_edge.push_back(static_cast<std::uint32_t>(shells.rest_length.size()));
  shells.reference_volume.push_back(volume);
  shells.rest_volume.push_back(volume);
  shells.type.push_back(type);
  shells.shape.push_back(std::move(shape));
}

inline Shells one_shell(std::uint32_t nodes, double radius = 6.0) {
  Shells shells;
  add_shell(shells, icosphere(nodes), sphere_volume(radius));
  return shells;
}

/// Cells of different meshes, sizes and types, their surfaces roughened: what a lane batch has to get right.
inline Shells rough_shells(double noise = 0.12) {
  Shells shells;
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  for (int cell = 0; cell < 15; ++cell) {
    const double radius = 5.0 + 0.1 * cell;
    add_shell(shells, icosphere(cell % 5 == 3 ? 42 : 162), sphere_volume(radius), {13.0 * cell, 2.0 * cell, -cell * 1.0},
              static_cast<std::uint16_t>(cell % 2));
  }
  for (Vec3d& x : shells.position) x += noise * Vec3d{normal(engine), normal(engine), normal(engine)};
  return shells;
}

inline ShellMechanics mechanics(const Shells& shells, const std::vector<ShellParameters>& types, std::span<const Vec3d> position,
                                int lanes = LaneBlock::kMaxLanes) {
  ShellMechanics out;
  internal_forces(make_shell_blocks(shells, lanes), shells, types, position, out);
  return out;
}

/// Parameters with which no law acts.
inline ShellParameters nothing() {
  ShellParameters p;
  p.spring_stiffness = p.edge_damping = p.hinge_stiffness = p.tension = p.bulk_modulus = p.shape_stiffness = p.barrier_stiffness =
      p.medium_friction = 0.0;
  return p;
}

/// The area ratio of all sheets of a shell.
inline void set_area_ratio(ShellParameters& p, double ratio) {
  for (Sheet& sheet : p.sheets) sheet.coefficient[1] = ratio;
}

inline SurfaceGeometry geometry_of(const Shells& shells, const ShellBlocks& blocks, std::span<const Vec3d> position) {
  std::vector<const Topology*> topology;
  for (const auto& shape : shells.shape) topology.push_back(shape->topology.get());
  SurfaceGeometry out;
  compute_surface_geometry({topology, shells.first_node, blocks.first_face}, position, out);
  return out;
}

inline ShellFriction friction_of(const Shells& shells, const ShellBlocks& blocks, const std::vector<ShellParameters>& types,
                                 std::span<const Vec3d> position) {
  ShellFriction out;
  compute_shell_friction(blocks, shells, types, position, geometry_of(shells, blocks, position).node_area, out);
  return out;
}

inline std::vector<Vec3d> random_vectors(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::vector<Vec3d> out(count);
  for (Vec3d& v : out) v = {normal(engine), normal(engine), normal(engine)};
  return out;
}

inline double dot(std::span<const Vec3d> a, std::span<const Vec3d> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += morula::dot(a[i], b[i]);
  return sum;
}

inline double norm(std::span<const Vec3d> a) { return std::sqrt(dot(a, a)); }

inline std::vector<Vec3d> moved(std::span<const Vec3d> x, std::span<const Vec3d> direction, double step) {
  std::vector<Vec3d> out(x.begin(), x.end());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += step * direction[i];
  return out;
}

inline double sum(const std::vector<double>& values) {
  double total = 0.0;
  for (const double value : values) total += value;
  return total;
}

}  // namespace morula::dcm::testing
