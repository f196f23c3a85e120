#include "core/contact/nearest_face.h"

#include <algorithm>
#include <cmath>

#include "core/contact/closest_foot.h"
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
constexpr double kLead = 0.08;

constexpr int kLanes = 8;

/// The nearest faces so far.
class Search {
 public:
  Search(const Vec3d& point, const PointsEvaluation& e, const PointsAgainstBody& lists) : point_(point), e_(e), lists_(lists) {
    second_ = e.reach.candidates();  // faces beyond the lists' reach are of no interest
    second2_ = second_ * second_;
  }

  /// Whether a face may be nearer than what is known; its ball has grown by at most twice what the nodes moved since it was measured.
  [[nodiscard]] bool may_be_near(std::uint16_t place) const {
    const double limit = std::min(second_, distance_ + kLead) + lists_.target_radius[place] + 2.0 * e_.patch_since_built;
    return norm2(point_ - e_.target_centroid[place]) <= limit * limit;
  }
  void try_face(std::uint16_t place) {
    const Triangle& t = faces()[lists_.target_face[place]];
    take(place, closest_foot_of(point_, e_.target.node(t[0]), e_.target.node(t[1]), e_.target.node(t[2])).distance2);
  }
  void try_faces(const std::uint16_t (&place)[kLanes], int count) {
    using Real = Lane<double, kLanes>;
    if (count < 3) {
      for (int lane = 0; lane < count; ++lane) try_face(place[lane]);
      return;
    }
    alignas(64) double corner[3][3][kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
      const Triangle& t = faces()[lists_.target_face[place[std::min(lane, count - 1)]]];
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3d x = e_.target.node(t[k]);
        for (std::size_t c = 0; c < 3; ++c) corner[k][c][lane] = x[c];
      }
    }
    const auto load = [&](std::size_t k) {
      return Vec3<Real>{Real::load(corner[k][0]), Real::load(corner[k][1]), Real::load(corner[k][2])};
    };
    const auto foot = closest_foot<Real>({point_.x, point_.y, point_.z}, load(0), load(1), load(2));
    for (int lane = 0; lane < count; ++lane) {
      if (foot.doubtful[lane] != 0.0)
        try_face(place[lane]);
      else
        take(place[lane], foot.distance2[lane]);
    }
  }
  [[nodiscard]] FoundFace result() const { return {place_, std::min(second_, distance_ + kLead)}; }

 private:
  [[nodiscard]] std::span<const Triangle> faces() const { return e_.target.topology->faces(); }
  void take(std::uint16_t place, double distance2) {
    if (distance2 < distance2_ || (distance2 == distance2_ && place < place_)) {
      if (distance2_ < second2_) set_second(distance2_);
      distance2_ = distance2;
      distance_ = std::sqrt(distance2);
      place_ = place;
    } else if (distance2 < second2_) {
      set_second(distance2);
    }
  }
  void set_second(double distance2) {
    second2_ = distance2;
    second_ = std::sqrt(distance2);
  }

  const Vec3d& point_;
  const PointsEvaluation& e_;
  const PointsAgainstBody& lists_;
  double distance2_ = 1e300, distance_ = 1e150, second2_, second_;
  std::uint16_t place_ = kAsleep;
};

}  // namespace

FoundFace find_nearest_face(const Vec3d& point, std::size_t source_place, std::uint16_t guess, const PointsEvaluation& e,
                              const PointsAgainstBody& lists) {
  Search search(point, e, lists);
  if (guess != kAsleep) search.try_face(guess);
  std::uint16_t waiting[kLanes];
  int count = 0;
  for (std::uint32_t k = lists.first_candidate[source_place]; k < lists.first_candidate[source_place + 1]; ++k) {
    const std::uint16_t place = lists.candidate[k];
    if (place == guess || !search.may_be_near(place)) continue;
    waiting[count++] = place;
    if (count == kLanes) {
      search.try_faces(waiting, count);
      count = 0;
    }
  }
  search.try_faces(waiting, count);
  return search.result();
}

bool is_inside(const Vec3d& away, const PairBody& target, std::uint32_t face, const double (&mu)[3]) {
  return dot(away, pseudonormal(target, face, mu)) < 0.0;
}

void remember(const FoundFace& nearest, double gap, std::size_t index, const PointsEvaluation& e, PointsAgainstBody& lists) {
  constexpr double kSafety = 0.999;  // bounds hold in spite of rounding
  const double reach = e.reach.candidates() - e.motion_since_built;  // within which all faces are known
  double clear;
  if (nearest.place == kAsleep || gap >= e.reach.range) {
    lists.nearest[index] = kAsleep;
    clear = (nearest.place == kAsleep ? reach : std::min(gap, reach)) - e.reach.range;
  } else {
    // No other face can be nearer while twice the motion is less than the lead of the nearest one.
    lists.nearest[index] = nearest.place;
    clear = 0.5 * (std::min(nearest.second, reach) - std::abs(gap));
  }
  lists.good_until[index] = static_cast<float>((e.motion + clear * kSafety) * (1.0 - 1e-6));
}

}  // namespace morula
