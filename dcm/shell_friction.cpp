#include "dcm/shell_friction.h"

#include <algorithm>

#include "core/mesh/lane_surface.h"
#include "dcm/lane_parameters.h"
#include "dcm/laws/edge_damper.h"
#include "dcm/laws/medium_friction.h"
#include "dcm/laws/volume_pressure.h"

namespace morula::dcm {
namespace {

struct Workspace {
  LaneVector<double> input, output, start;
};

/// Unit vectors along the edges of the step's start, from positions in lanes.
template <int W>
Vec3<Lane<double, W>> direction_of(const double* start, const Edge& edge) noexcept {
  return normalized(load_vec3<double, W>(start, edge.j) - load_vec3<double, W>(start, edge.i));
}

/// u = ∂V/∂x = Σ N/6 and η_V/V. Positions are in `ws.input`.
template <int W>
void compute_bulk_friction(const LaneBlock& block, const Shells& shells, const ShellMaterials& materials, ShellFriction::Block& out,
                           const Workspace& ws) noexcept {
  using Real = Lane<double, W>;
  const Topology& topology = *block.topology;
  out.volume_gradient.assign(topology.node_count() * std::size_t{3} * W, 0.0);
  Real six_volumes(0.0);
  for (const Triangle& t : topology.faces()) {
    const auto x0 = load_vec3<double, W>(ws.input.data(), t[0]);
    const auto n = cross(load_vec3<double, W>(ws.input.data(), t[1]) - x0, load_vec3<double, W>(ws.input.data(), t[2]) - x0);
    six_volumes += dot(x0, n);
    for (const std::uint32_t node : t) add_vec3<double, W>(out.volume_gradient.data(), node, n * Real(1.0 / 6.0));
  }
  for (int lane = 0; lane < W; ++lane) {
    const BulkViscosity law{materials.of(shells, block.member[lane]).bulk_viscosity};
    const double volume = six_volumes[lane] / 6.0;
    out.bulk_friction[lane] = volume > 0.0 ? law.friction(volume) : 0.0;
  }
}

template <int W>
void compute_block(const LaneBlock& block, const Shells& shells, const ShellMaterials& materials, std::span<const Vec3d> position,
                   std::span<const double> node_area, ShellFriction::Block& out, Workspace& ws) noexcept {
  using Real = Lane<double, W>;
  const Topology& topology = *block.topology;
  const std::size_t nodes = topology.node_count();
  out.medium.resize(nodes * W);
  load_lanes<W, double>(lane_pointers<W>(node_area.data(), block, shells.first_node), nodes, out.medium.data());
  const MediumFriction<Real> medium{parameter<double, W>(block, shells, materials, &ShellParameters::medium_friction)};
  for (std::size_t i = 0; i < nodes; ++i) medium.coefficient(load_scalar<double, W>(out.medium.data(), i)).store(out.medium.data() + i * W);
  for (int lane = 0; lane < LaneBlock::kMaxLanes; ++lane) {
    const ShellParameters& p = materials.of(shells, block.member[lane]);
    out.damping[lane] = p.edge_damping;
    out.isotropic_damping[lane] = p.isotropic_damping;
  }
  out.isotropic = any_has<W>(block, shells, materials, &ShellParameters::isotropic_damping);
  if (any_has<W>(block, shells, materials, &ShellParameters::bulk_viscosity)) {
    ws.input.resize(nodes * 3 * W);
    load_relative_positions<W>(block, lane_pointers<W>(&position.data()->x, block, shells.first_node, 3), ws.input.data());
    compute_bulk_friction<W>(block, shells, materials, out, ws);
  } else {
    out.volume_gradient.clear();
  }
}

template <int W>
Lane<double, W> add_isotropic_dampers(const ShellFriction::Block& friction, std::span<const Edge> edges, const double* d,
                                      double* y) noexcept {
  using Real = Lane<double, W>;
  const IsotropicDamper<Real> damper{Real::load(friction.isotropic_damping.data())};
  Real sum(0.0);
  for (const Edge& edge : edges) {
    const auto relative = load_vec3<double, W>(d, edge.i) - load_vec3<double, W>(d, edge.j);
    const auto force = damper.force(relative);
    sum -= dot(relative, force);
    add_vec3<double, W>(y, edge.i, -force);
    add_vec3<double, W>(y, edge.j, force);
  }
  return sum;
}

template <int W>
Lane<double, W> add_bulk_viscosity(const ShellFriction::Block& friction, std::size_t nodes, const double* d, double* y) noexcept {
  using Real = Lane<double, W>;
  const auto u = [&](std::size_t i) { return load_vec3<double, W>(friction.volume_gradient.data(), i); };
  Real change(0.0);
  for (std::size_t i = 0; i < nodes; ++i) change += dot(u(i), load_vec3<double, W>(d, i));
  const Real pressure = Real::load(friction.bulk_friction.data()) * change;
  for (std::size_t i = 0; i < nodes; ++i) add_vec3<double, W>(y, i, u(i) * pressure);
  return pressure * change;
}

/// y = Γ_n d, both in lanes; `start` holds the positions of the step's start. Gives dᵀΓ_n d.
template <int W>
Lane<double, W> apply_block(const Topology& topology, const ShellFriction::Block& friction, const double* start, const double* d,
                            double* y) noexcept {
  using Real = Lane<double, W>;
  const std::size_t nodes = topology.node_count();
  Real sum(0.0);
  for (std::size_t i = 0; i < nodes; ++i) {
    const auto di = load_vec3<double, W>(d, i);
    const auto drag = di * load_scalar<double, W>(friction.medium.data(), i);
    sum += dot(di, drag);
    store_vec3<double, W>(y, i, drag);
  }
  const EdgeDamper<Real> damper{Real::load(friction.damping.data())};
  for (const Edge& edge : topology.edges()) {
    const auto relative = load_vec3<double, W>(d, edge.i) - load_vec3<double, W>(d, edge.j);
    const auto force = damper.force(direction_of<W>(start, edge), relative);
    sum -= dot(relative, force);
    add_vec3<double, W>(y, edge.i, -force);
    add_vec3<double, W>(y, edge.j, force);
  }
  if (friction.isotropic) sum += add_isotropic_dampers<W>(friction, topology.edges(), d, y);
  if (!friction.volume_gradient.empty()) sum += add_bulk_viscosity<W>(friction, nodes, d, y);
  return sum;
}

/// What a block is given: displacements, or positions, then the friction is added to the result.
enum class Given { kDisplacement, kPosition };

template <int W, Given kGiven>
void friction_of_block(const LaneBlock& block, const Shells& shells, const ShellFriction& friction, std::size_t number,
                       std::span<const Vec3d> given, std::span<Vec3d> result, std::span<double> quadratic, Workspace& ws) noexcept {
  const std::size_t count = block.topology->node_count() * std::size_t{3};
  for (LaneVector<double>* array : {&ws.input, &ws.output, &ws.start}) array->resize(std::max(array->size(), count * W));
  const auto lanes = [&](std::span<const Vec3d> v) { return lane_pointers<W>(&v.data()->x, block, shells.first_node, 3); };
  double *const d = ws.input.data(), *const y = ws.output.data(), *const start = ws.start.data();
  const auto each = [&](const auto& function) {
    for (std::size_t i = 0; i < count * W; i += W) function(i);
  };
  using Real = Lane<double, W>;
  load_lanes<W, double>(lanes(given), count, d);
  if constexpr (kGiven == Given::kPosition) {
    load_lanes<W, double>(lanes(friction.start), count, start);
    each([&](std::size_t i) { (Real::load(d + i) - Real::load(start + i)).store(d + i); });
  }
  load_relative_positions<W>(block, lanes(friction.start), start);
  const auto sum = apply_block<W>(*block.topology, friction.blocks[number], start, d, y);
  if constexpr (kGiven == Given::kPosition) {
    load_lanes<W, double>(lanes(result), count, d);
    each([&](std::size_t i) { (Real::load(d + i) + Real::load(y + i)).store(y + i); });
  }
  store_lanes<W, double>(y, count, lane_pointers<W>(&result.data()->x, block, shells.first_node, 3));
  for (int lane = 0; lane < block.count; ++lane) quadratic[block.member[lane]] = sum[lane];
}

}  // namespace

void compute_shell_friction(const ShellBlocks& blocks, const Shells& shells, const ShellMaterials& materials,
                            std::span<const Vec3d> position, std::span<const double> node_area, ShellFriction& out) {
  out.blocks.resize(blocks.blocks.size());
  out.start = position;
  for_each_block<Workspace>(blocks, [&]<int W>(std::size_t b, const LaneBlock& block, Workspace& ws) {
    compute_block<W>(block, shells, materials, position, node_area, out.blocks[b], ws);
  });
}

void friction_times_displacement(const ShellBlocks& blocks, const Shells& shells, const ShellFriction& friction,
                                 std::span<const Vec3d> displacement, std::span<Vec3d> result, std::span<double> quadratic) {
  for_each_block<Workspace>(blocks, [&]<int W>(std::size_t b, const LaneBlock& block, Workspace& ws) {
    friction_of_block<W, Given::kDisplacement>(block, shells, friction, b, displacement, result, quadratic, ws);
  });
}

void add_friction_of_motion(const ShellBlocks& blocks, const Shells& shells, const ShellFriction& friction, std::span<const Vec3d> position,
                            std::span<Vec3d> result, std::span<double> quadratic) {
  for_each_block<Workspace>(blocks, [&]<int W>(std::size_t b, const LaneBlock& block, Workspace& ws) {
    friction_of_block<W, Given::kPosition>(block, shells, friction, b, position, result, quadratic, ws);
  });
}

}  // namespace morula::dcm
