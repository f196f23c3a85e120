#include "coupling/mechanics/free_clusters.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "core/parallel/threads.h"

namespace morula {
namespace {

constexpr std::uint64_t kTied = 0;  // no cell has this label, and it is smaller than all
constexpr std::uint64_t kNobody = ~std::uint64_t{0};
constexpr std::uint32_t kManyMembers = 2048;  // of a cluster whose sums several threads share
constexpr double kLeastDeterminant = 1e-13;   // of what resists, over the product of its diagonal: below it, rounding decides

/// Disjoint sets of bodies, each known by its smallest number.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Joins the bodies of those pairs that have a part in the matrix.
Sets sets_of_pairs(const Scene& scene, std::span<const ElementGroup> groups, const SpherePairs& spheres, int threads) {
  const auto first = static_cast<std::uint32_t>(scene.first_sphere());
  const bool packs = !spheres.packing.slopes.empty();
  const auto parts = static_cast<std::size_t>(std::max(threads, 1));
  std::vector<Sets> of_part(spheres.pairs.empty() ? 1 : parts, Sets(0));
  on_each_thread(static_cast<int>(of_part.size()), [&](std::size_t t) {
    Sets& sets = of_part[t] = Sets(scene.bodies().size());
    for (std::size_t k = spheres.pairs.size() * t / parts; k < spheres.pairs.size() * (t + 1) / parts; ++k) {
      const SpherePairElement& e = spheres.elements[k];
      const bool packed = packs && (spheres.packing.slopes[k].a != 0.0f || spheres.packing.slopes[k].b != 0.0f);
      if (e.area != 0.0f || e.stiffness != 0.0f || packed) sets.join(first + spheres.pairs[k].a, first + spheres.pairs[k].b);
    }
  });
  Sets& all = of_part.front();
  for (std::size_t t = 1; t < of_part.size(); ++t)
    for (std::uint32_t i = 0; i < scene.bodies().size(); ++i)
      if (const std::uint32_t root = of_part[t].find(i); root != i) all.join(i, root);
  for (const ElementGroup& group : groups)
    if (!group.rigid && !(group.elements[0].empty() && group.elements[1].empty())) all.join(group.body[0], group.body[1]);
  return std::move(all);
}

/// Sums of the bodies of a cluster, order-free.
struct ClusterSums {
  static constexpr std::size_t kTerms = 9;
  using Terms = std::array<double, kTerms>;

