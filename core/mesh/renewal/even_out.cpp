#include "core/mesh/renewal/even_out.h"

#include <algorithm>
#include <cmath>

namespace morula {
namespace {

constexpr double kSoftArea = 0.03;  // of the mean face area: what keeps faces from turning over is that steep
constexpr double kMostStep = 0.3;   // of the mean edge
constexpr double kStill = 1e-3;     // of the mean edge
constexpr int kMostHalvings = 4;

/// A function of the place of one node: its value and its gradient.
struct Unevenness {
  double value = 0.0;
  Vec3d gradient;
};

class Evening {
 public:
  Evening(const AskedSurface& surface, const Topology& topology, double theta, std::vector<SurfacePlace>& place)
      : surface_(surface), topology_(topology), theta_(theta), mean_area_(surface.area() / topology.face_count()), place_(place) {}

  [[nodiscard]] double mean_edge() const { return std::sqrt(4.0 * mean_area_ / std::sqrt(3.0)); }

  /// Σ f² over the faces around a node, if it were at this place; the gradient is left out where only the value is compared.
  template <bool kWithGradient>
  [[nodiscard]] Unevenness around(std::uint32_t node, const SurfacePlace& there) const {
    Unevenness sum;
    for (const std::uint32_t f : topology_.faces_of_node(node)) {
      const Triangle& face = topology_.faces()[f];
      const std::size_t c = face[0] == node ? 0 : face[1] == node ? 1 : 2;
      add_face<kWithGradient>(there, place_[face[(c + 1) % 3]], place_[face[(c + 2) % 3]], sum);
    }
    return sum;
  }

  /// Move a node downhill; how far it went [µm].
  double improve(std::uint32_t node) {
    const SurfacePlace here = place_[node];
    const Unevenness now = around<true>(node, here);
    const Vec3d& n = surface_.normals()[here.face];
    const Vec3d downhill = n * dot(n, now.gradient) - now.gradient;
    const double slope = norm(downhill), edge = mean_edge();
    if (!(slope > 0.0)) return 0.0;
    // Around a node of six equilateral faces the curvature of Σ f² is 16 / edge²; it grows with the sum itself.
    const double newton = edge * edge / (16.0 / 6.0 * now.value);
    double step = std::min(newton, kMostStep * edge / slope);
    if (step * slope < 1e-4 * edge) return 0.0;
    for (int halving = 0; halving <= kMostHalvings; ++halving, step *= 0.5) {
      const NearestFace foot = surface_.walk(here.point + downhill * step, here.face);
      const SurfacePlace there{foot.face, foot.closest.point};
      if (around<false>(node, there).value < now.value) {
        place_[node] = there;
        return norm(there.point - here.point);
      }
    }
    return 0.0;
  }

 private:
  /// One face with its corners a (the node asked about), b and c, and its part of the gradient with respect to a.
  template <bool kWithGradient>
  void add_face(const SurfacePlace& pa, const SurfacePlace& pb, const SurfacePlace& pc, Unevenness& sum) const {
    const auto normals = surface_.normals();
    const Vec3d mean_normal = normals[pa.face] + normals[pb.face] + normals[pc.face];
    const double length = norm(mean_normal);
    const Vec3d m = length > 0.0 ? mean_normal / length : mean_normal;
    const Vec3d ab = pb.point - pa.point, ac = pc.point - pa.point, bc = pc.point - pb.point;
    const double seen = 0.5 * dot(cross(ab, ac), m), soft = kSoftArea * mean_area_;
    const double root = std::sqrt(seen * seen + soft * soft), area = 0.5 * (seen + root);
    const double squares = norm2(ab) + norm2(ac) + norm2(bc);
    const double shape = squares / (kFourRootThree * area), ratio = area / mean_area_;
    const double spread = 1.0 - theta_ + 0.5 * theta_ * (ratio + 1.0 / ratio), f = shape * spread;
    sum.value += f * f;
    if constexpr (!kWithGradient) return;
    const Vec3d d_squares = (ab + ac) * -2.0;
    const Vec3d d_area = cross(m, bc) * (0.5 * (0.5 * (1.0 + seen / root)));
    const double d_spread = 0.5 * theta_ * (1.0 - 1.0 / (ratio * ratio)) / mean_area_;
    sum.gradient += (d_squares * (spread / (kFourRootThree * area)) + d_area * (shape * d_spread - f / area)) * (2.0 * f);
  }

  const AskedSurface& surface_;
  const Topology& topology_;
  double theta_, mean_area_;
  std::vector<SurfacePlace>& place_;
};

}  // namespace

void even_out(const AskedSurface& surface, const Topology& topology, double theta, int sweeps, std::vector<SurfacePlace>& place) {
  Evening evening(surface, topology, theta, place);
  const double still = kStill * evening.mean_edge();
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double largest = 0.0;
    for (std::uint32_t node = 0; node < topology.node_count(); ++node) largest = std::max(largest, evening.improve(node));
    if (largest <= still) return;
  }
}

}  // namespace morula
