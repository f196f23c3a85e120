#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "coupling/mechanics/term.h"

namespace morula {

/// Cortical tension by region of the surface and in time: E = Σ_T γ_T A_T with γ_T of RegionalTension::of_face (dcm.md §4).
///
/// What every face of a shell of the type has alike is the shells' own law (CorticalTension); here is γ_T − γ, which is zero, and costs nothing,
/// where no type has regions. γ_T is fixed within a step: marks and eased contact are those of its start, time that of its end.
class FaceTensions : public Term {
 public:
  explicit FaceTensions(const Model& model);

  void parameters_changed(const World& world) override { set(world.tissue, world.time); }
  [[nodiscard]] bool varies_with_time() const override { return vary_; }
  void evaluate(const World& world, Forces& out) override;
  void assemble(const World& world, double dt, Assembly& out) override;

  /// γ_T − γ of all owned faces at a time [s].
  void set(const Tissue& tissue, double time);

  /// Adds −∂E/∂x_c = −(γ_T − γ) ½ n×e_c to the force of the owned nodes, and Σ (γ_T − γ) A_T by shell to the energy.
  void add_forces(const dcm::Shells& shells, std::span<const Vec3d> position, std::span<Vec3d> force, OrderFreeSum& energy) const;

  /// Contact energies per area with these tensions on top: what the stiffness of a face's tension is made of (dcm::assemble_shell_operator).
  [[nodiscard]] std::span<const double> on_top_of(std::span<const double> face_energy);

  [[nodiscard]] std::span<const double> extra() const { return extra_; }  ///< γ_T − γ by owned face [nN/µm]

 private:
  const Model& model_;
  bool any_ = false, vary_ = false;
  std::vector<double> extra_, sum_;
};

}  // namespace morula
