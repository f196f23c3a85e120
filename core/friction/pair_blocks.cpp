#include "core/friction/pair_blocks.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace morula {
namespace {

using Float8v [[gnu::vector_size(32)]] = float;

Float8v load8(const EdgeBlock& block) {
  Float8v v;
  std::memcpy(&v, block.m, sizeof v);
  return v;
}
void add(EdgeBlock& block, float weight, Float8v matrix) {
  const Float8v sum = load8(block) + matrix * weight;
  std::memcpy(block.m, &sum, sizeof sum);
}

/// D = a I + (b + Δt k) n nᵀ of a contact point.
Float8v matrix_of(const ContactElement& e, const ElementGroup& group, float time_step) {
  const Vec3f n = e.normal<float>();
  const float a = e.w * group.tangential_friction;
  const float b = e.w * (group.normal_friction - group.tangential_friction) + time_step * e.k;
  const Float8v left{n.x, n.x, n.x, n.y, n.y, n.z, 0.0f, 0.0f}, right{n.x, n.y, n.z, n.y, n.z, n.z, 0.0f, 0.0f};
  return left * right * b + Float8v{a, 0.0f, 0.0f, a, 0.0f, a, 0.0f, 0.0f};
}

Triangle nodes_of(const Topology* topology, std::uint32_t face) {
  return topology == nullptr ? Triangle{0, 0, 0} : topology->faces()[face];
}

/// The topology whose faces the targets of direction d are; an obstacle is one node at rest.
const Topology* target_of(const ElementGroup& group, int d) { return group.rigid ? nullptr : group.topology[1 - d]; }

/// The weights of the target nodes; a body with one node has all of it there.
void target_weights(const ContactElement& e, const Topology* target, float (&mu)[3]) {
  if (target != nullptr) return e.weights(mu);
  mu[0] = 1.0f;
  mu[1] = mu[2] = 0.0f;
}

std::size_t node_count(const Topology* topology) { return topology == nullptr ? 1 : topology->node_count(); }

}  // namespace

PairCondenser::PairCondenser(const FaceQuadrature& quadrature, float time_step) : time_step_(time_step) {
  for (int q = 0; q < 4; ++q)
    for (int i = 0; i < 3; ++i) beta_[q][i] = static_cast<float>(quadrature.weight[q][i]);
}

void PairCondenser::mark_pairs(const ElementGroup& group) {
  const std::size_t rows = node_count(group.topology[0]), columns = group.rigid ? 1 : node_count(group.topology[1]);
  words_ = (columns + 63) / 64;
  row_used_.assign((rows + 63) / 64, 0);
  if (pattern_.size() < rows * words_) {
    pattern_.resize(rows * words_);
    first_slot_.resize(rows * words_);
  }
  const auto row = [&](std::uint32_t i) {
    std::uint64_t* const bits = pattern_.data() + i * words_;
    std::uint64_t& used = row_used_[i / 64];
    if (!(used >> (i % 64) & 1u)) {
      used |= std::uint64_t{1} << (i % 64);
      std::fill_n(bits, words_, 0);
    }
    return bits;
  };
  for (int d = 0; d < 2; ++d) {
    const Topology* const target = target_of(group, d);
    for (const ContactElement& e : group.elements[d]) {
      const Triangle source = nodes_of(group.topology[d], e.source_face()), t = nodes_of(target, e.target);
      float mu[3];
      target_weights(e, target, mu);
      if (d == 0) {
        for (const std::uint32_t i : source) {
          std::uint64_t* const bits = row(i);
          for (std::size_t j = 0; j < 3; ++j)
            if (mu[j] != 0.0f) bits[t[j] / 64] |= std::uint64_t{1} << (t[j] % 64);
        }
      } else {
        for (std::size_t j = 0; j < 3; ++j) {
          if (mu[j] == 0.0f) continue;
          std::uint64_t* const bits = row(t[j]);
          for (const std::uint32_t i : source) bits[i / 64] |= std::uint64_t{1} << (i % 64);
        }
      }
    }
  }
}

std::uint32_t PairCondenser::number_pairs(const ElementGroup& group) {
  std::uint32_t slots = 0;
  const std::size_t rows = node_count(group.topology[0]);
  for (std::size_t i = 0; i < rows; ++i) {
    if (!(row_used_[i / 64] >> (i % 64) & 1u)) continue;
    for (std::size_t w = 0; w < words_; ++w) {
      first_slot_[i * words_ + w] = slots;
      slots += static_cast<std::uint32_t>(std::popcount(pattern_[i * words_ + w]));
    }
  }
  return slots;
}

