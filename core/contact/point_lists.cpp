#include <algorithm>
#include <cmath>

#include "core/contact/surface_pair.h"

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

void add_candidates_of_face(const Ball& face, std::span<const Ball> target, double reach, std::vector<std::uint16_t>& out) {
  for (std::size_t m = 0; m < target.size(); ++m) {
    const double limit = reach + face.radius + target[m].radius;
    if (norm2(target[m].center - face.center) < limit * limit) out.push_back(static_cast<std::uint16_t>(m));
  }
}

std::uint16_t number_of(const std::vector<std::uint16_t>& sorted, std::uint32_t node) {
  return static_cast<std::uint16_t>(std::lower_bound(sorted.begin(), sorted.end(), node) - sorted.begin());
}

void collect_nodes(const Topology* topology, std::span<const std::uint32_t> faces, std::vector<std::uint16_t>& nodes) {
  for (const std::uint32_t face : faces)
    for (const std::uint32_t node : topology->faces()[face]) nodes.push_back(static_cast<std::uint16_t>(node));
}

void sort_unique(std::vector<std::uint16_t>& nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

void number_faces(const Topology* topology, std::span<const std::uint32_t> faces, const std::vector<std::uint16_t>& nodes,
                  std::vector<std::array<std::uint16_t, 3>>& numbered) {
  numbered.clear();
  for (const std::uint32_t face : faces) {
    const Triangle& t = topology->faces()[face];
    numbered.push_back({number_of(nodes, t[0]), number_of(nodes, t[1]), number_of(nodes, t[2])});
  }
}

}  // namespace

void build_point_lists(const PairBody& source, const PairBody& target, const ListReach& reach, int points_per_face,
                       std::span<const std::uint32_t> target_faces, PointsAgainstBody& lists) {
  lists.source_face.clear();
  lists.target_face.clear();
  lists.target_radius.clear();
  lists.first_candidate.assign(1, 0);
  lists.candidate.clear();

  const double distance = reach.candidates();
  std::vector<Ball> balls;
  Box near;
  if (target.topology == nullptr) {
    near.include(target.node(0) - Vec3d{1, 1, 1} * target.radius);
    near.include(target.node(0) + Vec3d{1, 1, 1} * target.radius);
  } else {
    for (const std::uint32_t face : target_faces) {
      balls.push_back(face_ball(target, face));
      near.include(balls.back().center - Vec3d{1, 1, 1} * balls.back().radius);
      near.include(balls.back().center + Vec3d{1, 1, 1} * balls.back().radius);
    }
    if (balls.empty()) return;
  }
  near = near.inflated(distance);

  for (std::uint32_t face = 0; face < source.topology->face_count(); ++face) {
    const Triangle& t = source.topology->faces()[face];
    Box box;
    for (const std::uint32_t node : t) box.include(source.node(node));
    if (!box.overlaps(near)) continue;
    const Ball ball = face_ball(source, face);
    if (target.topology == nullptr) {
      const double limit = target.radius + ball.radius + distance;
      if (norm2(ball.center - target.node(0)) > limit * limit) continue;
    } else {
      const std::size_t before = lists.candidate.size();
      add_candidates_of_face(ball, balls, distance, lists.candidate);
      if (lists.candidate.size() == before) continue;
    }
    lists.source_face.push_back(face);
    lists.first_candidate.push_back(static_cast<std::uint32_t>(lists.candidate.size()));
  }

  // Keep only the target faces that are somebody's candidate, in their order.
  std::vector<std::uint16_t> place(balls.size(), kAsleep);
  for (const std::uint16_t m : lists.candidate) place[m] = 0;
  std::uint16_t kept = 0;
  for (std::size_t m = 0; m < place.size(); ++m) {
    if (place[m] == kAsleep) continue;
    place[m] = kept++;
    lists.target_face.push_back(target_faces[m]);
    lists.target_radius.push_back(static_cast<float>(balls[m].radius * 1.000001));
  }
  for (std::uint16_t& m : lists.candidate) m = place[m];
  const std::size_t points = lists.source_face.size() * static_cast<std::size_t>(points_per_face);
  lists.nearest.assign(points, kAsleep);
  lists.good_until.assign(points, -1e30f);
}

void number_pair_nodes(const Topology* topology_a, const Topology* topology_b, SurfacePair& pair) {
  const Topology* topology[2] = {topology_a, topology_b};
  for (int body = 0; body < 2; ++body) {
    auto& nodes = pair.gradient[body].node;
    nodes.clear();
    if (topology[body] == nullptr) {
      nodes.push_back(0);
    } else if (!(pair.rigid && body == 1)) {
      collect_nodes(topology[body], pair.points[body].source_face, nodes);
      collect_nodes(topology[body], pair.points[1 - body].target_face, nodes);
      sort_unique(nodes);
    }
  }
  for (int d = 0; d < 2; ++d) {
    PointsAgainstBody& points = pair.points[d];
    points.source_node.clear();
    points.target_node.clear();
    if (points.source_face.empty()) continue;
    number_faces(topology[d], points.source_face, pair.gradient[d].node, points.source_node);
    if (!pair.rigid && topology[1 - d] != nullptr)
      number_faces(topology[1 - d], points.target_face, pair.gradient[1 - d].node, points.target_node);
  }
}

void clear_results(SurfacePair& pair) {
  pair.energy = 0.0;
  pair.overlap = 0.0;
  for (int body = 0; body < 2; ++body) {
    PairGradient& gradient = pair.gradient[body];
    gradient.force.assign(gradient.node.size(), Vec3d{});
    gradient.node_normal.clear();
    gradient.face_energy.assign(pair.points[body].source_face.size(), 0.0);
    gradient.face_contact.assign(pair.points[body].source_face.size(), 0.0);
    gradient.face_normal.clear();
    pair.elements[body].clear();
  }
}

}  // namespace morula
