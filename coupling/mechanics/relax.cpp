#include "coupling/mechanics/relax.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "coupling/loads/grips.h"
#include "coupling/mechanics/step.h"

namespace morula {
namespace {

constexpr double kFirstStep = 0.1;      // [s]
constexpr double kLongestStep = 120.0;  // [s]
constexpr double kShortestStep = 1e-4;  // [s]
constexpr double kFirstCap = 1e-3;      // δ of the capped traction at first [µm] ...
constexpr double kFirstDepth = 1.0;     // overlap that is looked for at first [µm]
constexpr double kSeenPart = 0.5;       // of it that may be found: where surfaces overlap more than is seen, some point lies in this half
constexpr double kLastCap = 0.1;        // ... and at most
constexpr double kRaiseCap = 1.08;      // from step to step: 60 steps from the first to the last; with 30, 470 of a group of 500 are stuck
constexpr int kBondingSteps = 20;       // over which adhesion and friction come in
constexpr double kFarStep = 0.2;        // a step is chosen to move nodes not much further [µm]
constexpr double kAtRest = 0.024;       // displacement of a longest step that counts as rest: 10⁻³ R a minute for R = 6 to 12 [µm]
constexpr int kMostSteps = 200;
constexpr double kHoldsMiddle = 100.0;  // stiffness over adhesion: that draws a cell with up to 1.5πWR, 0.05 R of such a spring
constexpr double kFirstOfMarch = 2.0;   // [s]
constexpr int kMostOfMarch = 60;        // steps: some that stick and slip never take long ones

/// The deepest overlap that there can be: two radii of the largest shell that moves.
double deepest_possible(const Tissue& tissue, std::span<const char> moves, const Comm& comm) {
  double largest_volume = 0.0;
  for (std::size_t i = 0; i < tissue.shells.size(); ++i)
    if (moves[i]) largest_volume = std::max(largest_volume, tissue.shells.rest_volume[i]);
  return 2.0 * std::cbrt(0.75 / std::numbers::pi * comm.max(largest_volume));
}

/// Springs that keep the middle of each shell that moves near to where it is, against adhesion that would draw it while nobody answers (decision 0088).
std::vector<Anchor> middles_of(const Tissue& tissue, std::span<const char> moves, double stiffness) {
  std::vector<Anchor> out;
  if (!(stiffness > 0.0)) return out;
  for (std::size_t i = 0; i < tissue.shells.size(); ++i) {
    if (!moves[i]) continue;
    Anchor& middle = out.emplace_back(on_center({.stiffness = stiffness}, tissue, true, i));
    middle.target = held_place(middle, tissue);
  }
  return out;
}

/// Lets overlap be seen as deep as there is any: to look deeper takes longer. Collective.
void see_all_overlap(Workspace& work, const Tissue& tissue, Settling& settling, double deepest) {
  double& depth = settling.strength.depth;
  for (;; depth = std::min(2.0 * depth, deepest)) {
    (void)prepare(work, tissue, &settling);
    if (depth >= deepest || deepest_overlap(work) <= kSeenPart * depth) return;
    work.known.reset();
  }
}

/// How far a step went, in units of what it is allowed; never 0.
double gone(const StepReport& done, const AllowedWays& allowed) {
  return std::max({done.way / allowed.of_body, done.displacement / allowed.of_point, 1e-12});
}

}  // namespace

double relax_in_place(Workspace& work, Tissue& tissue, std::span<const char> moves) {
  const Clock clock = tissue.clock;
  tissue.clock.capped = true;
  const double deepest = deepest_possible(tissue, moves, work.setting.comm);
  Settling settling{{moves.begin(), moves.end()}, {kFirstCap, std::min(kFirstDepth, deepest), 0.0}};
  work.age.reset();  // a scene in which the others are held
  see_all_overlap(work, tissue, settling, deepest);
  const std::vector<Vec3d> none(tissue.shells.node_count() + tissue.spheres.size());
  double dt = kFirstStep, overlap = deepest_overlap(work);
  const bool is_group = work.setting.comm.sum(static_cast<std::int64_t>(std::ranges::count_if(moves, std::identity()))) >= kGroup;
  const AllowedWays allowed = allowed_ways(work.setting.model);
  double adhesion = 0.0;
  for (const ContactPair& pair : work.setting.model.pairs) adhesion = std::max(adhesion, pair.adhesion);
  const std::vector<Anchor> held = middles_of(tissue, moves, kHoldsMiddle * adhesion);
  for (int k = 0; k < kMostSteps; ++k) {
    const auto done = advance(work, tissue, {dt, none, held, &settling});
    if (!done) {
      dt *= 0.25;
      if (dt < kShortestStep) break;  // as far as it goes
      continue;
    }
    overlap = done->overlap;
    ContactStrength& strength = settling.strength;
    if (overlap > kSeenPart * strength.depth) strength.depth = std::min(2.0 * strength.depth, deepest);
    if (strength.bonding == 0.0 && overlap > kOverlapAtRest) {
      strength.cap = std::min(kLastCap, kRaiseCap * strength.cap);
    } else if (strength.bonding < 1.0) {
      tissue.clock.capped = false;
      strength.bonding = std::min(1.0, strength.bonding + 1.0 / kBondingSteps);
    } else if (dt >= kLongestStep && (done->displacement < kAtRest || (is_group && gone(*done, allowed) <= 1.0))) {
      break;  // of a group some rim always goes on, in the run as well
    }
    dt = std::min(kLongestStep, dt * std::clamp(kFarStep / std::max(done->displacement, 1e-12), 0.5, 1.5));
  }
  tissue.clock = clock;
  work.age.reset();
  work.known.reset();
  return overlap;
}

void march_in_place(Workspace& work, Tissue& tissue, std::span<const char> moves, double step) {
  const Clock clock = tissue.clock;
  const Settling settling{{moves.begin(), moves.end()}, {}};
  const std::vector<Vec3d> none(tissue.shells.node_count() + tissue.spheres.size());
  const AllowedWays allowed = allowed_ways(work.setting.model);
  work.age.reset();  // a scene in which the others are held
  double dt = std::min(kFirstOfMarch, step);
  for (int k = 0; k < kMostOfMarch && dt >= kShortestStep; ++k) {
    const auto done = advance(work, tissue, {dt, none, {}, &settling});
    if (!done) {
      dt *= 0.25;
      continue;
    }
    const double way = gone(*done, allowed);
    if (dt >= step && way <= 1.0) break;
    dt = std::min(step, dt * std::clamp(0.9 / way, 0.5, 2.0));
  }
  tissue.clock = clock;
  work.age.reset();
  work.known.reset();
}

}  // namespace morula
