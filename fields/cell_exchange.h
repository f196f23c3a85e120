#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/cell_id.h"
#include "core/mesh/triangle_mesh.h"
#include "core/parallel/comm.h"
#include "core/space/space.h"
#include "core/vec3.h"
#include "fields/cell_weights.h"
#include "fields/field.h"
#include "fields/layout.h"

namespace morula::fields {

/// A cell as a field sees it: a ball, or what its surface encloses.
struct CellSource {
  CellId id;
  std::uint16_t type = 0;  ///< as FieldReaction::type
  Vec3d center{};
  double radius = 0.0;                ///< of a ball [µm]
  std::span<const Triangle> faces{};  ///< of a closed surface, outward; empty: a ball
  std::span<const Vec3d> nodes{};     ///< of the surface [µm]; must outlive the exchange
};

/// Which cell meets which voxel, on both sides: the rank that has the cell and the rank that has the voxel.
///
/// Sums at a voxel run in order of the cells' ids, sums at a cell in order of the voxels: the same bits on any number of ranks.
class CellExchange {
 public:
  /// Spread the cells of this rank over the voxels, and tell the voxels' owners. Collective.
  CellExchange(const Field& field, const Space& space, std::span<const CellSource> cells, const Comm& comm);

  /// Σ w_iv per (brick, voxel, type) of the types for which `takes_up` is true, sorted.
  [[nodiscard]] std::vector<Sink> sinks(const std::vector<bool>& takes_up) const;

  /// Give back to the cells: what each took [amol], its share w_iv/Σw of what its sink took, and what each sees, Σ w_iv c_v [mM].
  /// `sink_taken` belongs to the sinks of `layout`. Collective.
  void give_back(const Field& field, const Layout& layout, std::span<const double> sink_taken, const Comm& comm, std::span<double> taken,
                 std::span<double> seen) const;

 private:
  struct Deposit {
    std::uint64_t id = 0;
    double weight = 0.0;
    std::int32_t brick = 0;  ///< grid number when sent, then the number on this rank
    std::int32_t voxel = 0;
    std::uint16_t type = 0;
    std::uint16_t unused = 0;
    std::uint32_t from = 0;   ///< place of its rank in guests_; filled in by the receiver
    std::uint64_t place = 0;  ///< in that rank's message; filled in by the receiver
  };
  struct Share {
    double taken = 0.0;
    double concentration = 0.0;
  };
  /// Deposits of this rank's cells, by host; the bricks have their numbers in the grid. Finds the hosts and what is sent.
  std::vector<std::vector<Deposit>> deposits_for_hosts(const Field& field, std::span<const CellSource> cells,
                                                       std::span<const std::vector<VoxelWeight>> weights);
  /// Bricks by their numbers on this rank, and all in order.
  void sort_deposits(const Field& field);
  /// Shares for the guests go to them; gives those of the hosts, by host. Collective among partners.
  [[nodiscard]] std::vector<std::vector<Share>> swap_shares(std::vector<std::vector<Share>> of_guests, const Comm& comm) const;

  struct Sent {
    std::uint32_t host = 0;  ///< place in hosts_ of the rank that has the voxel
    double weight = 0.0;
  };
  /// Another rank, or this one, and how many deposits go there or have come from there.
  struct Partner {
    int rank = 0;
    std::size_t deposits = 0;
  };

  std::vector<Deposit> deposits_;        ///< on voxels of this rank, sorted by (brick, voxel, type, id)
  std::vector<Partner> guests_;          ///< ranks whose cells meet voxels of this rank
  std::vector<Partner> hosts_;           ///< ranks whose voxels meet cells of this rank
  std::vector<Sent> sent_;               ///< deposits of this rank's cells, cell after cell
  std::vector<std::size_t> first_sent_;  ///< of each cell; one more for the end
};

}  // namespace morula::fields
