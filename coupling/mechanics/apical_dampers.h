#pragma once
#include <array>
#include <span>
#include <vector>

#include "coupling/mechanics/marked_nodes.h"
#include "coupling/mechanics/term.h"

namespace morula {

/// Dampers between marked faces (dcm.md §15): friction of what changes the shape of the marked surface, on itself.
///
/// Of the marked nodes of the whole tissue, w_i = v_i − (V + Ω × r_i + s r̂_i), r_i from their area-weighted centre, V, Ω and s those for which Σ A_i |w_i|² is
/// least: the common translation and rotation and the mean radial speed, which the dampers do not resist (decision 0085). F_i = −µ A_i w_i; forces and torques
/// add up to zero. With B_i = [1, −r_i×, r̂_i] Γ = µ (A − A B (Bᵀ A B)⁻¹ Bᵀ A), A_i and B of the step's start. Cells that a damper has nodes of are one cluster
/// by its spring (ApicalSprings::add_joined).
class ApicalDampers : public Term {
 public:
  explicit ApicalDampers(const Model& model);

  /// Collective.
  void begin_step(const World& world, StepStart&) override { freeze(world.tissue.shells, world.position(), world.comm); }
  void add_friction(const World& world, const Way& way, std::span<Vec3d> out, OrderFreeSum& quadratic) override;
  /// With the mean temperature of the marked faces.
  void add_noise(const World& world, const Noise& noise, std::span<Vec3d> force) const override;
  void assemble(const World& world, double dt, Assembly& out) override;
  void drop_matrix() override;
  [[nodiscard]] bool empty() const override { return dampers_.empty(); }
  void add_product(std::span<const Float4> p, std::span<Float4> q) const override;
  void add_diagonal(std::span<SymMat3<float>> diagonal) const override;
  [[nodiscard]] std::size_t memory() const override;

  /// Γ of the nodes at these positions. Collective.
  void freeze(const dcm::Shells& shells, std::span<const Vec3d> position, const Comm& comm);
  /// Adds Γ d of the owned nodes to `out`, and dᵀΓd by shell to the sum. After freeze(). Collective.
  void add_friction_of(std::span<const Vec3d> way, std::span<Vec3d> out, OrderFreeSum& quadratic, const Comm& comm) const;
  /// Γ of the owned nodes of those shells that move (by shell; empty: all), for products, which are collective. After freeze().
  void assemble_of(std::span<const char> moves, const Comm& comm);

 private:
  static constexpr std::size_t kCommon = 7;  ///< translations, rotations, growth
  using Common = std::array<double, kCommon>;

  struct Node {
    std::uint32_t node;
    double area;          ///< A [µm²]
    Vec3d from, outward;  ///< r [µm] and its direction

    [[nodiscard]] Common sum_of(const Vec3d& v) const;  ///< Bᵀ v
    [[nodiscard]] Vec3d common(const Common& y) const;  ///< B y
  };
  struct Damper {
    int mark = 0;
    double friction = 0.0;  ///< µ [nN·s/µm³]
    NodesByShell<Node> marked{}, moving{};
    std::array<Common, kCommon> factor{};  ///< of Bᵀ A B (Cholesky); rows of motions that the others hold are zero

    /// The y for which Σ A |v − B y|² is least, of Bᵀ A v.
    [[nodiscard]] Common fit(Common sums) const;
  };
  void fit_common_motions(Damper& damper, const Comm& comm) const;

  const Model& model_;
  const Comm* comm_ = nullptr;  ///< of the products, while there is a matrix
  std::vector<Damper> dampers_;
};

}  // namespace morula
