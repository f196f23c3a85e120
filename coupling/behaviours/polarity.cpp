#include "coupling/behaviours/polarity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random/philox.h"

namespace morula {
namespace {

constexpr double kPiece = 0.02;              // variance of a turn
constexpr std::uint64_t kMostPieces = 2048;  // of a step; a longer one forgets the direction anyway

}  // namespace

Vec3d initial_polarity(CellId cell, const CellType& type, std::uint32_t seed) {
  if (!type.polarity.set) return {};
  if (norm2(type.start_polarity) > 0.0) return type.start_polarity;
  return Random(seed, RandomStream::kPolarity).direction(cell, std::numeric_limits<std::uint64_t>::max());  // no step has this number
}

Vec3d next_polarity(const Vec3d& polarity, const Vec3d& velocity, CellId cell, const CellType& type, std::uint32_t seed, std::uint64_t step,
                    double dt) {
  const PolarityTurning& law = type.polarity;
  if (!law.set || norm2(polarity) == 0.0) return polarity;
  Vec3d p = polarity;
  const double variance = 2.0 * law.diffusion * dt;
  if (variance > 0.0) {
    const Random random(seed, RandomStream::kPolarity);
    const auto pieces = static_cast<std::uint64_t>(std::clamp(std::ceil(variance / kPiece), 1.0, static_cast<double>(kMostPieces)));
    const double deviation = std::sqrt(variance / static_cast<double>(pieces));
    for (std::uint64_t k = 0; k < pieces; ++k) {
      const std::uint64_t index = (step * kMostPieces + k) * 2;
      const RandomPair one = random.normal(cell, index), two = random.normal(cell, index + 1);
      const Vec3d noise{one.first, one.second, two.first};
      const Vec3d turn = (noise - p * dot(noise, p)) * deviation;
      const double angle = norm(turn);
      if (angle > 0.0) p = normalized(p * std::cos(angle) + turn * (std::sin(angle) / angle));
    }
  }
  if (law.follow_velocity > 0.0 && norm2(velocity) > 0.0) {
    const Vec3d next = p + (normalized(velocity) - p) * -std::expm1(-dt / law.follow_velocity);
    if (norm2(next) > 0.0) p = normalized(next);
  }
  return p;
}

}  // namespace morula
