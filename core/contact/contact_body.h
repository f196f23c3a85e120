#pragma once
#include <cstdint>
#include <span>

#include "core/cell_id.h"
#include "core/mesh/surface_geometry.h"
#include "core/mesh/topology.h"
#include "core/vec3.h"

namespace morula {

enum class BodyShape : std::uint8_t { kSphere, kSurface };

/// What the contact layer knows of a body: where its points and faces are, and its place in the canonical order.
struct ContactBody {
  CellId id;
  std::uint32_t place = 0;        ///< place in the canonical order among the bodies of this rank, ghosts included
  std::uint32_t first_point = 0;  ///< into the positions; a sphere has one point
  std::uint32_t point_count = 1;
  std::uint32_t first_face = 0;  ///< into the surface geometry (surfaces only)
  const Topology* topology = nullptr;
  double radius = 0.0;  ///< of a sphere [µm]
  std::uint16_t material = 0;
  BodyShape shape = BodyShape::kSphere;
  bool owned = true;  ///< false: a read-only ghost
  bool moves = true;  ///< false: held in place while others relax around it

  /// Its points are unknowns of this rank.
  [[nodiscard]] bool active() const { return owned && moves; }
};

/// Bodies at some positions. `geometry` is that of the surfaces at these positions: normals of nodes, indexed as `position`.
struct ContactScene {
  std::span<const ContactBody> bodies;
  std::span<const Vec3d> position;
  const SurfaceGeometry* geometry = nullptr;
  std::span<const std::uint8_t> mark{};  ///< sets of marks by face of the surfaces; empty: no adhesion asks for them
};

}  // namespace morula
