#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/mesh/renewal/asked_surface.h"
#include "dcm/shells.h"

namespace morula {

/// A mesh that stands for the surface of a shell, or for a part of it, and what it is to have of that shell.
struct NewMesh {
  const dcm::ShellRecord& old;  ///< the shell as it was
  const AskedSurface& surface;  ///< what the new mesh stands for
  std::span<const std::uint32_t>
      source_face;                  ///< by face of the surface, the face of the shell that it is (a part of); faces beyond the end are new
  const ReferenceShape& shape;      ///< of the new mesh
  std::span<const Vec3d> position;  ///< of its nodes [µm]
  std::span<const char> is_new{};   ///< by face of it: made by the event, as the interface of a division; empty: none

  [[nodiscard]] bool face_is_new(std::size_t face) const { return !is_new.empty() && is_new[face] != 0; }
};

/// Rest lengths of the old metric where the nearest point is of the old surface; of new faces the present ones. The metric of a face with rest lengths
/// l1, l2, l3 is the form that gives its three sides these lengths. Where a law asks for the strain of faces (`of_triangles`), a face that would have no
/// triangle of such lengths, or a much flatter one than it is itself, has its edges shortened alike; springs do without.
std::vector<double> carried_rest_lengths(const NewMesh& mesh, bool of_triangles);

/// The stress-free shape of a shell on a mesh with connectivity of its own, of nodes at `position` that lie on the old surface.
///
/// Of an elastic surface, edges have the lengths that the metric of the old shape gives them, and faces the areas of these lengths. A fluid one forgets: they are
/// those of the mesh itself at unit volume. Areas are scaled so that their sum stays. Rest angles keep the curvature c0 = θ0 / l* of the old shape, the
/// mean over the edges of a face, with l* = ⅔ (A1 + A2) / l the distance between the faces of an edge (dcm.md §14).
std::shared_ptr<const ReferenceShape> carried_shape(const dcm::ShellRecord& old, const AskedSurface& surface,
                                                    std::shared_ptr<const Topology> topology, std::span<const Vec3d> position,
                                                    bool is_elastic);

/// The columns of the old shell that follow a rule of theirs (ColumnRules::on_new_mesh), on the new mesh. `part`: of the old volume that it encloses.
void carry_columns(const NewMesh& mesh, double part, dcm::ShellRecord& out);

}  // namespace morula
