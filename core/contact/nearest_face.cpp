#include "core/contact/nearest_face.h"

#include <algorithm>
#include <cmath>

#include "core/mesh/closest_point.h"
#include "core/mesh/pseudonormal.h"

namespace morula {
namespace {

/// A vector on the outer side of the nearest feature: face normal, sum of the two face normals at an edge, angle-weighted normal at a
/// node (Bærentzen & Aanæs 2005, doi:10.1109/TVCG.2005.49).
Vec3d pseudonormal(const PairBody& target, std::uint32_t face, const double (&mu)[3]) {
  const int zeros = (mu[0] == 0.0) + (mu[1] == 0.0) + (mu[2] == 0.0);
  if (zeros == 0) return target.face_normal[face];
  const Topology& topology = *target.topology;
  if (zeros == 1) {
    const int opposite = mu[0] == 0.0 ? 0 : mu[1] == 0.0 ? 1 : 2;
    const Edge& edge = topology.edges()[topology.face_edges()[face][static_cast<std::size_t>(opposite)]];
    return target.face_normal[edge.left] + target.face_normal[edge.right];
  }
  const int corner = mu[0] != 0.0 ? 0 : mu[1] != 0.0 ? 1 : 2;
  const std::uint32_t node = topology.faces()[face][static_cast<std::size_t>(corner)];
  Vec3d sum;
  for (const std::uint32_t f : topology.faces_of_node(node)) {
    const Triangle& t = topology.faces()[f];
    const int c = t[0] == node ? 0 : t[1] == node ? 1 : 2;
    sum += target.face_normal[f] * corner_angle(t, c, target.position);
  }
  return sum;
}

/// How far behind the nearest face another one need be known to lie: a longer lead would save nothing, since bodies move less between
/// evaluations [µm].
constexpr double kLead = 0.15;

struct Candidate {
  double distance2 = 1e300;
  double distance = 1e150;  ///< its root
  double second2 = 1e300;   ///< lower bound of the squared distance to all other faces
  double second = 1e150;    ///< its root
  std::uint16_t place = kAsleep;
  ClosestPoint closest;
};

ClosestPoint closest_on(const PairBody& target, std::uint32_t face, const Vec3d& point) {
  const Triangle& t = target.topology->faces()[face];
  return closest_point_on_triangle(point, target.node(t[0]), target.node(t[1]), target.node(t[2]));
}

void try_face(const Vec3d& point, std::uint16_t place, const PointsEvaluation& e, const PointsAgainstBody& lists, Candidate& best) {
  const Vec3d away = point - e.target_centroid[place];
  // The ball of the face has grown by at most twice what the bodies moved since it was measured.
  const double radius = lists.target_radius[place] + 2.0 * e.motion_since_built;
  const double limit = std::min(best.second, best.distance + kLead) + radius;
  const double center2 = norm2(away);
  if (center2 > limit * limit) return;
  const ClosestPoint closest = closest_on(e.target, lists.target_face[place], point);
  if (closest.distance2 < best.distance2 || (closest.distance2 == best.distance2 && place < best.place)) {
    if (best.distance2 < best.second2) {
      best.second2 = best.distance2;
      best.second = std::sqrt(best.second2);
    }
    best.distance2 = closest.distance2;
    best.distance = std::sqrt(best.distance2);
    best.place = place;
    best.closest = closest;
  } else if (closest.distance2 < best.second2) {
    best.second2 = closest.distance2;
    best.second = std::sqrt(best.second2);
  }
}

/// The nearest of the candidates, ties to the lowest face.
Candidate search(const Vec3d& point, std::size_t index, std::size_t source_face, const PointsEvaluation& e,
                 const PointsAgainstBody& lists) {
  Candidate best;
  const double reach = e.reach.candidates();
  best.second = reach;  // faces beyond the lists' reach are of no interest
  best.second2 = reach * reach;
  const std::uint16_t guess = lists.nearest[index];
  if (guess != kAsleep) try_face(point, guess, e, lists, best);
  for (std::uint32_t k = lists.first_candidate[source_face]; k < lists.first_candidate[source_face + 1]; ++k)
    if (lists.candidate[k] != guess) try_face(point, lists.candidate[k], e, lists, best);
  best.second = std::min(best.second, best.distance + kLead);
  return best;
}

bool is_inside(const Vec3d& point, const PairBody& target, std::uint32_t face, const ClosestPoint& closest) {
  return dot(point - closest.point, pseudonormal(target, face, closest.barycentric)) < 0.0;
}

PointGap signed_gap(const Vec3d& point, std::uint16_t place, const ClosestPoint& closest, bool inside, const PointsEvaluation& e,
                    const PointsAgainstBody& lists) {
  PointGap out;
  const double distance = std::sqrt(closest.distance2);
  out.gap = inside ? -distance : distance;
  out.in_range = out.gap < e.reach.range;
  out.place = place;
  out.foot = closest.point;
  for (int c = 0; c < 3; ++c) out.mu[c] = closest.barycentric[c];
  const Vec3d away = point - closest.point;
  const bool on_face = closest.barycentric[0] != 0.0 && closest.barycentric[1] != 0.0 && closest.barycentric[2] != 0.0;
  if (on_face || distance < 1e-12)
    out.normal = e.target.face_normal[lists.target_face[place]];
  else
    out.normal = away * ((inside ? -1.0 : 1.0) / distance);
  return out;
}

}  // namespace

PointGap gap_to_sphere(const Vec3d& point, const PairBody& target, const ListReach& reach) {
  PointGap out;
  const Vec3d away = point - target.node(0);
  const double distance = norm(away);
  out.gap = distance - target.radius;
  out.in_range = out.gap < reach.range;
  out.normal = distance > 1e-12 ? away * (1.0 / distance) : Vec3d{0, 0, 1};
  out.foot = target.node(0) + out.normal * target.radius;
  return out;
}

PointGap gap_to_surface(const Vec3d& point, std::size_t index, std::size_t source_face, const PointsEvaluation& e,
                        PointsAgainstBody& lists) {
  const bool sure = e.motion < lists.good_until[index];
  if (sure && lists.nearest[index] == kAsleep) return {};
  if (sure) {
    const std::uint16_t place = lists.nearest[index];
    const ClosestPoint closest = closest_on(e.target, lists.target_face[place], point);
    return signed_gap(point, place, closest, is_inside(point, e.target, lists.target_face[place], closest), e, lists);
  }

  const Candidate best = search(point, index, source_face, e, lists);
  constexpr double kSafety = 0.999;  // bounds hold in spite of rounding
  if (best.place == kAsleep) {
    const double clear = e.reach.candidates() - e.motion_since_built - e.reach.range;
    lists.nearest[index] = kAsleep;
    lists.good_until[index] = static_cast<float>((e.motion + clear * kSafety) * (1.0 - 1e-6));
    return {};
  }
  const double distance = best.distance;
  const bool inside = is_inside(point, e.target, lists.target_face[best.place], best.closest);
  if (!inside && distance >= e.reach.range) {
    lists.nearest[index] = kAsleep;
    lists.good_until[index] = static_cast<float>((e.motion + (distance - e.reach.range) * kSafety) * (1.0 - 1e-6));
    return {};
  }
  lists.nearest[index] = best.place;
  // No other face can be nearer while twice the motion is less than the lead of the nearest one.
  const double second = std::min(best.second, e.reach.candidates() - e.motion_since_built);
  lists.good_until[index] = static_cast<float>((e.motion + 0.5 * (second - distance) * kSafety) * (1.0 - 1e-6));
  return signed_gap(point, best.place, best.closest, inside, e, lists);
}

}  // namespace morula
