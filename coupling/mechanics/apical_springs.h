#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "coupling/mechanics/marked_nodes.h"
#include "coupling/mechanics/term.h"

namespace morula {

/// Springs that hold marked faces near their mean sphere (dcm.md §15), of which cells do the forces upon each other.
///
/// E = ½ k Σ A_i (|x_i − X| − R)² with X, R the area-weighted centre and mean radius of the marked nodes of the whole tissue, at the present positions,
/// and A_i a third of the marked areas around node i at the start of the step. F_i = −A_i (k d_i r̂_i − m), m = k Σ A_j d_j r̂_j/Σ A_j = −k R N, which is how
/// X follows its nodes: the forces add up to zero. The sphere goes where the cells go, within a step too: springs resist no common motion (decision 0083).
class ApicalSprings : public Term {
 public:
  explicit ApicalSprings(const Model& model) : model_(model) {}

  void parameters_changed(const World& world) override { set_weights(world.tissue.shells, world.comm); }
  void measure(const World& world) override { find_spheres(world.position(), world.comm); }
  void evaluate(const World& world, Forces& out) override { add_forces(world.position(), out.force, out.energy); }
  /// The cells that a spring has marked nodes of.
  void add_joined(const World& world, std::vector<std::vector<std::uint32_t>>& bodies) const override;
  void assemble(const World& world, double dt, Assembly& out) override;
  void drop_matrix() override;
  [[nodiscard]] bool empty() const override { return model_.apical_springs.empty(); }
  void add_product(std::span<const Float4> p, std::span<Float4> q) const override;
  void add_diagonal(std::span<SymMat3<float>> diagonal) const override;
  [[nodiscard]] std::size_t memory() const override;

  /// Areas of the owned nodes at the shells' positions. Collective.
  void set_weights(const dcm::Shells& shells, const Comm& comm);
  /// Mean spheres at these positions. After set_weights(). Collective.
  void find_spheres(std::span<const Vec3d> position, const Comm& comm);
  /// Adds the forces on the owned nodes at these positions, and the energies by shell. After find_spheres().
  void add_forces(std::span<const Vec3d> position, std::span<Vec3d> force, OrderFreeSum& energy) const;
  /// Δt K̃ with K̃ = k Σ A_i s_i s_iᵀ, s_i the change of the distance of node i from the mean sphere, of the owned nodes of those shells that move (by
  /// shell; empty: all). Products are collective. After find_spheres().
  void assemble_at(std::span<const Vec3d> position, std::span<const char> moves, double dt, const Comm& comm);

 private:
  /// A marked node in the matrix, and its direction from the centre.
  struct Direction {
    std::uint32_t node;
    double weight;  ///< A/Σ A
    Vec3d n;
  };
  struct Spring {
    NodesByShell<MarkedNode> marked;
    double area = 0.0;    ///< Σ A of all ranks [µm²]
    double radius = 0.0;  ///< R [µm]
    Vec3d center;         ///< X [µm]
    Vec3d normal;         ///< N = Σ A r̂/Σ A
    // of the matrix
    NodesByShell<Direction> moving;
    double stiffness = 0.0;  ///< Δt k Σ A [nN·s/µm]
    SymMat3<double> second;  ///< Σ A r̂ r̂ᵀ/Σ A of all nodes, moving or not
  };

  const Model& model_;
  const Comm* comm_ = nullptr;   ///< of the products, while there is a matrix
  std::vector<Spring> springs_;  ///< as the model has them
};

}  // namespace morula
