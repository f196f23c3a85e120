#include <algorithm>
#include <cmath>
#include <limits>

#include "coupling/behaviours/polarity_rule.h"

namespace morula {
namespace {

/// Of an angle of almost half a turn; a polarity that looks backwards begins to turn as if it were that much beside it.
constexpr double kMostTangent = 1e3;

/// Exact for a constant velocity: dθ/dt = −sin θ/τ for the angle θ between both, tan(θ/2) falls as e^(−t/τ).
Vec3d turn(const Vec3d& polarity, const TurningCell& cell, const OwnValues& own) {
  if (!(norm2(cell.velocity) > 0.0)) return polarity;
  const Vec3d ahead = normalized(cell.velocity);
  const double cosine = dot(polarity, ahead);
  Vec3d aside = polarity - ahead * cosine;
  const double sine = norm(aside);
  const bool in_line = sine < 1.0 / kMostTangent;
  if (in_line && cosine > 0.0) return ahead;
  if (in_line) aside = cross(ahead, std::abs(ahead.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0});
  const double tangent = in_line ? kMostTangent : std::min(kMostTangent, sine / (1.0 + cosine));
  const double angle = 2.0 * std::atan(tangent * std::exp(-cell.dt / own("follow_velocity")));
  return normalized(ahead * std::cos(angle) + normalized(aside) * std::sin(angle));
}

}  // namespace

std::shared_ptr<const PolarityRule> follow_velocity() {
  static const auto rule = std::make_shared<const PolarityRule>(
      PolarityRule{.info = {.name = "follow_velocity",
                            .title = "Polarity that turns to the cell's velocity",
                            .equation = "dp/dt = (v̂ − (v̂·p) p)/τ_p, |p| = 1",
                            .source = "choice of this project; Szabo et al. 2006, doi:10.1103/PhysRevE.74.061908",
                            .parameters = {given_by_study("follow_velocity", "time", "s", "τ_p.")}},
                   .keys = {{.spec = {.name = "follow_velocity",
                                      .doc = "Time in which the polarity turns to the cell's velocity; `never`: it does not.",
                                      .quantity = Quantity::kTime,
                                      .fallback = "never",
                                      .low = 0.0,
                                      .low_open = true,
                                      .specials = {{"never", 0.0}},
                                      .example = "20 min",
                                      .source = "chosen: off"}}},
                   .looks_at_velocity = true,
                   .acts = [](const OwnValues& own) { return own("follow_velocity") > 0.0; },
                   .longest_step =
                       [](const OwnValues& own) {
                         const double time = own("follow_velocity");
                         return time > 0.0 ? 0.15 * time : std::numeric_limits<double>::infinity();
                       },
                   .turn = &turn});
  return rule;
}

}  // namespace morula
