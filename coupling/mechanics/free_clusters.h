#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/friction/contact_element.h"
#include "core/friction/sphere_pairs.h"
#include "core/parallel/comm.h"
#include "core/parallel/shared_sums.h"
#include "core/vec3.h"
#include "coupling/mechanics/scene.h"

namespace morula {

/// How far a body is from the balance of its forces with the medium.
struct MediumBalance {
  Vec3d missing;             ///< Σ b − Σ γ v over its points: forces less medium friction [nN]
  SymMat3<double> friction;  ///< Σ γ [nN·s/µm]
};

/// Clusters of bodies that touch each other and nothing that stands outside the tissue (decision 0024).
///
/// Within such a cluster every force has its opposite, but those from outside and the friction with the medium: whatever the velocities
/// between its points, the exact solution of the force balance has Σ γ v = Σ b. Conjugate gradients find this motion last, for it is the
/// softest of all. A rigid shift of the cluster mends it and changes nothing else (time_stepping.md §11.1).
///
/// Bodies that touch an obstacle, are held, or are pulled by a spring from outside are tied, and so is their whole cluster. A wall of the domain is
/// flat and rubs nobody: who touches it is free along it, and tied across.
class FreeClusters {
 public:
  /// Clusters of the present matrix: bodies hang together where a pair of them has a part in it. `tied`: bodies that something from outside
  /// holds beside obstacles, by number. `walls`: wall_axes(). Collective.
  void find(const Scene& scene, std::span<const ElementGroup> groups, const SpherePairs& spheres, std::span<const std::uint32_t> tied,
            std::span<const int> walls, int threads, const Comm& comm);
  /// The velocity V = (Σ γ)⁻¹ (Σ b − Σ γ v) by body that each free cluster lacks, across walls none [µm/s]; 0 for tied ones, for ghosts, and
  /// where nothing rubs. The same bits on any number of ranks. Collective.
  [[nodiscard]] std::vector<Vec3d> shifts(std::span<const MediumBalance> by_body, const Comm& comm) const;
  [[nodiscard]] std::size_t memory() const;

 private:
  struct Cluster {
    std::uint64_t label = 0;            ///< bits of the smallest CellId
    std::uint32_t first = 0, last = 0;  ///< its active bodies of this rank, in members_
    std::uint64_t walls = 0;            ///< bit k: some stand across axis k
  };
  void collect(const Scene& scene, std::span<const std::uint64_t> label, std::span<const std::uint64_t> walls, const Comm& comm);

  int threads_ = 1;
  std::vector<std::uint32_t> members_;  ///< bodies, by cluster
  std::vector<Cluster> clusters_;       ///< by label
  SharedSums over_ranks_;               ///< by label of the clusters of this rank that go over several ranks
};

}  // namespace morula
