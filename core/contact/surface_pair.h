#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/contact_body.h"
#include "core/contact/traction_law.h"
#include "core/friction/contact_element.h"
#include "core/space/space.h"
#include "core/vec3.h"

namespace morula {

/// Contact of two materials as the contact layer needs it.
struct ContactMaterial {
  TractionLaw law;
  double sphere_modulus = 0.5;       ///< E/(1 − ν²) of the first material's spheres: they meet surfaces with sphere_foundation() [kPa]
  double normal_friction = 0.0;      ///< γ_n per contact area [nN·s/µm³]
  double tangential_friction = 0.0;  ///< γ_t per contact area [nN·s/µm³]
};

/// A body of a pair at present positions: a surface (its quadrature points are held against the other body, its faces are what the
/// other's points are held against), or a sphere (then `topology` is null and `position` holds its centre).
struct PairBody {
  const Topology* topology = nullptr;
  std::span<const Vec3d> position;
  std::span<const Vec3d> face_normal;
  std::span<const double> face_area;
  std::span<const Vec3d> node_normal;
  Vec3d shift{};        ///< added to the positions: periodic image, or how far an obstacle has moved
  double radius = 0.0;  ///< of a sphere

  [[nodiscard]] Vec3d node(std::uint32_t i) const { return position[i] + shift; }
  [[nodiscard]] Vec3d centroid(std::uint32_t face) const {
    const Triangle& t = topology->faces()[face];
    return (position[t[0]] + position[t[1]] + position[t[2]]) * (1.0 / 3.0) + shift;
  }
};

/// Reach of the candidate lists: contacts act at gaps below `range`; lists stay good while the bodies move less than `skin` against
/// each other; overlaps down to `depth` are seen (0: down to range + skin).
struct ListReach {
  double range = 0.5;
  double skin = 0.3;
  double depth = 0.0;

  /// Distance within which a face is a candidate when the lists are built.
  [[nodiscard]] double candidates() const { return (depth > range + skin ? depth : range + skin) + skin; }
};

/// Points of one body (the source) against the other (the target): candidate lists, and what can be kept between evaluations.
///
/// Lists and caches only save work: the nearest face is the exact nearest one whatever they hold, so that results do not depend on when
/// they were built.
struct PointsAgainstBody {
  std::vector<std::uint32_t> source_face;                 ///< faces of the source within reach of the target
  std::vector<std::array<std::uint16_t, 3>> source_node;  ///< their nodes, as numbered in the pair
  std::vector<std::uint32_t> target_face;                 ///< faces of the target that are a candidate of any source face
  std::vector<std::array<std::uint16_t, 3>> target_node;  ///< their nodes, as numbered in the pair
  std::vector<float> target_radius;                       ///< of a ball around the face's centroid, when the lists were built
  std::vector<std::uint32_t> first_candidate;             ///< by source face, one more at the end
  std::vector<std::uint16_t> candidate;                   ///< places in target_face, increasing
  std::vector<std::uint16_t> nearest;                     ///< by point: place of the nearest face in target_face, or kAsleep
  std::vector<float> good_until;                          ///< by point: the pair's motion up to which `nearest` is sure
};
inline constexpr std::uint16_t kAsleep = 0xFFFF;

/// Gradient of a pair's energy with respect to one of its bodies.
struct PairGradient {
  std::vector<std::uint16_t> node;   ///< nodes of the body that the pair can touch, increasing; a sphere has node 0
  std::vector<Vec3d> force;          ///< −∂E/∂x by node, at fixed face areas and normals [nN]
  std::vector<Vec3d> node_normal;    ///< ∂E/∂n_v by node; empty when zero [nN·µm]
  std::vector<double> face_energy;   ///< ∂E/∂A_T by source face [nN/µm]
  std::vector<Vec3d> face_normal;    ///< ∂E/∂n_T by source face; empty when zero [nN·µm]
  std::vector<double> face_contact;  ///< contact area of the face, by source face (ramp c/2 .. c) [µm²]
};

/// Two bodies in touch, at least one of them a surface; body a comes first in the canonical order. A rigid obstacle is always b.
struct SurfacePair {
  std::uint32_t a = 0, b = 0;  ///< bodies; b is the obstacle's number when `rigid`
  bool rigid = false;
  Vec3d shift{};                ///< image of b
  double motion = 0.0;          ///< how far the bodies have moved against each other since the pair came to be (an upper bound) [µm]
  double built_at = -1e300;     ///< motion when the lists were built
  PointsAgainstBody points[2];  ///< [0]: points of a against b; [1]: points of b against a
  PairGradient gradient[2];     ///< of a and of b
  std::vector<ContactElement> elements[2];       ///< at the present positions
  std::vector<ContactElement> step_elements[2];  ///< at the start of the step: its friction
  double energy = 0.0;                           ///< [nN·µm]
  double overlap = 0.0;                          ///< deepest penetration [µm]
};

/// Everything that evaluating one direction of a pair reads.
struct PointsEvaluation {
  const PairBody& source;
  const PairBody& target;
  const ContactMaterial& material;
  const FaceQuadrature& quadrature;
  ListReach reach;
  double share;   ///< ½ when both bodies are sources, else 1
  double motion;  ///< of the pair
  double motion_since_built;
  bool target_moves;                       ///< false for rigid obstacles: no gradient of the target is wanted
  std::span<const Vec3d> target_centroid;  ///< by place in the pair's target faces; filled by evaluate_points()
};

/// Fill the candidate lists of one direction. `target_faces` are the faces of the target that may be near, in increasing order (empty for
/// a sphere).
void build_point_lists(const PairBody& source, const PairBody& target, const ListReach& reach, int points_per_face,
                       std::span<const std::uint32_t> target_faces, PointsAgainstBody& lists);

/// Number the nodes of both bodies within the pair, after the lists of both directions are built.
void number_pair_nodes(const Topology* topology_a, const Topology* topology_b, SurfacePair& pair);

/// Set energy, overlap and gradients of a pair to zero and drop its elements.
void clear_results(SurfacePair& pair);

/// Add energy, gradients and elements of direction d (points of body d against the other) at the present positions.
void evaluate_points(const PointsEvaluation& evaluation, int d, SurfacePair& pair);

}  // namespace morula
