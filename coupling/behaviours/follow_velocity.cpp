#include <cmath>

#include "coupling/behaviours/polarity_rule.h"

namespace morula {
namespace {

/// Exact for a constant velocity, and back to length 1.
Vec3d turn(const Vec3d& polarity, const TurningCell& cell, const OwnValues& own) {
  if (!(norm2(cell.velocity) > 0.0)) return polarity;
  const Vec3d next = polarity + (normalized(cell.velocity) - polarity) * -std::expm1(-cell.dt / own("follow_velocity"));
  return norm2(next) > 0.0 ? normalized(next) : polarity;
}

}  // namespace

std::shared_ptr<const PolarityRule> follow_velocity() {
  static const auto rule = std::make_shared<const PolarityRule>(
      PolarityRule{.info = {.name = "follow_velocity",
                            .title = "Polarity that turns to the cell's velocity",
                            .equation = "dp/dt = (v̂ − p)/τ_p",
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
                   .turn = &turn});
  return rule;
}

}  // namespace morula
