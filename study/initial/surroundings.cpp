#include "study/initial/surroundings.h"

#include "core/mesh/pseudonormal.h"
#include "coupling/mechanics/contact_setup.h"

namespace morula::scenarios {

Result<Surroundings> Surroundings::of(const Model& model) {
  MORULA_TRY_ASSIGN(auto surfaces, contact_obstacles(model));
  Surroundings out;
  out.space_ = model.space;
  for (const ObstacleSpec& obstacle : model.obstacles) {
    out.names_.push_back(obstacle.name);
    out.inside_.push_back(obstacle.inside);
  }
  out.obstacles_ = model.obstacles.size();
  out.kept_ = std::make_shared<const std::vector<RigidSurface>>(std::move(surfaces));
  for (const RigidSurface& surface : *out.kept_) out.surfaces_.push_back(&surface);
  out.clear_.resize(out.surfaces_.size());
  for (std::size_t surface = 0; surface < out.obstacles_; ++surface) {  // most questions about a vessel are about its middle
    if (!out.inside_[surface]) continue;
    const Vec3d middle = out.surfaces_[surface]->tree->bounds().center();
    out.clear_[surface] = {middle, out.distance(surface, middle, 0.0)};
  }
  return out;
}

void Surroundings::add(const Vec3d& center, double radius) {
  center_.push_back(center);
  radius_.push_back(radius);
  largest_ = std::max(largest_, radius);
  grid_.reset();
}

void Surroundings::prepare(double largest_radius, double touch) {
  if (!center_.empty()) grid_.emplace(center_, touch * (largest_ + largest_radius), space_);
}

std::string Surroundings::name(std::size_t surface) const { return is_wall(surface) ? "the wall" : "obstacle '" + names_[surface] + "'"; }

double Surroundings::distance(std::size_t surface, const Vec3d& p, double cutoff, Vec3d* away) const {
  double least = cutoff;
  bool first = true;
  for_images(*surfaces_[surface], {}, space_, Box{p, p}.inflated(cutoff), [&](const SurfaceImage& image) {
    Vec3d from_it{};
    const double apart = distance_of_one(surface, p - image.shift, cutoff, away != nullptr ? &from_it : nullptr);
    if (!first && apart >= least) return;
    first = false;
    least = apart;
    if (away != nullptr) *away = from_it;
  });
  return least;
}

double Surroundings::distance_of_one(std::size_t surface, const Vec3d& p, double cutoff, Vec3d* away) const {
  const RigidSurface& s = *surfaces_[surface];
  const bool inside = !is_wall(surface) && inside_[surface];
  if (!inside && !s.tree->bounds().inflated(cutoff).contains(p)) return cutoff;
  if (norm(p - clear_[surface].center) + cutoff <= clear_[surface].radius) return cutoff;
  const auto nearest = s.tree->nearest(p);
  if (!nearest) return cutoff;
  const double distance = signed_distance(*s.topology, s.position, p, nearest->face, nearest->closest);
  if (away) {
    const Vec3d from = (p - nearest->closest.point) * (distance < 0.0 ? -1.0 : 1.0);
    *away = norm2(from) > 0.0 ? normalized(from) : pseudonormal(*s.topology, s.position, nearest->face, nearest->closest.feature);
  }
  return distance;
}

std::string Surroundings::what_is_at(const Vec3d& p, double radius, double touch) const {
  Vec3d ignored;
  const double worst = push(p, radius, touch, ignored);
  for (std::size_t surface = 0; surface < obstacles_; ++surface)
    if (touch * radius - distance(surface, p, touch * radius) >= worst) return name(surface);
  return "a cell that is there already";
}

double Surroundings::push(const Vec3d& p, double radius, double touch, Vec3d& out) const {
  double worst = -1e300;
  out = {};
  for (std::size_t surface = 0; surface < obstacles_; ++surface) {
    Vec3d away{};
    const double depth = touch * radius - distance(surface, p, touch * radius, &away);
    worst = std::max(worst, depth);
    if (depth > 0.0) out += away * depth;
  }
  if (grid_)
    grid_->near(p, [&](std::size_t j) {
      const Vec3d away = space_.nearest_image(p - center_[j]);
      const double apart = norm(away), depth = touch * (radius + radius_[j]) - apart;
      worst = std::max(worst, depth);
      if (depth > 0.0 && apart > 0.0) out += away * (depth / apart);
    });
  return worst;
}

}  // namespace morula::scenarios
