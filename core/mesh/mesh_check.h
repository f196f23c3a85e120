#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/result.h"

namespace morula {

enum class MeshProblemKind : std::uint8_t {
  kEmpty,             ///< no faces
  kBadIndex,          ///< a face names a node that does not exist
  kNotFinite,         ///< a coordinate is NaN or infinite
  kDegenerateFace,    ///< a face with a repeated node or without area
  kDuplicateFace,     ///< two faces with the same nodes
  kUnusedNode,        ///< a node that no face names
  kNonManifoldEdge,   ///< an edge with three or more faces
  kNonManifoldNode,   ///< the faces around a node form more than one fan
  kHole,              ///< a border: edges with one face
  kFlippedFaces,      ///< a patch whose faces run against the rest of their surface
  kNotOrientable,     ///< no choice of directions makes the faces agree (a Möbius band)
  kInsideOut,         ///< a closed surface whose faces point into the solid
  kSelfIntersection,  ///< two faces that cross, touch or lie on each other
};

/// One thing that is wrong with a mesh, and where.
struct MeshProblem {
  MeshProblemKind kind;
  std::string message;               ///< for the user: what, which faces, at which coordinates
  std::vector<std::uint32_t> faces;  ///< all faces that take part, in increasing order where there are many
  Vec3d place;                       ///< in the middle of it
};

/// What a mesh is to be.
struct MeshExpectation {
  bool closed = true;   ///< borders are problems; when false, an open surface (a plane) is fine
  bool outward = true;  ///< closed parts point outwards, parts that bound a cavity inside another one into the cavity
  bool no_self_intersection = true;
  std::size_t most_of_a_kind =
      10;  ///< list so many problems of each kind; the last one says how many more there are (crossings: that there are more)
};

/// Everything that is wrong with a triangle mesh, in the order of MeshProblemKind; empty when it is what it should be.
///
/// Topology::build() accepts every mesh that passes with `closed`. A face has no area when its corners lie exactly on a line or its height is below
/// 10⁻¹⁰ of its longest side. A bad index or coordinate ends the check early: geometry cannot be judged then.
std::vector<MeshProblem> check_mesh(std::span<const Vec3d> position, std::span<const Triangle> faces,
                                    const MeshExpectation& expectation = {});

/// check_mesh() as a Status: an error that names `name` and lists all problems.
Status require_sound_mesh(const std::string& name, std::span<const Vec3d> position, std::span<const Triangle> faces,
                          const MeshExpectation& expectation = {});

/// How many times the closed surface made of these faces winds around a point: 1 inside, 0 outside, −1 inside when the faces point inwards
/// (sum of solid angles over 4π; Van Oosterom & Strackee 1983, doi:10.1109/TBME.1983.325207).
double winding_number(std::span<const Vec3d> position, std::span<const Triangle> faces, const Vec3d& point);

}  // namespace morula
