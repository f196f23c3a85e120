#include <algorithm>
#include <cmath>

#include "core/contact/crossing.h"
#include "core/contact/nearest_face.h"
#include "core/contact/point_batch.h"
#include "core/contact/point_gradient.h"
#include "core/contact/rim_points.h"
#include "core/contact/surface_pair.h"

namespace morula {
namespace {

constexpr std::size_t kLanes = PointBatch::kLanes;

Vec3d quadrature_point(const PointsEvaluation& e, const Triangle& t, std::size_t q) {
  const auto& beta = e.quadrature.weight[q];
  return e.source.node(t[0]) * beta[0] + e.source.node(t[1]) * beta[1] + e.source.node(t[2]) * beta[2];
}

/// Where what is known of a point is kept.
std::size_t kept_at(const PointsEvaluation& e, std::size_t source_place, std::size_t q) {
  return source_place * static_cast<std::size_t>(e.quadrature.kept()) + e.quadrature.kept_at(q);
}

/// Note a point unless it surely is out of range. Where its nearest face is not sure it is to be searched for, from `guess` if nothing is known.
void collect_point(const PointsEvaluation& e, const PointsAgainstBody& lists, std::uint32_t source_place, std::size_t q,
                   std::uint16_t guess, PointsWorkspace& ws) {
  const std::size_t index = kept_at(e, source_place, q);
  const std::uint16_t known = lists.nearest[index], place = known & kNoFace;
  const bool sure = e.motion < lists.good_until[index];
  if (sure && (known & kAsleep)) return;
  if (!sure && e.target.topology != nullptr) ws.search.push_back(static_cast<std::uint32_t>(ws.points.size()));
  const Triangle& t = e.source.topology->faces()[lists.source_face[source_place]];
  ws.points.push_back({quadrature_point(e, t, q), source_place, static_cast<std::uint16_t>(q), place == kNoFace ? guess : place});
}

void collect_coarse_points(const PointsEvaluation& e, const PointsAgainstBody& lists, PointsWorkspace& ws) {
  ws.points.clear();
  ws.search.clear();
  for (std::uint32_t k = 0; k < lists.source_face.size(); ++k)
    for (std::size_t q = 0; q < static_cast<std::size_t>(e.quadrature.count); ++q) collect_point(e, lists, k, q, kNoFace, ws);
}

/// Those of the faces at the rim; the nearest face of a coarse point is a good guess.
void collect_fine_points(const PointsEvaluation& e, const PointsAgainstBody& lists, PointsWorkspace& ws) {
  ws.points.clear();
  ws.search.clear();
  for (const RimFace& face : ws.rim)
    for (std::size_t q = 0; q < FaceQuadrature::kFine; ++q)
      collect_point(e, lists, face.place, FaceQuadrature::kFirstFine + q, lists.nearest[kept_at(e, face.place, q % 3)] & kNoFace, ws);
}

/// Find the nearest faces that are to be searched for; what has no face within reach is out of range.
void find_faces(const PointsEvaluation& e, const PackedPoints& packed, PointsWorkspace& ws) {
  if (e.target.topology == nullptr) return;
  PointsAgainstBody& lists = ws.lists;
  if (!ws.search.empty()) {
    if (lists.first_candidate.size() != lists.source_face.size() + 1) packed.unpack_candidates(lists);
    find_nearest_faces(e, lists, ws);
  }
  std::erase_if(ws.points, [&](const ContactPoint& p) {
    if (p.place == kNoFace) remember(p, 0.0, kept_at(e, p.source_place, p.q), e, lists);
    return p.place == kNoFace;
  });
}

void fill(const PointsEvaluation& e, const PointsAgainstBody& lists, const ContactPoint& p, int lane, PointBatch& batch) {
  put(batch.point, lane, p.position);
  const Triangle& s = e.source.topology->faces()[lists.source_face[p.source_place]];
  for (std::size_t k = 0; k < 3; ++k) put(batch.source_corner[k], lane, e.source.position[s[k]]);
  if (e.target.topology == nullptr) return;
  const Triangle& t = e.target.topology->faces()[lists.target_face[p.place]];
  for (std::size_t k = 0; k < 3; ++k) {
    put(batch.corner[k], lane, e.target.node(t[k]));
    put(batch.node_normal[k], lane, e.target.node_normal[t[k]]);
  }
}

/// One direction of a pair under evaluation, and where its results go.
template <bool kPlain>
struct Direction {
  const PointsEvaluation& e;
  int d;
  const CrossingWatch& watch;
  SurfacePair& pair;
  PairGradient (&gradient)[2];
  PointsWorkspace& ws;
  const double touch = !kPlain && e.with_itself ? e.material.self_distance : 0.0;

