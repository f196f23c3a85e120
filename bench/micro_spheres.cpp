#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "cbm/laws/jkr.h"
#include "cbm/pair_forces.h"

namespace {

using namespace morula;
using namespace morula::cbm;

std::vector<double> overlaps(std::size_t count) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> overlap(-1.0, 2.0);
  std::vector<double> out(count);
  for (double& value : out) value = overlap(generator);
  return out;
}

PairLaw<double> reference_pair() { return make_pair_law(ContactMaterial::elastic(0.45, 0.4, 0.45, 0.4, 0.1), 5.0, 5.0); }

/// Force, stiffness, area and energy of one pair; independent pairs follow each other.
void jkr_throughput(benchmark::State& state) {
  const auto law = reference_pair();
  const auto values = overlaps(1024);
  for (auto _ : state) {
    for (const double value : values) {
      auto contact = jkr_contact(law, value);
      benchmark::DoNotOptimize(contact);
    }
  }
  state.SetItemsProcessed(state.iterations() * 1024);
}
BENCHMARK(jkr_throughput);

/// The same in a chain, where each overlap waits for the force before.
void jkr_latency(benchmark::State& state) {
  const auto law = reference_pair();
  double overlap = 0.5;
  for (auto _ : state) {
    overlap = 0.5 + 1e-12 * jkr_contact(law, overlap).force;
    benchmark::DoNotOptimize(overlap);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(jkr_latency);

/// Eight pairs at a time.
void jkr_lanes(benchmark::State& state) {
  using L = Lane<double, 8>;
  const auto scalar = reference_pair();
  const PairLaw<L> law{L(scalar.modulus),        L(scalar.reduced_radius), L(scalar.length),
                       L(scalar.inverse_length), L(scalar.radius),         L(scalar.force)};
  const auto values = overlaps(1024);
  for (auto _ : state) {
    for (std::size_t k = 0; k < values.size(); k += 8) {
      auto contact = jkr_contact(law, L::load(&values[k]));
      benchmark::DoNotOptimize(contact);
    }
  }
  state.SetItemsProcessed(state.iterations() * 1024);
}
BENCHMARK(jkr_lanes);

/// Geometry, cube root of R*, law: eight pairs at a time, as the step does it.
void pair_blocks(benchmark::State& state) {
  const SphereParameters sphere;
  const PairContact contact{sphere.law.get(), sphere.law->couple(sphere, &sphere, 0.1)};
  const auto values = overlaps(1024);
  PairBlock block;
  for (auto _ : state) {
    for (std::size_t k = 0; k < values.size(); k += PairBlock::kWidth) {
      for (int lane = 0; lane < PairBlock::kWidth; ++lane)
        block.set(lane, {10.0 - values[k + static_cast<std::size_t>(lane)], 0.1, 0.2}, 5.0, 5.0, contact, true, 0.0);
      evaluate(block, PairBlock::kWidth);
      benchmark::DoNotOptimize(block);
    }
  }
  state.SetItemsProcessed(state.iterations() * 1024);
}
BENCHMARK(pair_blocks);

}  // namespace
