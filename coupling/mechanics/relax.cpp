#include <algorithm>

#include "coupling/mechanics/mechanics.h"

namespace morula {
namespace {

constexpr double kFirstStep = 0.1;      // [s]
constexpr double kLongestStep = 30.0;   // [s]
constexpr double kCap = 0.1;            // δ of the capped traction [µm]
constexpr double kAtRest = 2e-3;        // displacement of a longest step that counts as rest [µm]
constexpr double kOverlapAtRest = 0.1;  // [µm]
constexpr int kMostSteps = 120;

}  // namespace

void Mechanics::hold_all_but(std::span<const char> moves) {
  std::vector<char> by_body;
  if (!moves.empty()) {  // ghosts never move; owned shells come first, owned spheres after the ghost shells
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
  const Clock clock = tissue.clock;
  tissue.clock.capped = true;
  evaluated_ = contacts_current_ = false;
  const double given_cap = relax_cap_;
  relax_cap_ = kCap;
  const std::vector<Vec3d> none(external_size(tissue));
  double dt = kFirstStep;
  std::optional<StepFault> fault;
  for (int k = 0; k < kMostSteps; ++k) {
    const auto done = step(tissue, dt, none);
    if (!done) {
      dt *= 0.25;
      if (dt > 1e-3) continue;
      fault = done.error();
      break;
    }
    if (done->overlap < kOverlapAtRest) tissue.clock.capped = false;
    if (!tissue.clock.capped && dt >= kLongestStep && done->displacement < kAtRest) break;
    dt = std::min(kLongestStep, 1.5 * dt);
  }
  tissue.clock = clock;
  relax_cap_ = given_cap;
  relaxing_ = false;
  hold_all_but({});
  evaluated_ = contacts_current_ = false;
  if (fault) return Error{ErrorKind::kPhysics, "cell " + fault->cell.text() + " finds no shape between its neighbours: " + fault->what, {}};
  return {};
}

}  // namespace morula
