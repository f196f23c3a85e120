#include <algorithm>
#include <cmath>

#include "coupling/behaviours/polarity_rule.h"

namespace morula {
namespace {

constexpr double kPiece = 0.02;              // variance of a turn
constexpr std::uint64_t kMostPieces = 2048;  // of a step; a longer one forgets the direction anyway

/// In pieces of a variance 2 D_r dt ≤ 0.02 each of which turns p along a great circle by a normal vector of its tangent plane.
Vec3d turn(const Vec3d& polarity, const TurningCell& cell, const OwnValues& own) {
  const double variance = 2.0 * own("turning") * cell.dt;
  const auto pieces = static_cast<std::uint64_t>(std::clamp(std::ceil(variance / kPiece), 1.0, static_cast<double>(kMostPieces)));
  const double deviation = std::sqrt(variance / static_cast<double>(pieces));
  Vec3d p = polarity;
  for (std::uint64_t k = 0; k < pieces; ++k) {
    const std::uint64_t index = (cell.step * kMostPieces + k) * 2;
    const RandomPair one = cell.random.normal(cell.id, index), two = cell.random.normal(cell.id, index + 1);
    const Vec3d noise{one.first, one.second, two.first};
    const Vec3d by = (noise - p * dot(noise, p)) * deviation;
    const double angle = norm(by);
    if (angle > 0.0) p = normalized(p * std::cos(angle) + by * (std::sin(angle) / angle));
  }
  return p;
}

}  // namespace

std::shared_ptr<const PolarityRule> rotational_diffusion() {
  static const auto rule = std::make_shared<const PolarityRule>(
      PolarityRule{.info = {.name = "rotational_diffusion",
                            .title = "Rotational diffusion of a cell's polarity",
                            .equation = "⟨p(0)·p(t)⟩ = e^(−2 D_r t)",
                            .source = "Debye 1929, Polar Molecules; rotational diffusion on the sphere",
                            .parameters = {given_by_study("turning", "rate", "1/s", "D_r.")}},
                   .keys = {{.spec = {.name = "turning",
                                      .doc = "D_r of rotational diffusion: the mean of p(0).p(t) falls as exp(-2 D_r t).",
                                      .quantity = Quantity::kRate,
                                      .fallback = "0 1/h",
                                      .low = 0.0,
                                      .high = 10.0,
                                      .example = "0.5 1/h",
                                      .source = "chosen: off"}}},
                   .acts = [](const OwnValues& own) { return own("turning") > 0.0; },
                   // A direction is kept over a step, by which ⟨x²⟩ comes out y coth y times too large, y = D_r dt: 0.75 % here.
                   .longest_step = [](const OwnValues& own) { return 0.15 / own("turning"); },
                   .turn = &turn});
  return rule;
}

}  // namespace morula
