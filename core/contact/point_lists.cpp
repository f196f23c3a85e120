#include <algorithm>
#include <cmath>

#include "core/contact/closest_foot.h"
#include "core/contact/faces_in_box.h"
#include "core/contact/self_contact.h"
#include "core/contact/surface_pair.h"
#include "core/simd/transpose.h"

namespace morula {
namespace {

struct Ball {
  Vec3d center;
  double radius;
};

Ball face_ball(const PairBody& body, std::uint32_t face) {
  const Triangle& t = body.topology->faces()[face];
  const Vec3d center = body.centroid(face);
  double radius2 = 0.0;
  for (const std::uint32_t node : t) radius2 = std::max(radius2, norm2(body.node(node) - center));
  return {center, std::sqrt(radius2)};
}

constexpr int kLanes = 8;
using Real = Lane<double, kLanes>;

/// Balls around faces, eight at a time; those that fill up the last eight are out of everybody's reach.
struct Balls {
  std::vector<double> x, y, z, radius;
  std::size_t count = 0;

  void add(const Ball& ball) {
    if (count++ % kLanes == 0) {
      for (auto* v : {&x, &y, &z}) v->resize(v->size() + kLanes, 1e30);
      radius.resize(radius.size() + kLanes, 0.0);
    }
    x[count - 1] = ball.center.x, y[count - 1] = ball.center.y, z[count - 1] = ball.center.z;
    radius[count - 1] = ball.radius;
  }
  /// Call `found` with the number of each ball within `distance` of a point.
  template <class Found>
  void near(const Vec3d& point, double distance, Found&& found) const {
    for (std::size_t first = 0; first < count; first += kLanes) {
      const Vec3<Real> away{Real::load(x.data() + first) - Real(point.x), Real::load(y.data() + first) - Real(point.y),
                            Real::load(z.data() + first) - Real(point.z)};
      const Real far = Real::load(radius.data() + first) + Real(distance);
      const auto within = norm2(away) < far * far;
      if (!any_lane<kLanes>(within)) continue;
      for (int lane = 0; lane < kLanes; ++lane)
        if (within[lane] != 0) found(first + static_cast<std::size_t>(lane));
    }
  }
};

/// Add the target faces that are within `reach` of the ball of a source face's points, and that `counts(face)`.
template <class Counts>
void add_candidates_of_face(const Ball& points, const PairBody& target, std::span<const std::uint32_t> target_faces, const Balls& balls,
                            double reach, Counts&& counts, std::vector<std::uint16_t>& out) {
  const double limit = (reach + points.radius) * (1.0 + 1e-9), limit2 = limit * limit;
  std::uint16_t waiting[kLanes];
  int count = 0;
  alignas(64) double corner[3][3][kLanes] = {};
  const auto measure = [&] {
    const auto load = [&](std::size_t k) {
      return Vec3<Real>{Real::load(corner[k][0]), Real::load(corner[k][1]), Real::load(corner[k][2])};
    };
    const auto foot = closest_foot<Real>({points.center.x, points.center.y, points.center.z}, load(0), load(1), load(2));
    for (int lane = 0; lane < count; ++lane)
      if (foot.distance2[lane] < limit2 || foot.doubtful[lane] != 0.0) out.push_back(waiting[lane]);
    count = 0;
  };
  balls.near(points.center, limit, [&](std::size_t m) {
    if (!counts(target_faces[m])) return;
    const Triangle& t = target.topology->faces()[target_faces[m]];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d x = target.node(t[k]);
      corner[k][0][count] = x.x, corner[k][1][count] = x.y, corner[k][2][count] = x.z;
    }
    waiting[count++] = static_cast<std::uint16_t>(m);
    if (count == kLanes) measure();
  });
  if (count > 0) measure();
}

void mark_nodes(const Topology& topology, std::span<const std::uint32_t> faces, std::vector<char>& marked) {
  for (const std::uint32_t face : faces)
    for (const std::uint32_t node : topology.faces()[face]) marked[node] = 1;
}

/// Carry over the nearest faces as guesses, and let points sleep on: at most until `longest`, since there are new candidates. `motion` is
/// that since the old lists were built.
void keep_what_is_known(const PointsAgainstBody& old, std::size_t points_per_face, double motion, double longest,
                        PointsAgainstBody& lists) {
  std::size_t k = 0;
  for (std::size_t m = 0; m < lists.source_face.size(); ++m) {
    while (k < old.source_face.size() && old.source_face[k] < lists.source_face[m]) ++k;
    if (k == old.source_face.size()) return;
    if (old.source_face[k] != lists.source_face[m]) continue;
    for (std::size_t q = 0; q < points_per_face; ++q) {
      const std::uint16_t known = old.nearest[k * points_per_face + q];
      std::uint16_t& now = lists.nearest[m * points_per_face + q];
      if ((known & kNoFace) != kNoFace) {
        const std::uint32_t face = old.target_face[known & kNoFace];
        const auto at = std::lower_bound(lists.target_face.begin(), lists.target_face.end(), face);
        if (at != lists.target_face.end() && *at == face) now = static_cast<std::uint16_t>(at - lists.target_face.begin());
      }
      if (!(known & kAsleep)) continue;
      now |= kAsleep;
      lists.good_until[m * points_per_face + q] =
          static_cast<float>(std::min(old.good_until[k * points_per_face + q] - motion, longest) * (1.0 - 1e-6));
    }
  }
}

}  // namespace

