#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "core/random/philox.h"
#include "study/initial/packing.h"

namespace {

using namespace morula;
using namespace morula::scenarios;

/// Radii of 6 µm that differ by 10 %, and the ball that they fill by this part.
struct Ball {
  InitialCells block;
  std::vector<double> radius;
  Space space;

  Ball(std::size_t count, double part) {
    const Random random(5, RandomStream::kInitialPosition);
    double cubes = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      radius.push_back(6.0 * (1.0 + 0.1 * std::numbers::sqrt3 * (2.0 * random.uniform(CellId::founder(i + 1), 0).first - 1.0)));
      cubes += std::pow(radius.back(), 3);
    }
    block.count = count;
    block.radius = std::cbrt(cubes / part);
    const double half = 2.0 * block.radius;
    space = {.box = {{-half, -half, -half}, {half, half, half}}, .boundary = {}};
  }
};

/// Arguments: cells, threads. Overlap over the mean radius, which 0.05 may have.
template <auto Place>
void places(benchmark::State& state, double part) {
  const Ball ball(static_cast<std::size_t>(state.range(0)), part);
  Packing packing;
  for (auto _ : state) packing = Place(ball.block, ball.radius, 0.95, ball.space, 1, 1, Surroundings(), static_cast<int>(state.range(1)));
  state.counters["overlap/R"] = packing.worst_overlap / mean_radius(ball.radius);
  state.counters["per million cells"] = benchmark::Counter(static_cast<double>(state.range(0)) * 1e-6,
                                                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// In order (`fill: sphere`), in a ball with room to spare.
void PlacesInOrder(benchmark::State& state) { places<pack_cells>(state, 0.5); }
/// In disorder (`fill: random`), as dense as they are asked to be: 0.60 of the ball.
void PlacesAtRandom(benchmark::State& state) { places<scatter_cells>(state, 0.60); }

BENCHMARK(PlacesInOrder)->Args({100000, 1})->Args({100000, 2})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(PlacesAtRandom)->Args({100000, 1})->Args({100000, 2})->Args({1000000, 2})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
