// Cost of the shell kernels, in ns per node. Run with OMP_NUM_THREADS=1 for the figures per core.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/mesh/surface_geometry.h"
#include "dcm/builtin.h"
#include "dcm/internal_forces.h"
#include "dcm/shell_operator.h"

namespace morula::dcm {
namespace {

/// Rough cells of 162 nodes: arguments are the number of cells and the lane width.
struct Bed {
  Shells shells;
  std::vector<ShellParameters> types{1};
  std::vector<const Topology*> topology;
  ShellBlocks blocks;
  SurfaceGeometry geometry;
  ShellFriction friction;
  ShellOperator matrix;
  std::vector<double> contact_energy;

  explicit Bed(const benchmark::State& state, const char* added = nullptr) {
    ShapeLibrary library;
    const auto shape = library.icosphere(162).value();
    std::mt19937_64 engine(1);
    std::normal_distribution<double> normal(0.0, 0.05);
    const double volume = 4.0 / 3.0 * std::numbers::pi * 216.0, size = std::cbrt(volume);
    for (int cell = 0; cell < state.range(0); ++cell) {
      for (const Vec3d& x : shape->position) {
        shells.position.push_back(size * x + Vec3d{13.0 * cell, 0.0, 0.0} + Vec3d{normal(engine), normal(engine), normal(engine)});
      }
      for (const double length : shape->edge_length) shells.rest_length.push_back(size * length);
      shells.first_node.push_back(static_cast<std::uint32_t>(shells.position.size()));
      shells.first_edge.push_back(static_cast<std::uint32_t>(shells.rest_length.size()));
      shells.reference_volume.push_back(1.02 * volume);
      shells.rest_volume.push_back(volume);
      shells.type.push_back(0);
      shells.shape.push_back(shape);
      topology.push_back(shape->topology.get());
    }
    types[0].spring_stiffness = 0.173205;
    types[0].hinge_stiffness = 1.0264e-3;
    types[0].tension = 0.5;
    if (added != nullptr) {
      const bool bends = shell_law(added).stencil == LawStencil::kNode;
      shell_law(added).strength().in(types[0]) = bends ? 8.8889e-4 : 0.0667;
      if (bends) types[0].hinge_stiffness = 0.0;
    }
    blocks = make_shell_blocks(shells, static_cast<int>(state.range(1)));
    contact_energy.assign(blocks.face_count(), -0.05);
    compute_surface_geometry(surfaces(), blocks.blocks, shells.position, geometry);
    compute_shell_friction(blocks, shells, types, shells.position, geometry.node_area, friction);
    assemble();
  }
  [[nodiscard]] SurfaceList surfaces() const { return {topology, shells.first_node, blocks.first_face}; }
  void assemble() { assemble_shell_operator(blocks, shells, types, shells.position, friction, contact_energy, 60.0, {}, matrix); }
};

void report(benchmark::State& state, const Bed& bed) {
  state.counters["ns_per_node"] = benchmark::Counter(static_cast<double>(bed.shells.node_count()) * 1e-9,
                                                     benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void surface_geometry(benchmark::State& state) {
  Bed bed(state);
  for (auto _ : state) {
    compute_surface_geometry(bed.surfaces(), bed.blocks.blocks, bed.shells.position, bed.geometry);
    benchmark::ClobberMemory();
  }
  report(state, bed);
}

void surface_forces(benchmark::State& state) {
  Bed bed(state);
  const std::vector<double> face_area(bed.blocks.face_count(), 0.1);
  const std::vector<Vec3d> face_normal(bed.blocks.face_count(), Vec3d{0.1, 0.2, 0.3}),
      node_normal(bed.shells.node_count(), Vec3d{0.1, 0.2, 0.3});
  std::vector<Vec3d> force(bed.shells.node_count());
  for (auto _ : state) {
    add_surface_forces(bed.surfaces(), bed.blocks.blocks, bed.shells.position, bed.geometry, {face_area, face_normal, node_normal}, force);
    benchmark::ClobberMemory();
  }
  report(state, bed);
}

void forces(benchmark::State& state, const char* added) {
  Bed bed(state, added);
  ShellMechanics out;
  for (auto _ : state) {
    internal_forces(bed.blocks, bed.shells, bed.types, bed.shells.position, out);
    benchmark::ClobberMemory();
  }
  report(state, bed);
}

void assembly(benchmark::State& state, const char* added) {
  Bed bed(state, added);
  for (auto _ : state) {
    bed.assemble();
    benchmark::ClobberMemory();
  }
  report(state, bed);
}

void operator_application(benchmark::State& state, const char* added) {
  Bed bed(state, added);
  std::vector<Float4> p(bed.shells.node_count(), Float4{0.1f, 0.2f, 0.3f, 0.0f}), q(p.size());
  for (auto _ : state) {
    apply_shell_operator(bed.blocks, bed.shells, bed.matrix, p, q);
    benchmark::ClobberMemory();
  }
  report(state, bed);
  std::size_t terms = 0;
  for (const auto& block : bed.matrix.blocks) terms += block.shape_face.size();
  state.counters["shape_terms_per_block"] = static_cast<double>(terms) / static_cast<double>(bed.matrix.blocks.size());
}

void block_diagonal(benchmark::State& state) {
  Bed bed(state);
  std::vector<SymMat3<float>> diagonal(bed.shells.node_count());
  for (auto _ : state) {
    add_block_diagonal(bed.blocks, bed.shells, bed.matrix, diagonal);
    benchmark::ClobberMemory();
  }
  report(state, bed);
}

void friction_of_displacement(benchmark::State& state) {
  Bed bed(state);
  std::vector<Vec3d> result(bed.shells.node_count());
  std::vector<double> quadratic(bed.shells.size());
  for (auto _ : state) {
    friction_times_displacement(bed.blocks, bed.shells, bed.friction, bed.shells.position, result, quadratic);
    benchmark::ClobberMemory();
  }
  report(state, bed);
}

void sizes(benchmark::internal::Benchmark* b) { b->Args({8, 1})->Args({8, 4})->Args({8, 8})->Args({200, 8})->MinTime(0.05); }

BENCHMARK(surface_geometry)->Apply(sizes);
BENCHMARK(surface_forces)->Apply(sizes);
BENCHMARK_CAPTURE(forces, by_default, nullptr)->Apply(sizes);
BENCHMARK_CAPTURE(assembly, by_default, nullptr)->Apply(sizes);
BENCHMARK_CAPTURE(operator_application, by_default, nullptr)->Apply(sizes);
BENCHMARK(block_diagonal)->Apply(sizes);
BENCHMARK(friction_of_displacement)->Apply(sizes);

// One more law beside those by default (Helfrich: in place of the hinges).
void eight_cells(benchmark::internal::Benchmark* b) { b->Args({8, 8})->MinTime(0.05); }
#define MORULA_WITH_LAW(law)                                         \
  BENCHMARK_CAPTURE(forces, with_##law, #law)->Apply(eight_cells);   \
  BENCHMARK_CAPTURE(assembly, with_##law, #law)->Apply(eight_cells); \
  BENCHMARK_CAPTURE(operator_application, with_##law, #law)->Apply(eight_cells)
MORULA_WITH_LAW(neo_hooke);
MORULA_WITH_LAW(st_venant_kirchhoff);
MORULA_WITH_LAW(skalak);
MORULA_WITH_LAW(local_area);
MORULA_WITH_LAW(global_area);
MORULA_WITH_LAW(helfrich);

}  // namespace
}  // namespace morula::dcm
