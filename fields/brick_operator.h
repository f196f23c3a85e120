#pragma once
#include <array>
#include <vector>

#include "fields/field_reactions.h"
#include "fields/field_spec.h"
#include "fields/halo.h"
#include "fields/layout.h"

namespace morula::fields {

/// The right-hand side of dc/dt = D ∇²c − what reactions take, on the bricks of a rank, and its derivative.
///
/// Cell-centred finite volumes: the flux through the face of two voxels is D (c_R − c_L)/h, used by both with opposite sign; at a
/// face of the domain with a given value c_b it is 2 D (c_b − c)/h (half a cell away), without flux it is 0
/// (physics: fields_and_coupling.md, A). A voxel's value comes from the same operations whoever owns its neighbours.
///
/// The vectors are unknowns as Layout lists them: the amounts that follow the concentrations get their rates in evaluate().
class BrickOperator {
 public:
  /// Keeps references to all but `grid`.
  BrickOperator(const Grid& grid, const FieldSpec& spec, const FieldReactions& reactions, const Layout& layout, Halo<double>& halo);

  /// d(unknowns)/dt at a time of the interval [s]. Collective. Rates of the amounts [amol/s] only if `amounts`, else 0.
  void evaluate(double time, const double* unknowns, double* rate, bool amounts);

  /// Take the slopes of the reactions at these concentrations; what follows uses them. J = ∂(dc/dt)/∂c.
  void linearize(const double* unknowns);
  /// out = (1 − γJ) x on the concentrations; returns x·out over all ranks. Collective.
  double shifted_product(double gamma, const double* x, double* out, const Comm& comm);
  /// out = 1/diag(1 − γJ) on the concentrations.
  void inverse_diagonal(double gamma, double* out) const;

  /// No eigenvalue of −J is larger at concentrations up to `highest` (Gershgorin) [1/s]; of this rank's voxels.
  [[nodiscard]] double largest_rate(double highest) const;
  /// Whether the right-hand side is linear, on all ranks.
  [[nodiscard]] bool is_linear() const { return !layout_.sinks_anywhere && reactions_.volume_is_linear(); }

  /// −∂(dc/dt)/∂c of all reactions by voxel, as linearize() took it, of first order ones too: what is not diffusion in −J [1/s].
  [[nodiscard]] double reaction_slope(std::size_t voxel) const { return slope_[voxel] + reactions_.first_order(); }

  [[nodiscard]] const Layout& layout() const { return layout_; }

 private:
  static constexpr std::size_t kPadded = Grid::kBrick + 2;
  using Padded = std::array<double, kPadded * kPadded * kPadded>;

  /// The brick with a layer of ghosts around it. At faces with a value the ghost is 2·scale·c_b − c, c_b that of time_.
  void fill(std::size_t brick, const double* values, double scale, Padded& padded) const;
  void fill_ghosts(std::size_t brick, std::size_t side, const double* values, double scale, Padded& padded) const;
  /// out = D ∇²_h c − λ c, λ of the reactions of first order
  void stencil(std::size_t brick, const Padded& padded, double* out) const;
  [[nodiscard]] std::span<const Sink> sinks_of(std::size_t brick) const;
  void boundary_amounts(std::size_t brick, const double* c, double* amounts) const;
  [[nodiscard]] const FaceCondition& face(std::size_t side) const { return spec_.boundary[side / 2][side % 2]; }

  const FieldSpec& spec_;
  const FieldReactions& reactions_;
  const Layout& layout_;
  Halo<double>& halo_;
  std::array<double, 3> conductance_{};  ///< D/h² along x, y, z [1/s]
  double voxel_volume_ = 0.0;
  double time_ = 0.0;             ///< of the last evaluate(), from the start of the interval [s]
  std::vector<double> slope_;     ///< −∂(dc/dt)/∂c of reactions that are not of first order, by voxel [1/s]
  std::vector<double> diagonal_;  ///< −diag J without these, by voxel [1/s]
  std::vector<double> partial_;   ///< a sum per brick
};

}  // namespace morula::fields
