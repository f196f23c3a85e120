#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/friction/contact_element.h"
#include "core/friction/sphere_pairs.h"
#include "core/parallel/comm.h"
#include "core/parallel/shared_sums.h"
#include "core/vec3.h"
#include "coupling/mechanics/outside_balance.h"
#include "coupling/mechanics/scene.h"

namespace morula {

/// Clusters of bodies that touch each other (decision 0024).
///
/// Within a cluster every force has its opposite, but those from outside, the friction with the medium, what obstacles do and springs to places of the
/// laboratory: whatever the velocities between its points, the exact solution of the force balance has Σ C v = Σ b. Conjugate gradients find this motion last, for it is the
/// softest of all. A rigid shift of the cluster mends it and changes nothing else (time_stepping.md §11.1).
///
/// Bodies that do not move are tied, and so is their whole cluster.
class FreeClusters {
 public:
  /// Clusters of the present matrix: bodies hang together where a pair of them has a part in it, or where they are in a list of `joined`, together with
  /// those of other ranks' same list. Collective.
  void find(const Scene& scene, std::span<const ElementGroup> groups, const SpherePairs& spheres,
            std::span<const std::vector<std::uint32_t>> joined, int threads, const Comm& comm);
  /// The velocity V = (Σ C)⁻¹ (Σ b − Σ C v) by body that each free cluster lacks [µm/s]; 0 for tied ones, for ghosts, and where nothing
  /// resists. The same bits on any number of ranks. Collective.
  [[nodiscard]] std::vector<Vec3d> shifts(std::span<const OutsideBalance> by_body, const Comm& comm) const;
  [[nodiscard]] std::size_t memory() const;

 private:
  struct Cluster {
    std::uint64_t label = 0;            ///< bits of the smallest CellId
    std::uint32_t first = 0, last = 0;  ///< its active bodies of this rank, in members_
  };
  /// `far`: labels of clusters that hang together with bodies of other ranks of which there may be no ghosts.
  void collect(const Scene& scene, std::span<const std::uint64_t> label, std::vector<std::uint64_t> far, const Comm& comm);

  int threads_ = 1;
  std::vector<std::uint32_t> members_;  ///< bodies, by cluster
  std::vector<Cluster> clusters_;       ///< by label
  SharedSums over_ranks_;               ///< by label of the clusters of this rank that go over several ranks
};

}  // namespace morula
