#include "core/friction/pair_blocks.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "core/simd/lane.h"

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

/// v vᵀ, where the six numbers of an EdgeBlock are.
Float8v square(const Vec3f& v) {
  return Float8v{v.x, v.x, v.x, v.y, v.y, v.z, 0.0f, 0.0f} * Float8v{v.x, v.y, v.z, v.y, v.z, v.z, 0.0f, 0.0f};
}
constexpr Float8v kOne{1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 1.0f, 0.0f, 0.0f};

/// The directions across the gap in which the distance d to the target is curved: both at a node, that across the edge on an edge, none within a face and
/// against a sphere. The energy u(d) has the second derivative u′/d there, which is u″ while the traction rises with the gap or with the depth; where it
/// falls the matrix has neither (decision 0065).
Float8v across_gap(const ContactElement& e, const ElementGroup& group, int d, const Vec3f& n) {
  const Topology* const target = group.topology[1 - d];
  if (target == nullptr || !e.at_edge()) return Float8v{};
  float mu[3];
  e.weights(mu);
  if ((mu[0] == 0.0f) + (mu[1] == 0.0f) + (mu[2] == 0.0f) == 2) return kOne - square(n);
  const std::size_t opposite = mu[0] == 0.0f ? 0 : mu[1] == 0.0f ? 1 : 2;
  const Triangle& face = target->faces()[e.target()];
  const Vec3d* const x = group.position[1 - d];
  const Vec3f across = cross(n, to_float(x[face[(opposite + 2) % 3]] - x[face[(opposite + 1) % 3]]));
  return square(across) * (1.0f / norm2(across));
}

/// D = a I + (b + Δt k) n nᵀ of a contact point of direction d, and Δt k across the gap where the distance is curved; its smallest eigenvalue behind.
Float8v matrix_of(const ContactElement& e, const ElementGroup& group, int d, float time_step) {
  const Vec3f n = e.normal<float>();
  const float stiffness = time_step * e.stiffness();
  const float a = e.area() * group.tangential_friction;
  const float b = e.area() * (group.normal_friction - group.tangential_friction) + stiffness;
  Float8v out = square(n) * b + across_gap(e, group, d, n) * stiffness + kOne * a;
  out[6] = b < 0.0f ? a + b : a;
  return out;
}

/// C of a sum of points as it is kept; sum.m[6] bounds its smallest eigenvalue from below.
NodePairBlock rounded(const EdgeBlock& sum, float per_unit, std::uint16_t j) {
  using Int8v [[gnu::vector_size(32)]] = std::int32_t;
  using Short8v [[gnu::vector_size(16)]] = std::int16_t;
  Float8v units = load8(sum) * per_unit;
  // an error of half a unit in every entry takes at most 1.5 units from an eigenvalue
  units += kOne * std::max(0.0f, 1.5f - units[6]);
  units += units < 0.0f ? Float8v{} - 0.5f : Float8v{} + 0.5f;
  const Int8v whole = __builtin_convertvector(units, Int8v);  // xx xy xz yy yz zz
  const Short8v packed = __builtin_convertvector(__builtin_shufflevector(whole, whole, 0, 7, 1, 3, 2, 4, 5, 7), Short8v);
  NodePairBlock out;
  std::memcpy(&out, &packed, sizeof out);
  out.j = j;
  out.unused = 0;
  return out;
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
      const Triangle source = nodes_of(group.topology[d], e.source_face()), t = nodes_of(target, e.target());
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

void PairCondenser::add_pair_blocks(const ElementGroup& group, NodePairArena& out) {
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
      const Triangle source = nodes_of(group.topology[d], e.source_face()), t = nodes_of(target, e.target());
      const Float8v matrix = matrix_of(e, group, d, time_step_);
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
  const auto make_room = [](auto& vector, std::size_t more) {
    if (vector.capacity() < vector.size() + more) vector.reserve(vector.size() + vector.size() / 8 + more);
  };
  make_room(out.blocks, slots);
  const std::size_t rows = node_count(group.topology[0]);
  make_room(out.rows, rows);
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    if (!(row_used_[i / 64] >> (i % 64) & 1u)) continue;
    const std::uint32_t first = next;
    float most = 0.0f;  // of all entries, since C is positive
    for (std::size_t w = 0; w < words_; ++w) next += static_cast<std::uint32_t>(std::popcount(pattern_[i * words_ + w]));
    for (std::uint32_t k = first; k < next; ++k) most = std::max({most, sum_[k].m[0], sum_[k].m[3], sum_[k].m[5]});
    const float per_unit = most > 0.0f ? NodePairBlock::kMost / most : 0.0f;
    out.rows.push_back({static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(next - first), most / NodePairBlock::kMost});
    std::uint32_t k = first;
    for (std::size_t w = 0; w < words_; ++w)
      for (std::uint64_t bits = pattern_[i * words_ + w]; bits != 0; bits &= bits - 1)
        out.blocks.push_back(
            rounded(sum_[k++], per_unit, static_cast<std::uint16_t>(w * 64 + static_cast<std::size_t>(std::countr_zero(bits)))));
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
      const Float8v matrix = matrix_of(sources[k], group, side, time_step_);
      const float* const beta = beta_[sources[k].point()];
      for (std::size_t c = 0; c < 3; ++c) sum[c] += matrix * (beta[(c + 1) % 3] * beta[(c + 2) % 3]);
    }
    for (std::size_t c = 0; c < 3; ++c) add(edges[edges_of_face[face][c]], -1.0f, sum[c]);
  }
  for (const ContactElement& e : group.elements[1 - side]) {
    const Float8v matrix = matrix_of(e, group, 1 - side, time_step_);
    float mu[3];
    e.weights(mu);
    const auto& edge = edges_of_face[e.target()];
    for (std::size_t c = 0; c < 3; ++c) add(edges[edge[c]], -mu[(c + 1) % 3] * mu[(c + 2) % 3], matrix);
  }
}