  [[nodiscard]] const PointsAgainstBody& lists() const { return ws.lists; }
  [[nodiscard]] PointSink sink_of(std::uint32_t source_place, const Triangle& target) {
    return {gradient[d], e.target_moves ? &gradient[1 - d] : nullptr, e.source.topology->faces()[lists().source_face[source_place]],
            target};
  }
  [[nodiscard]] Triangle target_of(const ContactPoint& p) const {
    return e.target.topology == nullptr ? Triangle{0, 0, 0} : e.target.topology->faces()[lists().target_face[p.place]];
  }

  void compute(std::size_t first, int points_per_face, PointBatch& batch);
  void add_point(const ContactPoint& p, const PointBatch& batch, int lane, double part);
  void add_coarse_face(std::size_t first, std::size_t last, const PointBatch (&batch)[2]);
  void evaluate_coarse();
  void evaluate_fine();
  void add_rim_face(const RimFace& face);
};

/// All of up to eight points from number `first` on; empty lanes repeat the last point.
template <bool kPlain>
void Direction<kPlain>::compute(std::size_t first, int points_per_face, PointBatch& batch) {
  std::uint32_t face[kLanes] = {};
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const ContactPoint& p = ws.points[std::min(first + lane, ws.points.size() - 1)];
    fill(e, lists(), p, static_cast<int>(lane), batch);
    if (e.target.topology != nullptr) face[lane] = lists().target_face[p.place];
    if (!kPlain && e.material.regional)
      find_adhesion(e, d, e.source.marks(lists().source_face[p.source_place]),
                    e.target.topology != nullptr ? &e.target.topology->faces()[face[lane]] : nullptr, static_cast<int>(lane), batch);
  }
  if (e.target.topology == nullptr)
    gaps_to_sphere(e.target, batch);
  else
    gaps_to_faces(e, face, batch);
  if constexpr (!kPlain) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) batch.inside[lane] = batch.gap[lane] < 0.0;
    if (e.with_itself) take_distances(touch, batch);
  }
  respond<kPlain>(e, points_per_face, batch);
}

