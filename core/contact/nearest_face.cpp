#include "core/contact/nearest_face.h"

#include <algorithm>
#include <cmath>

#include "core/contact/closest_foot.h"
#include "core/mesh/pseudonormal.h"
#include "core/simd/transpose.h"

namespace morula {
namespace {

/// A vector on the outer side of the nearest feature: face normal, sum of the two face normals at an edge, angle-weighted normal at a
/// node (Bærentzen & Aanæs 2005, doi:10.1109/TVCG.2005.49).
Vec3d pseudonormal(const PairBody& target, std::uint32_t face, const double (&mu)[3]) {
  const int zeros = (mu[0] == 0.0) + (mu[1] == 0.0) + (mu[2] == 0.0);
  if (zeros == 0) return target.face_normal(face);
  const Topology& topology = *target.topology;
  if (zeros == 1) {
    const int opposite = mu[0] == 0.0 ? 0 : mu[1] == 0.0 ? 1 : 2;
    const Edge& edge = topology.edges()[topology.face_edges()[face][static_cast<std::size_t>(opposite)]];
    return target.face_normal(edge.left) + target.face_normal(edge.right);
  }
  const int corner = mu[0] != 0.0 ? 0 : mu[1] != 0.0 ? 1 : 2;
  const std::uint32_t node = topology.faces()[face][static_cast<std::size_t>(corner)];
  Vec3d sum;
  for (const std::uint32_t f : topology.faces_of_node(node)) {
    const Triangle& t = topology.faces()[f];
    sum += target.face_normal(f) * corner_angle(t, corner_of(t, node), target.position);
  }
  return sum;
}

/// How far behind the nearest face another one need be known to lie: a longer lead would save nothing, since bodies move less between
/// evaluations [µm].
constexpr double kLead = 0.08;

constexpr int kLanes = 8;

/// Distances of all jobs, eight at a time.
void measure(const PointsEvaluation& e, const PointsAgainstBody& lists, PointsWorkspace& ws) {
  using Real = Lane<double, kLanes>;
  const auto faces = e.target.topology->faces();
  const std::size_t jobs = ws.jobs.size();
  ws.distance2.resize((jobs + kLanes - 1) / kLanes * kLanes);
  alignas(64) double data[4][3][kLanes];  // corners, then the point
  for (std::size_t first = 0; first < jobs; first += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const auto& job = ws.jobs[std::min(first + static_cast<std::size_t>(lane), jobs - 1)];
      const Triangle& t = faces[lists.target_face[job.place]];
      const Vec3d& point = ws.points[job.point].position;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3d& x = e.target.position[t[k]];
        data[k][0][lane] = x.x, data[k][1][lane] = x.y, data[k][2][lane] = x.z;
      }
      data[3][0][lane] = point.x, data[3][1][lane] = point.y, data[3][2][lane] = point.z;
    }
    const auto load = [&](std::size_t k) { return Vec3<Real>{Real::load(data[k][0]), Real::load(data[k][1]), Real::load(data[k][2])}; };
    const Vec3<Real> shift{e.target.shift.x, e.target.shift.y, e.target.shift.z};
    const auto foot = closest_foot<Real>(load(3), load(0) + shift, load(1) + shift, load(2) + shift);
    foot.distance2.store(ws.distance2.data() + first);
    if (!any_lane<kLanes>(foot.doubtful > Real(0.0))) continue;
    for (std::size_t k = first; k < std::min(jobs, first + kLanes); ++k) {
      const Triangle& t = faces[lists.target_face[ws.jobs[k].place]];
      ws.distance2[k] =
          closest_foot_of(ws.points[ws.jobs[k].point].position, e.target.node(t[0]), e.target.node(t[1]), e.target.node(t[2])).distance2;
    }
  }
}

/// Balls around the centroids of the target's faces.
void find_balls(const PointsEvaluation& e, const PointsAgainstBody& lists, PointsWorkspace& ws) {
  ws.ball.resize(lists.target_face.size());
  for (std::size_t m = 0; m < ws.ball.size(); ++m) {
    const std::uint32_t face = lists.target_face[m];
    const Triangle& t = e.target.topology->faces()[face];
    const Vec3d center = e.target.centroid(face);
    double radius2 = 0.0;
    for (const std::uint32_t node : t) radius2 = std::max(radius2, norm2(e.target.node(node) - center));
    ws.ball[m] = {center, std::sqrt(radius2) * (1.0 + 1e-12)};
  }
}

