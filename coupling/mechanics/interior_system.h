#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "core/friction/friction_system.h"
#include "core/mesh/surface_geometry.h"
#include "coupling/model.h"
#include "coupling/tissue.h"
#include "dcm/interior.h"

namespace morula {

/// The nuclei and links of the owned shells as the step sees them: their forces, their friction, and their part of the matrix.
///
/// A nucleus is a point among the unknowns that nothing but its own shell knows of: nuclei come after all other points, and no rank needs
/// those of another.
class InteriorSystem : public AddedPart {
 public:
  explicit InteriorSystem(const Model& model) : model_(model) {}

  /// `first_point`: of the first nucleus.
  void set_shells(const dcm::Shells& shells, std::uint32_t first_point);
  [[nodiscard]] bool empty() const override { return items_.empty(); }
  /// Points of the nuclei, in the order of their shells: (point, shell).
  struct Nucleus {
    std::uint32_t point, shell;
  };
  [[nodiscard]] std::span<const Nucleus> nuclei() const { return nuclei_; }

  /// Forces at `position`, added by point.
  void evaluate(const dcm::Shells& shells, std::span<const Vec3d> position, std::span<Vec3d> force);
  void add_energy(OrderFreeSum& sum) const;
  void begin_step(std::span<const Vec3d> position, const SurfaceGeometry& geometry);
  /// Γ_n d added to `out`, and dᵀΓ_n d to the sum.
  void add_step_friction(std::span<const Vec3d> start, std::span<const Vec3d> position, std::span<Vec3d> out, OrderFreeSum& quadratic);
  void assemble(std::span<const Vec3d> position, double dt);
  /// Where the solver starts: nuclei with the mean velocity of their cortex.
  void start_from_cortex(std::span<Float4> velocity) const;
  /// What the nucleus of a shell feels; zeros where there is none.
  [[nodiscard]] dcm::InteriorEnergy of_shell(std::uint32_t shell) const;
  [[nodiscard]] std::size_t memory() const;

  void add_product(std::span<const Float4> p, std::span<Float4> q) const override;
  void add_diagonal(std::span<SymMat3<float>> diagonal) const override;

 private:
  struct Item {
    std::uint32_t shell = 0, first_node = 0, node_count = 0, nucleus = 0;  ///< nucleus: its point
    bool has_nucleus = false;
    double rest_volume = 0.0;
    const Topology* topology = nullptr;
    const dcm::InteriorParameters* parameters = nullptr;
    std::shared_ptr<const dcm::InteriorLinks> links;
    dcm::InteriorEnergy energy;
    dcm::InteriorFriction friction;
    dcm::InteriorOperator matrix;
  };
  [[nodiscard]] dcm::InteriorView view(const Item& item, std::span<const Vec3d> position) const;

  const Model& model_;
  std::vector<Item> items_;
  std::vector<Nucleus> nuclei_;
  /// By shape and type.
  std::map<std::pair<std::shared_ptr<const ReferenceShape>, std::uint16_t>, std::shared_ptr<const dcm::InteriorLinks>> links_;
};

}  // namespace morula
