#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/contact/contact_body.h"
#include "core/contact/packed_points.h"
#include "core/contact/regional_adhesion.h"
#include "core/contact/surface_traction.h"
#include "core/friction/contact_element.h"
#include "core/mesh/face_quadrature.h"
#include "core/mesh/mark_sets.h"
#include "core/space/space.h"
#include "core/vec3.h"

namespace morula {

/// Friction of a contact per contact area [nN·s/µm³].
struct FrictionPerArea {
  double normal = 0.0;      ///< γ_n
  double tangential = 0.0;  ///< γ_t
};

/// Contact of two materials as the contact layer needs it.
struct ContactMaterial {
  SurfaceTraction law;
  double sphere_modulus = 0.5;    ///< E/(1 − ν²) of the first material's spheres: they meet surfaces with sphere_foundation() [kPa]
  double sphere_stiffness = 1.0;  ///< of their foundation over sphere_foundation()
  double sphere_adhesion = 1.0;   ///< W of these spheres with shells over that of the law
  double tension = 0.0;           ///< of surfaces of the first material in contact: what a new interface of sisters begins with [nN/µm]
  double tension_drop = 0.0;      ///< which surfaces of the first material lose in contact with the second, and adhere by [nN/µm]
  double new_surface = 0.0;       ///< time in which such an interface takes its own adhesion: the longer one of both materials [s]
  FrictionPerArea friction{};     ///< of two surfaces
  FrictionPerArea with_sphere{};  ///< of a sphere of the first material with a surface of the second
  std::shared_ptr<const RegionalAdhesion>
      regional{};  ///< W by the marks of the faces, in place of that of the law; null: everywhere the same
  double self_distance =
      0.0;  ///< of a material with itself: how near a surface lets parts of its own come (core/contact/self_contact.h); 0: off [µm]
  double self_radius = 0.0;  ///< typical radius of its bodies, from which the length of their edges follows [µm]
};

/// A body of a pair at present positions: a surface (its quadrature points are held against the other body, its faces are what the
/// other's points are held against), or a sphere (then `topology` is null and `position` holds its centre).
struct PairBody {
  const Topology* topology = nullptr;
  std::span<const Vec3d> position;
  std::span<const Vec3d> node_normal;
  Vec3d shift{};        ///< added to the positions: periodic image, or how far an obstacle has moved
  double radius = 0.0;  ///< of a sphere
  MarkSets marks{};     ///< by face; empty: none

  [[nodiscard]] Vec3d node(std::uint32_t i) const { return position[i] + shift; }
  /// Unit and outward.
  [[nodiscard]] Vec3d face_normal(std::uint32_t face) const {
    const Triangle& t = topology->faces()[face];
    return normalized(cross(position[t[1]] - position[t[0]], position[t[2]] - position[t[0]]));
  }
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

/// A vector and a zero: one register.
struct alignas(32) PaddedVec3 {
  using Vector [[gnu::vector_size(32)]] = double;
  Vector v{};

  static Vector of(const Vec3d& a) { return Vector{a.x, a.y, a.z, 0.0}; }
  [[nodiscard]] Vec3d value() const { return {v[0], v[1], v[2]}; }
};

/// Gradient of a pair's energy with respect to one of its bodies, good until the next pair is evaluated.
struct PairGradient {
  std::vector<PaddedVec3> force;  ///< −∂E/∂x by node of the body, at fixed face areas and node normals [nN]; zero but at the pair's nodes
  std::vector<Vec3d> node_normal;          ///< ∂E/∂n_v likewise [nN·µm]
  bool has_node_normal = false;            ///< false: all of node_normal is zero
  std::vector<double> face_energy;         ///< ∂E/∂A_T by source face [nN/µm]
  std::vector<float> told_area;            ///< of these in contact [µm²]
  std::vector<std::uint32_t> source_face;  ///< these faces
  double contact_area = 0.0;               ///< of the faces of this body, see SurfacePair::area [µm²]
};

/// Two bodies in touch, at least one of them a surface; body a comes first in the canonical order. A rigid obstacle is always b. A surface that
/// may touch itself is a pair with itself, with points in the first direction only.
struct SurfacePair {
  std::uint32_t a = 0, b = 0;  ///< bodies; b is the obstacle's number when `rigid`
  bool rigid = false;
  bool at_start = false;      ///< not evaluated since the step began: the elements are those of its start
  Vec3d shift{};              ///< image of b
  std::uint32_t image = 0;    ///< of an obstacle: SurfaceImage::number
  double motion = 0.0;        ///< how far the bodies have moved against each other since the pair came to be (an upper bound) [µm]
  double built_at = -1e300;   ///< motion when the lists were built
  double patch_motion = 0.0;  ///< that of the nodes in the lists alone, since the lists were built
  PackedPoints points[2];     ///< [0]: points of a against b; [1]: points of b against a
  std::vector<std::uint16_t> node[2];           ///< nodes of a and of b in these lists, increasing; a sphere has node 0, an obstacle none
  std::span<const ContactElement> elements[2];  ///< at the present positions; see present(). In the layer's stores.
  std::span<const ContactElement> step_elements[2];  ///< at the start of the step: its friction
  double energy = 0.0;                               ///< [nN·µm]
  double overlap = 0.0;                              ///< deepest penetration [µm]
  /// Of both surfaces in contact: what is nearer than half the range (contact_share() in traction_law.h), with adhesion or without. In the wedge
  /// beside a contact of radius a and angle θ it is too large by a part c/(2 a tan θ); the bevel that a coarse mesh has for its rim takes some of it
  /// away (doublets of 162 nodes: time_stepping.md §12.3). [µm²]
  double area = 0.0;
  /// Of the virial Σ x ⊗ f of this pair's forces on a and on b, what neither body bears for the other: the tension that adhesion takes from the
  /// surface, and between two surfaces half of forces times gaps. Less these, both virials sum to that of one force from centre to centre. Of a surface and a
  /// sphere it is the whole virial on the surface about the sphere's centre: one force in the middle of the contact stands for it (SphereTouch) [nN·µm].
  SymMat3<float> within[2];
  Vec3d push;                 ///< force on the obstacle or the sphere of the pair [nN]
  double step_overlap = 0.0;  ///< `overlap` at the start of the step [µm]
  std::uint32_t crossed = 0;  ///< points that are on another side than at the start of the step; see crossing.h
  double crossed_at = 1e300;  ///< of a surface against itself: the least distance of such a point from the other side [µm]

