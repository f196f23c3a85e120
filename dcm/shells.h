#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/boxed.h"
#include "core/column.h"
#include "core/mesh/mark_sets.h"
#include "core/mesh/topology.h"
#include "core/vec3.h"
#include "dcm/sheet_law.h"

namespace morula::dcm {

/// What the faces of one shell carry beside their geometry, by face of its Topology. Empty arrays: zero everywhere.
struct FaceState {
  std::vector<std::uint8_t> mark;  ///< sets of marks, as many bytes for each face as the study has marks for (MarkSets)
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
  /// The marks of the faces of a shell.
  [[nodiscard]] MarkSets marks_of(std::size_t shell) const { return {faces_of(shell).mark, topology(shell).face_count()}; }
  [[nodiscard]] FaceState& faces_of(std::size_t shell) {
    if (face.size() < size()) face.resize(size());
    return face[shell];
  }
};

/// One shell by itself: what a cell carries along when it changes its body, is taken back, or moves to another rank.
struct ShellRecord {
  std::shared_ptr<const ReferenceShape> shape;
  double reference_volume = 0.0;
  double rest_volume = 0.0;
  std::vector<Vec3d> position;
  std::vector<Vec3f> velocity;
  std::vector<double> rest_length;
  FaceState face{};
  std::optional<Vec3d> nucleus{};      ///< centre of its rigid nucleus
  Boxed<ShellRecord> nuclear_shell{};  ///< its nucleus that is a shell
  std::uint16_t type = 0;              ///< that of its cell, which gives it
};

// --- Columns: what a shell has beside its shape, declared once. The walks over them (records, messages between ranks, checkpoint, state hash,
// memory) need nothing else; what is added here is everywhere. A column of Shells knows: name, unit, T, kDomain, kFill;
//   values(shells, i), values(record)     the values of one shell; none where it has none
//   append(shells, values)                those of the shell that was added last (its shape is there already)
//   give(record, values), copy(shells, from)
//   rules                                 what growth, an exchange of bodies and another mesh do with it
// At an exchange of bodies, columns of nodes with the name of one of spheres go over to it as their mean, and back to every node, if another mesh
// does not make them anyhow.

/// One value of each shell.
template <class T>
using ColumnOfShells = ColumnOfBodies<T, Shells, ShellRecord>;

/// One value of each node, or of each edge.
template <class T, Domain kOf>
struct ColumnOfMesh {
  using Value = T;
  static constexpr Domain kDomain = kOf;
  static constexpr Fill kFill = Fill::kAll;
  const char* name;
  const char* unit;
  std::vector<T> Shells::*all;
  std::vector<T> ShellRecord::*one;
  ColumnRules rules{};

  [[nodiscard]] std::span<const T> values(const Shells& shells, std::size_t i) const {
    const auto& first = kOf == Domain::kNode ? shells.first_node : shells.first_edge;
    return std::span(shells.*all).subspan(first[i], first[i + 1] - first[i]);
  }
  [[nodiscard]] std::span<const T> values(const ShellRecord& shell) const { return shell.*one; }
  void append(Shells& shells, std::span<const T> values) const { (shells.*all).insert((shells.*all).end(), values.begin(), values.end()); }
  void give(ShellRecord& shell, std::span<const T> values) const { (shell.*one).assign(values.begin(), values.end()); }
  void copy(Shells& shells, const Shells& from) const { shells.*all = from.*all; }
  [[nodiscard]] std::size_t memory(const Shells& shells) const { return (shells.*all).capacity() * sizeof(T); }
};

/// As many values of each face, for the shells that have any.
template <class T>
struct ColumnOfFaces {
  using Value = T;
  static constexpr Domain kDomain = Domain::kFace;
  static constexpr Fill kFill = Fill::kAllOrNone;
  const char* name;
  const char* unit;
  std::vector<T> FaceState::*of;
  ColumnRules rules{};
  T of_new_face{};  ///< of faces of the interface that a division makes

  [[nodiscard]] std::span<const T> values(const Shells& shells, std::size_t i) const { return shells.faces_of(i).*of; }
  [[nodiscard]] std::span<const T> values(const ShellRecord& shell) const { return shell.face.*of; }
  void append(Shells& shells, std::span<const T> values) const {
    if (!values.empty()) (shells.faces_of(shells.size() - 1).*of).assign(values.begin(), values.end());
  }
  void give(ShellRecord& shell, std::span<const T> values) const { (shell.face.*of).assign(values.begin(), values.end()); }
  void copy(Shells& shells, const Shells& from) const {
    shells.face.resize(std::max(shells.face.size(), from.face.size()));
    for (std::size_t i = 0; i < shells.face.size(); ++i) shells.face[i].*of = from.faces_of(i).*of;
  }
  [[nodiscard]] std::size_t memory(const Shells& shells) const {
    std::size_t bytes = 0;
    for (const FaceState& face : shells.face) bytes += (face.*of).capacity() * sizeof(T);
    return bytes;
  }
};

/// The centres of the rigid nuclei.
struct ColumnOfNuclei {
  using Value = Vec3d;
  static constexpr Domain kDomain = Domain::kBody;
  static constexpr Fill kFill = Fill::kAllOrNone;
  const char* name;
  const char* unit;
  ColumnRules rules{};