void build_point_lists(const PairBody& source, const PairBody& target, const ListReach& reach, int points_per_face,
                       std::span<const std::uint32_t> target_faces, const PointsAgainstBody& old, double motion, double motion_since_built,
                       PointsAgainstBody& lists, int rings) {
  lists.clear();
  const double distance = reach.candidates();
  Balls balls;
  Box near;
  if (target.topology == nullptr) {
    near.include(target.node(0) - Vec3d{1, 1, 1} * target.radius);
    near.include(target.node(0) + Vec3d{1, 1, 1} * target.radius);
  } else {
    for (const std::uint32_t face : target_faces) {
      const Ball ball = face_ball(target, face);
      balls.add(ball);
      near.include(ball.center - Vec3d{1, 1, 1} * ball.radius);
      near.include(ball.center + Vec3d{1, 1, 1} * ball.radius);
    }
    if (balls.count == 0) return;
  }
  near = near.inflated(distance);
  NodesAround around(*source.topology);

  std::vector<std::uint32_t> source_faces;
  faces_in_box(source, near, source_faces);
  for (const std::uint32_t face : source_faces) {
    Ball ball = face_ball(source, face);
    ball.radius *= 0.5;  // of its points, at (2/3, 1/6, 1/6) and at the centroid
    if (target.topology == nullptr) {
      const double limit = target.radius + ball.radius + distance;
      if (norm2(ball.center - target.node(0)) > limit * limit) continue;
    } else {
      const std::size_t before = lists.candidate.size();
      if (rings > 0) around.find(face, rings);
      add_candidates_of_face(
          ball, target, target_faces, balls, distance, [&](std::uint32_t other) { return rings == 0 || !around.touch(other); },
          lists.candidate);
      if (lists.candidate.size() == before) continue;
    }
    lists.source_face.push_back(face);
    lists.first_candidate.push_back(static_cast<std::uint32_t>(lists.candidate.size()));
  }

  // Keep only the target faces that are somebody's candidate, in their order.
  std::vector<std::uint16_t> place(balls.count, kNoFace);
  for (const std::uint16_t m : lists.candidate) place[m] = 0;
  std::uint16_t kept = 0;
  for (std::size_t m = 0; m < place.size(); ++m) {
    if (place[m] == kNoFace) continue;
    place[m] = kept++;
    lists.target_face.push_back(target_faces[m]);
  }
  for (std::uint16_t& m : lists.candidate) m = place[m];
  const std::size_t points = lists.source_face.size() * static_cast<std::size_t>(points_per_face);
  lists.nearest.assign(points, kNoFace);
  lists.good_until.assign(points, 0.0f);
  // Faces that were in no list were beyond its reach, and the bodies have moved since.
  keep_what_is_known(old, static_cast<std::size_t>(points_per_face), motion, 0.999 * (distance - motion_since_built - reach.range), lists);
}

void collect_pair_nodes(const Topology* topology_a, const Topology* topology_b, const PointsAgainstBody (&lists)[2], SurfacePair& pair) {
  const Topology* topology[2] = {topology_a, topology_b};
  std::vector<std::uint16_t> nodes;
  std::vector<char> marked;
  for (int body = 0; body < 2; ++body) {
    nodes.clear();
    if (topology[body] == nullptr) {
      nodes.push_back(0);
    } else if (!(pair.rigid && body == 1)) {
      marked.assign(topology[body]->node_count(), 0);
      mark_nodes(*topology[body], lists[body].source_face, marked);
      mark_nodes(*topology[body], lists[1 - body].target_face, marked);
      for (std::size_t i = 0; i < marked.size(); ++i)
        if (marked[i]) nodes.push_back(static_cast<std::uint16_t>(i));
    }
    pair.node[body].assign(nodes.begin(), nodes.end());
  }
}

void clear_results(SurfacePair& pair, const std::size_t (&node_count)[2], PairGradient (&gradient)[2]) {
  pair.at_start = false;
  pair.energy = 0.0;
  pair.overlap = 0.0;
  pair.crossed = 0;
  pair.crossed_at = 1e300;
  for (int body = 0; body < 2; ++body) {
    PairGradient& g = gradient[body];
    if (g.force.size() < node_count[body]) g.force.resize(node_count[body]);
    if (g.node_normal.size() < node_count[body]) g.node_normal.resize(node_count[body]);
    for (const std::uint16_t node : pair.node[body]) {
      g.force[node] = {};
      g.node_normal[node] = {};
    }
    g.has_node_normal = false;
    g.face_energy.assign(pair.points[body].source_count(), 0.0);
    g.told_area.assign(pair.points[body].source_count(), 0.0f);
    g.source_face.clear();
    g.contact_area = 0.0;
    pair.elements[body] = {};
    pair.within[body] = {};
  }
}

}  // namespace morula
