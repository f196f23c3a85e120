#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/friction/friction_system.h"
#include "core/vec3.h"

namespace morula {

/// Springs between nodes and places, in the matrix of a step: those of grips, and of nodes that are held on a kink of the contact energy while
/// the others move.
///
/// Where the nearest face of a contact point changes, the force jumps. A node can rest there although neither side has a balance of forces: the
/// lowest energy is on the kink itself. Newton's step then goes over the kink, and a search that makes the whole step shorter stops every
/// other node with it. A stiff spring across the kink, in the matrix only, leaves the others free.
class HeldNodes : public AddedPart {
 public:
  [[nodiscard]] bool empty() const override { return held_.empty(); }
  void clear() { held_.clear(); }
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

}  // namespace morula
