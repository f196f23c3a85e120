#include "core/friction/friction_system.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

#include "core/parallel/threads.h"

namespace morula {
namespace {

constexpr std::size_t kWorkOfPoint = 8;  // in units of that of a block between two nodes
constexpr std::uint16_t kNoThread = 0xFFFF;

/// One number in all components.
Float4v splat(float s) { return Float4v{s, s, s, s}; }

/// In double: a float's determinant would cancel.
SymMat3<float> inverse_of(const SymMat3<float>& a) { return to_float(inverse(SymMat3<double>{a.xx, a.xy, a.xz, a.yy, a.yz, a.zz})); }

using Double4 [[gnu::vector_size(32)]] = double;
Double4 to_double(Float4v v) { return __builtin_convertvector(v, Double4); }
double total(Double4 sum) { return (sum[0] + sum[1]) + (sum[2] + sum[3]); }

/// Dot product over the points of one body, in double and in fixed order.
double dot_of_body(const Float4* a, const Float4* b, std::uint32_t count) {
  Double4 sum{};
  for (std::uint32_t i = 0; i < count; ++i) sum += to_double(load(a[i])) * to_double(load(b[i]));
  return total(sum);
}

Float4v times(const NodeInverse& m, Float4v r) {
  using Int4v [[gnu::vector_size(16)]] = std::int32_t;
  const Int4v words = *reinterpret_cast<const Int4v*>(m.word);                // NOLINT: same layout and alignment; vector types may alias
  const Float4v low = __builtin_convertvector((words << 16) >> 16, Float4v);  // xx xy xz, then anything
  const Float4v high = __builtin_convertvector(words >> 16, Float4v);         // yy yz zz
  const float unit = std::bit_cast<float>(m.word[3]);
  return (splat(r[0]) * low + splat(r[1]) * __builtin_shufflevector(low, high, 1, 4, 5, 3) +
          splat(r[2]) * __builtin_shufflevector(low, high, 2, 5, 6, 3)) *
         Float4v{unit, unit, unit, 0.0f};
}

}  // namespace

NodeInverse::NodeInverse(const SymMat3<float>& m) {
  const float unit = std::max({m.xx, m.yy, m.zz}) / 32764.0f;  // the matrix is positive
  const float per_unit = 1.0f / unit;
  const auto whole = [&](float entry, float back) {
    const float scaled = entry * per_unit + back;
    return static_cast<std::int32_t>(scaled + (scaled < 0.0f ? -0.5f : 0.5f));
  };
  const auto both = [](std::int32_t low, std::int32_t high) {
    return static_cast<std::int32_t>((static_cast<std::uint32_t>(low) & 0xFFFFu) | (static_cast<std::uint32_t>(high) << 16));
  };
  word[0] = both(whole(m.xx, 1.5f), whole(m.yy, 1.5f));
  word[1] = both(whole(m.xy, 0.0f), whole(m.yz, 0.0f));
  word[2] = both(whole(m.xz, 0.0f), whole(m.zz, 1.5f));
  word[3] = std::bit_cast<std::int32_t>(unit);
}

void FrictionSystem::set_layout(Layout layout, int threads) {
  layout_ = std::move(layout);
  threads_ = std::max(1, threads);
  drop_matrix();
  portions_.clear();
  sphere_pairs_ = nullptr;
  added_.clear();
}

void FrictionSystem::set_elements(std::span<const ElementGroup> groups, const FaceQuadrature& quadrature) {
  pairs_.assign(groups.size(), {});
  std::size_t points = 0;
  for (const ElementGroup& group : groups) points += group.elements[0].size() + group.elements[1].size();
  blocks_.resize(static_cast<std::size_t>(threads_));
  for (auto& arena : blocks_) arena.clear();
  WorkQueue queue(groups.size(), 8);
  on_each_thread(threads_, [&](std::size_t arena) {
    PairCondenser condenser(quadrature, dt_);
    NodePairArena& out = blocks_[arena];
    std::size_t points_done = 0;
    bool foreseen = false;
    queue.work_off([&](std::size_t g) {
      const ElementGroup& group = groups[g];
      if (!foreseen && points_done > 1000) {  // room for all, foreseen from the first: to grow by and by would copy them many times
        foreseen = true;
        const double more = 1.05 * static_cast<double>(points) / static_cast<double>(points_done) / threads_;
        out.blocks.reserve(static_cast<std::size_t>(more * static_cast<double>(out.blocks.size())));
        out.rows.reserve(static_cast<std::size_t>(more * static_cast<double>(out.rows.size())));
      }
      points_done += group.elements[0].size() + group.elements[1].size();
      const std::size_t begin = out.blocks.size(), first_row = out.rows.size();
      condenser.add_pair_blocks(group, out);
      pairs_[g] = {static_cast<std::uint32_t>(arena),
                   static_cast<std::uint32_t>(out.blocks.size() - begin),
                   static_cast<std::uint32_t>(out.rows.size() - first_row),
                   begin,
                   first_row,
                   {group.body[0], group.body[1]},
                   {group.first[0], group.first[1]},
                   {group.write[0], group.write[1] && !group.rigid},
                   group.rigid};
    });
  });
  lay_out_portions();
  divide_work();
  for (ThreadWork& work : work_) schedule_contacts(work);
}

void FrictionSystem::lay_out_portions() {
  portions_.clear();
  runs_.clear();
  const std::size_t points = shells_ == nullptr ? 0 : shells_->point_count();
  const auto batches = static_cast<std::uint32_t>(points == 0 ? 0 : shells_->batch_count());
  // Vectors of a portion: some 200 kB; and several portions for each of several threads.
  const auto threads = static_cast<std::uint32_t>(threads_), bodies = static_cast<std::uint32_t>(layout_.body_count());
  const std::uint32_t batches_each = threads == 1 ? 4 : std::clamp(batches / (4 * threads), 1u, 4u);
  const std::uint32_t bodies_each = threads == 1 ? 4096 : std::clamp(bodies / (4 * threads), 1u, 4096u);
  const auto add_body = [&](Portion& portion, std::uint32_t body) {
    if (portion.last_run > portion.first_run && runs_.back().last == body)
      ++runs_.back().last;
    else
      runs_.push_back({body, body + 1}), ++portion.last_run;
  };
  for (std::uint32_t batch = 0; batch < batches; batch += batches_each) {
    Portion& portion = portions_.emplace_back();
    portion.first_batch = batch;
    portion.last_batch = std::min(batches, batch + batches_each);
    portion.first_run = portion.last_run = static_cast<std::uint32_t>(runs_.size());
    for (std::uint32_t b = batch; b < portion.last_batch; ++b)
      for (const std::uint32_t body : shells_->bodies_of(b)) add_body(portion, body);
  }
  std::uint32_t in_portion = bodies_each;
  for (std::uint32_t body = 0; body < layout_.body_count(); ++body) {
    if (!layout_.owned[body] || layout_.points_of(body).first < points) continue;
    if (in_portion++ == bodies_each) {
      in_portion = 1;
      Portion& portion = portions_.emplace_back();
      portion.first_run = portion.last_run = static_cast<std::uint32_t>(runs_.size());
    }
    add_body(portions_.back(), body);
  }
}

void FrictionSystem::divide_work() {
  work_.assign(static_cast<std::size_t>(threads_), {});
  work_[0].last_portion = static_cast<std::uint32_t>(portions_.size());
  thread_of_.clear();
  // What is added elsewhere comes after the portions. What spheres that pack add is collective: no rank may leave it out.
  complete_ =
      std::all_of(added_.begin(), added_.end(), [](const AddedPart* part) { return part->empty(); }) &&
      (sphere_pairs_ == nullptr || !sphere_pairs_->packing.on) &&
      std::all_of(portions_.begin(), portions_.end(), [](const Portion& portion) { return portion.first_batch < portion.last_batch; });
  if (threads_ > 1) {  // neighbouring portions, about as many points and blocks to each
    std::vector<std::size_t> weight(layout_.body_count(), 0);
    for (const PairBlocks& pair : pairs_)
      for (int side = 0; side < (pair.rigid ? 1 : 2); ++side) weight[pair.body[side]] += pair.count;
    std::size_t all = 0;
    for (std::size_t body = 0; body < weight.size(); ++body)
      if (layout_.owned[body]) all += weight[body] += kWorkOfPoint * layout_.points_of(body).count;
    thread_of_.assign(layout_.body_count(), kNoThread);
    std::size_t seen = 0, thread = 0;
    for (std::uint32_t k = 0; k < portions_.size(); ++k) {
      for_bodies_of(portions_[k], [&](std::uint32_t body) {
        thread_of_[body] = static_cast<std::uint16_t>(thread);
        seen += weight[body];
      });
      work_[thread].last_portion = k + 1;
      if (thread + 1 < work_.size() && seen * work_.size() >= all * (thread + 1)) {
        ++thread;
        work_[thread].first_portion = work_[thread].last_portion = k + 1;
      }
    }
  }
  for (std::size_t t = 0; t < work_.size(); ++t) {
    work_[t].number = static_cast<std::uint16_t>(t);
    for (std::uint32_t g = 0; g < pairs_.size(); ++g)
      if (writes(work_[t], pairs_[g], 0) || writes(work_[t], pairs_[g], 1)) work_[t].groups.push_back(g);
  }
}

void FrictionSystem::schedule_contacts(ThreadWork& work) {
  // Contacts in their order, each as soon as its bodies, and those of all before it, are there: sums keep the canonical order. Other threads'
  // bodies, and ghosts, are there from the start.
  std::vector<std::uint32_t> there(layout_.body_count(), 0), last(layout_.body_count(), 0);
  const auto for_own_bodies = [&](auto&& function) {
    for (std::uint32_t k = work.first_portion; k < work.last_portion; ++k)
      for_bodies_of(portions_[k], [&](std::uint32_t body) { function(k, body); });
  };
  for_own_bodies([&](std::uint32_t k, std::uint32_t body) { there[body] = last[body] = k; });
  std::uint32_t next = 0;
  for (std::uint32_t k = work.first_portion; k < work.last_portion; ++k) {
    portions_[k].first_group = next;
    for (; next < work.groups.size(); ++next) {
      const PairBlocks& pair = pairs_[work.groups[next]];
      if (there[pair.body[0]] > k || (!pair.rigid && there[pair.body[1]] > k)) break;
      last[pair.body[0]] = k;
      if (!pair.rigid) last[pair.body[1]] = k;
    }
    portions_[k].last_group = next;
  }
  if (!complete_) return;
  std::vector<std::uint32_t> first(portions_.size() + 1, 0);
  for_own_bodies([&](std::uint32_t, std::uint32_t body) { ++first[last[body] + 1]; });
  for (std::size_t k = 0; k < portions_.size(); ++k) first[k + 1] += first[k];
  for (std::uint32_t k = work.first_portion; k < work.last_portion; ++k)
    portions_[k].first_done = first[k], portions_[k].last_done = first[k + 1];
  work.done.resize(first.back());
  for_own_bodies([&](std::uint32_t, std::uint32_t body) { work.done[first[last[body]]++] = body; });
}

template <class Body>
void FrictionSystem::for_bodies_of(const Portion& portion, Body&& body) const {
  for (std::uint32_t r = portion.first_run; r < portion.last_run; ++r)
    for (std::uint32_t number = runs_[r].first; number < runs_[r].last; ++number)
      if (layout_.owned[number]) body(number);
}

template <class Body>
void FrictionSystem::for_owned_bodies(Body&& function) const {
  on_each_thread(threads_, [&](std::size_t t) {
    const auto with_many = static_cast<std::uint32_t>(layout_.bodies.size());
    const char* const owned = layout_.owned.data();
    for (std::uint32_t k = work_[t].first_portion; k < work_[t].last_portion; ++k)
      for (std::uint32_t r = portions_[k].first_run; r < portions_[k].last_run; ++r) {
        std::uint32_t body = runs_[r].first;
        const std::uint32_t last = runs_[r].last;
        for (; body < std::min(last, with_many); ++body)
          if (owned[body]) function(t, layout_.bodies[body]);
        for (std::uint32_t point = layout_.points_of(body).first; body < last; ++body, ++point)
          if (owned[body]) function(t, BodyPoints{point, 1});
      }
  });
}

template <class Point>
void FrictionSystem::for_points_of(const Portion& portion, Point&& point) const {
  for_bodies_of(portion, [&](std::uint32_t body) {
    const BodyPoints points = layout_.points_of(body);
    for (std::uint32_t i = points.first; i < points.first + points.count; ++i) point(i);
  });
}

void FrictionSystem::multiply(const Portion& portion, std::span<const Float4> p, std::span<Float4> q) const {
  if (portion.first_batch < portion.last_batch) return shells_->multiply(portion.first_batch, portion.last_batch, p, q);
  for_points_of(portion, [&](std::uint32_t i) { store(q[i], splat(point_friction_[i - layout_.first_single()]) * load(p[i])); });
}

void FrictionSystem::apply_contacts(const ThreadWork& work, const Portion& portion, std::span<const Float4> p, std::span<Float4> q) const {
  for (std::uint32_t k = portion.first_group; k < portion.last_group; ++k) {
    const PairBlocks& pair = pairs_[work.groups[k]];
    apply_pair_blocks(blocks_of(pair), p.data() + pair.first[0], writes(work, pair, 0) ? q.data() + pair.first[0] : nullptr,
                      pair.rigid ? nullptr : p.data() + pair.first[1], writes(work, pair, 1) ? q.data() + pair.first[1] : nullptr);
  }
}

void FrictionSystem::add_others(std::span<const Float4> p, std::span<Float4> q) const {
  if (sphere_pairs_ != nullptr) sphere_pairs_->add_product(p, q, dt_);
  for (const AddedPart* part : added_) part->add_product(p, q);
}

template <class Before, class After>
void FrictionSystem::multiply_own(std::span<const Float4> p, std::span<Float4> q, const Before& before, const After& after) const {
  on_each_thread(threads_, [&](std::size_t t) {
    for (std::uint32_t k = work_[t].first_portion; k < work_[t].last_portion; ++k) {
      before(portions_[k]);
      multiply(portions_[k], p, q);
      apply_contacts(work_[t], portions_[k], p, q);
      after(t, portions_[k]);
    }
  });
}

void FrictionSystem::apply(std::span<const Float4> p, std::span<Float4> q) const {
  multiply_own(
      p, q, [](const Portion&) {}, [](std::size_t, const Portion&) {});
  add_others(p, q);
}

double FrictionSystem::turn(float alpha, float beta, std::span<Float4> v, const Comm& comm) {
  const Float4v a = splat(alpha), b = splat(beta);
  const auto renew = [&](const Portion& portion) {
    for_points_of(portion, [&](std::uint32_t i) {
      const Float4v p = load(p_[i]);
      store(v[i], load(v[i]) + a * p);
      store(p_[i], times(inverse_[i], load(r_[i])) + b * p);
    });
  };
  const bool alone = threads_ == 1 && !layout_.exchange;
  if (!alone)  // contacts need what other threads and ranks renew
    on_each_thread(threads_, [&](std::size_t t) {
      for (std::uint32_t k = work_[t].first_portion; k < work_[t].last_portion; ++k) renew(portions_[k]);
    });
  if (layout_.exchange) layout_.exchange(p_);
  std::vector<OrderFreeSum> sums(work_.size());
  multiply_own(
      p_, q_,
      [&](const Portion& portion) {
        if (alone) renew(portion);
      },
      [&](std::size_t t, const Portion& portion) {
        for (std::uint32_t k = portion.first_done; k < portion.last_done; ++k) {
          const BodyPoints points = layout_.points_of(work_[t].done[k]);
          sums[t].add(dot_of_body(p_.data() + points.first, q_.data() + points.first, points.count));
        }
      });
  if (!complete_) {
    add_others(p_, q_);
    return dot(p_, q_, comm);
  }
  for (std::size_t t = 1; t < sums.size(); ++t) sums[0] += sums[t];
  return comm.sum(sums[0]);
}

void FrictionSystem::add_contact_diagonal(const ThreadWork& work, std::span<SymMat3<float>> sum) const {
  for (const std::uint32_t g : work.groups) {
    const PairBlocks& pair = pairs_[g];
    for (int side = 0; side < 2; ++side) {
      if (!writes(work, pair, side)) continue;
      SymMat3<float>* const diagonal = sum.data() + pair.first[side];
      const NodePairBlocks blocks = blocks_of(pair);
      const NodePairBlock* block = blocks.blocks.data();
      for (const NodePairRow& row : blocks.rows)
        for (const NodePairBlock* const end = block + row.count; block != end; ++block)
          diagonal[side == 0 ? row.i : block->j] += block->matrix(row.unit);
    }
  }
}

void FrictionSystem::build_preconditioner() {
  std::vector<SymMat3<float>> diagonal(layout_.point_count);
  parallel_for(threads_, point_friction_.size(),
               [&](std::size_t i) { diagonal[layout_.first_single() + i] = isotropic(point_friction_[i]); });
  if (shells_ != nullptr && shells_->point_count() > 0) shells_->add_diagonal(diagonal);
  on_each_thread(threads_, [&](std::size_t t) { add_contact_diagonal(work_[t], diagonal); });
  if (sphere_pairs_ != nullptr) sphere_pairs_->add_diagonal(diagonal, dt_);
  for (const AddedPart* part : added_) part->add_diagonal(diagonal);
  inverse_.resize(layout_.point_count);
  for_owned_bodies([&](std::size_t, const BodyPoints& points) {
    for (std::uint32_t i = points.first; i < points.first + points.count; ++i) inverse_[i] = NodeInverse(inverse_of(diagonal[i]));
  });
}

void FrictionSystem::drop_matrix() {
  const auto give_back = [](auto& vector) { std::remove_reference_t<decltype(vector)>().swap(vector); };
  give_back(inverse_), give_back(p_), give_back(q_), give_back(r_), give_back(pairs_), give_back(blocks_);
}

double FrictionSystem::dot(std::span<const Float4> a, std::span<const Float4> b, const Comm& comm) const {
  std::vector<OrderFreeSum> sums(static_cast<std::size_t>(threads_));
  for_owned_bodies([&](std::size_t t, const BodyPoints& points) {
    sums[t].add(dot_of_body(a.data() + points.first, b.data() + points.first, points.count));
  });
  for (std::size_t t = 1; t < sums.size(); ++t) sums[0] += sums[t];
  return comm.sum(sums[0]);
}

void FrictionSystem::reduce(float alpha, const Comm& comm, double (&totals)[2]) {
  std::vector<std::array<OrderFreeSum, 2>> sums(static_cast<std::size_t>(threads_));
  const Float4v a = splat(alpha);
  for_owned_bodies([&](std::size_t t, const BodyPoints& points) {
    Double4 rr{}, rz{};
    for (std::uint32_t i = points.first; i < points.first + points.count; ++i) {
      const Float4v r = load(r_[i]) - a * load(q_[i]);
      store(r_[i], r);
      const Double4 wide = to_double(r);
      rr += wide * wide;
      rz += wide * to_double(times(inverse_[i], r));
    }
    sums[t][0].add(total(rr));
    sums[t][1].add(total(rz));
  });
  for (std::size_t t = 1; t < sums.size(); ++t)
    for (int k = 0; k < 2; ++k) sums[0][k] += sums[t][k];
  comm.sum(sums[0], totals);
}

Result<SolveReport, SolveFault> FrictionSystem::solve(std::span<Float4> v, double tolerance, int max_iterations, const Comm& comm) {
  assert(v.size() >= layout_.point_count && r_.size() == layout_.point_count && dt_ >= 0.0f);
  build_preconditioner();
  p_.assign(layout_.point_count, {});
  q_.assign(layout_.point_count, {});
  const auto exchange = [&](std::span<Float4> vector) {
    if (layout_.exchange) layout_.exchange(vector);
  };
  const auto for_owned_points = [&](auto&& function) {
    for_owned_bodies([&](std::size_t, const BodyPoints& points) {
      for (std::uint32_t i = points.first; i < points.first + points.count; ++i) function(i);
    });
  };

  constexpr double kNoForce = 1e-20;  // [nN]; what is below is lost in float's products, and moves nothing
  const double b_norm = std::sqrt(dot(r_, r_, comm));
  if (!std::isfinite(b_norm)) return SolveFault{"the force is not a number"};
  if (b_norm < kNoForce) {
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
  reduce(1.0f, comm, sums);
  double residual = std::sqrt(sums[0]);
  const double goal = tolerance * b_norm;
  SolveReport report{0, residual / b_norm, residual <= goal};
  float alpha = 0.0f, beta = 0.0f;
  while (residual > goal && report.iterations < max_iterations) {
    const double pq = turn(alpha, beta, v, comm);
    if (!(pq > 0.0)) return SolveFault{"the friction matrix is not positive definite"};
    const double rz = sums[1];
    alpha = static_cast<float>(rz / pq);
    reduce(alpha, comm, sums);
    residual = std::sqrt(sums[0]);
    beta = static_cast<float>(sums[1] / rz);
    ++report.iterations;
  }
  for_owned_points([&](std::uint32_t i) { store(v[i], load(v[i]) + splat(alpha) * load(p_[i])); });
  report.residual = residual / b_norm;
  report.converged = residual <= goal;
  return report;
}

std::size_t FrictionSystem::memory() const {
  const auto bytes = [](const auto& vector) { return vector.capacity() * sizeof(vector[0]); };
  std::size_t total = bytes(point_friction_) + bytes(pairs_) + bytes(inverse_) + bytes(p_) + bytes(q_) + bytes(r_) + bytes(layout_.bodies) +
                      bytes(layout_.owned) + bytes(portions_) + bytes(runs_) + bytes(thread_of_);
  for (const NodePairArena& arena : blocks_) total += bytes(arena.rows) + bytes(arena.blocks);
  for (const ThreadWork& work : work_) total += bytes(work.groups) + bytes(work.done);
  return total;
}

}  // namespace morula
