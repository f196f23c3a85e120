#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "coupling/mechanics/term.h"
#include "dcm/interior.h"

namespace morula {

/// Rigid nuclei and links within the owned shells: their forces, their friction, and their part of the matrix (dcm.md §12).
///
/// A nucleus is a point among the unknowns that nothing but its own shell knows of: nuclei come after all other points, and no rank needs
/// those of another.
class InteriorSystem : public Term {
 public:
  explicit InteriorSystem(const Model& model) : model_(model) {}

  void bodies_changed(const World& world) override;
  void evaluate(const World& world, Forces& out) override;
  /// Γ of the drag on the nuclei and of the dampers along the links. Where the solver starts, nuclei have the mean velocity of their cortex.
  void begin_step(const World& world, StepStart& start) override;
  void add_friction(const World& world, const Way& way, std::span<Vec3d> out, OrderFreeSum& quadratic) override;
  void add_noise(const World& world, const Noise& noise, std::span<Vec3d> force) const override;
  void assemble(const World& world, double dt, Assembly& out) override;
  [[nodiscard]] bool empty() const override { return items_.empty(); }
  void add_product(std::span<const Float4> p, std::span<Float4> q) const override;
  void add_diagonal(std::span<SymMat3<float>> diagonal) const override;
  [[nodiscard]] std::size_t memory() const override;

  /// What the nucleus of a shell feels; zeros where there is none.
  [[nodiscard]] dcm::InteriorEnergy of_shell(std::uint32_t shell) const;

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
  int threads_ = 1;
  std::vector<Item> items_;
  /// By shape and type.
  std::map<std::pair<std::shared_ptr<const ReferenceShape>, std::uint16_t>, std::shared_ptr<const dcm::InteriorLinks>> links_;
};

}  // namespace morula
