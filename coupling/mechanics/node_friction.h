#pragma once
#include <span>
#include <vector>

#include "coupling/mechanics/term.h"

namespace morula {

/// Friction of single nodes of shells beside the isotropic friction with the medium: different coefficients across and along the surface (dcm.md §1).
/// Nothing, and at no cost, where no type asks for it.
///
/// Of node i: a_i [(γ_n − γ_t) n_i n_iᵀ] or a_i [(γ_t − γ_n) (I − n_i n_iᵀ)], whichever is positive, on top of the lesser of both, at the step's start.
///
/// A term of its own: sums over terms run in their order, and this friction comes before that of all others. Its noise is drawn with that of the medium
/// (Membranes).
class NodeFriction : public Term {
 public:
  explicit NodeFriction(const Model& model) : model_(model) {}

  void begin_step(const World& world, StepStart&) override { friction_ = at(world.tissue, world.geometry); }
  void add_friction(const World& world, const Way& way, std::span<Vec3d> out, OrderFreeSum& quadratic) override;
  void assemble(const World& world, double dt, Assembly& out) override;
  [[nodiscard]] std::size_t memory() const override { return friction_.capacity() * sizeof(friction_[0]); }

  /// Blocks at the tissue's positions by owned node; empty where there are none.
  [[nodiscard]] std::vector<SymMat3<double>> at(const Tissue& tissue, const SurfaceGeometry& geometry) const;
  /// Those of the step. After begin_step().
  [[nodiscard]] std::span<const SymMat3<double>> friction() const { return friction_; }

 private:
  const Model& model_;
  std::vector<SymMat3<double>> friction_;  ///< of the step, by owned node; empty where there is none
};

}  // namespace morula
