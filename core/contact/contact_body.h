#pragma once
#include <cstdint>
#include <span>

#include "core/cell_id.h"
#include "core/mesh/mark_sets.h"
#include "core/mesh/surface_geometry.h"
#include "core/mesh/topology.h"
#include "core/vec3.h"

namespace morula {

enum class BodyShape : std::uint8_t { kSphere, kSurface };

/// What the contact layer knows of a body: where its points are, and its place in the canonical order. There may be 100,000 spheres: what
/// only surfaces have is in ContactScene.
struct ContactBody {
  CellId id;
  double radius = 0.0;            ///< of a sphere [µm]
  std::uint32_t place = 0;        ///< place in the canonical order among the bodies of this rank, ghosts included
  std::uint32_t first_point = 0;  ///< into the positions; a sphere has one point
  std::uint32_t point_count = 1;
  std::uint16_t material = 0;
  BodyShape shape = BodyShape::kSphere;
  bool owned : 1 = true;  ///< false: a read-only ghost
  bool moves : 1 = true;  ///< false: held in place while others relax around it

  /// Its points are unknowns of this rank.
  [[nodiscard]] bool active() const { return owned && moves; }
};
static_assert(sizeof(ContactBody) == 32);

/// Bodies at some positions; surfaces come first.
struct ContactScene {
  std::span<const ContactBody> bodies;
  std::span<const Vec3d> position;
  std::span<const Topology* const> topology;  ///< of the surfaces
  std::span<const std::uint32_t> first_face;  ///< of the surfaces, into the geometry
  const SurfaceGeometry* geometry = nullptr;  ///< of the surfaces at these positions: normals of nodes, indexed as `position`
  MarkSets marks{};                           ///< by face of the surfaces; empty: no adhesion asks for them

  /// Of a body by number: null for a sphere.
  [[nodiscard]] const Topology* topology_of(std::size_t body) const { return body < topology.size() ? topology[body] : nullptr; }
};

}  // namespace morula
