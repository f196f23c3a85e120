#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/contact/contact_layer.h"
#include "coupling/mechanics/membranes.h"
#include "coupling/mechanics/term.h"
#include "coupling/mechanics/told.h"
#include "dcm/nuclear_shell.h"

namespace morula {

/// The nuclei of owned shells that are shells themselves, as the step sees them: their own mechanics (a ShellSystem of their own), their contact
/// with the cortex around them, links, drag and the pressure of the cytosol, and their part of the matrix (decision 0021).
///
/// Their nodes come after all other points; nothing but their own cell knows of them, so that no rank needs those of another.
///
/// Contact is a second ContactLayer whose pairs are given: each cell's surface, with its faces turned around, and its nucleus. Seen so the two are
/// any two surfaces that meet with opposed normals.
class NucleusSystem : public Term {
 public:
  /// `cells`: the shells that hold the nuclei. Their pressure is that of the cytosol.
  NucleusSystem(const Model& model, Membranes& cells, int threads);

  void bodies_changed(const World& world) override;
  /// The nuclei's own laws, and what the cells hold that is no cytosol.
  void measure(const World& world) override;
  void evaluate(const World& world, Forces& out) override;
  [[nodiscard]] std::optional<StepFault> fault(const World& world) const override;
  /// A nucleus and its cortex would pass through each other (core/contact/crossing.h).
  [[nodiscard]] std::optional<CellId> crossed(const World& world, std::span<const Vec3d> start) const override;
  /// Γ of links and drag. Where the solver starts, nuclei have their last velocity, but go with the cell.
  void begin_step(const World& world, StepStart& start) override;
  void add_friction(const World& world, const Way& way, std::span<Vec3d> out, OrderFreeSum& quadratic) override;
  void add_noise(const World& world, const Noise& noise, std::span<Vec3d> force) const override;
  void end_step(const World&, StepEnd&) override { contacts_.end_step(); }
  void assemble(const World& world, double dt, Assembly& out) override;
  void drop_matrix() override { shells_.drop_matrix(); }
  [[nodiscard]] bool empty() const override { return items_.empty(); }
  void add_product(std::span<const Float4> p, std::span<Float4> q) const override;
  void add_diagonal(std::span<SymMat3<float>> diagonal) const override;
  [[nodiscard]] std::size_t memory() const override;

  /// By owned shell; nothing where it has no nucleus of that kind.
  [[nodiscard]] std::optional<NucleusState> of_shell(std::uint32_t shell) const;
  [[nodiscard]] dcm::ShellMaterials materials() const { return shells_.materials(); }

 private:
  struct Item {
    std::uint32_t shell = 0, first_cell_point = 0, cell_node_count = 0;  ///< who holds it
    std::uint32_t first_point = 0, node_count = 0;                       ///< its nodes
    std::uint16_t type = 0;
    double rest_volume = 0.0;  ///< of the cell [µm³]
    double energy = 0.0;       ///< of the links [fJ]
    const Topology* cell_topology = nullptr;
    const Topology* topology = nullptr;
    std::shared_ptr<const std::vector<dcm::InteriorLink>> links;
    dcm::NuclearFriction friction;
    dcm::NuclearOperator matrix;
  };
  /// Cells and nuclei as surfaces in contact: 2k and 2k + 1 are the cell of the k-th nucleus, turned around, and the nucleus.
  struct Surfaces {
    std::vector<ContactBody> body;
    std::vector<const Topology*> topology;
    std::vector<std::uint32_t> first_node, first_face;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    std::vector<Vec3d> position;
    SurfaceGeometry geometry;
    ContactGradient gradient;
  };
  using LinkKey = std::pair<std::shared_ptr<const ReferenceShape>, std::uint16_t>;

  const Topology* turned_around(const std::shared_ptr<const Topology>& topology);
  [[nodiscard]] ContactScene contact_scene() const {
    return {surfaces_.body, surfaces_.position, surfaces_.topology, surfaces_.first_face, &surfaces_.geometry, {}};
  }
  [[nodiscard]] SurfaceList surfaces() const { return {surfaces_.topology, surfaces_.first_node, surfaces_.first_face, threads_}; }
  template <class T>
  [[nodiscard]] std::span<T> part(std::span<T> by_node, std::size_t surface) const {
    return by_node.subspan(surfaces_.first_node[surface], surfaces_.first_node[surface + 1] - surfaces_.first_node[surface]);
  }
  [[nodiscard]] dcm::NucleusView view(std::size_t k) const;
  /// Spans of an array by point of the scene.
  template <class T>
  [[nodiscard]] static std::span<T> of_cell(std::span<T> by_point, const Item& item) {
    return by_point.subspan(item.first_cell_point, item.cell_node_count);
  }
  template <class T>
  [[nodiscard]] static std::span<T> of_nucleus(std::span<T> by_point, const Item& item) {
    return by_point.subspan(item.first_point, item.node_count);
  }

  /// Where the solver starts: the last velocity, but going with the cell.
  void start_with_cells(const Tissue& tissue, std::span<Float4> velocity) const;

  const Model& model_;
  Membranes& cells_;
  int threads_;
  ShellSystem shells_;
  ContactLayer contacts_;
  std::uint32_t first_point_ = 0;  ///< of the nuclei
  std::vector<Item> items_;
  std::vector<dcm::HeldVolume> held_;
  std::vector<Vec3d> own_force_;  ///< of the nuclei's own laws, by node
  std::map<LinkKey, std::shared_ptr<const std::vector<dcm::InteriorLink>>> links_;
  std::map<std::shared_ptr<const Topology>, std::shared_ptr<const Topology>> turned_;

  Surfaces surfaces_;
};

}  // namespace morula
