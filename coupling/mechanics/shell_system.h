#pragma once
#include <span>
#include <utility>
#include <vector>

#include "core/friction/friction_system.h"
#include "core/mesh/surface_geometry.h"
#include "core/parallel/order_free_sum.h"
#include "coupling/model.h"
#include "dcm/blocks.h"
#include "dcm/internal_forces.h"
#include "dcm/shell_friction.h"
#include "dcm/shell_operator.h"

namespace morula {

/// The owned shells as the step sees them: their forces, their friction, and their part of the matrix. Points 0 .. node_count−1.
class ShellSystem : public OperatorPart {
 public:
  explicit ShellSystem(const Model& model);
  /// Shells with these parameters by cell type.
  explicit ShellSystem(std::vector<dcm::ShellParameters> parameters) : parameters_(std::move(parameters)) {}

  /// `computed`: the shells that have forces, friction and a part of the matrix, by shell; the others are held in place. Empty: all.
  void set_shells(const dcm::Shells& shells, int threads, std::span<const char> computed = {});
  /// After set_shells(): how far each shell is from its type, as parts: its tension; its moduli in the plane and against bending. Empty: nowhere.
  void set_deviations(const dcm::Shells& shells, std::span<const double> of_tension, std::span<const double> of_stiffness);
  /// Internal forces at `position` into the first entries of `force`; all else is in `forces()` afterwards. `held`: what is in the shells that is
  /// not cytosol, by shell, good until assemble(); empty: nothing.
  void evaluate(const dcm::Shells& shells, std::span<const Vec3d> position, std::span<Vec3d> force,
                std::span<const dcm::HeldVolume> held = {});
  /// Friction of the step that starts at the shells' positions; these stay until the step is done. `geometry` is that of these positions.
  void begin_step(const dcm::Shells& shells, const SurfaceGeometry& geometry);
  /// `face_contact_energy`: by face, or empty: no contact. `contacts`: what they couple within a shell. `node_block`: Γ + Δt K that
  /// single nodes have more, by node, or empty.
  void assemble(const dcm::Shells& shells, std::span<const Vec3d> position, std::span<const double> face_contact_energy, double dt,
                const EdgeBlockSource& contacts, std::span<const SymMat3<double>> node_block);
  /// The matrix is not needed any more.
  void drop_matrix() { operator_ = {}; }
  /// Adds Γ_n d, d = position − start, of the shells' nodes to `out`, and dᵀΓ_n d to the sum.
  void add_step_friction(std::span<const Vec3d> position, std::span<Vec3d> out, OrderFreeSum& quadratic);

  /// function(shell, node, γ) for the nodes of the shells of a batch: friction with the medium of the step [nN·s/µm], shell by shell.
  /// `beside`: what single nodes have more (NodeFriction).
  template <class F>
  void for_medium_friction(std::size_t batch, std::span<const SymMat3<double>> beside, F&& function) const {
    const LaneBlock& block = blocks_.blocks[batch];
    const auto lanes = static_cast<std::size_t>(block.lanes);
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(block.count); ++lane) {
      const std::uint32_t shell = block.member[lane], first = shells_->first_node[shell];
      for (std::uint32_t node = first; node < shells_->first_node[shell + 1]; ++node) {
        SymMat3<double> friction = isotropic(friction_.blocks[batch].medium[(node - first) * lanes + lane]);
        if (!beside.empty()) friction += beside[node];
        function(shell, node, friction);
      }
    }
  }

  [[nodiscard]] const dcm::ShellMechanics& forces() const { return forces_; }
  [[nodiscard]] dcm::ShellMaterials materials() const {
    return of_each_.empty() ? dcm::ShellMaterials(parameters_) : dcm::ShellMaterials::of_each(of_each_);
  }
  [[nodiscard]] std::size_t memory() const;

  [[nodiscard]] std::size_t point_count() const override { return shells_ == nullptr ? 0 : shells_->node_count(); }
  [[nodiscard]] std::size_t batch_count() const override { return blocks_.blocks.size(); }
  [[nodiscard]] std::span<const std::uint32_t> bodies_of(std::size_t batch) const override {
    const LaneBlock& block = blocks_.blocks[batch];
    return std::span(block.member).first(static_cast<std::size_t>(block.count));
  }
  void multiply(std::size_t first, std::size_t last, std::span<const Float4> p, std::span<Float4> q) const override;
  void add_diagonal(std::span<SymMat3<float>> diagonal) const override;

 private:
  std::vector<dcm::ShellParameters> parameters_;  ///< by cell type
  std::vector<dcm::ShellParameters> of_each_;     ///< by shell, where they vary; else empty
  const dcm::Shells* shells_ = nullptr;
  std::span<const dcm::HeldVolume> held_;
  dcm::ShellBlocks blocks_;
  bool some_are_held_ = false;  ///< and are in no block
  dcm::ShellMechanics forces_;
  dcm::ShellFriction friction_;
  dcm::ShellOperator operator_;
  std::vector<double> friction_quadratic_;
  std::vector<SymMat3<float>> node_block_;  ///< Γ + Δt K that single nodes have more, or empty
};

}  // namespace morula
