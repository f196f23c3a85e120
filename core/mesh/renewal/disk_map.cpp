#include "core/mesh/renewal/disk_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace morula {
namespace {

/// What pulls a node towards its neighbours in the embedding; a neighbour is named once for each face at the common edge.
struct Pull {
  std::uint32_t node;
  double weight;
};

/// Mean-value weights of the nodes of some faces, (tan(α/2) + tan(β/2)) / r with the angles at the node beside the edge of length r.
std::vector<std::vector<Pull>> mean_value_weights(std::span<const Vec3d> position, std::span<const Triangle> faces) {
  std::vector<std::vector<Pull>> pulls(position.size());
  for (const Triangle& face : faces)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t node = face[c], next = face[(c + 1) % 3], last = face[(c + 2) % 3];
      const Vec3d u = position[next] - position[node], v = position[last] - position[node];
      const double lu = norm(u), lv = norm(v);
      // tan(α/2) = sin α / (1 + cos α); bounded where a face is folded flat.
      const double tangent = std::max(1e-9, norm(cross(u, v)) / std::max(lu * lv + dot(u, v), 1e-9 * lu * lv));
      pulls[node].push_back({next, tangent / lu});
      pulls[node].push_back({last, tangent / lv});
    }
  return pulls;
}

/// Every node that is not held moves to the weighted mean of its neighbours, over and over (successive over-relaxation), until nothing
/// moves.
void relax(const std::vector<std::vector<Pull>>& pulls, std::span<const std::uint32_t> inner, std::vector<Vec3d>& place) {
  constexpr double kOver = 1.5, kStill = 1e-7;
  constexpr int kMostSweeps = 4000;
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double largest = 0.0;
    for (const std::uint32_t node : inner) {
      double u = 0.0, v = 0.0, sum = 0.0;
      for (const Pull& pull : pulls[node]) {
        u += pull.weight * place[pull.node].x;
        v += pull.weight * place[pull.node].y;
        sum += pull.weight;
      }
      const double du = u / sum - place[node].x, dv = v / sum - place[node].y;
      place[node].x += kOver * du;
      place[node].y += kOver * dv;
      largest = std::max({largest, std::abs(du), std::abs(dv)});
    }
    if (largest < kStill) return;
  }
}

/// Angles of the rim's nodes by arc length, in the order in which the rim runs counter-clockwise about the old part.
std::vector<double> rim_angles(const ClosedHalf& half) {
  const std::uint32_t n = half.rim_nodes;
  const auto at = [&](std::uint32_t k) { return half.mesh.position[half.first_rim_node + k % n]; };
  std::vector<double> angle(n);
  double length = 0.0;
  for (std::uint32_t k = 0; k < n; ++k) {
    angle[k] = length;
    length += norm(at(k + 1) - at(k));
  }
  const double turn = (half.above ? 2.0 : -2.0) * std::numbers::pi / length;
  for (double& a : angle) a *= turn;
  return angle;
}

/// A turn about x and one about z by angles that no symmetry of an icosphere has.
Vec3d tilted(const Vec3d& d, int tilt) {
  const double about_x = 0.37 + 0.83 * tilt, about_z = 0.21 + 1.27 * tilt;
  const double cx = std::cos(about_x), sx = std::sin(about_x), cz = std::cos(about_z), sz = std::sin(about_z);
  const Vec3d e{cz * d.x - sz * d.y, sz * d.x + cz * d.y, d.z};
  return {e.x, cx * e.y - sx * e.z, sx * e.y + cx * e.z};
}

}  // namespace

TwoDiskMap::Disk TwoDiskMap::make_disk(const ClosedHalf& half, std::uint32_t first_face, std::uint32_t end_face,
                                       std::span<const double> rim_angle) {
  const auto& x = half.mesh.position;
  const auto faces = std::span(half.mesh.faces).subspan(first_face, end_face - first_face);
  const auto is_rim = [&](std::uint32_t n) { return n >= half.first_rim_node && n < half.first_rim_node + half.rim_nodes; };
  std::vector<Vec3d> place(x.size());
  for (std::uint32_t k = 0; k < half.rim_nodes; ++k) place[half.first_rim_node + k] = {std::cos(rim_angle[k]), std::sin(rim_angle[k]), 0.0};
  const auto pulls = mean_value_weights(x, faces);
  std::vector<std::uint32_t> inner;
  for (std::uint32_t n = 0; n < x.size(); ++n)
    if (!pulls[n].empty() && !is_rim(n)) inner.push_back(n);
  relax(pulls, inner, place);

  std::vector<double> area(kRings + 1, 0.0);
  for (const auto& [a, b, c] : faces) {
    const double part = norm(cross(x[b] - x[a], x[c] - x[a])) / 12.0;
    for (const auto& weight : kSixPoints) {
      const Vec3d p = place[a] * weight[0] + place[b] * weight[1] + place[c] * weight[2];
      area[std::min(kRings, 1 + static_cast<std::size_t>(norm(p) * static_cast<double>(kRings)))] += part;
    }
  }
  for (std::size_t k = 1; k <= kRings; ++k) area[k] += area[k - 1];
  const double total = area[kRings];
  for (double& a : area) a /= total;
  return {first_face, total, std::move(area), TriangleTree(place, faces)};
}

TwoDiskMap::TwoDiskMap(const ClosedHalf& half)
    : mesh_(half.mesh),
      old_part_(make_disk(half, 0, half.first_cap_face, rim_angles(half))),
      cap_(make_disk(half, half.first_cap_face, static_cast<std::uint32_t>(half.mesh.faces.size()), rim_angles(half))) {}

SurfacePlace TwoDiskMap::at(const Vec3d& direction) const {
  const double share = old_part_.area / (old_part_.area + cap_.area), from_pole = 0.5 * (1.0 - direction.z);
  const bool is_old = from_pole <= share;
  const Disk& disk = is_old ? old_part_ : cap_;
  const double wanted = std::clamp(is_old ? from_pole / share : (1.0 - from_pole) / (1.0 - share), 0.0, 1.0);
  std::size_t ring = 0;
  while (ring + 1 < kRings && disk.area_below[ring + 1] < wanted) ++ring;
  const double low = disk.area_below[ring], high = disk.area_below[ring + 1], k = static_cast<double>(ring);
  const double t = high > low ? std::clamp((wanted - low) / (high - low), 0.0, 1.0) : 1.0;
  const double radius = std::sqrt(k * k + t * (2.0 * k + 1.0)) / static_cast<double>(kRings);
  const double across = std::hypot(direction.x, direction.y);
  const Vec3d p = across > 0.0 ? Vec3d{direction.x, direction.y, 0.0} * (radius / across) : Vec3d{};
  const NearestFace found = *disk.tree.nearest(p);
  const std::uint32_t face = disk.first_face + found.face;
  const auto& [a, b, c] = mesh_.faces[face];
  const auto& w = found.closest.barycentric;
  return {face, mesh_.position[a] * w[0] + mesh_.position[b] * w[1] + mesh_.position[c] * w[2]};
}

std::vector<SurfacePlace> place_nodes(const TwoDiskMap& map, std::span<const Vec3d> direction, int tilt) {
  std::vector<SurfacePlace> out;
  out.reserve(direction.size());
  for (const Vec3d& d : direction) out.push_back(map.at(tilted(d, tilt)));
  return out;
}

}  // namespace morula
