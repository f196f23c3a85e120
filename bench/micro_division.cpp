#include <benchmark/benchmark.h>

#include <cmath>

#include "core/mesh/icosphere.h"
#include "core/mesh/renewal/divide_surface.h"

namespace {

using namespace morula;

/// A cell of radius 7 µm that is a little flattened and has waves, as cells in a tissue have; level 2: 162 nodes, 3: 642.
struct Cell {
  std::shared_ptr<const ReferenceShape> shape;
  std::vector<Vec3d> position;

  explicit Cell(std::uint32_t nodes) {
    ShapeLibrary library;
    shape = library.icosphere(nodes).value();
    for (const Vec3d& x : shape->position) {
      const Vec3d n = normalized(x);
      position.push_back(Vec3d{n.x * 1.15, n.y, n.z * 0.87} * (7.0 * (1.0 + 0.08 * std::sin(3.0 * n.x) * std::cos(2.5 * n.y))));
    }
  }
  [[nodiscard]] SurfaceView view() const { return {position, shape->topology.get()}; }
};

/// Six neighbours of the same shape that touch it, as walls.
std::vector<std::vector<Vec3d>> neighbours_of(const Cell& cell) {
  std::vector<std::vector<Vec3d>> out;
  for (const Vec3d& d : {Vec3d{16.1, 0, 0}, Vec3d{-16.1, 0, 0}, Vec3d{0, 14, 0}, Vec3d{0, -14, 0}, Vec3d{0, 0, 12.2}, Vec3d{0, 0, -12.2}}) {
    out.push_back(cell.position);
    for (Vec3d& x : out.back()) x += d;
  }
  return out;
}

/// Cut, cap, both daughters mapped and judged, for planes of many directions. Time for each daughter.
void division(benchmark::State& state, bool with_neighbours) {
  const Cell cell(static_cast<std::uint32_t>(state.range(0)));
  const auto around = with_neighbours ? neighbours_of(cell) : std::vector<std::vector<Vec3d>>{};
  std::vector<SurfaceView> views;
  for (const auto& one : around) views.push_back({one, cell.shape->topology.get()});
  int number = 0, refused = 0;
  for (auto _ : state) {
    const double angle = 2.4 * ++number, z = 1.0 - 2.0 * std::fmod(0.618 * number, 1.0), across = std::sqrt(1.0 - z * z);
    const auto result = divide_surface(cell.view(), {.normal = {across * std::cos(angle), across * std::sin(angle), z},
                                                     .share = number % 2 == 0 ? 0.5 : 0.4,
                                                     .shape = cell.shape.get(),
                                                     .neighbours = views});
    if (!result.ok()) ++refused;
  }
  state.counters["refused"] = refused;
  state.counters["daughters"] = benchmark::Counter(2.0 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
void division_alone(benchmark::State& state) { division(state, false); }
void division_in_tissue(benchmark::State& state) { division(state, true); }
BENCHMARK(division_alone)->Arg(162)->Arg(642)->Unit(benchmark::kMillisecond);
BENCHMARK(division_in_tissue)->Arg(162)->Arg(642)->Unit(benchmark::kMillisecond);

/// Cut and cap alone.
void cut_and_cap(benchmark::State& state) {
  const Cell cell(static_cast<std::uint32_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(cut_in_two(cell.view(), {0.3, 0.2, 1.0}, 0.5, state.range(0) == 162 ? 1.7 : 0.85).ok());
}
BENCHMARK(cut_and_cap)->Arg(162)->Arg(642)->Unit(benchmark::kMillisecond);

void redistribution(benchmark::State& state) {
  const Cell cell(static_cast<std::uint32_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(redistribute(cell.view()).ok());
}
BENCHMARK(redistribution)->Arg(162)->Arg(642)->Unit(benchmark::kMillisecond);

}  // namespace
