#pragma once
#include <vector>

#include "core/contact/contact_layer.h"
#include "dcm/shells.h"

namespace morula::test {

/// A third of each face for its nodes, by node of all shells [µm²].
inline std::vector<double> node_areas(const dcm::Shells& shells) {
  std::vector<double> area(shells.position.size(), 0.0);
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const std::uint32_t first = shells.first_node[s];
    const Vec3d* const x = shells.position.data() + first;
    for (const Triangle& t : shells.shape[s]->topology->faces())
      for (const std::uint32_t node : t) area[first + node] += norm(cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]])) / 6.0;
  }
  return area;
}

/// A contact point as friction sees it: nodes of both surfaces by their number in the scene, with weights β and −μ, and the area w it
/// stands for.
struct RubbingPoint {
  std::uint32_t node[6];
  double weight[6];
  double area;

  /// Σ β_i v_i − Σ μ_j v_j.
  [[nodiscard]] Vec3d jump(const std::vector<Vec3d>& velocity) const {
    Vec3d u{};
    for (int c = 0; c < 6; ++c) u += velocity[node[c]] * weight[c];
    return u;
  }
};

/// Contact points of all pairs of surfaces at the positions where the contacts were found last.
inline std::vector<RubbingPoint> rubbing_points(const ContactLayer& layer, const ContactScene& scene) {
  std::vector<RubbingPoint> out;
  const auto& quadrature = FaceQuadrature::with_points(layer.settings().points_per_face);
  for (const SurfacePair& pair : layer.pairs())
    for (std::size_t d = 0; d < 2; ++d) {
      const std::uint32_t number[2] = {d == 0 ? pair.a : pair.b, d == 0 ? pair.b : pair.a};
      for (const ContactElement& e : pair.present(d)) {
        RubbingPoint& point = out.emplace_back();
        double mu[3];
        e.weights(mu);
        point.area = e.area();
        for (std::size_t c = 0; c < 3; ++c) {
          point.node[c] = scene.bodies[number[0]].first_point + scene.topology[number[0]]->faces()[e.source_face()][c];
          point.node[3 + c] = scene.bodies[number[1]].first_point + scene.topology[number[1]]->faces()[e.target()][c];
          point.weight[c] = quadrature.weight[e.point()][c];
          point.weight[3 + c] = -mu[c];
        }
      }
    }
  return out;
}

/// Σ w γ |u|² of contacts with one friction γ in all directions, in the plain form.
inline double contact_dissipation(const std::vector<RubbingPoint>& points, double friction, const std::vector<Vec3d>& velocity) {
  double sum = 0.0;
  for (const RubbingPoint& point : points) sum += point.area * friction * norm2(point.jump(velocity));
  return sum;
}

}  // namespace morula::test