  [[nodiscard]] static std::span<const Vec3d> values(const Shells& shells, std::size_t i) {
    return {shells.nucleus_of(i), shells.nucleus_of(i) != nullptr ? 1u : 0u};
  }
  [[nodiscard]] static std::span<const Vec3d> values(const ShellRecord& shell) {
    return {shell.nucleus ? &*shell.nucleus : nullptr, shell.nucleus ? 1u : 0u};
  }
  static void append(Shells& shells, std::span<const Vec3d> values) {
    if (values.empty()) return;
    shells.nucleus.resize(shells.size());
    shells.nucleus.back() = values[0];
  }
  static void give(ShellRecord& shell, std::span<const Vec3d> values) {
    shell.nucleus = values.empty() ? std::nullopt : std::optional(values[0]);
  }
  static void copy(Shells& shells, const Shells& from) { shells.nucleus = from.nucleus; }
  [[nodiscard]] static std::size_t memory(const Shells& shells) { return shells.nucleus.capacity() * sizeof(shells.nucleus[0]); }
};

/// visit(column) for all columns of shells, in the order of the state hash.
template <class Visit>
void for_each_shell_column(Visit&& visit) {
  using enum OnNewMesh;
  visit(ColumnOfShells<std::uint16_t>{"type", "1", &Shells::type, &ShellRecord::type});
  visit(ColumnOfShells<double>{
      "reference_volume", "um^3", &Shells::reference_volume, &ShellRecord::reference_volume, {.grows = true, .on_new_mesh = kByVolume}});
  visit(ColumnOfShells<double>{
      "rest_volume", "um^3", &Shells::rest_volume, &ShellRecord::rest_volume, {.grows = true, .on_new_mesh = kMade}});
  visit(ColumnOfMesh<Vec3d, Domain::kNode>{"position", "um", &Shells::position, &ShellRecord::position, {.on_new_mesh = kMade}});
  visit(ColumnOfMesh<Vec3f, Domain::kNode>{"velocity", "um/s", &Shells::velocity, &ShellRecord::velocity, {.on_new_mesh = kMean}});
  visit(ColumnOfMesh<double, Domain::kEdge>{
      "rest_length", "um", &Shells::rest_length, &ShellRecord::rest_length, {.grows = true, .on_new_mesh = kMade}});
  visit(ColumnOfNuclei{"nucleus", "um", {.on_new_mesh = kMade}});
  visit(ColumnOfFaces<std::uint8_t>{"mark", "1", &FaceState::mark, {.on_new_mesh = kByCoverage}});
  visit(ColumnOfFaces<float>{"face_contact", "1", &FaceState::contact, {.on_new_mesh = kByPlace}, 1.0f});
}

/// How many values of a column a shell of this shape has.
inline std::size_t count_of(Domain domain, const ReferenceShape& shape) {
  switch (domain) {
    case Domain::kNode:
      return shape.topology->node_count();
    case Domain::kEdge:
      return shape.topology->edge_count();
    case Domain::kFace:
      return shape.topology->face_count();
    case Domain::kBody:
      break;
  }
  return 1;
}

/// Shell i by itself, without a nucleus that is a shell.
ShellRecord shell_out_of(const Shells& shells, std::size_t i);
/// Adds a shell behind the others; its nucleus that is a shell is not looked at.
void add_shell(Shells& shells, const ShellRecord& shell);
/// Adds the shells first, …, last − 1 of `from` behind the others.
void add_shells(Shells& shells, const Shells& from, std::size_t first, std::size_t last);
/// Bytes of all columns.
std::size_t memory_of(const Shells& shells);

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

/// Makes a surface stiffer by a factor: its moduli in the plane and against bending. Tension, volume and what only keeps the mesh in order stay.
inline void scale_stiffness(ShellParameters& p, double factor) {
  for (double* modulus : {&p.spring_stiffness, &p.local_area_modulus, &p.global_area_modulus, &p.hinge_stiffness, &p.helfrich_rigidity})
    *modulus *= factor;
  for (Sheet& sheet : p.sheets) sheet.coefficient[0] *= factor;
}

/// The parameters of some shells: those of their types, or of each its own.
class ShellMaterials {
 public:
  ShellMaterials(std::span<const ShellParameters> by_type) : all_(by_type) {}     // NOLINT: parameters by type are what it says
  ShellMaterials(const std::vector<ShellParameters>& by_type) : all_(by_type) {}  // NOLINT
  static ShellMaterials of_each(std::span<const ShellParameters> by_shell) { return {by_shell, true}; }

  [[nodiscard]] const ShellParameters& of(const Shells& shells, std::size_t shell) const {
    return all_[each_ ? shell : shells.type[shell]];
  }

 private:
  ShellMaterials(std::span<const ShellParameters> all, bool each) : all_(all), each_(each) {}

  std::span<const ShellParameters> all_;
  bool each_ = false;
};

/// Sum of the strengths of the sheets, which are shear moduli; of `Number`s, as the caller adds them up [nN/µm].
template <class Number = double>
Number sheet_strengths(const ShellParameters& p) {
  Number sum(0);
  for (const Sheet& sheet : p.sheets) sum += static_cast<Number>(sheet.coefficient[0]);
  return sum;
}

/// Whether the surface remembers how it is stretched; else it is a fluid.
inline bool has_elastic_surface(const ShellParameters& p) { return p.spring_stiffness > 0.0 || !p.sheets.empty(); }

/// Whether a law asks for the strain of faces, whose rest lengths then are those of triangles; of others they need not be.
inline bool strains_faces(const ShellParameters& p) {
  return !p.sheets.empty() || p.local_area_modulus > 0.0 || p.global_area_modulus > 0.0;
}

}  // namespace morula::dcm
