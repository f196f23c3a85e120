#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/contact/body_changes.h"
#include "core/contact/broad_phase.h"
#include "core/contact/common_drift.h"
#include "core/contact/contact_body.h"
#include "core/contact/element_store.h"
#include "core/contact/objective_friction.h"
#include "core/contact/packing_points.h"
#include "core/contact/rigid_surface.h"
#include "core/contact/sister_bond.h"
#include "core/contact/surface_pair.h"
#include "core/friction/contact_element.h"
#include "core/parallel/comm.h"

namespace morula {

/// Two spheres that may touch; body a comes first in the canonical order. On periodic axes the nearest image counts.
struct SphereNeighbours {
  std::uint32_t a, b;
};

struct ContactSettings {
  double range = 0.5;         ///< c [µm]
  double skin = 0.3;          ///< of a pair's lists [µm]
  double body_skin = 1.0;     ///< of the list of pairs [µm]
  double sphere_reach = 0.0;  ///< largest gap at which two spheres still pull [µm]
  double depth = 0.0;         ///< overlap that must be seen; 0: what the skin allows [µm]
  int points_per_face = 3;
  int threads = 1;
  bool objective_friction = false;  ///< friction that does not feel common rotations (core/contact/objective_friction.h)
};

/// Gradients that contacts leave on the points and faces of all bodies; sized like the scene. Only owned bodies are written.
struct ContactGradient {
  std::vector<Vec3d> force;         ///< by point: at fixed face areas and node normals
  std::vector<Vec3d> node_normal;   ///< ∂E/∂n_v by point
  std::vector<double> face_energy;  ///< ∂E/∂A_T by face
  std::vector<float> told_area;     ///< by face: its area in contact, summed over all that it touches; contact_area() [µm²]

  /// Zero for so many points, of which the first `surface_points` may belong to surfaces, and faces.
  void set_zero(std::size_t points, std::size_t surface_points, std::size_t faces);
  /// Area in contact of a surface whose faces begin with `first_face` [µm²]. A face counts with its own area at most: along the edges of cells it is near
  /// to two others and more.
  [[nodiscard]] double contact_area(std::span<const Triangle> faces, std::span<const Vec3d> nodes, std::size_t first_face) const;
  [[nodiscard]] std::size_t memory() const;
};

/// How one surface touches a sphere.
struct SphereTouch {
  std::uint32_t sphere = 0, surface = 0;  ///< bodies
  Vec3d place;                            ///< middle of the contact, halfway between both surfaces, from the sphere's centre [µm]
  Vec3d force;                            ///< on the sphere [nN]
  double area = 0.0;                      ///< of the surface in contact [µm²]
  double bulge = 0.0;                     ///< what the surface would hold more if its contact were flat there [µm³]
};

/// By body, ghosts too, how it differs from its material; empty: it does not.
struct OwnFactors {
  std::vector<double> tension;    ///< of a new interface of sisters (SisterBond)
  std::vector<double> stiffness;  ///< on the modulus of a sphere
  std::vector<double> adhesion;   ///< W of a pair takes the geometric mean of both; an obstacle's is 1
};

/// Which pairs are meant: surfaces with surfaces and obstacles, or with spheres.
enum class SurfacePairKind : std::uint8_t { kSurfaces, kWithSphere };

/// Contacts of all bodies of a rank: which bodies may touch, and for surfaces the gaps, energies, gradients and friction elements.
///
/// Every pair with at least one owned body is evaluated here, whole, by one thread; a pair across two ranks is evaluated on both,
/// identically. Sums over the pairs of a body run in canonical order. Pairs of two spheres are only listed: their laws live elsewhere.
class ContactLayer {
 public:
  ContactLayer(ContactSettings settings, RigidSurfaces obstacles, std::vector<ContactMaterial> materials, std::size_t material_count);