  [[nodiscard]] bool with_itself() const { return !rigid && a == b; }
  [[nodiscard]] std::span<const ContactElement> present(std::size_t d) const { return at_start ? step_elements[d] : elements[d]; }
};

/// Pairs come in the order of these: by the places of their bodies, obstacles with their images and then surfaces with themselves last.
inline std::array<std::uint64_t, 3> pair_key(const ContactScene& scene, const SurfacePair& pair) {
  const std::uint64_t kind = pair.rigid ? 1 : pair.with_itself() ? 2 : 0;
  return {kind, scene.bodies[pair.a].place, pair.rigid ? std::uint64_t{pair.b} << 32 | pair.image : scene.bodies[pair.b].place};
}

/// Everything that evaluating one direction of a pair reads.
struct PointsEvaluation {
  const PairBody& source;
  const PairBody& target;
  const ContactMaterial& material;
  const FaceQuadrature& quadrature;
  ListReach reach;
  double share;               ///< ½ when both bodies are sources, else 1
  double motion;              ///< of the nodes in the pair's lists since these were built
  double motion_since_built;  ///< of the whole bodies
  bool target_moves;          ///< false for rigid obstacles: no gradient of the target is wanted
  bool with_itself = false;   ///< source and target are one surface (core/contact/self_contact.h)
};

/// A quadrature point under evaluation.
struct ContactPoint {
  Vec3d position;
  std::uint32_t source_place;  ///< of its face in the pair's source faces
  std::uint16_t q;
  std::uint16_t place = kNoFace;  ///< of the nearest face in the pair's target faces; kNoFace: none within the reach of the lists
  double second = -1.0;           ///< no other face is nearer than this [µm]; < 0 where nothing was searched
};

/// A point of a contact that may be on another side of its target than it was at the start of the step (crossing.h).
struct SuspectPoint {
  std::uint32_t source;  ///< as in ContactElement
  bool inside;           ///< the gap is negative now
  double distance;       ///< |g| [µm]
};

/// What one thread needs to evaluate pairs.
struct PointsWorkspace {
  struct Ball {
    Vec3d center;
    double radius;
  };
  struct Job {  ///< the distance of a point from a face
    std::uint32_t point;
    std::uint16_t place;
  };
  std::vector<ContactPoint> points;
  std::vector<std::uint32_t> search;  ///< points whose nearest face is not sure
  std::vector<Ball> ball;             ///< around the target's faces
  std::vector<Job> jobs;
  std::vector<double> distance2;         ///< by job
  std::vector<double> guessed;           ///< of the guesses
  std::vector<ContactElement> elements;  ///< of one direction of a pair
  std::vector<SuspectPoint> suspects;    ///< points that may have changed their side
  PointsAgainstBody lists;
};

/// Fill the candidate lists of one direction. `target_faces` are the faces of the target that may be near, in increasing order (empty for
/// a sphere). `old` are the lists before; since they were built, the pair's nodes have moved by `motion` and the whole bodies by
/// `motion_since_built`. With `rings` > 0 source and target are one surface, and faces within so many edges of the source face are left out.
void build_point_lists(const PairBody& source, const PairBody& target, const ListReach& reach, int points_per_face,
                       std::span<const std::uint32_t> target_faces, const PointsAgainstBody& old, double motion, double motion_since_built,
                       PointsAgainstBody& lists, int rings = 0);

/// Note the nodes of both bodies that the lists of both directions can touch.
void collect_pair_nodes(const Topology* topology_a, const Topology* topology_b, const PointsAgainstBody (&lists)[2], SurfacePair& pair);

/// Set energy and overlap of a pair to zero, drop its elements, and make the gradients of its bodies (`node_count` of each) zero.
void clear_results(SurfacePair& pair, const std::size_t (&node_count)[2], PairGradient (&gradient)[2]);

/// Add energy and gradients of direction d (points of body d against the other) at the present positions; elements go to the workspace.
void evaluate_points(const PointsEvaluation& evaluation, int d, SurfacePair& pair, PairGradient (&gradient)[2], PointsWorkspace& workspace);

}  // namespace morula