void add_held_points(const ElementGroup& group, const FaceQuadrature& quadrature, float time_step, std::vector<HeldPoint>& out) {
  if (!group.rigid || !group.write[0]) return;
  std::vector<SymMat3<double>> by_node(node_count(group.topology[0]));
  std::vector<char> held(by_node.size(), 0);
  for (int d = 0; d < 2; ++d)
    for (const ContactElement& e : group.elements[d]) {
      const Float8v m = matrix_of(e, group, d, time_step);
      const SymMat3<double> block{m[0], m[1], m[2], m[3], m[4], m[5]};
      const Triangle nodes = nodes_of(group.topology[0], d == 0 ? e.source_face() : e.target());
      float mu[3] = {};
      if (d == 1) e.weights(mu);
      for (std::size_t k = 0; k < 3; ++k) {
        const double weight = d == 0 ? quadrature.weight[e.point()][k] : static_cast<double>(mu[k]);
        if (weight == 0.0) continue;
        by_node[nodes[k]] += weight * block;
        held[nodes[k]] = 1;
      }
    }
  for (std::uint32_t i = 0; i < by_node.size(); ++i)
    if (held[i] != 0) out.push_back({group.body[0], group.first[0] + i, by_node[i]});
}

EdgeBlockSource edge_blocks_of(std::span<const ElementGroup> groups, std::size_t bodies, const FaceQuadrature& quadrature,
                               float time_step) {
  std::vector<std::uint32_t> begin(bodies + 1, 0), incident;
  for (const ElementGroup& group : groups)
    for (std::size_t side = 0; side < (group.rigid ? 1 : 2); ++side) ++begin[group.body[side] + 1];
  for (std::size_t body = 1; body < begin.size(); ++body) begin[body] += begin[body - 1];
  incident.resize(begin.back());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::uint32_t g = 0; g < groups.size(); ++g)
    for (std::uint32_t side = 0; side < (groups[g].rigid ? 1u : 2u); ++side) incident[next[groups[g].body[side]]++] = 2 * g + side;
  return [groups, begin = std::move(begin), incident = std::move(incident), condenser = PairCondenser(quadrature, time_step)](
             std::uint32_t body, std::span<EdgeBlock> edges) {
    for (std::uint32_t k = begin[body]; k < begin[body + 1]; ++k)
      condenser.add_edge_blocks(groups[incident[k] / 2], static_cast<int>(incident[k] % 2), edges);
    return begin[body] < begin[body + 1];
  };
}

namespace {

/// N blocks of a row at once: their vectors side by side in one register.
template <int N>
struct Side {
  using Vector = typename Lane<float, 4 * N>::Vector;
  using Words = typename Lane<float, 4 * N>::Mask;

  /// The same numbers of each four: lane l gets number pick[l % 4] of its four in `a`, or of `b` where that is 4 to 7.
  template <int P0, int P1, int P2, int P3, int... L>
  static Vector pick(Vector a, Vector b, std::integer_sequence<int, L...>) {
    constexpr int from[4] = {P0, P1, P2, P3};
    return __builtin_shufflevector(a, b, (from[L % 4] < 4 ? L / 4 * 4 + from[L % 4] : 4 * N + L / 4 * 4 + from[L % 4] - 4)...);
  }
  template <int P0, int P1, int P2, int P3>
  static Vector pick(Vector a, Vector b) {
    return pick<P0, P1, P2, P3>(a, b, std::make_integer_sequence<int, 4 * N>{});
  }

