#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/volume_centroid_gradient.h"
#include "coupling/loads/grips.h"
#include "coupling/mechanics/term.h"

namespace morula {

/// Springs between nodes and places, in the matrix of a step alone: nodes that are held on a kink of the contact energy while the others move.
///
/// Where the nearest face of a contact point changes, the force jumps. A node can rest there although neither side has a balance of forces: the
/// lowest energy is on the kink itself. Newton's step then goes over the kink, and a search that makes the whole step shorter stops every
/// other node with it. A stiff spring across the kink, in the matrix only, leaves the others free.
class HeldNodes : public Term {
 public:
  void begin_step(const World&, StepStart&) override { held_.clear(); }
  void assemble(const World&, double dt, Assembly&) override { set_step(dt); }
  [[nodiscard]] bool empty() const override { return held_.empty(); }
  /// Hold a node against motion along the unit vector `along` by `stiffness` [nN/µm].
  void hold(std::uint32_t node, const Vec3d& along, double stiffness);
  void set_step(double dt) { dt_ = static_cast<float>(dt); }

  void add_product(std::span<const Float4> p, std::span<Float4> q) const override;
  void add_diagonal(std::span<SymMat3<float>> diagonal) const override;

 private:
  struct Held {
    std::uint32_t node;
    float x, y, z;  ///< along √stiffness
  };
  std::vector<Held> held_;
  float dt_ = 0.0f;
};

/// Springs between points, or the centres of volume of shells, and places of the laboratory: those of grips and traps, held implicitly at their
/// places of the step's end. K = k WᵀW with W = ∂x/∂x_i: I of a point, volume_centroid_gradient() of a shell.
///
/// A trap pulls along the normals of a surface only, as a force that acts on the cell's inside does. The mean of the nodes would be another thing: where
/// the cortex is fluid, they would go along the surface to the side of the pull and leave the cell behind.
class Grips : public Term {
 public:
  /// The springs of the next step. They are not copied.
  void set_anchors(std::span<const Anchor> anchors) { anchors_ = anchors; }
  /// Function(body, pull) for the springs of the step, as they pull at the present positions [nN].
  template <class F>
  void for_springs(const World& world, F&& function) const {
    for (const Spring& spring : springs_) function(spring.body, (spring.target - spring.place(world.position())) * spring.stiffness);
  }

  void begin_step(const World& world, StepStart& start) override;
  void add_outside(const Way& way, double dt, std::span<Vec3d> out, OrderFreeSum& work) override;
  void assemble(const World& world, double dt, Assembly& out) override;
  void drop_matrix() override { columns_.clear(); }
  void add_outside_balance(std::span<const Float4> velocity, std::span<OutsideBalance> by_body) const override;
  [[nodiscard]] bool empty() const override { return springs_.empty(); }
  void add_product(std::span<const Float4> p, std::span<Float4> q) const override;
  void add_diagonal(std::span<SymMat3<float>> diagonal) const override;

 private:
  struct Spring {
    double stiffness;
    Vec3d target;
    std::uint32_t body;
    std::uint32_t first, count;       ///< points
    std::span<const Triangle> faces;  ///< of a shell; none: of a point

    /// What it holds among all points.
    [[nodiscard]] Vec3d place(std::span<const Vec3d> all) const;
    /// ∂place/∂x of its points.
    [[nodiscard]] std::vector<CentroidGradient> gradient(std::span<const Vec3d> all) const;
  };
  /// √(Δt k) W of one point, by row.
  using Column = std::array<Vec3f, 3>;

  std::span<const Anchor> anchors_;
  std::vector<Spring> springs_;  ///< of the step
  std::vector<Column> columns_;  ///< of the springs' points, spring by spring, in the matrix
  double dt_ = 0.0;              ///< of the matrix [s]
};

}  // namespace morula
