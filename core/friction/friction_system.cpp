#include "core/friction/friction_system.h"

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace morula {
namespace {

/// One number in all components.
Float4v splat(float s) { return Float4v{s, s, s, s}; }

float dot3(Float4v a, Float4v b) {
  const Float4v m = a * b;
  return m[0] + m[1] + m[2];
}

SymMat3<float> inverse_of(const SymMat3<float>& a) {
  const double c00 = double(a.yy) * a.zz - double(a.yz) * a.yz;
  const double c01 = double(a.xz) * a.yz - double(a.xy) * a.zz;
  const double c02 = double(a.xy) * a.yz - double(a.xz) * a.yy;
  const double det = a.xx * c00 + a.xy * c01 + a.xz * c02;
  const double s = 1.0 / det;
  return {static_cast<float>(c00 * s),
          static_cast<float>(c01 * s),
          static_cast<float>(c02 * s),
          static_cast<float>((double(a.xx) * a.zz - double(a.xz) * a.xz) * s),
          static_cast<float>((double(a.xy) * a.xz - double(a.xx) * a.yz) * s),
          static_cast<float>((double(a.xx) * a.yy - double(a.xy) * a.xy) * s)};
}

using Double4 [[gnu::vector_size(32)]] = double;
Double4 to_double(Float4v v) { return __builtin_convertvector(v, Double4); }
double total(Double4 sum) { return (sum[0] + sum[1]) + (sum[2] + sum[3]); }

/// Dot product over the points of one body, in double and in fixed order.
double dot_of_body(const Float4* a, const Float4* b, std::uint32_t count) {
  Double4 sum{};
  for (std::uint32_t i = 0; i < count; ++i) sum += to_double(load(a[i])) * to_double(load(b[i]));
  return total(sum);
}

Float4v times(const SymMat3<float>& m, Float4v r) {
  return splat(r[0]) * Float4v{m.xx, m.xy, m.xz, 0.0f} + splat(r[1]) * Float4v{m.xy, m.yy, m.yz, 0.0f} +
         splat(r[2]) * Float4v{m.xz, m.yz, m.zz, 0.0f};
}

inline Float4v response(Float4v u, Float4v n, float a, float b) { return splat(a) * u + splat(b * dot3(n, u)) * n; }

}  // namespace

void FrictionSystem::set_layout(Layout layout, int threads) {
  layout_ = std::move(layout);
  threads_ = std::max(1, threads);
  inverse_.assign(layout_.point_count, {});
  for (auto* vector : {&p_, &q_, &r_}) vector->assign(layout_.point_count, Float4{});
  // Contiguous ranges of bodies of about equal numbers of points.
  std::size_t owned_points = 0;
  for (std::size_t body = 0; body < layout_.body_count(); ++body)
    if (layout_.owned[body]) owned_points += layout_.points_of(body).count;
  work_.assign(static_cast<std::size_t>(threads_), {});
  std::size_t seen = 0, thread = 0;
  for (std::size_t body = 0; body < layout_.body_count(); ++body) {
    if (layout_.owned[body]) seen += layout_.points_of(body).count;
    work_[thread].last_body = static_cast<std::uint32_t>(body + 1);
    if (thread + 1 < work_.size() && seen * work_.size() >= owned_points * (thread + 1)) {
      ++thread;
      work_[thread].first_body = work_[thread].last_body = static_cast<std::uint32_t>(body + 1);
    }
  }
  pairs_.clear();
  for (auto& arena : blocks_) arena.clear();
  sphere_pairs_ = nullptr;
  added_.clear();
}

void FrictionSystem::set_elements(std::span<const ElementGroup> groups, const FaceQuadrature& quadrature) {
  pairs_.assign(groups.size(), {});
  blocks_.resize(static_cast<std::size_t>(threads_));
  for (auto& arena : blocks_) arena.clear();
#pragma omp parallel num_threads(threads_)
  {
    const auto arena = static_cast<std::uint32_t>(omp_get_thread_num());
    PairCondenser condenser(quadrature, dt_);
#pragma omp for schedule(dynamic, 8)
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const ElementGroup& group = groups[g];
      NodePairArena& out = blocks_[arena];
      const std::size_t begin = out.blocks.size(), first_row = out.rows.size();
      condenser.add_pair_blocks(group, out);
      pairs_[g] = {arena,
                   static_cast<std::uint32_t>(out.blocks.size() - begin),
                   static_cast<std::uint32_t>(out.rows.size() - first_row),
                   begin,
                   first_row,
                   {group.body[0], group.body[1]},
                   {group.first[0], group.first[1]},
                   {group.write[0], group.write[1] && !group.rigid},
                   group.rigid};
    }
  }
  for (ThreadWork& work : work_) {
    work.groups.clear();
    for (std::uint32_t g = 0; g < pairs_.size(); ++g)
      if ((pairs_[g].write[0] && work.has(pairs_[g].body[0])) || (pairs_[g].write[1] && work.has(pairs_[g].body[1])))
        work.groups.push_back(g);
  }
  if (shells_ == nullptr || shells_->point_count() == 0) return;

  std::vector<std::uint32_t> begin(layout_.body_count() + 1, 0), incident;
  for (const ElementGroup& group : groups)
    for (std::size_t side = 0; side < (group.rigid ? 1 : 2); ++side) ++begin[group.body[side] + 1];
  for (std::size_t body = 1; body < begin.size(); ++body) begin[body] += begin[body - 1];
  incident.resize(begin.back());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::uint32_t g = 0; g < groups.size(); ++g)
    for (std::uint32_t side = 0; side < (groups[g].rigid ? 1u : 2u); ++side) incident[next[groups[g].body[side]]++] = 2 * g + side;
  const PairCondenser condenser(quadrature, dt_);
  shells_->add_edge_blocks([&](std::uint32_t body, std::span<EdgeBlock> edges) {
    for (std::uint32_t k = begin[body]; k < begin[body + 1]; ++k)
      condenser.add_edge_blocks(groups[incident[k] / 2], static_cast<int>(incident[k] % 2), edges);
    return begin[body] < begin[body + 1];
  });
}