  /// The vectors `get(0)` .. `get(N − 1)` side by side. Not through memory: what was stored in pieces can not be loaded as a whole at once.
  template <class Get>
  static Vector gather(const Get& get) {
    if constexpr (N == 1) {
      return get(0);
    } else if constexpr (N == 2) {
      return __builtin_shufflevector(get(0), get(1), 0, 1, 2, 3, 4, 5, 6, 7);
    } else {
      const auto half = Side<2>::gather(get), rest = Side<2>::gather([&](int k) { return get(k + 2); });
      return __builtin_shufflevector(half, rest, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    }
  }
  template <int K>
  static Float4v part(Vector v) {
    return __builtin_shufflevector(v, v, 4 * K, 4 * K + 1, 4 * K + 2, 4 * K + 3);
  }

  /// C d in units of the row, with anything behind.
  static Vector times(const NodePairBlock* block, Vector d) {
    Words packed;
    std::memcpy(&packed, block, sizeof packed);  // two entries in each
    const Words lower = (packed << 16) >> 16, upper = packed >> 16;
    const Vector low = __builtin_convertvector(lower, Vector);   // xx xy xz zz
    const Vector high = __builtin_convertvector(upper, Vector);  // j yy yz
    return pick<0, 0, 0, 0>(d, d) * low + pick<1, 1, 1, 1>(d, d) * pick<1, 5, 6, 6>(low, high) +
           pick<2, 2, 2, 2>(d, d) * pick<2, 6, 3, 3>(low, high);
  }
};

/// What N blocks of a row do to its own node, added to `sum`, and to the others.
template <int N, bool kFirst, bool kSecond, bool kRest>
inline void apply_blocks(const NodePairBlock* block, Float4v pi, Float4v unit, Float4v& sum, const Float4* p1, Float4* q1) {
  using S = Side<N>;
  typename S::Vector d = S::gather([&](int) { return pi; });
  if constexpr (!kRest) d -= S::gather([&](int k) { return load(p1[block[k].j]); });
  const typename S::Vector f = S::times(block, d) * S::gather([&](int) { return unit; });
  const auto give = [&]<int K>() {
    if constexpr (kFirst) sum += S::template part<K>(f);
    if constexpr (kSecond) store(q1[block[K].j], load(q1[block[K].j]) - S::template part<K>(f));
  };
  give.template operator()<0>();
  if constexpr (N > 1) give.template operator()<1>();
  if constexpr (N > 2) give.template operator()<2>(), give.template operator()<3>();
}

template <bool kFirst, bool kSecond, bool kRest>
void apply_rows(const NodePairBlocks& pair, const Float4* p0, Float4* q0, const Float4* p1, Float4* q1) {
  const NodePairBlock* block = pair.blocks.data();
  for (const NodePairRow& row : pair.rows) {
    const Float4v pi = load(p0[row.i]), unit{row.unit, row.unit, row.unit, 0.0f};
    Float4v sum{};
    const NodePairBlock* const end = block + row.count;
    for (; end - block >= 4; block += 4) apply_blocks<4, kFirst, kSecond, kRest>(block, pi, unit, sum, p1, q1);
    for (; end - block >= 2; block += 2) apply_blocks<2, kFirst, kSecond, kRest>(block, pi, unit, sum, p1, q1);
    if (end != block) apply_blocks<1, kFirst, kSecond, kRest>(block++, pi, unit, sum, p1, q1);
    if constexpr (kFirst) store(q0[row.i], load(q0[row.i]) + sum);
  }
}

}  // namespace

void apply_pair_blocks(const NodePairBlocks& pair, const Float4* p0, Float4* q0, const Float4* p1, Float4* q1) {
  if (p1 == nullptr) return q0 != nullptr ? apply_rows<true, false, true>(pair, p0, q0, nullptr, nullptr) : void();
  if (q0 != nullptr && q1 != nullptr) return apply_rows<true, true, false>(pair, p0, q0, p1, q1);
  if (q0 != nullptr) return apply_rows<true, false, false>(pair, p0, q0, p1, nullptr);
  if (q1 != nullptr) return apply_rows<false, true, false>(pair, p0, nullptr, p1, q1);
}

}  // namespace morula
