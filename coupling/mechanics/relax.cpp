#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/mechanics/mechanics.h"

namespace morula {
namespace {

constexpr double kFirstStep = 0.1;      // [s]
constexpr double kLongestStep = 30.0;   // [s]
constexpr double kShortestStep = 1e-4;  // [s]
constexpr double kFirstCap = 1e-3;      // δ of the capped traction at first [µm] ...
constexpr double kLastCap = 0.1;        // ... and at most
constexpr double kRaiseCap = 1.08;      // from step to step: 60 steps from the first to the last
constexpr int kHoldSteps = 20;          // over which adhesion and friction come in
constexpr double kFarStep = 0.1;        // a step is chosen to move nodes not much further [µm]
constexpr double kAtRest = 6e-3;        // displacement of a longest step that counts as rest: 10⁻³ R a minute for R = 6 to 12 [µm]
constexpr double kOverlapAtRest = 0.1;  // [µm]
constexpr int kMostSteps = 200;

}  // namespace

void Mechanics::hold_all_but(std::span<const char> moves) {
  std::vector<char> by_body;
  if (!moves.empty()) {  // owned shells come first, owned spheres after the ghost shells
    by_body.assign(scene_.bodies().size(), 0);
    std::copy_n(moves.begin(), scene_.owned_shells(), by_body.begin());
    std::copy(moves.begin() + static_cast<std::ptrdiff_t>(scene_.owned_shells()), moves.end(),
              by_body.begin() + static_cast<std::ptrdiff_t>(scene_.first_sphere()));
  }
  scene_.set_moving(by_body);
  lay_out_system();
}

Status Mechanics::relax(Tissue& tissue, std::span<const char> moves) {
  prepare(tissue);
  relax_moves_.assign(moves.begin(), moves.end());
  hold_all_but(relax_moves_);
  relaxing_ = true;
  anchors_ = {};
  const Clock clock = tissue.clock;
  tissue.clock.capped = true;
  double largest_volume = 0.0;
  for (std::size_t i = 0; i < tissue.shells.size(); ++i)
    if (moves[i]) largest_volume = std::max(largest_volume, tissue.shells.rest_volume[i]);
  relax_depth_ = 2.0 * std::cbrt(0.75 / std::numbers::pi * comm_.max(largest_volume));
  relax_cap_ = kFirstCap;
  relax_hold_ = 0.0;
  evaluated_ = contacts_current_ = false;
  const std::vector<Vec3d> none(external_size(tissue));
  double dt = kFirstStep, overlap = 0.0;
  for (int k = 0; k < kMostSteps; ++k) {
    const auto done = step(tissue, dt, none);
    if (!done) {
      dt *= 0.25;
      if (dt < kShortestStep) break;  // as far as it goes
      continue;
    }
    overlap = done->overlap;
    if (relax_hold_ == 0.0 && overlap > kOverlapAtRest) {
      relax_cap_ = std::min(kLastCap, kRaiseCap * relax_cap_);
    } else if (relax_hold_ < 1.0) {
      tissue.clock.capped = false;
      relax_hold_ = std::min(1.0, relax_hold_ + 1.0 / kHoldSteps);
    } else if (dt >= kLongestStep && done->displacement < kAtRest) {
      break;
    }
    dt = std::min(kLongestStep, dt * std::clamp(kFarStep / std::max(done->displacement, 1e-12), 0.5, 1.5));
  }
  tissue.clock = clock;
  tissue.clock.capped = clock.capped || overlap > kOverlapAtRest;
  relaxing_ = false;
  hold_all_but({});
  evaluated_ = contacts_current_ = false;
  return {};
}

}  // namespace morula