template <class Body>
void FrictionSystem::for_owned_bodies(Body&& function) const {
#pragma omp parallel for schedule(static, 1) num_threads(threads_)
  for (int t = 0; t < threads_; ++t) {
    const std::uint32_t last = work_[static_cast<std::size_t>(t)].last_body;
    const auto with_many = static_cast<std::uint32_t>(layout_.bodies.size());
    std::uint32_t body = work_[static_cast<std::size_t>(t)].first_body;
    for (; body < std::min(last, with_many); ++body)
      if (layout_.owned[body]) function(t, layout_.bodies[body]);
    const char* const owned = layout_.owned.data();
    for (std::uint32_t point = layout_.points_of(body).first; body < last; ++body, ++point)
      if (owned[body]) function(t, BodyPoints{point, 1});
  }
}

void FrictionSystem::apply_contacts(int thread, std::span<const Float4> p, std::span<Float4> q) const {
  const ThreadWork& work = work_[static_cast<std::size_t>(thread)];
  for (const std::uint32_t g : work.groups) {
    const PairBlocks& pair = pairs_[g];
    const bool write[2] = {pair.write[0] && work.has(pair.body[0]), pair.write[1] && work.has(pair.body[1])};
    apply_pair_blocks(blocks_of(pair), p.data() + pair.first[0], write[0] ? q.data() + pair.first[0] : nullptr,
                      pair.rigid ? nullptr : p.data() + pair.first[1], write[1] ? q.data() + pair.first[1] : nullptr);
  }
}

void FrictionSystem::apply(std::span<const Float4> p, std::span<Float4> q) const {
  if (shells_ != nullptr && shells_->point_count() > 0) shells_->multiply(p, q);
  const std::size_t done = shells_ != nullptr ? shells_->point_count() : 0;
  for_owned_bodies([&](int, const BodyPoints& points) {
    if (points.first < done) return;
    for (std::uint32_t i = points.first; i < points.first + points.count; ++i) store(q[i], splat(point_friction_[i]) * load(p[i]));
  });
#pragma omp parallel for schedule(static, 1) num_threads(threads_)
  for (int t = 0; t < threads_; ++t) apply_contacts(t, p, q);
  if (sphere_pairs_ != nullptr) sphere_pairs_->add_product(p, q, dt_);
  for (const AddedPart* part : added_) part->add_product(p, q);
}

void FrictionSystem::add_contact_diagonal(int thread) {
  const ThreadWork& work = work_[static_cast<std::size_t>(thread)];
  for (const std::uint32_t g : work.groups) {
    const PairBlocks& pair = pairs_[g];
    for (int side = 0; side < 2; ++side) {
      if (!pair.write[side] || !work.has(pair.body[side])) continue;
      SymMat3<float>* const diagonal = inverse_.data() + pair.first[side];
      const NodePairBlocks blocks = blocks_of(pair);
      const NodePairBlock* block = blocks.blocks.data();
      for (const NodePairRow& row : blocks.rows)
        for (const NodePairBlock* const end = block + row.count; block != end; ++block)
          diagonal[side == 0 ? row.i : block->j] += block->matrix(row.unit);
    }
  }
}

void FrictionSystem::build_preconditioner() {
  for (std::size_t i = 0; i < layout_.point_count; ++i) inverse_[i] = isotropic(point_friction_[i]);
  if (shells_ != nullptr && shells_->point_count() > 0) shells_->add_diagonal(inverse_);
#pragma omp parallel for schedule(static, 1) num_threads(threads_)
  for (int t = 0; t < threads_; ++t) add_contact_diagonal(t);
  if (sphere_pairs_ != nullptr) sphere_pairs_->add_diagonal(inverse_, dt_);
  for (const AddedPart* part : added_) part->add_diagonal(inverse_);
  for_owned_bodies([&](int, const BodyPoints& points) {
    for (std::uint32_t i = points.first; i < points.first + points.count; ++i) inverse_[i] = inverse_of(inverse_[i]);
  });
}

