#include "coupling/mechanics/free_clusters.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "core/parallel/threads.h"

namespace morula {
namespace {

constexpr std::uint64_t kTied = 0;            // no cell has this label, and it is smaller than all
constexpr std::uint32_t kManyMembers = 2048;  // of a cluster whose sums several threads share
constexpr double kLeastFriction = 1e-9;       // of the determinant, in units of that of isotropic friction of the same trace

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

/// Calls tie(body, obstacle) for those that touch an obstacle.
template <class Tie>
void for_tied(const Scene& scene, std::span<const ElementGroup> groups, const SpherePairs& spheres, Tie&& tie) {
  for (const ElementGroup& group : groups)
    if (group.rigid && !(group.elements[0].empty() && group.elements[1].empty())) tie(group.body[0], group.obstacle);
  for (const RigidPairElement& e : spheres.rigid)
    if (e.isotropic != 0.0f || e.axial != 0.0f || e.stiffness != 0.0f)
      tie(static_cast<std::uint32_t>(scene.first_sphere()) + e.sphere, e.obstacle);
}

/// Sums of the bodies of a cluster, order-free.
struct ClusterSums {
  static constexpr std::size_t kTerms = 9;
  using Terms = std::array<double, kTerms>;

  static Terms terms_of(const MediumBalance& b) {
    const SymMat3<double>& f = b.friction;
    return {b.missing.x, b.missing.y, b.missing.z, f.xx, f.xy, f.xz, f.yy, f.yz, f.zz};
  }
  static void add(const MediumBalance& b, OrderFreeSum* sums) {
    const Terms terms = terms_of(b);
    for (std::size_t k = 0; k < kTerms; ++k) sums[k].add(terms[k]);
  }
  /// `walls`: bits of the axes along which nothing moves.
  static Vec3d velocity(const double* t, std::uint64_t walls) {
    Vec3d missing{t[0], t[1], t[2]};
    SymMat3<double> friction{t[3], t[4], t[5], t[6], t[7], t[8]};
    const double mean = (friction.xx + friction.yy + friction.zz) / 3.0;
    if (walls & 1) missing.x = friction.xy = friction.xz = 0.0, friction.xx = mean;
    if (walls & 2) missing.y = friction.xy = friction.yz = 0.0, friction.yy = mean;
    if (walls & 4) missing.z = friction.xz = friction.yz = 0.0, friction.zz = mean;
    if (!(mean > 0.0) || !(determinant(friction) > kLeastFriction * mean * mean * mean)) return {};
    return inverse(friction) * missing;
  }
};

std::vector<std::uint64_t> sorted_unique(std::vector<std::uint64_t> list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

}  // namespace

void FreeClusters::find(const Scene& scene, std::span<const ElementGroup> groups, const SpherePairs& spheres,
                        std::span<const std::uint32_t> tied, std::span<const int> walls, int threads, const Comm& comm) {
  threads_ = threads;
  const auto bodies = scene.bodies();
  const bool has_walls = std::ranges::any_of(walls, [](int axis) { return axis >= 0; });
  std::vector<std::uint64_t> label(bodies.size()), least(bodies.size()), across(has_walls ? bodies.size() : 0), all(across);
  for (std::size_t i = 0; i < bodies.size(); ++i) label[i] = bodies[i].moves ? bodies[i].id.bits() : kTied;
  for (const std::uint32_t body : tied) label[body] = kTied;
  Sets sets = sets_of_pairs(scene, groups, spheres, threads);
  for_tied(scene, groups, spheres, [&](std::uint32_t body, std::uint32_t obstacle) {
    if (const int axis = walls[obstacle]; axis < 0)
      label[body] = kTied;
    else
      across[body] |= std::uint64_t{1} << axis;
  });
  // Each rank knows a part of a cluster: the smallest label, and the walls of all, go from rank to rank until nobody finds more.
  for (bool changed = true; changed;) {
    least = label;
    for (std::uint32_t i = 0; i < bodies.size(); ++i) least[sets.find(i)] = std::min(least[sets.find(i)], label[i]);
    for (std::uint32_t i = 0; i < bodies.size(); ++i) label[i] = least[sets.find(i)];
    all = across;
    for (std::uint32_t i = 0; i < all.size(); ++i) all[sets.find(i)] |= across[i];
    for (std::uint32_t i = 0; i < all.size(); ++i) across[i] = all[sets.find(i)];
    if (comm.size() == 1) break;
    least = label;
    all = across;
    scene.exchange_bodies(std::span(label));
    if (has_walls) scene.exchange_bodies(std::span(across));
    changed = comm.any(label != least || across != all);
  }
  collect(scene, label, across, comm);
}

void FreeClusters::collect(const Scene& scene, std::span<const std::uint64_t> label, std::span<const std::uint64_t> walls,
                           const Comm& comm) {
  const auto bodies = scene.bodies();
  std::vector<std::uint64_t> labels, of_ghosts;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (label[i] == kTied) continue;
    if (bodies[i].active() && (labels.empty() || labels.back() != label[i])) labels.push_back(label[i]);
    if (!bodies[i].owned) of_ghosts.push_back(label[i]);
  }
  labels = sorted_unique(std::move(labels));
  clusters_.assign(labels.size(), {});
  for (std::size_t k = 0; k < labels.size(); ++k) clusters_[k].label = labels[k];
  const auto cluster_of = [&](std::size_t body) -> Cluster& {
    return clusters_[static_cast<std::size_t>(std::lower_bound(labels.begin(), labels.end(), label[body]) - labels.begin())];
  };
  const auto is_member = [&](std::size_t body) { return label[body] != kTied && bodies[body].active(); };
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (is_member(i)) {
      Cluster& cluster = cluster_of(i);
      ++cluster.last;
      if (!walls.empty()) cluster.walls = walls[i];
    }
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
  std::erase_if(of_ghosts, [&](std::uint64_t label_of_ghost) { return !std::binary_search(labels.begin(), labels.end(), label_of_ghost); });
  over_ranks_.find(sorted_unique(std::move(of_ghosts)), comm);
}

std::vector<Vec3d> FreeClusters::shifts(std::span<const MediumBalance> by_body, const Comm& comm) const {
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
      give(cluster, ClusterSums::velocity(ClusterSums::terms_of(by_body[members_[cluster.first]]).data(), cluster.walls));
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
      give(cluster, ClusterSums::velocity(total.data(), cluster.walls));
    }
  }
  if (comm.size() == 1) return out;
  const std::vector<double> totals = over_ranks_.totals(parts, kTerms, comm);
  for (const auto& [cluster, place] : wait) give(*cluster, ClusterSums::velocity(totals.data() + kTerms * place, cluster->walls));
  return out;
}

std::size_t FreeClusters::memory() const {
  return members_.capacity() * sizeof(members_[0]) + clusters_.capacity() * sizeof(clusters_[0]) + over_ranks_.memory();
}

}  // namespace morula
