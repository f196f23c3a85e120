#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/parallel/comm.h"
#include "core/space/space.h"
#include "fields/brick_operator.h"
#include "fields/field.h"
#include "fields/field_spec.h"
#include "fields/halo.h"
#include "fields/layout.h"

namespace morula::fields {

/// A symmetric positive approximate inverse of 1 − γJ, as good on any number of voxels: one V-cycle of geometric multigrid on cell-centred
/// volumes (Wesseling 1992, An Introduction to Multigrid Methods, ch. 5; Trottenberg, Oosterlee & Schüller 2001, Multigrid).
///
/// Each level halves the voxels along each axis: first within the bricks, by the ranks that own them; when one value a brick is left, all
/// ranks gather these and go on alike, down to one value. The operator of a level is that of its wide voxels by finite volumes, not
/// Galerkin's product; residuals are averaged over a wide voxel and corrections are constant in it; the smoother is a Chebyshev polynomial of degree
/// two (Adams et al. 2003, doi:10.1016/S0021-9991(03)00194-3). In single precision, as a preconditioner may be. A value comes from the
/// same operations whoever owns its neighbours: the same bits on any number of ranks and threads.
class Multigrid {
 public:
  /// Keeps a reference to `comm`.
  Multigrid(const Field& field, const FieldSpec& spec, const Layout& layout, const Space& space, const Comm& comm);

  /// Take 1 − γJ with `op` as it was linearized last. Collective.
  void prepare(double gamma, const BrickOperator& op);
  /// z ≈ (1 − γJ)⁻¹ r on the concentrations. Collective.
  void apply(const double* r, double* z);

 private:
  using Values = std::vector<float>;
  /// The voxels of a level along one axis.
  struct Axis {
    std::vector<double> width;         ///< [µm]
    std::vector<double> lower, upper;  ///< D over width and distance to the neighbour below and above; 0 where nothing flows [1/s]
    Values below, above;               ///< the same times γ
    Values share;                      ///< of the next level's wide voxel that a voxel fills
  };
  struct Level {
    Layout layout;                                  ///< of the bricks; the gathered levels are one brick
    std::vector<std::array<std::size_t, 3>> start;  ///< place of each brick's first voxel in the whole level
    std::array<Axis, 3> axes;
    std::unique_ptr<Halo<float>> halo;
    Values shift;     ///< 1 + γ × slope of the reactions
    Values b, x, y;   ///< (1 − γJ) x = b; y: room for the smoother
    Values residual;  ///< only here to be averaged
  };
  struct Row;

  [[nodiscard]] bool is_gathered(std::size_t level) const { return level >= kShared; }
  /// Where the values of the wide voxels of a brick begin in the next level.
  [[nodiscard]] std::size_t wide_at(std::size_t level, std::size_t brick) const;
  /// Call update(row) on each row along x of the operand v, its ghosts fetched from the neighbours. Collective.
  template <class Update>
  void sweep(Level& level, const Values& v, Update&& update) const;
  void fill(const Level& level, std::size_t brick, const Values& v, float* padded) const;
  void smooth_from_zero(Level& level) const;
  void smooth(Level& level) const;
  /// Means of `fine` over the wide voxels of the next level. Collective.
  void average(std::size_t level, const Values& fine, Values& wide);
  void add_correction(std::size_t level);
  void cycle(std::size_t level);

  static constexpr std::size_t kShared = 3;  ///< levels of 8, 4 and 2 voxels along a brick

  const Comm& comm_;
  std::vector<std::int64_t> bricks_;        ///< of this rank
  std::vector<std::int64_t> gather_order_;  ///< all bricks, rank after rank
  std::vector<Level> levels_;
};

}  // namespace morula::fields
