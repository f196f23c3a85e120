#pragma once
#include "cbm/laws/jkr.h"
#include "core/random/philox.h"
#include "scenarios/calibrate/data.h"

namespace morula::calibrate {

/// The reference pair of cbm.md §2: R = 5 µm, E = 0.45 kPa, ν = 0.4, W = 0.1 nN/µm.
inline constexpr double kYoung = 0.45, kPoisson = 0.4, kAdhesion = 0.1, kRadius = 5.0;

inline cbm::PairLaw<double> reference_pair() {
  return cbm::make_pair_law(cbm::ContactMaterial::elastic(kYoung, kPoisson, kYoung, kPoisson, kAdhesion), kRadius, kRadius);
}

/// Its forces at evenly spaced overlaps [µm], each its own experiment, with normal noise of 2 % of the pull-off force times `noise`.
inline Data jkr_points(double from, double to, int count, double noise, std::uint32_t seed) {
  const auto law = reference_pair();
  const Random random(seed, RandomStream::kInitialPosition);
  Data out;
  for (int k = 0; k < count; ++k) {
    const double overlap = from + (to - from) * k / (count - 1);
    const double error = noise * 0.02 * cbm::pull_off_force(law) * random.normal(CellId(7), static_cast<std::uint64_t>(k)).first;
    out.pairs.push_back({.experiment = k,
                         .overlap = overlap,
                         .force = cbm::jkr_contact(law, overlap).force + error,
                         .radius_a = kRadius,
                         .radius_b = kRadius});
  }
  return out;
}

}  // namespace morula::calibrate
