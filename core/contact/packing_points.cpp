#include "core/contact/packing_points.h"

#include <cmath>

namespace morula {
namespace {

/// Calls function(place of the face, its area, number of the point, position − centre, distance) for the points within half the onset of the
/// sphere or deeper.
template <class F>
void for_points_within(const PairBody& surface, const PairBody& sphere, const FaceQuadrature& quadrature,
                       std::span<const std::uint32_t> faces, double onset, F&& function) {
  const double reach = sphere.radius + 0.5 * onset;
  const Vec3d center = sphere.node(0) - surface.shift;
  const auto triangles = surface.topology->faces();
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const Triangle& t = triangles[faces[k]];
    const Vec3d x[3] = {surface.position[t[0]] - center, surface.position[t[1]] - center, surface.position[t[2]] - center};
    const double area = 0.5 * norm(cross(x[1] - x[0], x[2] - x[0]));
    for (int q = 0; q < quadrature.count; ++q) {
      const auto& beta = quadrature.weight[q];
      const Vec3d away = x[0] * beta[0] + x[1] * beta[1] + x[2] * beta[2];
      const double square = norm2(away);
      if (square < reach * reach) function(k, area, q, away, std::sqrt(square));
    }
  }
}

}  // namespace

Penetration penetration(const PairBody& surface, const PairBody& sphere, const FaceQuadrature& quadrature,
                        std::span<const std::uint32_t> faces, double onset) noexcept {
  Penetration out;
  for_points_within(surface, sphere, quadrature, faces, onset, [&](std::size_t, double face_area, int, const Vec3d&, double distance) {
    const PackingDepth f = PackingDepth::of(distance, sphere.radius, onset);
    const double area = face_area / quadrature.count;
    out.volume += area * f.depth;
    out.slope += area * f.slope;
  });
  return out;
}

void add_packing(const PairBody& surface, const PairBody& sphere, const FaceQuadrature& quadrature, const SpherePressure& pressure,
                 double onset, int d, const SurfacePair& pair, PairGradient (&gradient)[2], std::vector<ContactElement>& elements) {
  if (pressure.pressure == 0.0 && pressure.resistance == 0.0) return;
  std::vector<std::uint32_t> faces;
  pair.points[d].unpack_source_faces(faces);
  const double part = 1.0 / quadrature.count;
  for_points_within(
      surface, sphere, quadrature, faces, onset, [&](std::size_t k, double face_area, int q, const Vec3d& away, double distance) {
        const std::uint32_t face = faces[k];
        const PackingDepth f = PackingDepth::of(distance, sphere.radius, onset);
        const double area = face_area * part;
        const Vec3d normal = distance > 1e-12 ? away * (1.0 / distance) : Vec3d{0, 0, 1};
        const auto push = PaddedVec3::of(normal * (area * pressure.pressure * f.slope));  // out of the sphere
        const Triangle& t = surface.topology->faces()[face];
        for (std::size_t i = 0; i < 3; ++i) gradient[d].force[t[i]].v += push * quadrature.weight[q][i];
        gradient[1 - d].force[0].v -= push;
        gradient[d].face_energy[k] += part * pressure.pressure * f.depth;
        ContactElement& element = elements.emplace_back(face, static_cast<std::uint32_t>(q), 0);  // no area: the pair's own element rubs
        element.set_weights(ContactElement::kWeightUnits, 0);
        element.set_normal(normal);
        element.set_stiffness(static_cast<float>(area * (pressure.pressure * f.curvature + pressure.resistance * f.slope)));
      });
}

}  // namespace morula
