#pragma once
#include <span>
#include <vector>

#include "coupling/mechanics/term.h"

namespace morula {

/// What acts on single nodes of shells beside the isotropic friction with the medium: friction with different coefficients across and along the
/// surface (dcm.md §1), and the springs and dampers that hold marked faces near their mean sphere (dcm.md §15). Nothing, and at no cost, where
/// no type and no study asks for it.
///
/// Friction of node i: a_i [(γ_n − γ_t) n_i n_iᵀ] or a_i [(γ_t − γ_n) (I − n_i n_iᵀ)], whichever is positive, on top of the lesser of both; and
/// µ A_i of a spring, A_i a third of the marked areas around the node. All of the step's start.
///
/// Spring: E = ½ k Σ A_i (|x_i − X| − R)² − Σ A_i m·x_i with X, R the area-weighted centre and mean radius of the marked nodes, A_i and
/// m = k Σ A_i d_i r̂_i/Σ A_i those of the step's start: the net force of the start is zero.
class NodeTerms : public Term {
 public:
  explicit NodeTerms(const Model& model) : model_(model) {}

  void parameters_changed(const World& world) override;
  void evaluate(const World& world, Forces& out) override;
  void add_tied(const World& world, std::vector<std::uint32_t>& bodies) const override;
  void assemble(const World& world, double dt, Assembly& out) override;

  [[nodiscard]] bool has_friction() const;

  /// Mean spheres and weights of the springs at the tissue's positions. Collective.
  void set_springs(const Tissue& tissue, const Comm& comm);
  /// Friction blocks at the step's start; empty where there are none.
  [[nodiscard]] std::vector<SymMat3<double>> friction(const Tissue& tissue, const SurfaceGeometry& geometry) const;
  /// Adds the springs' forces on the owned nodes, and their energies by shell.
  void add_forces(const dcm::Shells& shells, std::span<const Vec3d> position, std::span<Vec3d> force, OrderFreeSum& energy) const;
  /// Positive semi-definite stiffness k A_i r̂ r̂ᵀ by owned node; empty without springs.
  [[nodiscard]] std::vector<SymMat3<double>> stiffness(std::span<const Vec3d> position, std::size_t nodes) const;

 private:
  struct Sphere {
    Vec3d center, pull;          ///< X, m
    double radius = 0.0;         ///< R [µm]
    std::vector<double> weight;  ///< A_i by owned node [µm²]
  };
  const Model& model_;
  std::vector<Sphere> spheres_;  ///< by spring
};

/// The friction of NodeTerms, a term of its own: sums over terms run in their order, and this friction comes before that of all others. Its
/// noise is drawn with that of the medium (Membranes).
class NodeFriction : public Term {
 public:
  explicit NodeFriction(const NodeTerms& nodes) : nodes_(nodes) {}

  void begin_step(const World& world, StepStart& start) override;
  void add_friction(const World& world, const Way& way, std::span<Vec3d> out, OrderFreeSum& quadratic) override;
  void assemble(const World& world, double dt, Assembly& out) override;
  [[nodiscard]] std::size_t memory() const override { return friction_.capacity() * sizeof(friction_[0]); }

  /// Blocks at the tissue's positions by owned node; empty where there are none.
  [[nodiscard]] std::vector<SymMat3<double>> at(const Tissue& tissue, const SurfaceGeometry& geometry) const {
    return nodes_.friction(tissue, geometry);
  }
  /// Those of the step. After begin_step().
  [[nodiscard]] std::span<const SymMat3<double>> friction() const { return friction_; }

 private:
  const NodeTerms& nodes_;
  std::vector<SymMat3<double>> friction_;  ///< of the step, by owned node; empty where there is none
};

}  // namespace morula