double FrictionSystem::dot(std::span<const Float4> a, std::span<const Float4> b, const Comm& comm) const {
  std::vector<OrderFreeSum> sums(static_cast<std::size_t>(threads_));
  for_owned_bodies([&](int t, const BodyPoints& points) {
    sums[static_cast<std::size_t>(t)].add(dot_of_body(a.data() + points.first, b.data() + points.first, points.count));
  });
  for (std::size_t t = 1; t < sums.size(); ++t) sums[0] += sums[t];
  return comm.sum(sums[0]);
}

void FrictionSystem::advance(float alpha, std::span<Float4> v, const Comm& comm, double (&totals)[2]) {
  std::vector<std::array<OrderFreeSum, 2>> sums(static_cast<std::size_t>(threads_));
  const Float4v a = splat(alpha);
  for_owned_bodies([&](int t, const BodyPoints& points) {
    Double4 rr{}, rz{};
    for (std::uint32_t i = points.first; i < points.first + points.count; ++i) {
      store(v[i], load(v[i]) + a * load(p_[i]));
      const Float4v r = load(r_[i]) - a * load(q_[i]);
      store(r_[i], r);
      const Double4 wide = to_double(r);
      rr += wide * wide;
      rz += wide * to_double(times(inverse_[i], r));
    }
    sums[static_cast<std::size_t>(t)][0].add(total(rr));
    sums[static_cast<std::size_t>(t)][1].add(total(rz));
  });
  for (std::size_t t = 1; t < sums.size(); ++t)
    for (int k = 0; k < 2; ++k) sums[0][k] += sums[t][k];
  comm.sum(sums[0], totals);
}

Result<SolveReport, SolveFault> FrictionSystem::solve(std::span<Float4> v, double tolerance, int max_iterations, const Comm& comm) {
  build_preconditioner();
  const auto exchange = [&](std::span<Float4> vector) {
    if (layout_.exchange) layout_.exchange(vector);
  };
  const auto for_owned_points = [&](auto&& function) {
    for_owned_bodies([&](int, const BodyPoints& points) {
      for (std::uint32_t i = points.first; i < points.first + points.count; ++i) function(i);
    });
  };

  const double b_norm = std::sqrt(dot(r_, r_, comm));
  if (!std::isfinite(b_norm)) return SolveFault{"the force is not a number"};
  if (b_norm == 0.0) {
    for_owned_points([&](std::uint32_t i) { v[i] = {}; });
    return SolveReport{};
  }
  exchange(v);
  apply(v, q_);
  for_owned_points([&](std::uint32_t i) { store(p_[i], load(r_[i]) - load(q_[i])); });
  // A start that is worse than none is dropped: zero velocity has the residual ‖b‖.
  const bool helps = std::sqrt(dot(p_, p_, comm)) < b_norm;
  for_owned_points([&](std::uint32_t i) {
    p_[i] = {};
    if (!helps) v[i] = q_[i] = {};
  });
  double sums[2];  // r·r, r·z
  advance(1.0f, v, comm, sums);
  double residual = std::sqrt(sums[0]);
  const double goal = tolerance * b_norm;
  SolveReport report{0, residual / b_norm, residual <= goal};
  float beta = 0.0f;
  while (residual > goal && report.iterations < max_iterations) {
    for_owned_points([&](std::uint32_t i) { store(p_[i], times(inverse_[i], load(r_[i])) + splat(beta) * load(p_[i])); });
    exchange(p_);
    apply(p_, q_);
    const double pq = dot(p_, q_, comm);
    if (!(pq > 0.0)) return SolveFault{"the friction matrix is not positive definite"};
    const double rz = sums[1];
    advance(static_cast<float>(rz / pq), v, comm, sums);
    residual = std::sqrt(sums[0]);
    beta = static_cast<float>(sums[1] / rz);
    ++report.iterations;
  }
  report.residual = residual / b_norm;
  report.converged = residual <= goal;
  return report;
}

std::size_t FrictionSystem::memory() const {
  const auto bytes = [](const auto& vector) { return vector.capacity() * sizeof(vector[0]); };
  std::size_t total = bytes(point_friction_) + bytes(pairs_) + bytes(inverse_) + bytes(p_) + bytes(q_) + bytes(r_) + bytes(layout_.bodies) +
                      bytes(layout_.owned);
  for (const NodePairArena& arena : blocks_) total += bytes(arena.rows) + bytes(arena.blocks);
  for (const ThreadWork& work : work_) total += bytes(work.groups);
  return total;
}

}  // namespace morula
