#include <benchmark/benchmark.h>

#include <cmath>

#include "core/space/curve.h"
#include "coupling/before_step.h"
#include "coupling/cell_record.h"

namespace {

using namespace morula;

/// Cells on a lattice, all of them spheres, or shells of 162 nodes.
Tissue lattice(std::int64_t count, bool shells, ShapeLibrary& shapes) {
  const auto along = static_cast<std::int64_t>(std::ceil(std::cbrt(static_cast<double>(count))));
  std::vector<CellRecord> cells;
  for (std::int64_t k = 0; k < count; ++k) {
    const Vec3d center{10.0 * static_cast<double>(k % along), 10.0 * static_cast<double>(k / along % along),
                       10.0 * static_cast<double>(k / (along * along))};
    CellRecord& cell = cells.emplace_back();
    cell.row.id = CellId::founder(static_cast<std::uint64_t>(k) + 1);
    cell.row.order = curve_place(center);
    if (shells) {
      cell.shell = spherical_shell(shapes.icosphere(162).value(), center, 900.0, 900.0);
    } else {
      cell.sphere.emplace();
      cell.sphere->position = center;
      cell.sphere->radius = 6.0;
      for (std::uint64_t n = 0; n < 12; ++n) cell.sphere->attached.push_back(CellId::founder(n + 1));
    }
  }
  Tissue tissue;
  put_together(tissue, std::move(cells));
  return tissue;
}

/// An event of one cell in the middle of the tables: it leaves, and a cell like it comes in.
void one_event(benchmark::State& state, bool shells) {
  ShapeLibrary shapes;
  Tissue tissue = lattice(state.range(0), shells, shapes);
  const std::size_t row = tissue.cells.size() / 2;
  for (auto _ : state) replace_cells(tissue, std::vector<std::size_t>{row}, {record_of(tissue, {row, shells, row})});
  state.SetItemsProcessed(state.iterations());
}
void event_among_spheres(benchmark::State& state) { one_event(state, false); }
void event_among_shells(benchmark::State& state) { one_event(state, true); }
BENCHMARK(event_among_spheres)->Arg(1000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(event_among_shells)->Arg(1000)->Unit(benchmark::kMillisecond);

/// What each step keeps in case that it is refused.
void keep_before_step(benchmark::State& state) {
  ShapeLibrary shapes;
  const Tissue tissue = lattice(state.range(0), false, shapes);
  BeforeStep before;
  for (auto _ : state) before.keep(tissue);
  state.counters["bytes_per_cell"] = static_cast<double>(before.memory()) / static_cast<double>(tissue.cells.size());
}
BENCHMARK(keep_before_step)->Arg(100000)->Unit(benchmark::kMillisecond);

}  // namespace
