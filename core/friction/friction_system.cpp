#include "core/friction/friction_system.h"

#include <omp.h>

#include <algorithm>
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

/// Dot product over the points of one body, in double and in fixed order.
double dot_of_body(const Float4* a, const Float4* b, std::uint32_t count) {
  using Double4 [[gnu::vector_size(32)]] = double;
  Double4 sum{};
  for (std::uint32_t i = 0; i < count; ++i) {
    const Double4 x{a[i].x, a[i].y, a[i].z, a[i].w}, y{b[i].x, b[i].y, b[i].z, b[i].w};
    sum += x * y;
  }
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

inline Float4v response(Float4v u, Float4v n, float a, float b) { return splat(a) * u + splat(b * dot3(n, u)) * n; }

}  // namespace

void FrictionSystem::set_layout(Layout layout, int threads) {
  layout_ = std::move(layout);
  threads_ = std::max(1, threads);
  inverse_.assign(layout_.point_count, {});
  for (auto* vector : {&p_, &q_, &r_, &z_}) vector->assign(layout_.point_count, Float4{});
  // Contiguous ranges of bodies of about equal numbers of points.
  std::size_t owned_points = 0;
  for (std::size_t body = 0; body < layout_.bodies.size(); ++body)
    if (layout_.owned[body]) owned_points += layout_.bodies[body].count;
  work_.assign(static_cast<std::size_t>(threads_), {});
  std::size_t seen = 0, thread = 0;
  for (std::size_t body = 0; body < layout_.bodies.size(); ++body) {
    if (layout_.owned[body]) seen += layout_.bodies[body].count;
    work_[thread].last_body = static_cast<std::uint32_t>(body + 1);
    if (thread + 1 < work_.size() && seen * work_.size() >= owned_points * (thread + 1)) {
      ++thread;
      work_[thread].first_body = work_[thread].last_body = static_cast<std::uint32_t>(body + 1);
    }
  }
  groups_.clear();
  sphere_pairs_ = nullptr;
}

void FrictionSystem::set_elements(std::vector<ElementGroup> groups, const FaceQuadrature& quadrature) {
  groups_ = std::move(groups);
  for (int q = 0; q < 4; ++q)
    for (int i = 0; i < 3; ++i) beta_[q][i] = static_cast<float>(quadrature.weight[q][i]);
  for (ThreadWork& work : work_) {
    work.groups.clear();
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const auto mine = [&](std::uint32_t body) { return body >= work.first_body && body < work.last_body; };
      const bool source = groups_[g].write_source && mine(groups_[g].source_body);
      const bool target = groups_[g].write_target && groups_[g].target_moves && mine(groups_[g].target_body);
      if (source || target) work.groups.push_back(static_cast<std::uint32_t>(g));
    }
  }
}

template <class Body>
void FrictionSystem::for_owned_bodies(Body&& function) const {
#pragma omp parallel for schedule(static, 1) num_threads(threads_)
  for (int t = 0; t < threads_; ++t)
    for (std::uint32_t body = work_[static_cast<std::size_t>(t)].first_body; body < work_[static_cast<std::size_t>(t)].last_body; ++body)
      if (layout_.owned[body]) function(t, body);
}

