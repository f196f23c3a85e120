#include "coupling/mechanics/relax.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/mechanics/step.h"

namespace morula {
namespace {

constexpr double kFirstStep = 0.1;      // [s]
constexpr double kLongestStep = 30.0;   // [s]
constexpr double kShortestStep = 1e-4;  // [s]
constexpr double kFirstCap = 1e-3;      // δ of the capped traction at first [µm] ...
constexpr double kLastCap = 0.1;        // ... and at most
constexpr double kRaiseCap = 1.08;      // from step to step: 60 steps from the first to the last
constexpr int kBondingSteps = 20;       // over which adhesion and friction come in
constexpr double kFarStep = 0.1;        // a step is chosen to move nodes not much further [µm]
constexpr double kAtRest = 6e-3;        // displacement of a longest step that counts as rest: 10⁻³ R a minute for R = 6 to 12 [µm]
constexpr double kOverlapAtRest = 0.1;  // [µm]
constexpr int kMostSteps = 200;

/// The deepest overlap that there can be: two radii of the largest shell that moves.
double deepest_possible(const Tissue& tissue, std::span<const char> moves, const Comm& comm) {
  double largest_volume = 0.0;
  for (std::size_t i = 0; i < tissue.shells.size(); ++i)
    if (moves[i]) largest_volume = std::max(largest_volume, tissue.shells.rest_volume[i]);
  return 2.0 * std::cbrt(0.75 / std::numbers::pi * comm.max(largest_volume));
}

/// Other bodies move from here on, and contacts have another strength.
void hold_all_but(Workspace& work, std::span<const char> moves) {
  lay_out_system(work, moves);
  work.terms.contacts->forget();
  work.known.reset();
}

}  // namespace

Status relax_in_place(Workspace& work, Tissue& tissue, std::span<const char> moves) {
  (void)prepare(work, tissue);
  const Clock clock = tissue.clock;
  tissue.clock.capped = true;
  Settling settling{{moves.begin(), moves.end()}, {kFirstCap, deepest_possible(tissue, moves, work.setting.comm), 0.0}};
  hold_all_but(work, settling.moves);
  const std::vector<Vec3d> none(tissue.shells.node_count() + tissue.spheres.size());
  double dt = kFirstStep, overlap = 0.0;
  for (int k = 0; k < kMostSteps; ++k) {
    const auto done = advance(work, tissue, {dt, none, {}, &settling});
    if (!done) {
      dt *= 0.25;
      if (dt < kShortestStep) break;  // as far as it goes
      continue;
    }
    overlap = done->overlap;
    ContactStrength& strength = settling.strength;
    if (strength.bonding == 0.0 && overlap > kOverlapAtRest) {
      strength.cap = std::min(kLastCap, kRaiseCap * strength.cap);
    } else if (strength.bonding < 1.0) {
      tissue.clock.capped = false;
      strength.bonding = std::min(1.0, strength.bonding + 1.0 / kBondingSteps);
    } else if (dt >= kLongestStep && done->displacement < kAtRest) {
      break;
    }
    dt = std::min(kLongestStep, dt * std::clamp(kFarStep / std::max(done->displacement, 1e-12), 0.5, 1.5));
  }
  tissue.clock = clock;
  tissue.clock.capped = clock.capped || overlap > kOverlapAtRest;
  hold_all_but(work, {});
  return {};
}

}  // namespace morula
