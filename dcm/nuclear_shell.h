#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/friction/contact_element.h"
#include "core/friction/float4.h"
#include "core/vec3.h"
#include "dcm/interior.h"
#include "dcm/shells.h"

namespace morula::dcm {

/// Nuclei that are shells of their own (dcm.md §12): the same class, laws and operator as for the shells of cells, in a list beside them. What is
/// here holds a nucleus and its cell together: links, drag and the pressure of the cytosol. Their contact is that of two surfaces.
struct NuclearShells {
  Shells shells;                     ///< `type` is that of the cell
  std::vector<std::uint32_t> owner;  ///< by nucleus: number of the shell that holds it, increasing

  [[nodiscard]] std::size_t size() const { return owner.size(); }
  /// Number of the nucleus of a shell; size(): it has none.
  [[nodiscard]] std::size_t of_shell(std::size_t shell) const;
};

/// V0 of a nucleus that is at rest with this volume in a cell at rest: its pressure bears its own tension and the pressure of the cytosol, which is
/// the Laplace pressure of the cell (dcm.md §4: T4.3 for both). V_n and V_cell [µm³], γ of the cell [nN/µm].
double nucleus_reference_volume(double nucleus_volume, double cell_volume, const ShellParameters& nucleus, double cell_tension);

/// Let a nucleus grow with its cell, as a rigid one does: it is stress-free, and at rest, at the fraction f of the cell's target volume V_t [µm³].
void set_nucleus_target(Shells& nuclei, std::size_t nucleus, const InteriorParameters& interior, double cell_tension,
                        double cell_target_volume);

/// Links from the nodes i of a cell to the nodes j of its nucleus that lie in the same direction in the undeformed cell. Their cortical ends are
/// those of links to a rigid nucleus (choose_links()); the rest length is `rest` × (rest volume of the cell)^{1/3}.
std::vector<InteriorLink> choose_nuclear_links(const ReferenceShape& cell, const ReferenceShape& nucleus,
                                               const InteriorParameters& parameters);

/// A cell and its nucleus at some positions.
struct NucleusView {
  const InteriorParameters* parameters = nullptr;
  std::span<const InteriorLink> links;
  const Topology* cell_topology = nullptr;
  const Topology* nucleus_topology = nullptr;
  std::span<const Vec3d> cell, nucleus;  ///< nodes [µm]
  double rest_volume = 0.0;              ///< of the cell's membrane [µm³]
};

/// Vectors on the nodes of a cell and on those of its nucleus.
struct NucleusVectors {
  std::span<Vec3d> cell, nucleus;
};

/// Adds the pulls of the links; gives their energy [fJ].
double add_nuclear_link_forces(const NucleusView& view, NucleusVectors force);
/// Adds −p ∂V_n/∂x: the cytosol at pressure p [kPa] presses on the nucleus. The cell's own share is in internal_forces() (HeldVolume).
void add_cytosol_pressure(const NucleusView& view, double pressure, std::span<Vec3d> nucleus_force);

/// Friction of a nucleus with its cell, frozen at the start of a step: drag of the cytoplasm and the dampers of the links.
///
/// The cytoplasm moves as the rigid motion v̄ + ω̄ × (x − c) that is nearest to the motion of the cortex (least squares by area); every node of the
/// nucleus rubs on it with its share a_i/A_n of 6πηR_n (dcm.md §12): the traction of Stokes' sphere is even over its surface.
/// Opposite forces go to the cortex by the same rule: no net force, no net torque, and a rigid motion of both feels nothing.
struct NuclearFriction {
  Vec3d center;                     ///< c: of the cortex, by area [µm]
  std::vector<double> share;        ///< a_k/A of the cortex
  std::vector<Vec3d> arm;           ///< x_k − c of the cortex
  SymMat3<double> inverse_inertia;  ///< of Σ (a_k/A) (r² I − r rᵀ) [1/µm²]
  std::vector<double> friction;     ///< 6πηR_n a_i/A_n of the nucleus [nN·s/µm]
  std::vector<Vec3d> nucleus_arm;   ///< x_i − c
  std::vector<Vec3d> direction;     ///< of the links
};
void find_nuclear_friction(const NucleusView& view, std::span<const double> cell_node_area, std::span<const double> nucleus_node_area,
                           NuclearFriction& out);
/// Puts the rigid motion of the cell in the place of that of the nucleus: where a solver starts, since the drag is too weak to count in a residual.
void move_with_cell(const NuclearFriction& friction, std::span<const Vec3d> cell_velocity, std::span<Vec3d> nucleus_velocity);
/// Adds Γ_n d to the results and returns dᵀΓ_n d; `way` are displacements since the step's start.
double add_nuclear_friction(const NucleusView& view, const NuclearFriction& friction, NucleusVectors way, NucleusVectors result);

/// The part of the matrix Γ_n + Δt K̃ between a cell and its nucleus, positive semi-definite.
struct NuclearOperator {
  struct Contact {  ///< a point of one surface against a face of the other
    std::uint32_t source[3] = {}, target[3] = {};
    double beta[3] = {}, mu[3] = {};
    Vec3d normal;
    double stiffness = 0.0;  ///< Δt k [nN·s/µm]
    bool of_cell = false;    ///< the source is the cell
  };
  const NuclearFriction* friction = nullptr;
  std::vector<SymMat3<double>> link;  ///< dampers and springs
  std::vector<Contact> contact;
  std::vector<Vec3d> cell_gradient, nucleus_gradient;  ///< ∂V/∂x of the cell and of the nucleus [µm²]
  double cytosol_stiffness = 0.0;                      ///< Δt K_V/(V − V_n) [nN·s/µm⁵]
};
/// All but the contacts. `bulk_modulus` K_V is that of the cell; g_c g_cᵀ of the cell alone is in its own operator.
void assemble_nuclear_operator(const NucleusView& view, const NuclearFriction& friction, double bulk_modulus, double time_step,
                               NuclearOperator& out);
/// Adds contacts of one direction. The Topologies are those that the elements were found with: the cell's faces are turned around there.
void add_nuclear_contacts(std::span<const ContactElement> elements, const Topology& source, const Topology& target, bool of_cell,
                          int points_per_face, double time_step, NuclearOperator& out);
/// q += A p.
void add_nuclear_product(const NucleusView& view, const NuclearOperator& matrix, std::span<const Float4> cell_p,
                         std::span<const Float4> nucleus_p, std::span<Float4> cell_q, std::span<Float4> nucleus_q);
void add_nuclear_diagonal(const NucleusView& view, const NuclearOperator& matrix, std::span<SymMat3<float>> cell,
                          std::span<SymMat3<float>> nucleus);

/// Smallest distance of a node of the nucleus from the faces of its cell [µm]; negative: the deepest node outside.
double nucleus_clearance(const NucleusView& view);

}  // namespace morula::dcm
