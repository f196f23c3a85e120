#include <algorithm>
#include <cmath>

#include "core/contact/closest_foot.h"
#include "core/contact/crossing.h"
#include "core/contact/nearest_face.h"
#include "core/contact/surface_pair.h"

namespace morula {
namespace {

/// Where a point stands against the other body.
struct PointGap {
  double gap = 0.0;          ///< g: signed distance, < 0 inside [µm]
  Vec3d normal;              ///< n̂ = ∂g/∂x_q, unit, away from the target
  double mu[3] = {1, 0, 0};  ///< weights of the nearest face's nodes at the nearest point
};

/// Where the results of one point go.
struct Sink {
  PairGradient& source;
  PairGradient* target;  ///< null for rigid obstacles
  const Triangle& source_node;
  Triangle target_node;

  void push_source(const FaceQuadrature& quadrature, int q, const Vec3d& force) {
    const auto padded = PaddedVec3::of(force);
    for (std::size_t i = 0; i < 3; ++i) source.force[source_node[i]].v += padded * quadrature.weight[q][i];
  }
  void push_target(std::size_t corner, const Vec3d& force) {
    if (target != nullptr) target->force[target_node[corner]].v += PaddedVec3::of(force);
  }
  void push_target(const double (&mu)[3], const Vec3d& force) {
    if (target == nullptr) return;
    const auto padded = PaddedVec3::of(force);
    for (std::size_t j = 0; j < 3; ++j) target->force[target_node[j]].v += padded * mu[j];
  }
};

/// Normal of the target at the foot point: node normals interpolated, or the sphere's.
struct TargetNormal {
  Vec3d unit;
  double length;  ///< of the interpolated vector
};

/// Face that a point lies on.
struct SourceFace {
  Vec3d normal;  ///< n_T
  double area;   ///< A_T
};

/// Gradient through the weights μ_j of the foot point, which slides on its feature: c_j = ∂E/∂μ_j.
void add_foot_gradient(const PointsEvaluation& e, int q, const Triangle& t, const PointGap& gap, const double (&c)[3], Sink& sink) {
  const Vec3d y[3] = {e.target.node(t[0]), e.target.node(t[1]), e.target.node(t[2])};
  const int zeros = (gap.mu[0] == 0.0) + (gap.mu[1] == 0.0) + (gap.mu[2] == 0.0);
  if (zeros == 0) {  // inside the face: ∂λ_j is the in-plane gradient, plus the tilt of the plane
    const Vec3d normal = cross(y[1] - y[0], y[2] - y[0]);
    const double twice_area = norm(normal);
    const Vec3d n = normal * (1.0 / twice_area);
    Vec3d slope[3], total;
    for (std::size_t j = 0; j < 3; ++j) {
      slope[j] = cross(n, y[(j + 2) % 3] - y[(j + 1) % 3]) * (1.0 / twice_area);
      total += slope[j] * c[j];
    }
    sink.push_source(e.quadrature, q, -total);
    for (std::size_t j = 0; j < 3; ++j) sink.push_target(j, total * gap.mu[j] - n * (gap.gap * dot(slope[j], total)));
  } else if (zeros == 1) {  // on an edge p–r: ∂t is along the edge, plus its turn
    const std::size_t p = gap.mu[0] == 0.0 ? 1 : gap.mu[1] == 0.0 ? 2 : 0;
    const std::size_t r = (p + 1) % 3;
    const Vec3d along = y[r] - y[p];
    const double length2 = norm2(along);
    const double k = c[r] - c[p];
    const Vec3d pull = along * (k / length2);
    const Vec3d turn = (gap.normal * gap.gap) * (k / length2);
    sink.push_source(e.quadrature, q, -pull);
    sink.push_target(p, pull * gap.mu[p] + turn);
    sink.push_target(r, pull * gap.mu[r] - turn);
  }
}

/// Forces on the corners of the source face from h = ∂E/∂n_T: F_c = e_c × w, w = (I − n_T n_Tᵀ) h/(2 A_T), e_c the edge opposite to c.
void add_face_normal_gradient(const PairBody& source, const SourceFace& face, const Vec3d& h, Sink& sink) {
  const Vec3d& n = face.normal;
  const Vec3d w = (h - n * dot(n, h)) * (0.5 / face.area);
  const Vec3d& x0 = source.position[sink.source_node[0]];
  const Vec3d& x1 = source.position[sink.source_node[1]];
  const Vec3d& x2 = source.position[sink.source_node[2]];
  const Vec3d f0 = cross(x2 - x1, w), f1 = cross(x0 - x2, w);
  sink.source.force[sink.source_node[0]].v += PaddedVec3::of(f0);
  sink.source.force[sink.source_node[1]].v += PaddedVec3::of(f1);
  sink.source.force[sink.source_node[2]].v -= PaddedVec3::of(f0 + f1);
}

/// Gradient through the opposed-normal weight: `h0` = ∂E/∂m with m = −n_T·n_y.
void add_weight_gradient(const PointsEvaluation& e, int q, const SourceFace& face, const Triangle* t, const PointGap& gap,
                         const TargetNormal& normal, double h0, Sink& sink) {
  add_face_normal_gradient(e.source, face, normal.unit * -h0, sink);
  const Vec3d h = face.normal * -h0;  // ∂E/∂n_y
  const Vec3d across = (h - normal.unit * dot(normal.unit, h)) * (1.0 / normal.length);
  if (t == nullptr) {  // n_y = (x_q − x)/|x_q − x| of a sphere
    const Vec3d force = across * (1.0 / (gap.gap + e.target.radius));
    sink.push_source(e.quadrature, q, -force);
    sink.push_target(0, force);
    return;
  }
  double c[3];
  for (std::size_t j = 0; j < 3; ++j) {
    c[j] = dot(across, e.target.node_normal[(*t)[j]]);
    if (sink.target == nullptr || gap.mu[j] == 0.0) continue;
    sink.target->has_node_normal = true;
    sink.target->node_normal[sink.target_node[j]] += across * gap.mu[j];
  }
  add_foot_gradient(e, q, *t, gap, c, sink);
}

constexpr int kLanes = 8;
using Real = Lane<double, kLanes>;
using Vector = Vec3<Real>;

/// Up to 8 points and their nearest faces, in lanes.
struct alignas(64) Batch {
  double point[3][kLanes], source_corner[3][3][kLanes];
  double corner[3][3][kLanes], node_normal[3][3][kLanes];
  // results
  double source_normal[3][kLanes], face_area[kLanes], area[kLanes];  ///< of the source's face; what the point stands for
  double gap[kLanes], normal[3][kLanes], mu[3][kLanes];
  double unit[3][kLanes], length[kLanes];  ///< normal of the target at the foot point
  double weight_slope[kLanes], attraction[kLanes], tension[kLanes], density[kLanes], told[kLanes], pull[3][kLanes];
  double bearing[kLanes], stiffness[kLanes];
  bool inside[kLanes];                                      ///< the gap is negative
  double corner_adhesion[3][kLanes], per_adhesion[kLanes];  ///< where W differs by marks: W at the target's nodes, and energy by W
  std::int32_t rounded_mu[2][kLanes];                       ///< as ContactElement keeps them
};

/// What is behind the point is cut off.
void store_cut(std::int32_t (&out)[kLanes], Real value) {
  using Int [[gnu::vector_size(kLanes * sizeof(std::int32_t))]] = std::int32_t;
  const Int cut = __builtin_convertvector(value.v, Int);
  __builtin_memcpy(out, &cut, sizeof cut);
}

void put(double (&array)[3][kLanes], int lane, const Vec3d& v) { array[0][lane] = v.x, array[1][lane] = v.y, array[2][lane] = v.z; }
Vec3d get(const double (&array)[3][kLanes], int lane) { return {array[0][lane], array[1][lane], array[2][lane]}; }
Vector load(const double (&array)[3][kLanes]) { return {Real::load(array[0]), Real::load(array[1]), Real::load(array[2])}; }
void store(double (&array)[3][kLanes], const Vector& v) { v.x.store(array[0]), v.y.store(array[1]), v.z.store(array[2]); }

/// Gaps against the nearest faces of a surface.
void gaps_to_faces(const PointsEvaluation& e, std::span<const std::uint32_t> face, Batch& batch) {
  const Vector point = load(batch.point), a = load(batch.corner[0]), b = load(batch.corner[1]), c = load(batch.corner[2]);
  Foot<Real> foot = closest_foot<Real>(point, a, b, c);
  for (int lane = 0; lane < kLanes; ++lane) {
    if (foot.doubtful[lane] == 0.0) continue;
    const auto right =
        closest_foot_of(get(batch.point, lane), get(batch.corner[0], lane), get(batch.corner[1], lane), get(batch.corner[2], lane));
    foot.away.x.set(lane, right.away.x), foot.away.y.set(lane, right.away.y), foot.away.z.set(lane, right.away.z);
    for (int k = 0; k < 3; ++k) foot.mu[k].set(lane, right.mu[k]);
    foot.distance2.set(lane, right.distance2);
  }
  const Vector twice_area = cross(b - a, c - a);
  const Vector unit = twice_area * (Real(1.0) / norm(twice_area));
  const Real distance = sqrt(foot.distance2), zero(0.0);
  select(dot(foot.away, unit) < zero, -distance, distance).store(batch.gap);
  store(batch.normal, unit);
  for (std::size_t k = 0; k < 3; ++k) foot.mu[k].store(batch.mu[k]);
  const Real inner = min(min(foot.mu[0], foot.mu[1]), foot.mu[2]);
  for (int lane = 0; lane < kLanes; ++lane) {
    if (inner[lane] != 0.0) continue;  // on an edge or a node: the side is that of the pseudonormal
    const Vec3d away{foot.away.x[lane], foot.away.y[lane], foot.away.z[lane]};
    const double mu[3] = {foot.mu[0][lane], foot.mu[1][lane], foot.mu[2][lane]};
    const bool inside = is_inside(away, e.target, face[static_cast<std::size_t>(lane)], mu);
    batch.gap[lane] = inside ? -distance[lane] : distance[lane];
    if (distance[lane] >= 1e-12) put(batch.normal, lane, away * ((inside ? -1.0 : 1.0) / distance[lane]));
  }
  const Vector sum =
      load(batch.node_normal[0]) * foot.mu[0] + load(batch.node_normal[1]) * foot.mu[1] + load(batch.node_normal[2]) * foot.mu[2];
  const Real length = norm(sum);
  const auto usable = length > Real(1e-9);
  const Vector normal = load(batch.normal);
  const Real inverse = Real(1.0) / length;
  store(batch.unit, Vector{select(usable, sum.x * inverse, normal.x), select(usable, sum.y * inverse, normal.y),
                           select(usable, sum.z * inverse, normal.z)});
  select(usable, length, Real(1.0)).store(batch.length);
}

/// Gaps against a sphere: |x_q − x| − R.
void gaps_to_sphere(const PairBody& target, Batch& batch) {
  const Vec3d center = target.node(0);
  for (int lane = 0; lane < kLanes; ++lane) {
    const Vec3d away = get(batch.point, lane) - center;
    const double distance = norm(away);
    batch.gap[lane] = distance - target.radius;
    const Vec3d normal = distance > 1e-12 ? away * (1.0 / distance) : Vec3d{0, 0, 1};
    put(batch.normal, lane, normal);
    put(batch.unit, lane, normal);
    batch.length[lane] = 1.0;
    batch.mu[0][lane] = 1.0;
    batch.mu[1][lane] = batch.mu[2][lane] = 0.0;
  }
}

/// W of a face with these marks of body d against the faces around a node of the other, on average: it changes without a jump as the nearest
/// point moves on.
double adhesion_at_node(const PointsEvaluation& e, int d, MarkSet marks, std::uint32_t node) {
  const auto faces = e.target.topology->faces_of_node(node);
  double sum = 0.0;
  for (const std::uint32_t face : faces) {
    const MarkSet other = e.target.marks[face];
    sum += d == 0 ? e.material.regional->between(marks, other) : e.material.regional->between(other, marks);
  }
  return sum / static_cast<double>(faces.size());
}

/// W at the nodes of the nearest face, for one point of a face with these marks. A sphere and an obstacle carry none.
void find_adhesion(const PointsEvaluation& e, int d, MarkSet marks, const Triangle* face, int lane, Batch& batch) {
  for (std::size_t j = 0; j < 3; ++j)
    batch.corner_adhesion[j][lane] = face != nullptr && !e.target.marks.empty() ? adhesion_at_node(e, d, marks, (*face)[j])
                                     : d == 0                                   ? e.material.regional->between(marks, {})
                                                                                : e.material.regional->between({}, marks);
}

/// A surface against itself acts by the unsigned distance, less that of touch (self_contact.h).
void take_distances(double touch, Batch& batch) {
  for (int lane = 0; lane < kLanes; ++lane) {
    if (batch.inside[lane]) put(batch.normal, lane, -get(batch.normal, lane));
    batch.gap[lane] = std::abs(batch.gap[lane]) - touch;
  }
}

/// Energies, tractions and stiffness at the gaps. `kPlain`: one W everywhere, and two different bodies.
template <bool kPlain>
void respond(const PointsEvaluation& e, Batch& batch) {
  const SurfaceTraction& law = e.material.law;
  const Vector x0 = load(batch.source_corner[0]);
  const Vector twice = cross(load(batch.source_corner[1]) - x0, load(batch.source_corner[2]) - x0);
  const Real length = norm(twice), face_area = length * Real(0.5);
  const Vector source_normal = twice * (Real(1.0) / length);
  store(batch.source_normal, source_normal);
  face_area.store(batch.face_area);
  const Real gap = Real::load(batch.gap);
  const auto weight = OpposedWeight::of(-dot(source_normal, load(batch.unit)));
  TractionPart attraction, repulsion;
  law.form->evaluate(law, gap, attraction, repulsion);
  const Real part(1.0 / e.quadrature.count);
  const Real area = face_area * Real(e.share) * part;
  if (!kPlain && e.material.regional) {
    (area * weight.value * attraction.energy).store(batch.per_adhesion);
    Real adhesion(0.0);
    for (std::size_t j = 0; j < 3; ++j) adhesion = adhesion + Real::load(batch.corner_adhesion[j]) * Real::load(batch.mu[j]);
    attraction = {attraction.energy * adhesion, attraction.slope * adhesion, attraction.curvature * adhesion};
  }
  weight.slope.store(batch.weight_slope);
  (area * attraction.energy).store(batch.attraction);
  (area * attraction.energy * weight.value).store(batch.tension);
  (weight.value * attraction.energy + repulsion.energy).store(batch.density);
  (face_area * part * contact_share(gap, law.range)).store(batch.told);
  store(batch.pull, load(batch.normal) * (area * (weight.value * attraction.slope + repulsion.slope)));
  (area * friction_weight(gap, law.range)).store(batch.bearing);
  (area * (weight.value * attraction.curvature + repulsion.curvature)).store(batch.stiffness);
  area.store(batch.area);
  for (std::size_t k = 0; k < 2; ++k)
    store_cut(batch.rounded_mu[k], Real::load(batch.mu[k]) * Real(ContactElement::kWeightUnits) + Real(0.5));
}

Vec3d quadrature_point(const PointsEvaluation& e, const Triangle& t, int q) {
  const auto& beta = e.quadrature.weight[q];
  return e.source.node(t[0]) * beta[0] + e.source.node(t[1]) * beta[1] + e.source.node(t[2]) * beta[2];
}

/// The points that may be in range, with the nearest faces known; those that surely are not are left out.
void collect_points(const PointsEvaluation& e, PointsAgainstBody& lists, PointsWorkspace& ws) {
  ws.points.clear();
  ws.search.clear();
  const std::uint32_t count = static_cast<std::uint32_t>(e.quadrature.count);
  const auto triangles = e.source.topology->faces();
  for (std::uint32_t k = 0; k < lists.source_face.size(); ++k) {
    const Triangle& t = triangles[lists.source_face[k]];
    for (std::uint32_t q = 0; q < count; ++q) {
      const std::uint32_t index = k * count + q;
      const std::uint16_t known = lists.nearest[index];
      const bool sure = e.motion < lists.good_until[index];
      if (sure && (known & kAsleep)) continue;
      if (!sure && e.target.topology != nullptr) ws.search.push_back(static_cast<std::uint32_t>(ws.points.size()));
      const std::uint16_t guess = known & kNoFace;
      ws.points.push_back({quadrature_point(e, t, static_cast<int>(q)), k, static_cast<std::uint16_t>(q), guess});
    }
  }
}

void fill(const PointsEvaluation& e, const PointsAgainstBody& lists, const ContactPoint& p, int lane, Batch& batch) {
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

/// Add one point's share to SurfacePair::within. An energy of attraction E in proportion to the area with the normal m is a tension, of the virial
/// −E (I − m ⊗ m); a force along n over the gap g between two surfaces has the virial −g f n ⊗ n, half on either side. That of a sphere is found for
/// the whole pair (ContactLayer::evaluate_pair).
void add_within(const PointsEvaluation& e, int d, const Batch& batch, int lane, SurfacePair& pair) {
  if (e.target_moves && e.target.topology == nullptr) return;
  const double tension = batch.tension[lane];
  if (tension != 0.0) pair.within[d] += to_float(outer(tension, get(batch.source_normal, lane)) + isotropic(-tension));
  if (!e.target_moves) return;
  const Vec3d n = get(batch.normal, lane);
  const SymMat3<float> of_gap = to_float(outer(-0.5 * batch.gap[lane] * dot(get(batch.pull, lane), n), n));
  for (SymMat3<float>& side : pair.within) side += of_gap;
}

/// Add one point's share to the pair.
template <bool kPlain>
void add_point(const PointsEvaluation& e, int d, const PointsAgainstBody& lists, const ContactPoint& p, const Batch& batch, int lane,
               SurfacePair& pair, PairGradient (&gradient)[2], std::vector<ContactElement>& elements) {
  const std::uint32_t face = lists.source_face[p.source_place];
  const bool sphere = e.target.topology == nullptr;
  Sink sink{gradient[d], e.target_moves ? &gradient[1 - d] : nullptr, e.source.topology->faces()[face], {0, 0, 0}};
  if (!sphere) sink.target_node = e.target.topology->faces()[lists.target_face[p.place]];
  PointGap gap;
  gap.gap = batch.gap[lane];
  gap.normal = get(batch.normal, lane);
  for (std::size_t j = 0; j < 3; ++j) gap.mu[j] = batch.mu[j][lane];
  const double scale = e.share * (1.0 / e.quadrature.count);
  pair.energy += batch.area[lane] * batch.density[lane];
  sink.source.face_energy[p.source_place] += scale * batch.density[lane];
  if (kPlain || !e.with_itself) {
    sink.source.contact_area += batch.told[lane];
    sink.source.told_area[p.source_place] += static_cast<float>(batch.told[lane]);
    add_within(e, d, batch, lane, pair);
    pair.overlap = gap.gap < -pair.overlap ? -gap.gap : pair.overlap;
  }

  const Vec3d pull = get(batch.pull, lane);
  sink.push_source(e.quadrature, p.q, -pull);
  if (sphere)
    sink.push_target(0, pull);
  else
    sink.push_target(gap.mu, pull);
  if (batch.weight_slope[lane] != 0.0) {
    const Triangle* target_face = sphere ? nullptr : &e.target.topology->faces()[lists.target_face[p.place]];
    add_weight_gradient(e, p.q, {get(batch.source_normal, lane), batch.face_area[lane]}, target_face, gap,
                        {get(batch.unit, lane), batch.length[lane]}, batch.weight_slope[lane] * batch.attraction[lane], sink);
  }
  if (!kPlain && e.material.regional && !e.target.marks.empty()) {
    double c[3];
    for (std::size_t j = 0; j < 3; ++j) c[j] = batch.per_adhesion[lane] * batch.corner_adhesion[j][lane];
    if (c[0] != c[1] || c[1] != c[2]) add_foot_gradient(e, p.q, sink.target_node, gap, c, sink);
  }
  const std::uint32_t target = sphere ? 0 : lists.target_face[p.place];
  ContactElement& element = elements.emplace_back(face, p.q, target < ContactElement::kMostTargetFaces ? target : 0);
  element.set_weights(batch.rounded_mu[0][lane], batch.rounded_mu[1][lane]);
  element.set_normal(gap.normal);
  element.set_area(static_cast<float>(batch.bearing[lane]));
  element.set_stiffness(static_cast<float>(batch.stiffness[lane]));
  element.set_inside(kPlain ? gap.gap < 0.0 : batch.inside[lane]);
}

/// All points of `ws`, eight at a time.
template <bool kPlain>
void evaluate_batches(const PointsEvaluation& e, int d, const CrossingWatch& watch, SurfacePair& pair, PairGradient (&gradient)[2],
                      PointsWorkspace& ws) {
  PointsAgainstBody& lists = ws.lists;
  const double touch = !kPlain && e.with_itself ? e.material.self_distance : 0.0;
  Batch batch;
  for (std::size_t first = 0; first < ws.points.size(); first += kLanes) {
    const int count = static_cast<int>(std::min<std::size_t>(kLanes, ws.points.size() - first));
    std::uint32_t face[kLanes] = {};
    for (int lane = 0; lane < kLanes; ++lane) {  // empty lanes repeat the last point
      const ContactPoint& p = ws.points[first + static_cast<std::size_t>(std::min(lane, count - 1))];
      fill(e, lists, p, lane, batch);
      if (e.target.topology != nullptr) face[lane] = lists.target_face[p.place];
      if (!kPlain && e.material.regional)
        find_adhesion(e, d, e.source.marks[lists.source_face[p.source_place]],
                      e.target.topology != nullptr ? &e.target.topology->faces()[face[lane]] : nullptr, lane, batch);
    }
    if (e.target.topology == nullptr)
      gaps_to_sphere(e.target, batch);
    else
      gaps_to_faces(e, face, batch);
    if constexpr (!kPlain) {
      for (int lane = 0; lane < kLanes; ++lane) batch.inside[lane] = batch.gap[lane] < 0.0;
      if (e.with_itself) take_distances(touch, batch);
    }
    respond<kPlain>(e, batch);
    for (int lane = 0; lane < count; ++lane) {
      const ContactPoint& p = ws.points[first + static_cast<std::size_t>(lane)];
      const double gap = batch.gap[lane];
      if (p.second >= 0.0) remember(p, gap + touch, p.source_place * static_cast<std::size_t>(e.quadrature.count) + p.q, e, lists);
      if (gap < e.material.law.range) {
        add_point<kPlain>(e, d, lists, p, batch, lane, pair, gradient, ws.elements);
        if (watch.suspects(gap + touch))
          ws.suspects.push_back({ws.elements.back().place(), kPlain ? gap < 0.0 : batch.inside[lane], std::abs(gap + touch)});
      }
    }
  }
}

}  // namespace

void evaluate_points(const PointsEvaluation& e, int d, SurfacePair& pair, PairGradient (&gradient)[2], PointsWorkspace& ws) {
  PointsAgainstBody& lists = ws.lists;
  pair.points[d].unpack(lists);
  collect_points(e, lists, ws);
  if (!ws.search.empty()) {
    pair.points[d].unpack_candidates(lists);
    find_nearest_faces(e, lists, ws);
  }
  if (e.target.topology != nullptr) {  // what has no face within reach is out of range
    const auto index = [&](const ContactPoint& p) { return p.source_place * static_cast<std::size_t>(e.quadrature.count) + p.q; };
    std::erase_if(ws.points, [&](const ContactPoint& p) {
      if (p.place == kNoFace) remember(p, 0.0, index(p), e, lists);
      return p.place == kNoFace;
    });
  }
  ws.elements.clear();
  ws.suspects.clear();
  const CrossingWatch watch(pair, e);
  if (e.with_itself || e.material.regional)
    evaluate_batches<false>(e, d, watch, pair, gradient, ws);
  else
    evaluate_batches<true>(e, d, watch, pair, gradient, ws);
  watch.look(pair.step_elements[d], ws.elements, ws.suspects, pair);
  pair.points[d].update(lists);
  std::swap(gradient[d].source_face, lists.source_face);
}

}  // namespace morula
