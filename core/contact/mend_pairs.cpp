// Lists of pairs after a few bodies have come or gone.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/contact/contact_layer.h"

namespace morula {

void ContactLayer::mend(const ContactScene& scene, const Space& space, const BodyChanges& changes) {
  std::size_t points = 0;
  for (const ContactBody& body : changes.before) points += body.point_count;
  if (stray_.size() != changes.before.size() || known_at_.size() != points) fresh_ = true;
  if (fresh_) return;
  std::vector<SurfacePair> kept = std::move(pairs_);
  const auto renumber = [&](SurfacePair& pair) {  // false: it has gone
    pair.a = changes.now[pair.a];
    if (!pair.rigid) pair.b = changes.now[pair.b];
    return pair.a != BodyChanges::kNone && (pair.rigid || pair.b != BodyChanges::kNone);
  };
  std::erase_if(kept, [&](SurfacePair& pair) { return !renumber(pair); });
  renumber_motions(scene, changes);

  pairs_.clear();
  spheres_.clear();
  std::vector<std::uint32_t> surfaces(changes.fresh);
  std::erase_if(surfaces, [&](std::uint32_t i) { return scene.bodies[i].shape == BodyShape::kSphere; });
  std::ranges::sort(surfaces, {}, [&](std::uint32_t i) { return scene.bodies[i].place; });
  if (!changes.fresh.empty()) add_body_pairs(scene, space, changes.fresh);
  add_obstacle_pairs(scene, space, surfaces);
  add_self_pairs(scene, surfaces);
  if (pairs_.empty()) {
    pairs_ = std::move(kept);
  } else {
    std::vector<SurfacePair> all;
    all.reserve(kept.size() + pairs_.size());
    std::merge(std::make_move_iterator(kept.begin()), std::make_move_iterator(kept.end()), std::make_move_iterator(pairs_.begin()),
               std::make_move_iterator(pairs_.end()), std::back_inserter(all),
               [&](const SurfacePair& p, const SurfacePair& q) { return pair_key(scene, p) < pair_key(scene, q); });
    pairs_ = std::move(all);
  }
  sort_kinds(scene);
  know_bodies(scene);
}

void ContactLayer::renumber_motions(const ContactScene& scene, const BodyChanges& changes) {
  const std::size_t n = scene.bodies.size();
  const bool had_travel = !travel_.empty(), has_travel = had_travel || !scene.topology.empty();
  std::vector<Vec3f> known_at(scene.position.size());
  std::vector<float> last_radius(n), listed_radius(has_travel ? n : 0), stray(n);
  std::vector<Vec3f> listed_at(has_travel ? n : 0);
  std::vector<double> travel(has_travel ? n : 0);
  for (std::size_t i = 0; i < n; ++i) {
    const ContactBody& body = scene.bodies[i];
    const std::uint32_t was = changes.was[i];
    if (was == BodyChanges::kNone) {
      for (std::uint32_t p = body.first_point; p < body.first_point + body.point_count; ++p) {
        const Vec3d& x = scene.position[p];
        known_at[p] = has_travel || body.shape == BodyShape::kSurface ? to_float(x) : listed_place(x);
        const double drifts = norm(drift_.at(x));
        rounding_ = std::max(rounding_, rounding_of(std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}) + drifts));
      }
      last_radius[i] = static_cast<float>(body.radius);
      if (has_travel) {
        listed_at[i] = listed_place(scene.position[body.first_point]);
        listed_radius[i] = last_radius[i];
      }
      // The place on the drift's way is not quite where the drift brings it from.
      const Vec3d &now = scene.position[body.first_point], then = now - drift_.at(now);
      stray[i] = static_cast<float>(2.0 * norm(now - then - drift_.at(then)) + 2.0 * rounding_);
      continue;
    }
    const ContactBody& old = changes.before[was];
    std::copy_n(known_at_.begin() + old.first_point, old.point_count, known_at.begin() + body.first_point);
    last_radius[i] = last_radius_[was];
    stray[i] = stray_[was];
    if (has_travel) {
      listed_at[i] = had_travel ? listed_at_[was] : known_at_[old.first_point];
      listed_radius[i] = had_travel ? listed_radius_[was] : last_radius_[was];
    }
    if (had_travel) {
      travel[i] = travel_[was];
    } else if (has_travel) {  // until now there were no surfaces, and ways were those from where the list was made
      travel[i] = way_of(scene, body, old.first_point, last_radius_[was]);
    }
  }
  known_at_ = std::move(known_at);
  last_radius_ = std::move(last_radius);
  travel_ = std::move(travel);
  listed_at_ = std::move(listed_at);
  listed_radius_ = std::move(listed_radius);
  stray_ = std::move(stray);
  motion_.assign(has_travel ? n : 0, {});
}

}  // namespace morula