void FrictionSystem::apply_elements(int thread, std::span<const Float4> p, std::span<Float4> q) const {
  const ThreadWork& work = work_[static_cast<std::size_t>(thread)];
  const auto mine = [&](std::uint32_t body) { return body >= work.first_body && body < work.last_body; };
  for (const std::uint32_t g : work.groups) {
    const ElementGroup& group = groups_[g];
    const bool write_source = group.write_source && mine(group.source_body);
    const bool write_target = group.write_target && group.target_moves && mine(group.target_body);
    const Float4* source = p.data() + group.source_first;
    Float4* source_out = q.data() + group.source_first;
    const Float4* target = p.data() + group.target_first;
    Float4* target_out = q.data() + group.target_first;
    for (const ContactElement& e : group.elements) {
      const float* beta = beta_[e.point];
      const float mu[3] = {e.mu[0], e.mu[1], 1.0f - e.mu[0] - e.mu[1]};
      Float4v u = splat(beta[0]) * load(source[e.source[0]]) + splat(beta[1]) * load(source[e.source[1]]) +
                  splat(beta[2]) * load(source[e.source[2]]);
      if (group.target_moves)
        u -= splat(mu[0]) * load(target[e.target[0]]) + splat(mu[1]) * load(target[e.target[1]]) + splat(mu[2]) * load(target[e.target[2]]);
      const Float4v f = response(u, Float4v{e.n[0], e.n[1], e.n[2], 0.0f}, e.a, e.b + dt_ * e.k);
      if (write_source)
        for (int i = 0; i < 3; ++i) store(source_out[e.source[i]], load(source_out[e.source[i]]) + splat(beta[i]) * f);
      if (write_target)
        for (int j = 0; j < 3; ++j) store(target_out[e.target[j]], load(target_out[e.target[j]]) - splat(mu[j]) * f);
    }
  }
}

void FrictionSystem::apply(std::span<const Float4> p, std::span<Float4> q) const {
  if (shells_ != nullptr && shells_->point_count() > 0) shells_->multiply(p, q);
  const std::size_t done = shells_ != nullptr ? shells_->point_count() : 0;
  for_owned_bodies([&](int, std::uint32_t body) {
    const BodyPoints& points = layout_.bodies[body];
    if (points.first < done) return;
    for (std::uint32_t i = points.first; i < points.first + points.count; ++i) store(q[i], splat(point_friction_[i]) * load(p[i]));
  });
#pragma omp parallel for schedule(static, 1) num_threads(threads_)
  for (int t = 0; t < threads_; ++t) apply_elements(t, p, q);
  if (sphere_pairs_ != nullptr) sphere_pairs_->add_product(p, q, dt_);
}

void FrictionSystem::build_preconditioner() {
  for (std::size_t i = 0; i < layout_.point_count; ++i) inverse_[i] = isotropic(point_friction_[i]);
  if (shells_ != nullptr && shells_->point_count() > 0) shells_->add_diagonal(inverse_);
  const auto block = [&](float weight, float a, float b, const float* n) {
    return SymMat3<float>(isotropic(weight * a) + outer(weight * b, Vec3f{n[0], n[1], n[2]}));
  };
#pragma omp parallel for schedule(static, 1) num_threads(threads_)
  for (int t = 0; t < threads_; ++t) {
    const ThreadWork& work = work_[static_cast<std::size_t>(t)];
    const auto mine = [&](std::uint32_t body) { return body >= work.first_body && body < work.last_body; };
    for (const std::uint32_t g : work.groups) {
      const ElementGroup& group = groups_[g];
      const bool write_source = group.write_source && mine(group.source_body);
      const bool write_target = group.write_target && group.target_moves && mine(group.target_body);
      for (const ContactElement& e : group.elements) {
        const float b = e.b + dt_ * e.k;
        const float mu[3] = {e.mu[0], e.mu[1], 1.0f - e.mu[0] - e.mu[1]};
        for (int i = 0; i < 3; ++i) {
          const float beta = beta_[e.point][i];
          if (write_source) inverse_[group.source_first + e.source[i]] += block(beta * beta, e.a, b, e.n);
          if (write_target) inverse_[group.target_first + e.target[i]] += block(mu[i] * mu[i], e.a, b, e.n);
        }
      }
    }
  }
  if (sphere_pairs_ != nullptr) sphere_pairs_->add_diagonal(inverse_, dt_);
  for_owned_bodies([&](int, std::uint32_t body) {
    const BodyPoints& points = layout_.bodies[body];
    for (std::uint32_t i = points.first; i < points.first + points.count; ++i) inverse_[i] = inverse_of(inverse_[i]);
  });
}

void FrictionSystem::precondition(std::size_t body) {
  const BodyPoints& points = layout_.bodies[body];
  for (std::uint32_t i = points.first; i < points.first + points.count; ++i) {
    const Vec3f z = inverse_[i] * Vec3f{r_[i].x, r_[i].y, r_[i].z};
    z_[i] = {z.x, z.y, z.z, 0.0f};
  }
}

