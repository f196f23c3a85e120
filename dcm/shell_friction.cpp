#include "dcm/shell_friction.h"

#include "core/mesh/lane_surface.h"
#include "dcm/lane_parameters.h"
#include "dcm/laws/edge_damper.h"
#include "dcm/laws/medium_friction.h"

namespace morula::dcm {
namespace {

struct Workspace {
  LaneVector<double> input, output;
};

template <int W>
void compute_block(const LaneBlock& block, const Shells& shells, std::span<const ShellParameters> types, std::span<const Vec3d> position,
                   std::span<const double> node_area, ShellFriction::Block& out, Workspace& ws) noexcept {
  using Real = Lane<double, W>;
  const Topology& topology = *block.topology;
  const std::size_t nodes = topology.node_count(), edges = topology.edge_count();
  ws.input.resize(nodes * 3 * W);
  out.direction.resize(edges * 3 * W);
  out.medium.resize(nodes * W);
  load_relative_positions<W>(block, lane_pointers<W>(&position.data()->x, block, shells.first_node, 3), ws.input.data());
  for (std::size_t k = 0; k < edges; ++k) {
    const Edge& edge = topology.edges()[k];
    const auto e = load_vec3<double, W>(ws.input.data(), edge.j) - load_vec3<double, W>(ws.input.data(), edge.i);
    store_vec3<double, W>(out.direction.data(), k, normalized(e));
  }
  load_lanes<W, double>(lane_pointers<W>(node_area.data(), block, shells.first_node), nodes, out.medium.data());
  const MediumFriction<Real> medium{parameter<double, W>(block, shells, types, &ShellParameters::medium_friction)};
  for (std::size_t i = 0; i < nodes; ++i) medium.coefficient(load_scalar<double, W>(out.medium.data(), i)).store(out.medium.data() + i * W);
  for (int lane = 0; lane < LaneBlock::kMaxLanes; ++lane) out.damping[lane] = types[shells.type[block.member[lane]]].edge_damping;
}

template <int W>
void apply_block(const LaneBlock& block, const Shells& shells, const ShellFriction::Block& friction, std::span<const Vec3d> displacement,
                 std::span<Vec3d> result, std::span<double> quadratic, Workspace& ws) noexcept {
  using Real = Lane<double, W>;
  const Topology& topology = *block.topology;
  const std::size_t nodes = topology.node_count(), edges = topology.edge_count();
  ws.input.resize(nodes * 3 * W);
  ws.output.resize(nodes * 3 * W);
  double *const d = ws.input.data(), *const y = ws.output.data();
  load_lanes<W, double>(lane_pointers<W>(&displacement.data()->x, block, shells.first_node, 3), nodes * 3, d);
  Real sum(0.0);
  for (std::size_t i = 0; i < nodes; ++i) {
    const auto di = load_vec3<double, W>(d, i);
    const auto drag = di * load_scalar<double, W>(friction.medium.data(), i);
    sum += dot(di, drag);
    store_vec3<double, W>(y, i, drag);
  }
  const EdgeDamper<Real> damper{Real::load(friction.damping.data())};
  for (std::size_t k = 0; k < edges; ++k) {
    const Edge& edge = topology.edges()[k];
    const auto relative = load_vec3<double, W>(d, edge.i) - load_vec3<double, W>(d, edge.j);
    const auto force = damper.force(load_vec3<double, W>(friction.direction.data(), k), relative);
    sum -= dot(relative, force);
    add_vec3<double, W>(y, edge.i, -force);
    add_vec3<double, W>(y, edge.j, force);
  }
  store_lanes<W, double>(y, nodes * 3, lane_pointers<W>(&result.data()->x, block, shells.first_node, 3));
  for (int lane = 0; lane < block.count; ++lane) quadratic[block.member[lane]] = sum[lane];
}

}  // namespace

void compute_shell_friction(const ShellBlocks& blocks, const Shells& shells, std::span<const ShellParameters> types,
                            std::span<const Vec3d> position, std::span<const double> node_area, ShellFriction& out) {
  out.blocks.resize(blocks.blocks.size());
  for_each_block<Workspace>(blocks, [&]<int W>(std::size_t b, const LaneBlock& block, Workspace& ws) {
    compute_block<W>(block, shells, types, position, node_area, out.blocks[b], ws);
  });
}

void friction_times_displacement(const ShellBlocks& blocks, const Shells& shells, const ShellFriction& friction,
                                 std::span<const Vec3d> displacement, std::span<Vec3d> result, std::span<double> quadratic) {
  for_each_block<Workspace>(blocks, [&]<int W>(std::size_t b, const LaneBlock& block, Workspace& ws) {
    apply_block<W>(block, shells, friction.blocks[b], displacement, result, quadratic, ws);
  });
}

}  // namespace morula::dcm
