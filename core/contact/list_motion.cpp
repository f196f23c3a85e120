// How long the list of pairs holds: bodies may go as far as its skin beside a drift that is common to all.
#include <algorithm>
#include <cmath>

#include "core/contact/contact_layer.h"
#include "core/contact/float_rounding.h"
#include "core/parallel/threads.h"

namespace morula {
namespace {

/// Part of the skin from which on a common drift is looked for.
constexpr double kWorthADrift = 0.3;
/// Part of the skin from which on the pairs of single spheres are found again; what is left is for the next step.
constexpr double kStrays = 0.4;
/// Part of the bodies that may be such spheres; beyond it the list is as well made anew.
constexpr std::size_t kPartOfBodies = 16;
constexpr double kRoundedUp = 1.000001;

}  // namespace

double ContactLayer::stray_of(const ContactScene& scene, std::size_t i, const CommonDrift& drift) const {
  const ContactBody& body = scene.bodies[i];
  const Vec3d& now = scene.position[body.first_point];
  if (body.shape == BodyShape::kSphere) {
    const bool own = !listed_at_.empty();
    const Vec3d then = to_double(own ? listed_at_[i] : known_at_[body.first_point]);
    const double grown = growth(body, own ? listed_radius_[i] : last_radius_[i]);
    return (norm(now - then - drift.at(then)) + grown + rounding_) * kRoundedUp;
  }
  const double way = travel_.empty() ? way_of(scene, body, body.first_point, last_radius_[i]) : travel_[i];
  if (drift.strain == 0.0) return way * kRoundedUp;
  return (way + norm(drift.at(now)) + drift.strain * (widest_ + way)) * kRoundedUp;  // its points drift, too
}

CommonDrift ContactLayer::drift_of_spheres(const ContactScene& scene) const {
  const std::size_t first = scene.topology.size();  // surfaces come first
  if (periodic_ || !obstacles_.empty() || first >= scene.bodies.size()) return {};
  const std::uint32_t point = scene.bodies[first].first_point;
  const std::size_t count = scene.bodies.size() - first;
  return common_drift(listed_at_.empty() ? std::span(known_at_).subspan(point, count) : std::span(listed_at_).subspan(first, count),
                      scene.position.subspan(point, count));
}

double ContactLayer::find_strays(const ContactScene& scene) {
  const double skin = settings_.body_skin;
  const auto used_with = [&](const CommonDrift& drift) {
    const double most = parallel_max(settings_.threads, scene.bodies.size(), [&](std::size_t i) {
      const double stray = stray_of(scene, i, drift);
      stray_[i] = static_cast<float>(stray * kRoundedUp);
      return stray;
    });
    return (2.0 * most + drift.strain * widest_) / skin;
  };
  drift_ = {};
  double used = used_with(drift_);
  if (used < kWorthADrift) return used;
  const CommonDrift drift = drift_of_spheres(scene);
  if (!(drift.strain > 0.0)) return used;
  if (const double less = used_with(drift); less < used) {
    drift_ = drift;
    return less;
  }
  return used_with(drift_);
}

void ContactLayer::add_strays(BodyChanges& changes) const {
  if (fresh_ || stray_.size() != changes.before.size()) return;
  const double most = 0.5 * (kStrays * settings_.body_skin - drift_.strain * widest_);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> strays;
  for (std::uint32_t i = static_cast<std::uint32_t>(changes.shells_before); i < stray_.size(); ++i)
    if (static_cast<double>(stray_[i]) > most && changes.before[i].shape == BodyShape::kSphere && changes.now[i] != BodyChanges::kNone)
      strays.emplace_back(i, changes.now[i]);
  if (strays.size() * kPartOfBodies > stray_.size()) return;
  for (const auto& [before, now] : strays) {
    changes.fresh.push_back(now);
    changes.was[now] = BodyChanges::kNone;
    changes.now[before] = BodyChanges::kNone;
  }
  changes.strays = std::move(strays);
  std::ranges::sort(changes.fresh);
}

}  // namespace morula
