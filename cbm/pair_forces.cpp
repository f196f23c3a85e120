#include "cbm/pair_forces.h"

#include <cassert>

namespace morula::cbm {
namespace {

/// x_j − x_i, by the nearest image where the domain is periodic.
Vec3d between(const Space& space, bool periodic, const SphereView& spheres, const SpherePair& pair) {
  const Vec3d direct = spheres.position[pair.j] - spheres.position[pair.i];
  return periodic ? space.nearest_image(direct) : direct;
}

}  // namespace

ContactTable::ContactTable(std::span<const SphereParameters> types, std::span<const SurfacePair> surfaces) : types_(types.size()) {
  assert(surfaces.size() == types_ * types_);
  entries_.reserve(surfaces.size());
  for (std::size_t a = 0; a < types_; ++a) {
    for (std::size_t b = 0; b < types_; ++b) {
      const SurfacePair& surface = surfaces[a * types_ + b];
      // Always from the lower type's side, so that (a, b) and (b, a) are the same numbers to the last bit.
      const SphereParameters& first = types[a < b ? a : b];
      const SphereParameters& second = types[a < b ? b : a];
      const double adhesion = first.adhesive && second.adhesive ? surface.adhesion : 0.0;
      entries_.push_back({ContactMaterial::elastic(first.young, first.poisson, second.young, second.poisson, adhesion),
                          surface.normal_friction, surface.tangential_friction});
    }
  }
}

double ContactTable::reach(double largest_radius) const {
  double longest = 0.0;
  for (const Entry& entry : entries_) {
    longest = max(longest, adhesive_reach(make_pair_law(entry.material, largest_radius, largest_radius)));
  }
  return 2.0 * largest_radius + longest;
}

void evaluate_pairs(const Space& space, const SphereView& spheres, const ContactTable& table, std::span<const SpherePair> pairs,
                    std::span<PairResponse> out) {
  assert(out.size() == pairs.size());
  const bool periodic = space.any_periodic();
  const auto count = static_cast<std::int64_t>(pairs.size());
#pragma omp parallel for schedule(static) if (count > 1000)
  for (std::int64_t k = 0; k < count; ++k) {
    const SpherePair& pair = pairs[k];
    out[k] = evaluate_pair(table.entry(spheres.type[pair.i], spheres.type[pair.j]), between(space, periodic, spheres, pair),
                           spheres.radius[pair.i], spheres.radius[pair.j], pair.attached, pair.offset);
  }
}

std::size_t update_attached(const Space& space, const SphereView& spheres, const ContactTable& table, std::span<SpherePair> pairs) {
  const bool periodic = space.any_periodic();
  const auto count = static_cast<std::int64_t>(pairs.size());
  std::int64_t changed = 0;
#pragma omp parallel for schedule(static) reduction(+ : changed) if (count > 1000)
  for (std::int64_t k = 0; k < count; ++k) {
    SpherePair& pair = pairs[k];
    const double radius_i = spheres.radius[pair.i];
    const double radius_j = spheres.radius[pair.j];
    const PairLaw<double> law = make_pair_law(table.entry(spheres.type[pair.i], spheres.type[pair.j]).material, radius_i, radius_j);
    const double overlap = radius_i + radius_j - norm(between(space, periodic, spheres, pair)) - pair.offset;
    const bool attached = update_attached(overlap, pair.attached, law);
    changed += attached != pair.attached;
    pair.attached = attached;
  }
  return static_cast<std::size_t>(changed);
}

SphereContactSums sum_contacts(std::size_t sphere_count, std::span<const SpherePair> pairs, std::span<const PairResponse> responses) {
  assert(responses.size() == pairs.size());
  SphereContactSums sums;
  sums.force.assign(sphere_count, Vec3d{});
  sums.area.assign(sphere_count, 0.0);
  sums.virial.assign(sphere_count, 0.0);
  sums.count.assign(sphere_count, 0);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const PairResponse& response = responses[k];
    const Vec3d force = response.force * response.normal;
    const double virial = response.distance * response.force;
    sums.force[pairs[k].i] -= force;
    sums.force[pairs[k].j] += force;
    for (const std::uint32_t sphere : {pairs[k].i, pairs[k].j}) {
      sums.area[sphere] += response.area;
      sums.virial[sphere] += virial;
      sums.count[sphere] += response.area > 0.0;
    }
  }
  return sums;
}

}  // namespace morula::cbm