void PairCondenser::add_pair_blocks(const ElementGroup& group, std::vector<NodePairBlock>& out) {
  mark_pairs(group);
  const std::uint32_t slots = number_pairs(group);
  sum_.assign(slots, {});
  const auto slot = [&](std::uint32_t i, std::uint32_t j) {
    const std::size_t word = i * words_ + j / 64;
    return first_slot_[word] + static_cast<std::uint32_t>(std::popcount(pattern_[word] & ((std::uint64_t{1} << (j % 64)) - 1)));
  };
  for (int d = 0; d < 2; ++d) {
    const Topology* const target = target_of(group, d);
    for (const ContactElement& e : group.elements[d]) {
      const Triangle source = nodes_of(group.topology[d], e.source_face()), t = nodes_of(target, e.target);
      const Float8v matrix = matrix_of(e, group, time_step_);
      const float* const beta = beta_[e.point()];
      float mu[3];
      target_weights(e, target, mu);
      for (std::size_t j = 0; j < 3; ++j) {
        if (mu[j] == 0.0f) continue;
        const Float8v part = matrix * mu[j];
        for (std::size_t i = 0; i < 3; ++i) add(sum_[d == 0 ? slot(source[i], t[j]) : slot(t[j], source[i])], beta[i], part);
      }
    }
  }
  if (out.capacity() < out.size() + slots) out.reserve(out.size() + out.size() / 8 + slots);
  const std::size_t rows = node_count(group.topology[0]);
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    if (!(row_used_[i / 64] >> (i % 64) & 1u)) continue;
    for (std::size_t w = 0; w < words_; ++w)
      for (std::uint64_t bits = pattern_[i * words_ + w]; bits != 0; bits &= bits - 1) {
        NodePairBlock& block = out.emplace_back();
        block.i = static_cast<std::uint16_t>(i);
        block.j = static_cast<std::uint16_t>(w * 64 + static_cast<std::size_t>(std::countr_zero(bits)));
        std::memcpy(block.c, sum_[next++].m, sizeof block.c);
      }
  }
}

void PairCondenser::add_edge_blocks(const ElementGroup& group, int side, std::span<EdgeBlock> edges) const {
  if (group.topology[side] == nullptr) return;
  const auto edges_of_face = group.topology[side]->face_edges();
  const auto sources = group.elements[side];
  for (std::size_t k = 0; k < sources.size();) {  // the points of a face come one after the other
    const std::uint32_t face = sources[k].source_face();
    Float8v sum[3] = {};
    for (; k < sources.size() && sources[k].source_face() == face; ++k) {
      const Float8v matrix = matrix_of(sources[k], group, time_step_);
      const float* const beta = beta_[sources[k].point()];
      for (std::size_t c = 0; c < 3; ++c) sum[c] += matrix * (beta[(c + 1) % 3] * beta[(c + 2) % 3]);
    }
    for (std::size_t c = 0; c < 3; ++c) add(edges[edges_of_face[face][c]], -1.0f, sum[c]);
  }
  for (const ContactElement& e : group.elements[1 - side]) {
    const Float8v matrix = matrix_of(e, group, time_step_);
    float mu[3];
    e.weights(mu);
    const auto& edge = edges_of_face[e.target];
    for (std::size_t c = 0; c < 3; ++c) add(edges[edge[c]], -mu[(c + 1) % 3] * mu[(c + 2) % 3], matrix);
  }
}

namespace {

/// C d, with a zero behind.
Float4v times(const NodePairBlock& block, Float4v d) {
  using Int4v [[gnu::vector_size(16)]] = std::int32_t;
  Float4v low, high;  // xx xy xz yy and xz yy yz zz
  std::memcpy(&low, block.c, sizeof low);
  std::memcpy(&high, block.c + 2, sizeof high);
  const Float4v x = __builtin_shufflevector(d, d, 0, 0, 0, 0), y = __builtin_shufflevector(d, d, 1, 1, 1, 1),
                z = __builtin_shufflevector(d, d, 2, 2, 2, 2);
  const Float4v sum = x * low + y * __builtin_shufflevector(low, high, 1, 3, 6, 6) + z * __builtin_shufflevector(high, high, 0, 2, 3, 3);
  return reinterpret_cast<Float4v>(reinterpret_cast<Int4v>(sum) & Int4v{-1, -1, -1, 0});
}

template <bool kFirst, bool kSecond, bool kRest>
void apply_rows(std::span<const NodePairBlock> blocks, const Float4* p0, Float4* q0, const Float4* p1, Float4* q1) {
  const NodePairBlock* block = blocks.data();
  const NodePairBlock* const end = block + blocks.size();
  while (block != end) {
    const std::uint16_t i = block->i;
    const Float4v pi = load(p0[i]);
    Float4v sum{};
    for (; block != end && block->i == i; ++block) {
      const Float4v f = times(*block, kRest ? pi : pi - load(p1[block->j]));
      if constexpr (kFirst) sum += f;
      if constexpr (kSecond) store(q1[block->j], load(q1[block->j]) - f);
    }
    if constexpr (kFirst) store(q0[i], load(q0[i]) + sum);
  }
}

}  // namespace

void apply_pair_blocks(std::span<const NodePairBlock> blocks, const Float4* p0, Float4* q0, const Float4* p1, Float4* q1) {
  if (p1 == nullptr) return q0 != nullptr ? apply_rows<true, false, true>(blocks, p0, q0, nullptr, nullptr) : void();
  if (q0 != nullptr && q1 != nullptr) return apply_rows<true, true, false>(blocks, p0, q0, p1, q1);
  if (q0 != nullptr) return apply_rows<true, false, false>(blocks, p0, q0, p1, nullptr);
  if (q1 != nullptr) return apply_rows<false, true, false>(blocks, p0, nullptr, p1, q1);
}

}  // namespace morula
