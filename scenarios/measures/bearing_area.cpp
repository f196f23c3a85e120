#include "scenarios/measures/bearing_area.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/contact/closest_foot.h"

namespace morula::scenarios {
namespace {

/// φ of dcm.md §1, written out: what judges the friction of contacts does not take its weight from them.
double friction_part(double gap, double range) {
  const double s = std::clamp(2.0 - 2.0 * gap / range, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

/// ∫ φ dA of one face, `gap` a function of the point.
template <class Gap>
double bearing_part(const ShellView& shell, const Triangle& t, double range, const Gap& gap) {
  constexpr int kParts = 4;  // along an edge
  const Vec3d a = shell.nodes[t[0]], u = (shell.nodes[t[1]] - a) * (1.0 / kParts), v = (shell.nodes[t[2]] - a) * (1.0 / kParts);
  double out = 0.0;
  const auto add = [&](double i, double j) { out += 0.5 * norm(cross(u, v)) * friction_part(gap(a + u * i + v * j), range); };
  for (int i = 0; i < kParts; ++i)
    for (int j = 0; i + j < kParts; ++j) {
      add(i + 1.0 / 3.0, j + 1.0 / 3.0);
      if (i + j < kParts - 1) add(i + 2.0 / 3.0, j + 2.0 / 3.0);
    }
  return out;
}

struct Ball {
  Vec3d center;
  double radius = 0.0;
};
Ball ball_around(const ShellView& shell, const Triangle& t) {
  Ball out{(shell.nodes[t[0]] + shell.nodes[t[1]] + shell.nodes[t[2]]) * (1.0 / 3.0)};
  for (const std::uint32_t node : t) out.radius = std::max(out.radius, norm(shell.nodes[node] - out.center));
  return out;
}

double bearing_area_against(const ShellView& shell, const ShellView& other, double range) {
  std::vector<Ball> balls;
  for (const Triangle& t : other.faces) balls.push_back(ball_around(other, t));
  double out = 0.0;
  std::vector<Triangle> near;
  for (const Triangle& t : shell.faces) {
    const Ball own = ball_around(shell, t);
    near.clear();
    for (std::size_t f = 0; f < balls.size(); ++f)
      if (norm(balls[f].center - own.center) < balls[f].radius + own.radius + range) near.push_back(other.faces[f]);
    if (near.empty()) continue;
    out += bearing_part(shell, t, range, [&](const Vec3d& x) {
      double least = std::numeric_limits<double>::infinity();
      for (const Triangle& n : near)
        least = std::min(least, closest_foot_of(x, other.nodes[n[0]], other.nodes[n[1]], other.nodes[n[2]]).distance2);
      return std::sqrt(least);
    });
  }
  return out;
}

}  // namespace

double bearing_area_on_plane(const ShellView& shell, double height, double range) {
  double out = 0.0;
  for (const Triangle& t : shell.faces) out += bearing_part(shell, t, range, [&](const Vec3d& x) { return x.z - height; });
  return out;
}

double bearing_area_between(const ShellView& a, const ShellView& b, double range) {
  return 0.5 * (bearing_area_against(a, b, range) + bearing_area_against(b, a, range));
}

}  // namespace morula::scenarios