  static Terms terms_of(const OutsideBalance& b) {
    const SymMat3<double>& c = b.resistance;
    return {b.missing.x, b.missing.y, b.missing.z, c.xx, c.xy, c.xz, c.yy, c.yz, c.zz};
  }
  static void add(const OutsideBalance& b, OrderFreeSum* sums) {
    const Terms terms = terms_of(b);
    for (std::size_t k = 0; k < kTerms; ++k) sums[k].add(terms[k]);
  }
  static Vec3d velocity(const double* t) {
    const SymMat3<double> resistance{t[3], t[4], t[5], t[6], t[7], t[8]};
    if (!(determinant(resistance) > kLeastDeterminant * resistance.xx * resistance.yy * resistance.zz)) return {};
    return inverse(resistance) * Vec3d{t[0], t[1], t[2]};
  }
};

std::uint64_t least_of_all(std::uint64_t label, const Comm& comm) {
  for (const std::int64_t of_rank : comm.gather_to_all(std::bit_cast<std::int64_t>(label)))
    label = std::min(label, std::bit_cast<std::uint64_t>(of_rank));
  return label;
}

std::vector<std::uint64_t> sorted_unique(std::vector<std::uint64_t> list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

}  // namespace

void FreeClusters::find(const Scene& scene, std::span<const ElementGroup> groups, const SpherePairs& spheres,
                        std::span<const std::vector<std::uint32_t>> joined, int threads, const Comm& comm) {
  threads_ = threads;
  const auto bodies = scene.bodies();
  std::vector<std::uint64_t> label(bodies.size()), least(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) label[i] = bodies[i].moves ? bodies[i].id.bits() : kTied;
  Sets sets = sets_of_pairs(scene, groups, spheres, threads);
  for (const auto& list : joined)
    for (const std::uint32_t body : list) sets.join(list.front(), body);
  // Each rank knows a part of a cluster: the smallest label goes from rank to rank until nobody finds a smaller one.
  for (bool changed = true; changed;) {
    least = label;
    for (std::uint32_t i = 0; i < bodies.size(); ++i) least[sets.find(i)] = std::min(least[sets.find(i)], label[i]);
    for (std::uint32_t i = 0; i < bodies.size(); ++i) label[i] = least[sets.find(i)];
    if (comm.size() == 1) break;
    least = label;
    scene.exchange_bodies(std::span(label));
    for (const auto& list : joined) {
      const std::uint64_t of_all = least_of_all(list.empty() ? kNobody : label[list.front()], comm);
      if (!list.empty()) label[list.front()] = of_all;
    }
    changed = comm.any(label != least);
  }
  std::vector<std::uint64_t> far;
  for (const auto& list : joined)
    if (!list.empty()) far.push_back(label[list.front()]);
  collect(scene, label, std::move(far), comm);
}

void FreeClusters::collect(const Scene& scene, std::span<const std::uint64_t> label, std::vector<std::uint64_t> far, const Comm& comm) {
  const auto bodies = scene.bodies();
  std::vector<std::uint64_t> labels;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (label[i] == kTied) continue;
    if (bodies[i].active() && (labels.empty() || labels.back() != label[i])) labels.push_back(label[i]);
    if (!bodies[i].owned) far.push_back(label[i]);
  }
  labels = sorted_unique(std::move(labels));
  clusters_.assign(labels.size(), {});
  for (std::size_t k = 0; k < labels.size(); ++k) clusters_[k].label = labels[k];
  const auto cluster_of = [&](std::size_t body) -> Cluster& {
    return clusters_[static_cast<std::size_t>(std::lower_bound(labels.begin(), labels.end(), label[body]) - labels.begin())];
  };
  const auto is_member = [&](std::size_t body) { return label[body] != kTied && bodies[body].active(); };
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (is_member(i)) ++cluster_of(i).last;
  std::uint32_t next = 0;
  for (Cluster& cluster : clusters_) {
    cluster.first = next;
    next += cluster.last;
    cluster.last = cluster.first;
  }
  members_.resize(next);
  for (std::uint32_t i = 0; i < bodies.size(); ++i)
    if (is_member(i)) members_[cluster_of(i).last++] = i;
  if (comm.size() == 1) return;
  // Both ranks of two bodies that hang together see it: a cluster goes over several ranks where a ghost of it is beside a body of this rank.
  std::erase_if(far, [&](std::uint64_t of_other) { return !std::binary_search(labels.begin(), labels.end(), of_other); });
  over_ranks_.find(sorted_unique(std::move(far)), comm);
}

std::vector<Vec3d> FreeClusters::shifts(std::span<const OutsideBalance> by_body, const Comm& comm) const {
  constexpr std::size_t kTerms = ClusterSums::kTerms;
  std::vector<Vec3d> out(by_body.size());
  const std::span<const std::uint64_t> shared = over_ranks_.keys();
  std::vector<OrderFreeSum> parts(kTerms * shared.size());
  std::vector<std::pair<const Cluster*, std::size_t>> wait;  // for the other ranks: a cluster and its place in the list
  const auto give = [&](const Cluster& cluster, const Vec3d& velocity) {
    for (std::uint32_t m = cluster.first; m < cluster.last; ++m) out[members_[m]] = velocity;
  };
  for (const Cluster& cluster : clusters_) {
    const auto found = std::lower_bound(shared.begin(), shared.end(), cluster.label);
    if (found != shared.end() && *found == cluster.label) {
      const auto place = static_cast<std::size_t>(found - shared.begin());
      for (std::uint32_t m = cluster.first; m < cluster.last; ++m) ClusterSums::add(by_body[members_[m]], parts.data() + kTerms * place);
      wait.emplace_back(&cluster, place);
    } else if (cluster.last - cluster.first == 1) {  // most clusters of a dilute tissue; an order-free sum is large
      give(cluster, ClusterSums::velocity(ClusterSums::terms_of(by_body[members_[cluster.first]]).data()));
    } else {
      const std::uint32_t count = cluster.last - cluster.first;
      const int threads = count < kManyMembers ? 1 : threads_;
      std::vector<std::array<OrderFreeSum, kTerms>> of_part(static_cast<std::size_t>(std::max(threads, 1)));
      on_each_thread(threads, [&](std::size_t t) {
        for (std::size_t m = count * t / of_part.size(); m < count * (t + 1) / of_part.size(); ++m)
          ClusterSums::add(by_body[members_[cluster.first + m]], of_part[t].data());
      });
      std::array<OrderFreeSum, kTerms>& sums = of_part.front();
      for (std::size_t t = 1; t < of_part.size(); ++t)
        for (std::size_t k = 0; k < kTerms; ++k) sums[k] += of_part[t][k];
      ClusterSums::Terms total;
      std::transform(sums.begin(), sums.end(), total.begin(), [](const OrderFreeSum& sum) { return sum.value(); });
      give(cluster, ClusterSums::velocity(total.data()));
    }
  }
  if (comm.size() == 1) return out;
  const std::vector<double> totals = over_ranks_.totals(parts, kTerms, comm);
  for (const auto& [cluster, place] : wait) give(*cluster, ClusterSums::velocity(totals.data() + kTerms * place));
  return out;
}

std::size_t FreeClusters::memory() const {
  return members_.capacity() * sizeof(members_[0]) + clusters_.capacity() * sizeof(clusters_[0]) + over_ranks_.memory();
}

}  // namespace morula