/// Add a part of one point's share to the pair. Points with no part still say on which side they are.
template <bool kPlain>
void Direction<kPlain>::add_point(const ContactPoint& p, const PointBatch& batch, int lane, double part) {
  const std::uint32_t face = lists().source_face[p.source_place];
  const bool sphere = e.target.topology == nullptr;
  PointSink sink = sink_of(p.source_place, target_of(p));
  PointGap gap;
  gap.gap = batch.gap[lane];
  gap.normal = get(batch.normal, lane);
  for (std::size_t j = 0; j < 3; ++j) gap.mu[j] = batch.mu[j][lane];
  if (kPlain || !e.with_itself) pair.overlap = gap.gap < -pair.overlap ? -gap.gap : pair.overlap;
  const std::uint32_t target = sphere ? 0 : lists().target_face[p.place];
  ContactElement& element = ws.elements.emplace_back(face, p.q, target < ContactElement::kMostTargetFaces ? target : 0);
  element.set_weights(batch.rounded_mu[0][lane], batch.rounded_mu[1][lane]);
  element.set_normal(gap.normal);
  element.set_inside(kPlain ? gap.gap < 0.0 : batch.inside[lane]);
  if (part == 0.0) return;
  element.set_area(static_cast<float>(batch.bearing[lane] * part));
  element.set_stiffness(static_cast<float>(batch.stiffness[lane] * part));

  const int points = p.q < FaceQuadrature::kFirstFine ? e.quadrature.count : FaceQuadrature::kFine;
  pair.energy += batch.area[lane] * batch.density[lane] * part;
  sink.source.face_energy[p.source_place] += e.share * (1.0 / points) * batch.density[lane] * part;
  if (kPlain || !e.with_itself) sink.source.contact_area += batch.told[lane] * part;
  const Vec3d pull = get(batch.pull, lane) * part;
  sink.push_source(e.quadrature, p.q, -pull);
  if (sphere)
    sink.push_target(0, pull);
  else
    sink.push_target(gap.mu, pull);
  if (batch.weight_slope[lane] != 0.0)
    add_weight_gradient(e, p.q, {get(batch.source_normal, lane), batch.face_area[lane]}, sphere ? nullptr : &sink.target_node, gap,
                        {get(batch.unit, lane), batch.length[lane]}, batch.weight_slope[lane] * batch.attraction[lane] * part, sink);
  if (!kPlain && e.material.regional && !e.target.mark.empty()) {
    double c[3];
    for (std::size_t j = 0; j < 3; ++j) c[j] = batch.per_adhesion[lane] * batch.corner_adhesion[j][lane] * part;
    if (c[0] != c[1] || c[1] != c[2]) add_foot_gradient(e, p.q, sink.target_node, gap, c, sink);
  }
}

/// The points of one face, number `first` to `last`; number i is in lane i % 8 of batch i / 8 % 2.
template <bool kPlain>
void Direction<kPlain>::add_coarse_face(std::size_t first, std::size_t last, const PointBatch (&batch)[2]) {
  const auto batch_of = [&](std::size_t i) -> const PointBatch& { return batch[i / kLanes % 2]; };
  const auto count = static_cast<std::size_t>(e.quadrature.count);
  double gaps[RimWeight::kMostPoints] = {1e300, 1e300, 1e300, 1e300};
  for (std::size_t i = first; i < last; ++i) gaps[ws.points[i].q] = batch_of(i).gap[i % kLanes];
  const RimWeight rim = RimWeight::of(gaps, count, e.material.law.range);
  RimFace* face = nullptr;
  if (rim.value > 0.0) {
    face = &ws.rim.emplace_back();
    face->place = ws.points[first].source_place;
    face->share = rim.value;
    face->area = batch_of(first).face_area[first % kLanes];
  }
  for (std::size_t i = first; i < last; ++i) {
    const ContactPoint& p = ws.points[i];
    const PointBatch& now = batch_of(i);
    const auto lane = static_cast<int>(i % kLanes);
    const double gap = now.gap[lane];
    if (p.second >= 0.0) remember(p, gap + touch, kept_at(e, p.source_place, p.q), e, ws.lists);
    if (!(gap < e.material.law.range)) continue;
    add_point(p, now, lane, 1.0 - rim.value);
    if (watch.suspects(gap + touch))
      ws.suspects.push_back({ws.elements.back().place(), kPlain ? gap < 0.0 : now.inside[lane], std::abs(gap + touch)});
    if (face == nullptr) continue;
    face->coarse_mean += now.density[lane] / static_cast<double>(count);
    face->coarse[face->count++] = {
        rim.slope[p.q], get(now.normal, lane), {now.mu[0][lane], now.mu[1][lane], now.mu[2][lane]}, p.q, target_of(p)};
  }
}

