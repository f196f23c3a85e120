#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/contact_body.h"
#include "core/contact/contact_layer.h"
#include "core/friction/sphere_pairs.h"

namespace morula {

/// The pair of two bodies that were found to be near, of which the spheres begin with `first_sphere`; it adheres to nobody yet.
inline SpherePair pair_of(const SphereNeighbours& found, std::uint32_t first_sphere) {
  return {found.a - first_sphere, (found.b - first_sphere) & 0x7FFFFFFFu, 0};
}

/// Canonical order of pairs of these spheres.
inline bool comes_before(std::span<const ContactBody> spheres, const SpherePair& p, const SpherePair& q) {
  const auto a = spheres[p.a].place, b = spheres[q.a].place;
  return a != b ? a < b : spheres[p.b].place < spheres[q.b].place;
}

/// What has become of the spheres of a list of pairs, by old number: the new one, or BodyChanges::kNone.
struct SphereRenumbering {
  std::vector<std::uint32_t> now;    ///< of those whose pairs stay
  std::vector<std::uint32_t> place;  ///< of all that are still there
};

/// What changes beside the list itself when some spheres have come or gone.
struct MergedPairs {
  std::vector<SpherePair> dropped;      ///< old pairs that do not stay, with their old numbers, in their order
  std::vector<std::uint32_t> of_fresh;  ///< new pairs of which one sphere is fresh, increasing
  std::vector<std::uint32_t> watched;   ///< where the watched old pairs are now, or kGone
  static constexpr std::uint32_t kGone = ~0u;
};

/// Gives the spheres of a list of pairs their new numbers where they stand, takes out pairs that do not stay, and puts those that were `found` (numbers of bodies, the spheres of
/// which begin with `first_sphere`) among them in canonical order. `spheres`: all of the scene. `fresh`: by new number. `watched`: numbers of old pairs, increasing. Found pairs
/// adhere to nobody, and are none of those that stay.
[[nodiscard]] MergedPairs merge_sphere_pairs(std::vector<SpherePair>& pairs, const SphereRenumbering& number,
                                             std::span<const SphereNeighbours> found, std::span<const ContactBody> spheres,
                                             std::uint32_t first_sphere, std::span<const char> fresh,
                                             std::span<const std::uint32_t> watched, int threads);

}  // namespace morula