  /// The bodies have changed. Lists of pairs are kept where both bodies stay what they were. Topologies of the old bodies must not go before the
  /// next rebuild(): a body is the same if its id and its Topology are.
  void reset() { fresh_ = true; }
  /// A few bodies have come or gone and all others are where they were at the last note_motion(): lists are mended. Pairs of bodies that have gone go,
  /// and the pairs of new ones are found; what the others have moved since their pairs were found still counts. Pairs of new spheres wait for
  /// take_sphere_neighbours(). Where the lists were to be made anew in any case, they still are.
  void mend(const ContactScene& scene, const Space& space, const BodyChanges& changes);
  /// Spheres that have strayed from what is common to all, since their pairs were found, and will soon have gone as far as these allow for, come in `changes`
  /// as if they had gone and come again: few fast ones (sisters) do not wear out the lists of all. Before mend(). None where there are many.
  void add_strays(BodyChanges& changes) const;
  /// Lists are to be made anew before evaluate().
  [[nodiscard]] bool is_stale() const { return fresh_; }
  /// The elements of some pairs are those that begin_step() found.
  [[nodiscard]] bool is_at_step_start() const;
  void set_depth(double depth);
  void set_offsets(std::span<const Vec3d> offsets);
  void set_cap(double cap);
  /// Part of adhesion that acts, 0 to 1: a new shell is let out of deep overlap before it sticks to its neighbours.
  void set_bonding(double part) { bonding_ = part; }
  /// Of the bodies of the scene; lists stay what they are.
  void set_own_factors(OwnFactors factors) { own_ = std::move(factors); }
  [[nodiscard]] const OwnFactors& own_factors() const { return own_; }
  /// Tensions of surfaces where others have them at another time: those of `materials`, in the same order as at the start.
  void take_tensions(std::span<const ContactMaterial> materials) {
    for (std::size_t i = 0; i < materials_.size(); ++i) {
      materials_[i].tension = materials[i].tension;
      materials_[i].tension_drop = materials[i].tension_drop;
    }
  }
  /// Surfaces of sisters that adhere otherwise than their materials do; sorted by cell.
  void set_sister_bonds(std::vector<SisterBond> bonds) { sister_bonds_ = std::move(bonds); }
  [[nodiscard]] const std::vector<SisterBond>& sister_bonds() const { return sister_bonds_; }
  [[nodiscard]] double bonding() const { return bonding_; }
  [[nodiscard]] double cap() const { return materials_.empty() ? 0.0 : materials_.front().law.cap; }

  /// Take note of how far the bodies have moved since the last call. True when the list of pairs is no longer sure: rebuild() is due
  /// before evaluate(). Local to the rank; on several ranks all rebuild when one must.
  [[nodiscard]] bool note_motion(const ContactScene& scene);
  /// How much of the way that the list of pairs allows for was used up at the last note_motion(), 1: all of it.
  [[nodiscard]] double skin_used() const { return skin_used_; }
  /// How often the list of pairs has been made anew.
  [[nodiscard]] std::uint64_t times_rebuilt() const { return times_rebuilt_; }
  /// Find the pairs of bodies again. On several ranks the ghosts must be renewed first.
  void rebuild(const ContactScene& scene, const Space& space);
  /// The same with these pairs of surfaces (first and second body, in canonical order) and no others.
  void rebuild(const ContactScene& scene, std::span<const std::pair<std::uint32_t, std::uint32_t>> pairs);

  /// Narrow phase of the surface pairs of one kind at the present positions: energies and elements, kept; gradients are added to `gradient`.
  void evaluate(const ContactScene& scene, SurfacePairKind kind, ContactGradient& gradient);
  /// The same of the bodies with these[body] != 0 alone, where all others are as they were at the last evaluate(): their gradients are added, and what
  /// was found of pairs without one of these stays. Not after begin_step() or make_room().
  void evaluate_of(std::span<const char> these, const ContactScene& scene, SurfacePairKind kind, ContactGradient& gradient);
  /// What surfaces take of each sphere at the present positions, added to `by_body` in canonical order; before evaluate() of that kind.
  void find_penetration(const ContactScene& scene, std::span<Penetration> by_body);
  /// Pressures of spheres by body (of surfaces: ignored), from here on; none: spheres do not resist their packing.
  void set_packing(std::span<const SpherePressure> by_body) { packing_.assign(by_body.begin(), by_body.end()); }
  /// A pair with a point that changed its side since the step began though its gap cannot have passed through zero (crossing.h), as the
  /// contacts were found last; null: none, or a start from overlap, where nearest faces may jump. `start`: positions at the start of the step.
  [[nodiscard]] const SurfacePair* crossed(const ContactScene& scene, std::span<const Vec3d> start) const;
  [[nodiscard]] bool has_pairs(SurfacePairKind kind) const { return !pairs_of_kind_[static_cast<std::size_t>(kind)].empty(); }

  /// Energy of the pairs that this rank counts (those whose first body it owns), added to an order-free sum.
  void add_energy(const ContactScene& scene, OrderFreeSum& sum) const;
  /// Deepest penetration of a surface into another surface or obstacle [µm], and which pair has it.
  [[nodiscard]] const SurfacePair* deepest(const ContactScene& scene) const;

  /// How surfaces touch spheres as the contacts were found last, in canonical order; ghosts, too. The middle of a contact is that of the area that
  /// bears friction; without any it is the centre.
  [[nodiscard]] std::vector<SphereTouch> touches_of_spheres(const ContactScene& scene) const;

