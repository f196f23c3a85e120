#include "core/friction/sphere_pairs.h"

#include <algorithm>

#include "core/parallel/threads.h"

namespace morula {
namespace {

Float4v splat(float s) { return Float4v{s, s, s, s}; }

Float4v pair_force(Float4v u, const float* n, float isotropic, float axial) {
  const Float4v normal{n[0], n[1], n[2], 0.0f};
  const Float4v along = normal * u;
  return splat(isotropic) * u + splat(axial * (along[0] + along[1] + along[2])) * normal;
}

SymMat3<float> pair_block(const float* n, float isotropic_part, float axial) {
  return isotropic(isotropic_part) + outer(axial, Vec3f{n[0], n[1], n[2]});
}

}  // namespace

void SpherePairs::set_friction(std::vector<PairFriction> friction, std::size_t count) {
  friction_ = std::move(friction);
  materials_ = count;
  uniform_ = std::all_of(friction_.begin(), friction_.end(),
                         [&](const PairFriction& f) { return f.tangential == friction_[0].tangential && f.extra == friction_[0].extra; });
}

void SpherePairs::set_layout(std::uint32_t first_point, std::uint32_t owned, int threads) {
  first_point_ = first_point;
  owned_ = owned;
  const auto count = static_cast<std::uint32_t>(std::max(1, threads));
  shares_.assign(count, {});
  for (std::uint32_t t = 0; t < count; ++t) {
    shares_[t].first = static_cast<std::uint32_t>(std::uint64_t{owned} * t / count);
    shares_[t].last = static_cast<std::uint32_t>(std::uint64_t{owned} * (t + 1) / count);
  }
  if (count == 1) {
    shares_[0].runs.push_back({0, static_cast<std::uint32_t>(pairs.size())});
    return;
  }
  on_each_thread(threads, [&](std::size_t t) {
    Share& share = shares_[t];
    for (std::uint32_t k = 0; k < pairs.size(); ++k) {
      if (!share.has(pairs[k].a) && !share.has(pairs[k].b)) continue;
      if (!share.runs.empty() && share.runs.back().last == k)
        ++share.runs.back().last;
      else
        share.runs.push_back({k, k + 1});
    }
  });
}

template <class F>
void SpherePairs::for_shares(F&& function) const {
  const int threads = static_cast<int>(shares_.size());
  on_each_thread(threads, [&](std::size_t t) { function(shares_[t]); });
}

template <class OnPair, class OnRigid>
void SpherePairs::for_entries(float dt, OnPair&& on_pair, OnRigid&& on_rigid) const {
  for_shares([&](const Share& share) {
    for (const Run& run : share.runs)
      for (std::uint32_t k = run.first; k < run.last; ++k) {
        const SpherePairElement& e = elements[k];
        if (e.area == 0.0f && e.stiffness == 0.0f) continue;
        const PairFriction& f = friction(pairs[k]);
        on_pair(share, pairs[k], e.n, e.area * f.tangential, e.area * f.extra + dt * e.stiffness);
      }
    for (const RigidPairElement& e : rigid)
      if (share.has(e.sphere)) on_rigid(e, e.axial + dt * e.stiffness);
  });
}

template <class OnPair>
void SpherePairs::for_caps(OnPair&& on_pair) const {
  for_shares([&](const Share& share) {
    for (const Run& run : share.runs)
      for (std::uint32_t k = run.first; k < run.last; ++k)
        if (packing.slopes[k].a != 0.0f || packing.slopes[k].b != 0.0f) on_pair(share, k);
  });
}

void SpherePairs::add_packing_product(std::span<const Float4> p, std::span<Float4> q, float dt) const {
  // g_i·p first, for every sphere whole: it needs all neighbours, so that those of ghosts come from their owners.
  std::vector<Float4> swelling(p.size());
  const Float4* in = p.data() + first_point_;
  Float4* sum = swelling.data() + first_point_;
  const auto approach = [&](std::uint32_t k) {
    const float* n = elements[k].n;
    const Float4v along = Float4v{n[0], n[1], n[2], 0.0f} * (load(in[pairs[k].a]) - load(in[pairs[k].b]));
    return along[0] + along[1] + along[2];
  };
  for_caps([&](const Share& share, std::uint32_t k) {
    const SpherePair& pair = pairs[k];
    const float u = approach(k);
    if (share.has(pair.a)) sum[pair.a].x += packing.slopes[k].a * u;
    if (share.has(pair.b)) sum[pair.b].x += packing.slopes[k].b * u;
  });
  if (packing.exchange) packing.exchange(swelling);
  Float4* out = q.data() + first_point_;
  for_caps([&](const Share& share, std::uint32_t k) {
    const SpherePair& pair = pairs[k];
    const float f = dt * (packing.resistance[pair.a] * sum[pair.a].x * packing.slopes[k].a +
                          packing.resistance[pair.b] * sum[pair.b].x * packing.slopes[k].b);
    const float* n = elements[k].n;
    const Float4v force = splat(f) * Float4v{n[0], n[1], n[2], 0.0f};
    if (share.has(pair.a)) store(out[pair.a], load(out[pair.a]) + force);
    if (share.has(pair.b)) store(out[pair.b], load(out[pair.b]) - force);
  });
}

void SpherePairs::add_packing_diagonal(std::span<SymMat3<float>> diagonal, float dt) const {
  SymMat3<float>* out = diagonal.data() + first_point_;
  std::vector<Vec3f> own(owned_);  // the part of g_i that belongs to its own centre
  for_caps([&](const Share& share, std::uint32_t k) {
    const SpherePair& pair = pairs[k];
    const Vec3f n{elements[k].n[0], elements[k].n[1], elements[k].n[2]};
    const SpherePacking::Slopes& slope = packing.slopes[k];
    if (share.has(pair.a)) {
      own[pair.a] += n * slope.a;
      out[pair.a] += outer(dt * packing.resistance[pair.b] * slope.b * slope.b, n);
    }
    if (share.has(pair.b)) {
      own[pair.b] += n * -slope.b;
      out[pair.b] += outer(dt * packing.resistance[pair.a] * slope.a * slope.a, n);
    }
  });
  for (std::uint32_t i = 0; i < owned_; ++i) out[i] += outer(dt * packing.resistance[i], own[i]);
}

void SpherePairs::add_product(std::span<const Float4> p, std::span<Float4> q, float dt) const {
  const Float4* in = p.data() + first_point_;
  Float4* out = q.data() + first_point_;
  for_entries(
      dt,
      [&](const Share& share, const SpherePair& pair, const float* n, float isotropic, float axial) {
        const Float4v force = pair_force(load(in[pair.a]) - load(in[pair.b]), n, isotropic, axial);
        if (share.has(pair.a)) store(out[pair.a], load(out[pair.a]) + force);
        if (share.has(pair.b)) store(out[pair.b], load(out[pair.b]) - force);
      },
      [&](const RigidPairElement& e, float axial) {
        store(out[e.sphere], load(out[e.sphere]) + pair_force(load(in[e.sphere]), e.n, e.isotropic, axial));
      });
  if (packing.on && dt > 0.0f) add_packing_product(p, q, dt);
}

void SpherePairs::add_diagonal(std::span<SymMat3<float>> diagonal, float dt) const {
  SymMat3<float>* out = diagonal.data() + first_point_;
  for_entries(
      dt,
      [&](const Share& share, const SpherePair& pair, const float* n, float isotropic, float axial) {
        const SymMat3<float> block = pair_block(n, isotropic, axial);
        if (share.has(pair.a)) out[pair.a] += block;
        if (share.has(pair.b)) out[pair.b] += block;
      },
      [&](const RigidPairElement& e, float axial) { out[e.sphere] += pair_block(e.n, e.isotropic, axial); });
  if (packing.on && dt > 0.0f) add_packing_diagonal(diagonal, dt);
}

void SpherePairs::add_friction(std::span<const Vec3d> from, std::span<const Vec3d> to, std::span<const Vec3d> obstacle_way,
                               std::span<Vec3d> out, OrderFreeSum& quadratic) const {
  const auto displacement = [&](std::uint32_t sphere) { return to[first_point_ + sphere] - from[first_point_ + sphere]; };
  Vec3d* force = out.data() + first_point_;
  std::vector<OrderFreeSum> sums(shares_.size());
  const bool slippery = uniform_ && friction_[0].tangential == 0.0f && friction_[0].extra == 0.0f;
  const int threads = static_cast<int>(shares_.size());
  on_each_thread(threads, [&](std::size_t t) {
    const Share& share = shares_[t];
    OrderFreeSum& sum = sums[t];
    std::uint32_t sphere = 0;
    double of_sphere = 0.0;  // pairs that come first under one sphere: their order is canonical, so they may be added up in double
    for (const Run& run : slippery ? std::span<const Run>() : std::span(share.runs))
      for (std::uint32_t k = run.first; k < run.last; ++k) {
        const SpherePairElement& e = elements[k];
        if (e.area == 0.0f) continue;
        const SpherePair pair = pairs[k];
        const PairFriction& coefficient = friction(pair);
        const Vec3d u = displacement(pair.a) - displacement(pair.b);
        const Vec3d n{e.n[0], e.n[1], e.n[2]};
        const double area = e.area;
        const Vec3d f = u * (area * coefficient.tangential) + n * (area * coefficient.extra * dot(n, u));
        if (share.has(pair.a)) {
          force[pair.a] += f;
          if (pair.a != sphere) {
            sum.add(of_sphere);
            of_sphere = 0.0;
            sphere = pair.a;
          }
          of_sphere += dot(f, u);
        }
        if (share.has(pair.b)) force[pair.b] -= f;
      }
    sum.add(of_sphere);
    for (const RigidPairElement& e : rigid) {
      if (!share.has(e.sphere)) continue;
      const Vec3d n{e.n[0], e.n[1], e.n[2]}, d = displacement(e.sphere) - obstacle_way[e.obstacle];
      const Vec3d f = d * static_cast<double>(e.isotropic) + n * (static_cast<double>(e.axial) * dot(n, d));
      force[e.sphere] += f;
      sum.add(dot(f, d));
    }
  });
  for (const OrderFreeSum& sum : sums) quadratic += sum;
}

std::size_t SpherePairs::memory() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t total = bytes(pairs) + bytes(elements) + bytes(rigid) + bytes(material) + bytes(friction_) + packing.memory();
  for (const Share& share : shares_) total += bytes(share.runs);
  return total;
}

}  // namespace morula
