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
#include "core/friction/friction_system.h"
#include "core/mesh/surface_geometry.h"
#include "coupling/mechanics/shell_system.h"
#include "coupling/model.h"
#include "coupling/tissue.h"
#include "dcm/nuclear_shell.h"

namespace morula {

/// How a nucleus that is a shell stands in its cell.
struct NucleusState {
  double overlap = 0.0;       ///< deepest penetration of nucleus and cortex [µm]
  double contact_area = 0.0;  ///< of nucleus and cortex, of both surfaces [µm²]
  double volume = 0.0;        ///< [µm³]
  double pressure = 0.0;      ///< inside it [kPa]
};

/// The nuclei of owned shells that are shells themselves, as the step sees them: their own mechanics (a ShellSystem of their own), their contact
/// with the cortex around them, links, drag and the pressure of the cytosol, and their part of the matrix (decision 0021).
///
/// Their nodes come after all other points; nothing but their own cell knows of them, so that no rank needs those of another.
///
/// Contact is a second ContactLayer whose pairs are given: each cell's surface, with its faces turned around, and its nucleus. Seen so the two are
/// any two surfaces that meet with opposed normals.
class NucleusSystem : public AddedPart {
 public:
  NucleusSystem(const Model& model, int threads);

  /// `first_point`: of the nodes of the first nucleus.
  void set_shells(const Tissue& tissue, std::uint32_t first_point);
  /// Nuclei are held with their cells. `bodies` begin with the owned shells.
  void set_moving(std::span<const ContactBody> bodies);
  [[nodiscard]] bool empty() const override { return items_.empty(); }
  /// function(point) for all nodes of nuclei that move.
  template <class F>
  void for_points(F&& function) const {
    for (const Item& item : items_)
      if (item.moves)
        for (std::uint32_t i = item.first_point; i < item.first_point + item.node_count; ++i) function(i);
  }
  /// function(shell, point) for all nodes of nuclei, shell by shell.
  template <class F>
  void for_nodes_of_shells(F&& function) const {
    for (const Item& item : items_)
      for (std::uint32_t i = item.first_point; i < item.first_point + item.node_count; ++i) function(item.shell, i);
  }
  /// function(point, whether it moves) for all nodes.
  template <class F>
  void for_all_points(F&& function) const {
    for (const Item& item : items_)
      for (std::uint32_t i = item.first_point; i < item.first_point + item.node_count; ++i) function(i, item.moves);
  }

  /// The nuclei's own laws at `position`; gives what the owned shells hold that is no cytosol, by shell (empty: nothing).
  std::span<const dcm::HeldVolume> evaluate_shells(const Tissue& tissue, std::span<const Vec3d> position);
  /// After the cells' own laws, whose pressures these are: adds all forces on nuclei, and those on the cells around them.
  void evaluate(const Tissue& tissue, std::span<const Vec3d> position, std::span<const double> cell_pressure, std::span<Vec3d> force);
  void add_energy(OrderFreeSum& sum) const;
  /// A nucleus that is too distorted, and the shell that holds it.
  [[nodiscard]] std::optional<std::pair<std::uint32_t, std::string>> find_fault() const;
  /// A nucleus and its cortex would pass through each other (core/contact/crossing.h).
  [[nodiscard]] bool crossed() const { return !empty() && contacts_.crossed(contact_scene(), {}) != nullptr; }

  void begin_step(const Tissue& tissue);
  void end_step() { contacts_.end_step(); }
  /// Γ_n d added to `out`, and dᵀΓ_n d to the sum.
  void add_step_friction(std::span<const Vec3d> start, std::span<const Vec3d> position, std::span<Vec3d> out, OrderFreeSum& quadratic);
  /// Where the solver starts: the last velocity, but going with the cell.
  void start_with_cells(const Tissue& tissue, std::span<Float4> velocity) const;
  void assemble(const Tissue& tissue, std::span<const Vec3d> position, double dt);
  void drop_matrix() { shells_.drop_matrix(); }

  /// By owned shell; nothing where it has no nucleus of that kind.
  [[nodiscard]] std::optional<NucleusState> of_shell(std::uint32_t shell) const;
  [[nodiscard]] std::span<const dcm::ShellParameters> parameters() const { return shells_.parameters(); }
  [[nodiscard]] std::size_t memory() const;

  void add_product(std::span<const Float4> p, std::span<Float4> q) const override;
  void add_diagonal(std::span<SymMat3<float>> diagonal) const override;

 private:
  struct Item {
    std::uint32_t shell = 0, first_cell_point = 0, cell_node_count = 0;  ///< who holds it
    std::uint32_t first_point = 0, node_count = 0;                       ///< its nodes
    bool moves = true;
    std::uint16_t type = 0;
    double rest_volume = 0.0;  ///< of the cell [µm³]
    double energy = 0.0;       ///< of the links [fJ]
    const Topology* cell_topology = nullptr;
    const Topology* topology = nullptr;
    std::shared_ptr<const std::vector<dcm::InteriorLink>> links;
    dcm::NuclearFriction friction;
    dcm::NuclearOperator matrix;
  };
  using LinkKey = std::pair<std::shared_ptr<const ReferenceShape>, std::uint16_t>;

  const Topology* turned_around(const std::shared_ptr<const Topology>& topology);
  [[nodiscard]] ContactScene contact_scene() const { return {bodies_, position_, topologies_, first_face_, &geometry_, {}}; }
  [[nodiscard]] SurfaceList surfaces() const { return {topologies_, first_node_, first_face_}; }
  /// Surfaces 2k and 2k + 1 are the cell of the k-th nucleus and the nucleus.
  template <class T>
  [[nodiscard]] std::span<T> part(std::span<T> by_node, std::size_t surface) const {
    return by_node.subspan(first_node_[surface], first_node_[surface + 1] - first_node_[surface]);
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

  const Model& model_;
  ShellSystem shells_;
  ContactLayer contacts_;
  std::uint32_t first_point_ = 0, node_count_ = 0;
  std::vector<Item> items_;
  std::vector<dcm::HeldVolume> held_;
  std::vector<Vec3d> own_force_;  ///< of the nuclei's own laws, by node
  std::map<LinkKey, std::shared_ptr<const std::vector<dcm::InteriorLink>>> links_;
  std::map<std::shared_ptr<const Topology>, std::shared_ptr<const Topology>> turned_;

  // cells and nuclei as surfaces in contact
  std::vector<ContactBody> bodies_;
  std::vector<const Topology*> topologies_;
  std::vector<std::uint32_t> first_node_, first_face_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;
  std::vector<Vec3d> position_;
  SurfaceGeometry geometry_;
  ContactGradient gradient_;
};

}  // namespace morula