  /// Friction of a pair of these bodies, by what they are.
  [[nodiscard]] FrictionPerArea friction_of(std::span<const ContactBody> bodies, const SurfacePair& pair) const;
  /// Keep the present friction as that of the step (Γ_n).
  void begin_step(const ContactScene& scene);
  /// How far each obstacle has gone since the step began [µm].
  [[nodiscard]] std::vector<Vec3d> obstacle_ways() const;
  /// The friction of the step's start is not needed any more.
  void end_step();
  /// The matrix is made: forget the present points (not those of the step's start) until the next evaluate().
  void make_room();
  /// Friction that is beside the element groups, as begin_step() found it; null where it is within them.
  [[nodiscard]] const ObjectiveFriction* own_friction() const { return settings_.objective_friction ? &objective_ : nullptr; }
  /// The same of the contacts as they were found last.
  [[nodiscard]] ObjectiveFriction friction_now(const ContactScene& scene) const;
  /// Friction of the step's start applied to the way d of all points from `start` (obstacles have moved since begin_step()): adds Γ_n d to `out`
  /// (owned points) and dᵀΓ_n d of the counted pairs to the sum. `moved`: false where all points are at the start.
  void add_step_friction(const ContactScene& scene, std::span<const Vec3d> start, bool moved, std::span<Vec3d> out,
                         OrderFreeSum& quadratic) const;
  /// Element groups for the friction system: by the later of their bodies in canonical order, then by the other; obstacles last.
  [[nodiscard]] std::vector<ElementGroup> element_groups(const ContactScene& scene) const;

  /// Pairs of spheres that rebuild() has found, in canonical order; handed over, for the layer has no use for them.
  [[nodiscard]] std::vector<SphereNeighbours> take_sphere_neighbours() { return std::move(spheres_); }
  [[nodiscard]] std::span<const SurfacePair> pairs() const { return pairs_; }
  [[nodiscard]] std::span<const RigidSurface> obstacles() const { return obstacles_.all(); }
  [[nodiscard]] const RigidSurfaces& shared_obstacles() const { return obstacles_; }
  [[nodiscard]] const Vec3d& obstacle_offset(std::size_t i) const { return offsets_[i]; }
  [[nodiscard]] std::span<const Vec3d> offsets() const { return offsets_; }
  [[nodiscard]] const ContactMaterial& material(std::uint16_t a, std::uint16_t b) const { return materials_[a * material_count_ + b]; }
  [[nodiscard]] const ContactSettings& settings() const { return settings_; }
  /// Bytes that lists and results take.
  [[nodiscard]] std::size_t memory() const;

 private:
  struct BodyMotion {
    Vec3d mean;              ///< since the last call of note_motion()
    double deviation = 0.0;  ///< largest distance of a point's displacement from the mean
  };
  [[nodiscard]] const ContactMaterial& material_of(const ContactScene& scene, const SurfacePair& pair) const {
    return material(scene.bodies[pair.a].material, pair.rigid ? obstacles_[pair.b].material : scene.bodies[pair.b].material);
  }
  [[nodiscard]] PairBody view(const ContactScene& scene, const SurfacePair& pair, int which) const;
  void rebuild_lists(const ContactScene& scene, SurfacePair& pair);
  void evaluate_pair(const ContactScene& scene, SurfacePair& pair, PairGradient (&gradient)[2], PointsWorkspace& workspace,
                     ElementStore& store);
  void collect(const ContactScene& scene, const SurfacePair& pair, int side, const PairGradient& part, ContactGradient& gradient) const;
  /// What pairs of surfaces must know of the motion since the last note_motion().
  void note_motion_of_pairs(const ContactScene& scene);
  /// How far the bodies have strayed since their pairs were found, from a common drift where there is one; gives the part of the skin that is used.
  double find_strays(const ContactScene& scene);
  /// Bound on the way of a body beside a drift since its pairs were found [µm].
  [[nodiscard]] double stray_of(const ContactScene& scene, std::size_t body, const CommonDrift& drift) const;
  [[nodiscard]] CommonDrift drift_of_spheres(const ContactScene& scene) const;
  /// How much nearer a body may be than its present place tells, to one whose pairs are found now [µm].
  [[nodiscard]] double slack_of(std::size_t body) const {
    return stray_.empty() ? 0.0 : static_cast<double>(stray_[body]) + 0.5 * drift_.strain * widest_;
  }
  /// Where a sphere is said to have been when pairs were found, so that the drift since then brings it to its present place.
  [[nodiscard]] Vec3f listed_place(const Vec3d& now) const { return to_float(now - drift_.at(now)); }
  /// The bond of a pair of sisters whose interface is new; null: none.
  [[nodiscard]] const SisterBond* sister_bond(const ContactScene& scene, const SurfacePair& pair) const;
  /// Factor on W of a pair: √(f_a f_b).
  [[nodiscard]] double own_adhesion(const SurfacePair& pair) const;
  /// A tension of both surfaces of a pair together [nN/µm].
  [[nodiscard]] double both_tensions(const ContactScene& scene, const SurfacePair& pair, double ContactMaterial::*of) const;
  /// Way of a body since the last note_motion(), when its points were `known_point` and those after it.
  [[nodiscard]] BodyMotion motion_of(const ContactScene& scene, const ContactBody& body, std::uint32_t known_point,
                                     float last_radius) const;
  /// Bound on the way of its points from where they were then, and of its surface.
  [[nodiscard]] double way_of(const ContactScene& scene, const ContactBody& body, std::uint32_t known_point, float last_radius) const;
  /// How far a position with coordinates up to this may be off when it is kept as float [µm].
  [[nodiscard]] static double rounding_of(double largest);
  /// Bound on how far the nodes in a pair's lists have moved against each other since the last call of note_motion().
  [[nodiscard]] double patch_motion(const ContactScene& scene, const SurfacePair& pair) const;
  void know_positions(const ContactScene& scene);
  void know_bodies(const ContactScene& scene);
  /// Pairs under the numbers that their bodies have now; those go whose bodies are not what they were. After reset().
  void renumber(const ContactScene& scene);
  /// After the pairs were found: take over the lists of those that were there before, and begin to count motion.
  void keep_lists(const ContactScene& scene, std::vector<SurfacePair> old);
  [[nodiscard]] Extent extent_of(const ContactScene& scene, std::uint32_t body) const;
  /// Pairs of bodies that may touch, to the lists of spheres and of surfaces. `wanted`: only those with one of these bodies; else all.
  void add_body_pairs(const ContactScene& scene, const Space& space, std::span<const std::uint32_t> wanted);
  void add_obstacle_pairs(const ContactScene& scene, const Space& space, std::span<const std::uint32_t> bodies);
  /// Surfaces that may touch themselves, after all other pairs.
  void add_self_pairs(const ContactScene& scene, std::span<const std::uint32_t> bodies);
  void renumber_motions(const ContactScene& scene, const BodyChanges& changes);
  /// Which pairs are of which kind.
  void sort_kinds(const ContactScene& scene);
  void evaluate_list(std::span<const std::uint32_t> list, std::span<const char> these, const ContactScene& scene,
                     std::vector<ElementStore>& stores, ContactGradient& gradient);
  [[nodiscard]] ListReach reach() const { return {settings_.range, settings_.skin, settings_.depth}; }
  /// Of a pair: a surface keeps a distance from itself.
  [[nodiscard]] ListReach reach_of(const SurfacePair& pair, const ContactMaterial& material) const {
    return pair.with_itself() ? ListReach{settings_.range + material.self_distance, settings_.skin, 0.0} : reach();
  }