/// The nearest face so far and how far all others are at least.
struct Best {
  double distance2 = 1e300, second2;
  std::uint16_t place = kNoFace;

  void take(std::uint16_t other, double other2) {
    if (other2 < distance2 || (other2 == distance2 && other < place)) {
      second2 = std::min(second2, distance2);
      distance2 = other2;
      place = other;
    } else {
      second2 = std::min(second2, other2);
    }
  }
};

/// Queue the candidates that may be nearer than `limit`, but for the guess.
void queue_candidates(const PointsAgainstBody& lists, std::uint32_t number, double limit, PointsWorkspace& ws) {
  const ContactPoint& point = ws.points[number];
  const std::uint32_t begin = lists.first_candidate[point.source_place], end = lists.first_candidate[point.source_place + 1];
  std::size_t count = ws.jobs.size();
  ws.jobs.resize(count + (end - begin));
  for (std::uint32_t k = begin; k < end; ++k) {
    const std::uint16_t place = lists.candidate[k];
    const PointsWorkspace::Ball& ball = ws.ball[place];
    const double far = limit + ball.radius;
    ws.jobs[count] = {number, place};
    count += static_cast<std::size_t>((norm2(ball.center - point.position) <= far * far) & (place != point.place));
  }
  ws.jobs.resize(count);
}

}  // namespace

void find_nearest_faces(const PointsEvaluation& e, const PointsAgainstBody& lists, PointsWorkspace& ws) {
  if (ws.search.empty()) return;
  find_balls(e, lists, ws);
  // Of most points the nearest face is still the one that it was: measure that first.
  ws.jobs.clear();
  for (const std::uint32_t number : ws.search)
    if (ws.points[number].place != kNoFace) ws.jobs.push_back({number, ws.points[number].place});
  measure(e, lists, ws);
  std::vector<double>& guessed = ws.guessed;
  guessed.assign(ws.distance2.begin(), ws.distance2.begin() + static_cast<std::ptrdiff_t>(ws.jobs.size()));

  const double reach = e.reach.candidates();  // faces beyond the lists' reach are of no interest
  ws.jobs.clear();
  std::size_t guess = 0;
  for (const std::uint32_t number : ws.search) {
    const ContactPoint& point = ws.points[number];
    double near;  // the nearest face is not farther than this
    if (point.place != kNoFace) {
      near = std::sqrt(guessed[guess++]);
    } else {
      double near2 = reach * reach;
      for (std::uint32_t k = lists.first_candidate[point.source_place]; k < lists.first_candidate[point.source_place + 1]; ++k)
        near2 = std::min(near2, norm2(ws.ball[lists.candidate[k]].center - point.position));
      near = std::sqrt(near2);
    }
    queue_candidates(lists, number, std::min(reach, near + kLead), ws);
  }
  measure(e, lists, ws);
  guess = 0;
  std::size_t job = 0;
  for (const std::uint32_t number : ws.search) {
    ContactPoint& point = ws.points[number];
    Best best;
    best.second2 = reach * reach;
    if (point.place != kNoFace) best.take(point.place, guessed[guess++]);
    for (; job < ws.jobs.size() && ws.jobs[job].point == number; ++job) best.take(ws.jobs[job].place, ws.distance2[job]);
    const bool found = best.distance2 <= reach * reach;
    point.place = found ? best.place : kNoFace;
    point.second = std::min(std::sqrt(best.second2), std::sqrt(best.distance2) + kLead);
  }
}

bool is_inside(const Vec3d& away, const PairBody& target, std::uint32_t face, const double (&mu)[3]) {
  return dot(away, pseudonormal(target, face, mu)) < 0.0;
}

void remember(const ContactPoint& point, double gap, std::size_t index, const PointsEvaluation& e, PointsAgainstBody& lists) {
  constexpr double kSafety = 0.999;                                  // bounds hold in spite of rounding
  const double reach = e.reach.candidates() - e.motion_since_built;  // within which all faces are known
  const bool asleep = point.place == kNoFace || gap >= e.reach.range;
  double clear;
  if (asleep)
    clear = (point.place == kNoFace ? reach : std::min(gap, reach)) - e.reach.range;
  else  // no other face can be nearer while twice the motion is less than the lead of the nearest one
    clear = 0.5 * (std::min(point.second, reach) - std::abs(gap));
  lists.nearest[index] = static_cast<std::uint16_t>(asleep ? point.place | kAsleep : point.place);
  lists.good_until[index] = static_cast<float>(std::max(0.0, (e.motion + clear * kSafety) * (1.0 - 1e-6)));
}

}  // namespace morula