template <bool kPlain>
void Direction<kPlain>::evaluate_coarse() {
  PointBatch batch[2];
  const std::size_t size = ws.points.size();
  std::size_t done = 0;
  for (std::size_t first = 0; first < size; first += kLanes) {
    compute(first, e.quadrature.count, batch[first / kLanes % 2]);
    const std::size_t known = std::min(size, first + kLanes);
    while (done < known) {  // faces of which all points are known
      std::size_t last = done + 1;
      while (last < size && ws.points[last].source_place == ws.points[done].source_place) ++last;
      if (last > known) break;
      add_coarse_face(done, last, batch);
      done = last;
    }
  }
}

template <bool kPlain>
void Direction<kPlain>::evaluate_fine() {
  PointBatch batch;
  auto face = ws.rim.begin();
  for (std::size_t first = 0; first < ws.points.size(); first += kLanes) {
    compute(first, FaceQuadrature::kFine, batch);
    for (std::size_t i = first; i < std::min(ws.points.size(), first + kLanes); ++i) {
      const ContactPoint& p = ws.points[i];
      const auto lane = static_cast<int>(i - first);
      while (face->place != p.source_place) ++face;
      if (p.second >= 0.0) remember(p, batch.gap[lane] + touch, kept_at(e, p.source_place, p.q), e, ws.lists);
      if (!(batch.gap[lane] < e.material.law.range)) continue;
      add_point(p, batch, lane, face->share);
      face->fine_mean += batch.density[lane] / FaceQuadrature::kFine;
    }
  }
}

/// Force of ψ: the energy changes with it by what the two sets of points differ.
template <bool kPlain>
void Direction<kPlain>::add_rim_face(const RimFace& face) {
  const double difference = e.share * face.area * (face.fine_mean - face.coarse_mean);
  for (std::size_t i = 0; i < face.count; ++i) {
    const RimFace::Coarse& point = face.coarse[i];
    if (point.slope == 0.0) continue;
    PointSink sink = sink_of(face.place, point.target);
    const Vec3d pull = point.normal * (difference * point.slope);
    sink.push_source(e.quadrature, point.q, -pull);
    if (e.target.topology == nullptr)
      sink.push_target(0, pull);
    else
      sink.push_target(point.mu, pull);
  }
}

template <bool kPlain>
void evaluate_direction(const PointsEvaluation& e, int d, SurfacePair& pair, PairGradient (&gradient)[2], PointsWorkspace& ws) {
  const CrossingWatch watch(pair, e);
  Direction<kPlain> direction{e, d, watch, pair, gradient, ws};
  collect_coarse_points(e, ws.lists, ws);
  find_faces(e, pair.points[d], ws);
  direction.evaluate_coarse();
  watch.look(pair.step_elements[d], ws.elements, ws.suspects, pair);
  if (ws.rim.empty()) return;
  const auto coarse = static_cast<std::ptrdiff_t>(ws.elements.size());
  collect_fine_points(e, ws.lists, ws);
  find_faces(e, pair.points[d], ws);
  direction.evaluate_fine();
  for (const RimFace& face : ws.rim) direction.add_rim_face(face);
  std::inplace_merge(ws.elements.begin(), ws.elements.begin() + coarse, ws.elements.end(),
                     [](const ContactElement& a, const ContactElement& b) { return a.place() < b.place(); });
}

}  // namespace

void evaluate_points(const PointsEvaluation& e, int d, SurfacePair& pair, PairGradient (&gradient)[2], PointsWorkspace& ws) {
  pair.points[d].unpack(ws.lists);
  ws.lists.first_candidate.clear();
  ws.elements.clear();
  ws.suspects.clear();
  ws.rim.clear();
  if (e.with_itself || e.material.regional)
    evaluate_direction<false>(e, d, pair, gradient, ws);
  else
    evaluate_direction<true>(e, d, pair, gradient, ws);
  pair.points[d].update(ws.lists);
  std::swap(gradient[d].source_face, ws.lists.source_face);
}

}  // namespace morula
