#pragma once
#include <span>

#include "core/mesh/mark_sets.h"
#include "core/mesh/topology.h"
#include "core/mesh/triangle_mesh.h"
#include "core/vec3.h"

namespace morula {

inline Vec3d face_area_vector(const Triangle& t, std::span<const Vec3d> x) { return cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]) * 0.5; }
inline Vec3d face_middle(const Triangle& t, std::span<const Vec3d> x) { return (x[t[0]] + x[t[1]] + x[t[2]]) * (1.0 / 3.0); }

/// Function(face, area vector) for every face.
template <class F>
void for_faces(const Topology& topology, std::span<const Vec3d> x, F&& function) {
  for (const Triangle& t : topology.faces()) function(t, face_area_vector(t, x));
}

/// Function(face, area vector) for every face with a mark.
template <class F>
void for_marked_faces(const Topology& topology, std::span<const Vec3d> x, const MarkSets& marks, int mark, F&& function) {
  for (std::size_t f = 0; f < marks.size(); ++f)
    if (marks.has(f, mark)) function(topology.faces()[f], face_area_vector(topology.faces()[f], x));
}

inline void add_to_corners(const Triangle& t, const Vec3d& whole, std::span<Vec3d> force) {
  for (const std::uint32_t node : t) force[node] += whole * (1.0 / 3.0);
}

}  // namespace morula
