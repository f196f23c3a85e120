#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/traction_law.h"
#include "core/friction/float4.h"
#include "core/mesh/topology.h"
#include "core/vec3.h"
#include "dcm/laws/cytoskeleton_link.h"
#include "dcm/shells.h"

namespace morula::dcm {

/// Links of one kind in the cells of a type.
struct LinkParameters {
  static constexpr std::uint32_t kAll = 0xffffffff;
  std::uint32_t count = 0;    ///< of links; kAll: one for each node
  double stiffness = 0.0;     ///< k_l of one link [nN/µm]
  double damping = 0.0;       ///< c_l of one link [nN·s/µm]
  bool tension_only = false;  ///< a link goes slack below its rest length

  [[nodiscard]] bool act() const { return count > 0 && (stiffness > 0.0 || damping > 0.0); }
  [[nodiscard]] CytoskeletonLink law() const { return {stiffness, damping, tension_only}; }
};

/// What the shells of a cell type have inside: a nucleus that floats, rigid or a shell of its own, and a cytoskeleton of links.
struct InteriorParameters {
  double nucleus_fraction = 0.0;      ///< volume of the nucleus in parts of the membrane's rest volume; 0: no nucleus
  double cytoplasm_viscosity = 1e-3;  ///< η of the drag on the nucleus [kPa·s]
  LinkParameters nucleus_links;       ///< from nodes to the centre of a rigid nucleus, or to the nodes of one that is a shell
  LinkParameters cortex_links;        ///< across the cell, between opposite nodes
  std::uint32_t nucleus_nodes = 0;    ///< of the nucleus' own mesh; 0: it is rigid
  ShellParameters nucleus_shell;      ///< its mechanics; what it rubs on is the cytoplasm, so that medium_friction does not act

  [[nodiscard]] bool has_nucleus() const { return nucleus_fraction > 0.0; }
  [[nodiscard]] bool has_nuclear_shell() const { return has_nucleus() && nucleus_nodes > 0; }
  [[nodiscard]] bool has_rigid_nucleus() const { return has_nucleus() && nucleus_nodes == 0; }
  /// Beside a nucleus that is a shell (nuclear_shell.h).
  [[nodiscard]] bool acts() const { return has_rigid_nucleus() || cortex_links.act(); }
};

/// R_n of a nucleus at rest: a ball of nucleus_fraction × rest volume [µm].
double nucleus_radius(const InteriorParameters& parameters, double rest_volume);

/// A link of the undeformed cell: its rest length is `rest` × (rest volume)^{1/3}, so that it grows with the cell.
struct InteriorLink {
  std::uint32_t i = 0, j = 0;  ///< nodes; of a link to the nucleus only i
  double rest = 0.0;
};

/// The links of a shape, chosen once.
struct InteriorLinks {
  std::vector<InteriorLink> nucleus, cortex;
};

/// Links of all cells of this shape and type. Nodes are taken in the order of a hash of their number, which spreads any number of them
/// evenly over meshes of even triangles; a link across goes to the node that lies most nearly opposite, seen from the centroid of the
/// undeformed cell, and no two nodes have two. Links are at rest in the undeformed cell with the nucleus at its centroid.
InteriorLinks choose_links(const ReferenceShape& shape, const InteriorParameters& parameters);

/// One cell as its interior sees it.
struct InteriorView {
  const InteriorParameters* parameters = nullptr;
  const InteriorLinks* links = nullptr;
  const Topology* topology = nullptr;
  std::span<const Vec3d> node;     ///< positions of the shell's nodes [µm]
  const Vec3d* nucleus = nullptr;  ///< its centre; null: none [µm]
  double rest_volume = 0.0;        ///< of the membrane [µm³]
  double repulsion = 0.0;          ///< k_r of nucleus and cortex [kPa/µm]
  int points_per_face = 3;
};

/// Adds −∂E/∂x to the forces of the nodes and of the nucleus (null if there is none). Net force and torque are zero.
struct InteriorEnergy {
  double energy = 0.0;        ///< [fJ]
  double overlap = 0.0;       ///< deepest penetration of cortex and nucleus [µm]
  double contact_area = 0.0;  ///< of the cortex with the nucleus [µm²]
  double push = 0.0;          ///< sum of the normal forces of that contact [nN]
};
InteriorEnergy add_interior_forces(const InteriorView& cell, std::span<Vec3d> force, Vec3d* nucleus_force);

/// Friction Γ_n of the interior, frozen at the start of a step: drag of the nucleus and dampers along the links.
struct InteriorFriction {
  double drag = 0.0;          ///< ζ [nN·s/µm]
  std::vector<double> share;  ///< a_i/A by node; empty without a nucleus
  std::vector<Vec3d> nucleus_direction, cortex_direction;
};
void find_interior_friction(const InteriorView& cell, std::span<const double> node_area, InteriorFriction& out);

/// Adds Γ_n d to the results and returns dᵀΓ_n d; d are displacements since the step's start. Without nucleus its arguments are null.
double add_interior_friction(const InteriorView& cell, const InteriorFriction& friction, std::span<const Vec3d> node_way,
                             const Vec3d* nucleus_way, std::span<Vec3d> node_result, Vec3d* nucleus_result);

/// The interior's part of the matrix Γ_n + Δt K̃, in float: positive semi-definite, on differences of velocities.
struct InteriorOperator {
  struct Contact {
    std::uint32_t face = 0;
    float beta[3] = {};
    Vec3<float> normal;
    float stiffness = 0.0f;  ///< Δt k_r A w
  };
  float drag = 0.0f;
  std::vector<float> share;
  std::vector<SymMat3<float>> nucleus_block, cortex_block;  ///< by link
  std::vector<Contact> contact;
};
void assemble_interior(const InteriorView& cell, const InteriorFriction& friction, double time_step, InteriorOperator& out);

/// q += A p on the nodes and the nucleus.
void add_interior_product(const InteriorView& cell, const InteriorOperator& matrix, std::span<const Float4> p, std::span<Float4> q,
                          const Float4* nucleus_p, Float4* nucleus_q);
/// Add the 3×3 diagonal blocks.
void add_interior_diagonal(const InteriorView& cell, const InteriorOperator& matrix, std::span<SymMat3<float>> diagonal,
                           SymMat3<float>* nucleus_diagonal);

}  // namespace morula::dcm
