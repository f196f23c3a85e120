#include "core/mesh/renewal/cut_halves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/mesh/renewal/planar_triangulation.h"

namespace morula {
namespace {

constexpr double kRimDistance = 0.45;  // of the spacing, between the rim and the points inside (decision 0038)

double squared_distance_to_segment(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b) {
  const double du = b.u - a.u, dv = b.v - a.v, length2 = du * du + dv * dv;
  const double t = length2 > 0.0 ? std::clamp(((p.u - a.u) * du + (p.v - a.v) * dv) / length2, 0.0, 1.0) : 0.0;
  const double eu = p.u - a.u - t * du, ev = p.v - a.v - t * dv;
  return eu * eu + ev * ev;
}

bool is_far_from(std::span<const PlanePoint> rim, const PlanePoint& p, double distance) {
  for (std::size_t n = 0; n < rim.size(); ++n)
    if (squared_distance_to_segment(p, rim[n], rim[(n + 1) % rim.size()]) < distance * distance) return false;
  return true;
}

ClosedHalf closed(OpenHalf open, const Cap& cap, std::uint32_t rim_nodes, bool above) {
  ClosedHalf out;
  out.mesh = std::move(open.mesh);
  out.first_rim_node = open.first_rim_node;
  out.rim_nodes = rim_nodes;
  out.first_cap_face = static_cast<std::uint32_t>(out.mesh.faces.size());
  out.source_face = std::move(open.source_face);
  out.above = above;
  out.mesh.position.insert(out.mesh.position.end(), cap.inner.begin(), cap.inner.end());
  for (auto [a, b, c] : cap.faces) {
    if (above) std::swap(b, c);
    out.mesh.faces.push_back({out.first_rim_node + a, out.first_rim_node + b, out.first_rim_node + c});
  }
  return out;
}

}  // namespace

Result<Cap> make_cap(std::span<const Vec3d> rim, const Vec3d& normal, double spacing) {
  if (rim.empty() || !(spacing > 0.0)) return Error{ErrorKind::kInput, "a cap needs a rim and a spacing that is positive", ""};
  Vec3d first, second, center;
  frame_about(normal, first, second);
  for (const Vec3d& p : rim) center += p;
  center *= 1.0 / static_cast<double>(rim.size());
  std::vector<PlanePoint> polygon;
  double radius = 0.0;
  for (const Vec3d& p : rim) {
    polygon.push_back({dot(p - center, first), dot(p - center, second)});
    radius = std::max(radius, std::hypot(polygon.back().u, polygon.back().v));
  }
  MORULA_TRY_ASSIGN(PlanarTriangulation triangulation, PlanarTriangulation::of_polygon(polygon));
  Cap out;
  const double row = 0.5 * std::numbers::sqrt3 * spacing;
  const int rows = static_cast<int>(radius / row) + 1, columns = static_cast<int>(radius / spacing) + 2;
  for (int j = -rows; j <= rows; ++j)
    for (int i = -columns; i <= columns; ++i) {
      const PlanePoint p{(i + (j % 2 == 0 ? 0.0 : 0.5)) * spacing, j * row};
      if (is_far_from(polygon, p, kRimDistance * spacing) && triangulation.insert(p))
        out.inner.push_back(center + first * p.u + second * p.v);
    }
  out.faces = triangulation.triangles();
  return out;
}

Result<CutHalves> cut_in_two(const SurfaceView& surface, const Vec3d& normal, double share, double cap_spacing) {
  MORULA_TRY_ASSIGN(PlaneCut cut, cut_by_plane(surface, normal, share));
  MORULA_TRY_ASSIGN(const Cap cap, make_cap(cut.rim, cut.normal, cap_spacing));
  CutHalves out;
  const auto rim_nodes = static_cast<std::uint32_t>(cut.rim.size());
  out.half[0] = closed(std::move(cut.above), cap, rim_nodes, true);
  out.half[1] = closed(std::move(cut.below), cap, rim_nodes, false);
  const auto& mesh = out.half[1].mesh;
  for (std::size_t f = out.half[1].first_cap_face; f < mesh.faces.size(); ++f) {
    const auto& [a, b, c] = mesh.faces[f];
    out.cap_area += 0.5 * norm(cross(mesh.position[b] - mesh.position[a], mesh.position[c] - mesh.position[a]));
  }
  out.rim = std::move(cut.rim);
  return out;
}

}  // namespace morula
