/// Where a surface and a sphere touch, and what the pair's forces on the surface have of a virial (decision 0054).
#include "core/contact/sphere_touch.h"

#include <algorithm>

#include "core/contact/contact_layer.h"
#include "core/parallel/threads.h"
#include "core/virial.h"

namespace morula {
namespace {

/// Twice the area of a face, along its normal.
Vec3d twice_area(const PairBody& surface, const Triangle& t) {
  return cross(surface.node(t[1]) - surface.node(t[0]), surface.node(t[2]) - surface.node(t[0]));
}

}  // namespace

SymMat3<double> virial_about(const Vec3d& center, const PairBody& surface, std::span<const std::uint16_t> nodes,
                             const PairGradient& gradient) {
  SymMat3<double> out;
  for (const std::uint16_t node : nodes) out += virial_of(surface.node(node) - center, gradient.force[node].value());
  for (std::size_t k = 0; k < gradient.source_face.size(); ++k) {
    if (gradient.face_energy[k] == 0.0) continue;
    const Vec3d twice = twice_area(surface, surface.topology->faces()[gradient.source_face[k]]);
    const double area = 0.5 * norm(twice), energy = gradient.face_energy[k] * area;
    if (area > 0.0) out += outer(energy, twice * (0.5 / area)) + isotropic(-energy);
  }
  return out;
}

std::vector<SphereTouch> ContactLayer::touches_of_spheres(const ContactScene& scene) const {
  const std::vector<std::uint32_t>& list = pairs_of_kind_[static_cast<std::size_t>(SurfacePairKind::kWithSphere)];
  const FaceQuadrature& quadrature = FaceQuadrature::with_points(settings_.points_per_face);
  std::vector<SphereTouch> out(list.size());
  parallel_for(settings_.threads, list.size(), [&](std::size_t k) {
    const SurfacePair& pair = pairs_[list[k]];
    const int d = scene.bodies[pair.a].shape == BodyShape::kSurface ? 0 : 1;
    const PairBody surface = view(scene, pair, d), sphere = view(scene, pair, 1 - d);
    Vec3d sum, facing;
    double weight = 0.0, overlap = 0.0;
    double cones = 0.0;  // three times the volume between the contact and the sphere's centre, < 0
    for (const ContactElement& element : pair.present(static_cast<std::size_t>(d))) {
      const auto area = static_cast<double>(element.area());
      if (area == 0.0) continue;
      const Triangle& t = surface.topology->faces()[element.source_face()];
      const auto& beta = quadrature.weight[element.point()];
      Vec3d at;
      for (std::size_t i = 0; i < 3; ++i) at += (surface.node(t[i]) - sphere.node(0)) * beta[i];
      const Vec3d twice = twice_area(surface, t), vector_area = twice * (area / norm(twice));
      facing += vector_area;
      cones += dot(at, vector_area);
      sum += at * area;
      overlap += std::max(0.0, sphere.radius - norm(at)) * area;
      weight += area;
    }
    const double length = norm(sum);
    const Vec3d place = length > 0.0 ? sum * ((1.0 + 0.5 * overlap / length) / weight) : Vec3d{};
    out[k] = {.sphere = d == 0 ? pair.b : pair.a,
              .surface = d == 0 ? pair.a : pair.b,
              .place = place,
              .force = pair.push,
              .area = pair.area,
              .bulge = (dot(place, facing) - cones) / 3.0};
  });
  return out;
}

}  // namespace morula
