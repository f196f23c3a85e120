#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/topology.h"
#include "core/vec3.h"
#include "dcm/sheet_law.h"

namespace morula::dcm {

/// What the faces of one shell carry beside their geometry, by face of its Topology. Empty arrays: zero everywhere.
struct FaceState {
  std::vector<std::uint8_t> mark;  ///< set of marks: bit k is the k-th of the study
  std::vector<float> contact;      ///< part of the face that is in contact with other cells, eased over time; 0 to 1

  [[nodiscard]] bool empty() const { return mark.empty() && contact.empty(); }
};

/// All shells of a rank: what a checkpoint holds of them, and nothing else. Nodes of a shell are contiguous; shells come in the order of
/// their cells. Geometry, forces and operators are derived from this and live in workspaces.
struct Shells {
  std::vector<std::shared_ptr<const ReferenceShape>> shape;  ///< by shell
  std::vector<std::uint32_t> first_node{0};                  ///< by shell, one more at the end
  std::vector<std::uint32_t> first_edge{0};                  ///< by shell, one more at the end
  std::vector<std::uint16_t> type;                           ///< by shell: cell type, gives the parameters
  std::vector<double> reference_volume;                      ///< by shell: V0 of the pressure law [µm³]
  std::vector<double> rest_volume;                           ///< by shell: volume of the stress-free membrane [µm³]
  std::vector<Vec3d> position;                               ///< by node [µm]
  std::vector<Vec3f> velocity;                               ///< by node: last solution, the solver's start [µm/s]
  std::vector<double> rest_length;                           ///< by edge; those of a face are its reference metric [µm]
  std::vector<std::optional<Vec3d>> nucleus;  ///< by shell: centre of its rigid nucleus; shells beyond the end have none [µm]
  std::vector<FaceState> face;                ///< by shell; empty: no shell has any

  [[nodiscard]] std::size_t size() const { return shape.size(); }
  [[nodiscard]] std::uint32_t node_count() const { return first_node.back(); }
  [[nodiscard]] std::span<Vec3d> nodes(std::size_t shell) {
    return std::span(position).subspan(first_node[shell], first_node[shell + 1] - first_node[shell]);
  }
  [[nodiscard]] std::span<const Vec3d> nodes(std::size_t shell) const {
    return std::span(position).subspan(first_node[shell], first_node[shell + 1] - first_node[shell]);
  }
  [[nodiscard]] const Vec3d* nucleus_of(std::size_t shell) const {
    return shell < nucleus.size() && nucleus[shell] ? &*nucleus[shell] : nullptr;
  }
  [[nodiscard]] const Topology& topology(std::size_t shell) const { return *shape[shell]->topology; }
  /// What the faces of a shell carry.
  [[nodiscard]] const FaceState& faces_of(std::size_t shell) const {
    static const FaceState kNothing;
    return shell < face.size() ? face[shell] : kNothing;
  }
  [[nodiscard]] FaceState& faces_of(std::size_t shell) {
    if (face.size() < size()) face.resize(size());
    return face[shell];
  }
};

/// Parameters of the single-cell mechanics of one cell type, in internal units (physics: dcm.md, time_stepping.md §9).
struct ShellParameters {
  double spring_stiffness = 0.0;       ///< k = (√3/2) E h [nN/µm]
  double local_area_modulus = 0.0;     ///< K_a of every face [nN/µm]
  double global_area_modulus = 0.0;    ///< K_G of the whole surface [nN/µm]
  double turnover_rate = 0.0;          ///< 1/τ at which rest lengths become the present ones [1/s]
  double edge_damping = 0.1;           ///< γ_int per edge, along the edge [nN·s/µm]
  double isotropic_damping = 0.0;      ///< γ_iso per edge, in all directions; resists rotation [nN·s/µm]
  double hinge_stiffness = 0.0;        ///< k_h = (2/√3) E h³ / (12 (1 − ν²)) [nN·µm]
  double helfrich_rigidity = 0.0;      ///< κ [nN·µm]
  double spontaneous_curvature = 0.0;  ///< c0 of the Helfrich energy [1/µm]
  double tension = 0.0;                ///< γ [nN/µm]
  double bulk_modulus = 2.5;           ///< K_V [kPa]
  double bulk_viscosity = 0.0;         ///< η_V of the volume [kPa·s]
  double shape_stiffness = 0.03;       ///< k_s of the triangle shape term k_s A_ref (1/q − 1)² [nN/µm]
  double barrier_stiffness = 1.0;      ///< k_d of the dihedral barrier k_d z²/(1 − z²) [nN·µm]
  double barrier_angle = 1.6;          ///< |θ| from which the barrier acts [rad]
  double medium_friction = 0.1;        ///< γ_med per area of the node [nN·s/µm³]
  std::vector<Sheet> sheets{};         ///< laws of the strain of a face, such as the neo-Hookean

  friend bool operator==(const ShellParameters&, const ShellParameters&) = default;
};

/// Sum of the strengths of the sheets, which are shear moduli; of `Number`s, as the caller adds them up [nN/µm].
template <class Number = double>
Number sheet_strengths(const ShellParameters& p) {
  Number sum(0);
  for (const Sheet& sheet : p.sheets) sum += static_cast<Number>(sheet.coefficient[0]);
  return sum;
}

}  // namespace morula::dcm