double FrictionSystem::dot(std::span<const Float4> a, std::span<const Float4> b, const Comm& comm) const {
  std::vector<OrderFreeSum> sums(static_cast<std::size_t>(threads_));
  for_owned_bodies([&](int t, std::uint32_t body) {
    const BodyPoints& points = layout_.bodies[body];
    sums[static_cast<std::size_t>(t)].add(dot_of_body(a.data() + points.first, b.data() + points.first, points.count));
  });
  for (std::size_t t = 1; t < sums.size(); ++t) sums[0] += sums[t];
  return comm.sum(sums[0]);
}

Result<SolveReport, SolveFault> FrictionSystem::solve(std::span<const Float4> b, std::span<Float4> v, double tolerance, int max_iterations,
                                                      const Comm& comm) {
  build_preconditioner();
  const auto exchange = [&](std::span<Float4> vector) {
    if (layout_.exchange) layout_.exchange(vector);
  };
  const auto for_owned_points = [&](auto&& function) {
    for_owned_bodies([&](int, std::uint32_t body) {
      const BodyPoints& points = layout_.bodies[body];
      for (std::uint32_t i = points.first; i < points.first + points.count; ++i) function(i);
    });
  };

  const double b_norm = std::sqrt(dot(b, b, comm));
  if (!std::isfinite(b_norm)) return SolveFault{"the force is not a number"};
  if (b_norm == 0.0) {
    for_owned_points([&](std::uint32_t i) { v[i] = {}; });
    return SolveReport{};
  }
  exchange(v);
  apply(v, q_);
  for_owned_points([&](std::uint32_t i) { store(r_[i], load(b[i]) - load(q_[i])); });
  // A start that is worse than none is dropped: zero velocity has the residual ‖b‖.
  double residual = std::sqrt(dot(r_, r_, comm));
  if (!(residual < b_norm)) {
    for_owned_points([&](std::uint32_t i) {
      v[i] = {};
      r_[i] = b[i];
    });
    residual = b_norm;
  }
  const double goal = tolerance * b_norm;
  SolveReport report{0, residual / b_norm, residual <= goal};
  for_owned_bodies([&](int, std::uint32_t body) { precondition(body); });
  for_owned_points([&](std::uint32_t i) { p_[i] = z_[i]; });
  double rz = dot(r_, z_, comm);
  while (residual > goal && report.iterations < max_iterations) {
    exchange(p_);
    apply(p_, q_);
    const double pq = dot(p_, q_, comm);
    if (!(pq > 0.0)) return SolveFault{"the friction matrix is not positive definite"};
    const float alpha = static_cast<float>(rz / pq);
    for_owned_bodies([&](int, std::uint32_t body) {
      const BodyPoints& points = layout_.bodies[body];
      for (std::uint32_t i = points.first; i < points.first + points.count; ++i) {
        store(v[i], load(v[i]) + splat(alpha) * load(p_[i]));
        store(r_[i], load(r_[i]) - splat(alpha) * load(q_[i]));
      }
      precondition(body);
    });
    residual = std::sqrt(dot(r_, r_, comm));
    const double rz_next = dot(r_, z_, comm);
    const float beta = static_cast<float>(rz_next / rz);
    rz = rz_next;
    for_owned_points([&](std::uint32_t i) { store(p_[i], load(z_[i]) + splat(beta) * load(p_[i])); });
    ++report.iterations;
  }
  report.residual = residual / b_norm;
  report.converged = residual <= goal;
  return report;
}

std::size_t FrictionSystem::memory() const {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t total = bytes(layout_.bodies) + bytes(layout_.owned) + bytes(point_friction_) + bytes(groups_) + bytes(inverse_) + bytes(p_) +
                      bytes(q_) + bytes(r_) + bytes(z_);
  for (const ThreadWork& work : work_) total += bytes(work.groups);
  return total;
}

}  // namespace morula