  /// A body of a pair, as it was at the last rebuild().
  struct KnownBody {
    CellId id;
    std::uint32_t number, first_point;
    const Topology* topology;  ///< null: a sphere
  };

  double bonding_ = 1.0;
  OwnFactors own_;
  std::vector<SisterBond> sister_bonds_;
  ContactSettings settings_;
  RigidSurfaces obstacles_;
  std::vector<Vec3d> offsets_, last_offsets_, step_offsets_;
  std::vector<ContactMaterial> materials_;
  std::size_t material_count_;
  bool fresh_ = true;
  std::vector<KnownBody> known_bodies_;  ///< of the pairs, sorted by id

  std::vector<SurfacePair> pairs_;
  ObjectiveFriction objective_;
  std::vector<SpherePressure> packing_;  ///< by body; empty: none
  std::vector<SphereNeighbours> spheres_;
  std::size_t sphere_pairs_before_ = 0;             ///< how many the last rebuild() found
  std::vector<std::uint32_t> pairs_of_kind_[2];     ///< by SurfacePairKind
  std::vector<ElementStore> present_[2], step_[2];  ///< of the pairs of a kind, by thread: their elements and step_elements
  std::vector<Vec3f> known_at_;  ///< where the points were at the last note_motion(); if there are no pairs, at the last rebuild()
  double rounding_ = 0.0;        ///< how far that may be off [µm]
  std::vector<BodyMotion> motion_;
  std::vector<float> last_radius_;  ///< of spheres: growth counts as motion
  std::vector<double> travel_;      ///< by body: bound on the way of its points since the list of pairs was built; empty: without surfaces
  /// Where spheres were when their pairs were found, and their radii then, by body; empty where known_at_ and last_radius_ are of that time.
  std::vector<Vec3f> listed_at_;
  std::vector<float> listed_radius_;
  std::vector<float> stray_;  ///< by body, at the last note_motion() [µm]
  CommonDrift drift_;         ///< from which they stray
  double widest_ = 0.0;       ///< distance of two bodies at which they are just no pair, the largest [µm]
  bool periodic_ = true;      ///< distances are of nearest images: no drift is common to all
  double obstacle_travel_ = 0.0;
  double skin_used_ = 0.0;
  std::uint64_t times_rebuilt_ = 0;
};

}  // namespace morula
