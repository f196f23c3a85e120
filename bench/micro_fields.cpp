#include <benchmark/benchmark.h>
#include <mpi.h>

#include <cstdlib>
#include <vector>

#include "core/parallel/quiet_mpi.h"
#include "core/random/philox.h"
#include "fields/field_solver.h"
#include "fields/reactions/uptake.h"

namespace {

using namespace morula;
using namespace morula::fields;

/// This process alone; starts MPI at first use, for all benchmarks of the program.
Comm alone() {
  int started = 0;
  MPI_Initialized(&started);
  if (started == 0) {
    quiet_mpi();
    MPI_Init(nullptr, nullptr);
    std::atexit([] { MPI_Finalize(); });
  }
  return Comm(MPI_COMM_SELF);
}

struct Oxygen {
  Space space;
  FieldSpec spec;
  std::vector<CellSource> cells;

  Oxygen(int voxels, int count) {
    const double side = 10.0 * voxels;
    space.box = {{0, 0, 0}, {side, side, side}};
    spec.name = "oxygen";
    spec.diffusion = 2000.0;
    spec.initial = 0.2;
    spec.voxel = 10.0;
    for (auto& axis : spec.boundary)
      for (auto& face : axis) face = {FaceCondition::Kind::kValue, 0.2};
    FieldReaction& taken = spec.reactions.emplace_back(FieldReaction{uptake(), {}});
    taken.values.set("rate", 40.0), taken.values.set("half_saturation", 0.005);
    const Random random(3, RandomStream::kInitialPosition);
    for (std::uint64_t i = 1; i <= static_cast<std::uint64_t>(count); ++i) {
      const CellId id = CellId::founder(i);
      const auto a = random.uniform(id, 0), b = random.uniform(id, 1);
      const auto place = [&](double u) { return side * (0.25 + 0.5 * u); };
      cells.push_back({id, 0, {place(a.first), place(a.second), place(b.first)}, 6.0});
    }
  }
  Field field() const {
    const Grid grid = grid_for(spec, space).value();
    return uniform_field(grid, spec.initial, owners_along_curve(grid, 1), 0);
  }
};

/// One coupling interval near the steady state, the cells moving by 0.1 µm between intervals: what a run pays.
void CouplingInterval(benchmark::State& state) {
  Oxygen oxygen(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const double interval = static_cast<double>(state.range(2));
  const Comm comm = alone();
  Field field = oxygen.field();
  FieldSolver solver;
  std::vector<double> taken(oxygen.cells.size()), seen(oxygen.cells.size());
  const auto advance = [&] { return solver.advance(field, oxygen.spec, oxygen.space, oxygen.cells, interval, comm, taken, seen).value(); };
  for (int i = 0; i < 5; ++i) advance();
  IntervalReport report;
  std::int64_t steps = 0, failed = 0, iterations = 0, evaluations = 0, count = 0;
  for (auto _ : state) {
    for (auto& cell : oxygen.cells) cell.center.x += (cell.id.bits() & 1u) ? 0.1 : -0.1;
    report = advance();
    steps += report.work.steps;
    failed += report.work.failed_steps;
    iterations += report.work.linear_iterations;
    evaluations += report.work.evaluations;
    ++count;
  }
  const auto mean = [&](std::int64_t total) { return static_cast<double>(total) / static_cast<double>(count); };
  state.counters["steps"] = mean(steps);
  state.counters["failed"] = mean(failed);
  state.counters["iterations"] = mean(iterations);
  state.counters["evaluations"] = mean(evaluations);
  state.counters["balance"] = report.balance_error();
  state.counters["minimum_mM"] = report.minimum;
}
BENCHMARK(CouplingInterval)
    ->ArgNames({"voxels", "cells", "interval_s"})
    ->Args({25, 400, 60})
    ->Args({25, 400, 5})
    ->Args({25, 400, 1})
    ->Args({40, 2000, 60})
    ->Args({128, 20000, 60})
    ->Unit(benchmark::kMillisecond);

/// The first interval after a cold start, far from steady.
void FirstInterval(benchmark::State& state) {
  const Oxygen oxygen(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const Comm comm = alone();
  FieldSolver solver;
  std::vector<double> taken(oxygen.cells.size()), seen(oxygen.cells.size());
  for (auto _ : state) {
    Field field = oxygen.field();
    benchmark::DoNotOptimize(solver.advance(field, oxygen.spec, oxygen.space, oxygen.cells, 60.0, comm, taken, seen).value());
  }
}
BENCHMARK(FirstInterval)->ArgNames({"voxels", "cells"})->Args({25, 400})->Unit(benchmark::kMillisecond);

}  // namespace
