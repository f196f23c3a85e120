#include <benchmark/benchmark.h>

#include <random>
#include <vector>

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

/// The whole kernel: geometry, cube root of R*, law, friction; 60 000 pairs of a dense tissue in list order, one thread.
void pair_kernel(benchmark::State& state) {
  const int side = 20;
  std::vector<Vec3d> position;
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> jitter(-0.5, 0.5);
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z)
        position.push_back({9.0 * x + jitter(generator), 9.0 * y + jitter(generator), 9.0 * z + jitter(generator)});
    }
  }
  const std::vector<double> radius(position.size(), 5.0);
  const std::vector<std::uint16_t> type(position.size(), 0);
  std::vector<SpherePair> pairs;
  for (std::uint32_t i = 0; i < position.size(); ++i) {
    for (const std::uint32_t next : {1u, 20u, 21u, 400u, 401u, 420u, 421u, 440u}) {
      if (i + next < position.size()) pairs.push_back({i, i + next, true, 0.0});
    }
  }
  const std::vector<SphereParameters> types = {{0.45, 0.4}};
  const std::vector<SurfacePair> surfaces = {{0.1, 50, 50}};
  const ContactTable table(types, surfaces);
  Space space;
  std::vector<PairResponse> out(pairs.size());
  for (auto _ : state) {
    evaluate_pairs(space, {position, radius, type}, table, pairs, out);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pairs.size()));
}
BENCHMARK(pair_kernel);

}  // namespace
