#pragma once
#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "cbm/laws/sphere_caps.h"
#include "cbm/pair_forces.h"
#include "core/friction/sphere_pairs.h"
#include "coupling/mechanics/surface_contacts.h"
#include "coupling/mechanics/term.h"
#include "coupling/mechanics/told.h"

namespace morula {

struct SphereRenumbering;

/// Contacts of spheres with spheres and with obstacles: JKR or Hertz forces, packing, and who adheres to whom. What they rub is a term of its
/// own (SphereFriction).
///
/// Candidates come from the contact layer. Whether a pair is attached is state (cbm::Spheres::attached) and fixed within a step. Nothing is
/// kept of a pair but what the solver needs of it: evaluating adds to sums by sphere at once.
class SphereContacts : public Term {
 public:
  SphereContacts(const Model& model, SurfaceContacts& surfaces);

  /// What is known of pairs is known of bodies that are no more.
  void bodies_changed(const World&) override {
    sisters_.clear();
    adhesion_.young.clear();
  }
  void bodies_replaced(const World& world, const BodyChanges& changes) override;
  /// Rest distances of young sisters at the present radii, and at the time of the world: within a step its end.
  void parameters_changed(const World& world) override { update_sisters(world.scene, world.time); }
  [[nodiscard]] bool varies_with_time() const override { return !sisters_.empty(); }
  /// New candidates if the surfaces' layer has some, and the pressures of packing, which surfaces feel, too.
  void measure(const World& world) override;
  /// Forces, energy and pressures, and the elements of the matrix.
  void evaluate(const World& world, Forces& out) override;
  /// From here on the present friction is that of the step.
  void begin_step(const World&, StepStart&) override { friction_is_frozen_ = true; }
  /// Who adheres to whom after the step, into the tissue; pressures follow.
  void end_step(const World& world, StepEnd& end) override;
  void abandon_step() override { friction_is_frozen_ = false; }
  [[nodiscard]] std::size_t memory() const override;
  [[nodiscard]] Stage stage() const override { return Stage::kContacts; }

  /// Whether any type of the model has a pressure of packing (cbm.md §3).
  [[nodiscard]] bool packs() const { return packing_.acts; }
  /// φ of owned sphere i, and whether it is beyond the calibrated range of its type (packing.h).
  [[nodiscard]] double packing(std::size_t i) const { return packing_.acts ? packing_.part[i] : 0.0; }
  /// The pairs' part of the friction system.
  [[nodiscard]] const SpherePairs& pairs() const { return list_; }
  /// How far each obstacle has gone since the step began [µm].
  [[nodiscard]] std::vector<Vec3d> obstacle_ways() const { return layer().obstacle_ways(); }
  /// Flags at the present positions, into the tissue; pressures follow. Returns whether any flag of this rank has changed.
  bool update_attached(const World& world, Tissue& tissue);
  /// What is found anew when a step has ended: values of spheres alone, or their packing and so those of their neighbours, too.
  enum class Renewed { kNothing, kValues, kPacking };
  /// The time has moved on: rest distances and pressures of young sisters anew.
  Renewed renew_sisters(const World& world);
  /// Spheres have gone on along curved obstacles: how these bear them where they are now, which is kept within a step, and pressures with it.
  Renewed renew_supports(const World& world);
  /// Σ_k (x_i − x_k)·f_k over the contacts of owned sphere i with spheres and obstacles [nN·µm].
  [[nodiscard]] double virial(std::size_t i) const { return virial_[i]; }
  /// What spheres and obstacles do to a sphere.
  struct Pressing {
    double with_cells = 0.0;      ///< area in contact with spheres, by pairs [µm²]
    double with_obstacles = 0.0;  ///< [µm²]
    SymMat3<double> virial{};     ///< Σ_k (x_i − x_k) ⊗ f_k [nN·µm]
  };
  /// Of the owned spheres; evaluates the pairs, for nobody needs this in a step.
  [[nodiscard]] std::vector<Pressing> pressing(const Scene& scene) const;
  /// Laws of contact by material, for who asks what they would say.
  [[nodiscard]] const cbm::ContactTable& table() const { return table_; }
  /// How an owned sphere stands to the law of its contacts with spheres and obstacles.
  struct Standing {
    double outside = 0.0;  ///< the most of cbm::part_of_range
    double caps = 0.0;     ///< of it behind the planes of these contacts [µm³]
  };
  [[nodiscard]] std::vector<Standing> standings(const Scene& scene) const;
  /// Contacts of spheres with spheres that this rank counts, and those beyond the range of their law.
  [[nodiscard]] SphereRangeCount count_beyond_range(const Scene& scene) const;
  /// function(owned sphere, obstacle, normal, area) for the spheres that touch obstacles.
  template <class F>
  void for_touched_obstacles(F&& function) const {
    for (const RigidPair& pair : rigid_)
      if (pair.area > 0.0) function(pair.sphere, pair.obstacle, pair.normal, pair.area);
  }
  /// function(owned sphere, obstacle, force on it) for every contact of a sphere with an obstacle [nN].
  template <class F>
  void for_pushed_obstacles(F&& function) const {
    for (const RigidPair& pair : rigid_) function(pair.sphere, pair.obstacle, pair.normal * pair.force);
  }

 private:
  /// Two daughters of one division; part of their overlap is forgiven for a while.
  struct Sisters {
    std::uint32_t pair;
    double birth_radius_a, birth_radius_b, birth_time;
    double offset = 0.0;  ///< the law sees δ − offset [µm]
  };
  /// The plane that touches the smooth surface of a hollow part where a sphere is: the nearest points of its faces jump from one to the next (decision 0087).
  struct TouchingPlane {
    Vec3d from, normal;  ///< the centre of the sphere then, as the obstacle sees it [µm]; of length 1
    double distance;     ///< of that centre from the plane [µm]
    friend bool operator==(const TouchingPlane&, const TouchingPlane&) = default;
  };
  /// How an obstacle bears a sphere.
  struct Support {
    SurfaceCurvature curvature;
    std::optional<TouchingPlane> plane;  ///< of a hollow part
    friend bool operator==(const Support&, const Support&) = default;
  };
  /// An owned sphere near a smooth part of an obstacle. A sphere adheres to an obstacle as a whole: the pairs of both share the flag.
  struct RigidPair {
    std::uint32_t sphere, obstacle, part;
    SurfaceImage image{};  ///< of the obstacle
    bool attached = false, attached_next = false;
    double clear = 0.0;  ///< no other obstacle is nearer to clear_at than this [µm]
    Vec3d clear_at{};
    Vec3d normal{};
    std::optional<Support> support;  ///< where the sphere touched the obstacle at the start of the step, or came to it
    double distance = 0.0, force = 0.0, energy = 0.0, area = 0.0;
    [[nodiscard]] bool same_bodies(const RigidPair& other) const { return sphere == other.sphere && obstacle == other.obstacle; }
  };

  /// What packing adds to a pair at a distance of the centres [µm]: force apart [nN], stiffness [nN/µm].
  struct PackingForce {
    double force = 0.0, stiffness = 0.0;
    cbm::SphereCaps caps;
  };
  /// How the spheres are packed, where some type resists it; empty elsewhere.
  struct Packing {
    bool acts = false;                        ///< some type of the model has a pressure of packing
    std::vector<double> part;                 ///< by owned sphere: φ
    std::vector<double> pressure;             ///< by sphere, ghosts too: p [kPa]
    std::vector<SpherePressure> on_surfaces;  ///< by body
  };
  /// Who adheres to whom, beside the flags of the pairs.
  struct Adhesion {
    std::vector<std::uint32_t> count;               ///< by sphere, ghosts too: how many of its pairs are attached
    std::vector<std::vector<std::uint32_t>> flips;  ///< by share: pairs whose flag changes if the step ends where they were evaluated last
    std::vector<std::uint32_t> young;  ///< came since the last step: who adheres to them may still get another name; increasing
    std::vector<std::uint32_t> lost;   ///< spheres with other partners than the mended list has; increasing
    bool partners_are_lost = false;    ///< some sphere has partners that are no pair of a list that was made anew
  };
  [[nodiscard]] int threads() const { return std::max(1, layer().settings().threads); }
  /// The pairs that one thread visits: forces on its spheres, elements and flags of the pairs that it writes, and energies of those that come first
  /// under one of its spheres.
  void evaluate_share(std::size_t share, const Scene& scene, Vec3d* force, OrderFreeSum& energy);
  [[nodiscard]] PackingForce packing_force(const Scene& scene, const SpherePair& pair, double distance) const;
  void share_pressures(const Scene& scene, std::span<const double> slopes, std::span<const Penetration> others, const Comm& comm);
  [[nodiscard]] const ContactLayer& layer() const { return surfaces_.layer(); }
  void set_pairs(const World& world);
  void find_packing(const Scene& scene, std::span<const Penetration> penetration, const Comm& comm);
  void find_sisters(const World& world);
  void update_sisters(const Scene& scene, double now);
  void find_rigid_pairs(const Scene& scene, const Tissue& tissue);
  /// Adds the pairs of an owned sphere with obstacles. `rubs`: those of the step's start, which go on to its end.
  void add_rigid_pairs(const Scene& scene, const Tissue& tissue, std::uint32_t sphere, std::span<const RigidPair> rubs);
  [[nodiscard]] bool are_attached(const Scene& scene, const Tissue& tissue, const SpherePair& pair) const;
  [[nodiscard]] bool sisters_in(const Scene& scene, const SpherePair& pair) const;
  /// Counts the partners of spheres, and notes whether some have others that are no pair of the list.
  void count_partners(const Scene& scene, const Tissue& tissue);
  /// How many listed partners each sphere adheres to, ghosts too; an obstacle is one.
  [[nodiscard]] std::vector<std::uint32_t> listed_partners() const;
  void set_attached(SpherePair& pair, bool attached);
  // Lists are mended (sphere_mending.cpp).
  /// The list after the changes; the pairs of fresh spheres are returned, spheres that have lost a pair become suspects.
  std::vector<std::uint32_t> merge_pairs(const Scene& scene, const SphereRenumbering& number, std::span<const char> fresh,
                                         std::vector<char>& suspects);
  void renumber_rigid_pairs(const Scene& scene, const Tissue& tissue, std::span<const std::uint32_t> now, std::span<const char> fresh);
  void add_sisters(const World& world, std::span<const std::uint32_t> pairs);
  /// Notes which spheres have other partners in the tissue than in the list: of these, and of those that have more or fewer.
  void look_for_lost(const Scene& scene, const Tissue& tissue, std::vector<char> suspects);
  /// The stretches of a share in which a sphere is marked.
  [[nodiscard]] SpherePairs::Share marked_part(const SpherePairs::Share& share, const std::vector<char>& marked) const;
  void keep_step_friction(const Scene& scene, std::vector<SpherePair> old_pairs, std::vector<SpherePairElement> old_elements);
  /// Evaluates the pairs of a share that pass `wanted`: calls sink(number of the pair, block, lane) in their order for those within reach,
  /// and far_away(number) for the others.
  template <class Wanted, class Sink, class FarAway>
  void visit(const SpherePairs::Share& share, const Scene& scene, Wanted&& wanted, Sink&& sink, FarAway&& far_away) const;
  void set_element(SpherePairElement& element, const cbm::PairBlock& block, int lane) const;
  /// Where the part of the obstacle bears the sphere, seen from its centre: normal and distance of the pair. False: it does not (foot_on_part()).
  bool locate_rigid(const Scene& scene, RigidPair& pair) const;
  /// Whether another obstacle covers the place where a sphere would touch this one.
  bool find_covered(const Scene& scene, RigidPair& pair, const Foot& foot) const;
  void evaluate_rigid(const Scene& scene, std::size_t k);
  /// That of the obstacle, or of a wall of the domain.
  [[nodiscard]] std::size_t material_of(const RigidPair& pair) const;
  [[nodiscard]] cbm::PairContact contact_with_obstacle(const Scene& scene, const RigidPair& pair) const;
  void note_curved_obstacles();
  /// Marks a sphere, by its number among all of the scene; there are no marks before the first.
  static void mark(std::vector<char>& marked, const Scene& scene, std::uint32_t sphere);
  /// Pressures of the marked spheres anew, without touching forces.
  void refresh_values(const Scene& scene, const std::vector<char>& marked);
  /// function(owned sphere, partner) for all that are attached.
  template <class F>
  void for_attached(const Scene& scene, F&& function) const {
    const auto owned = static_cast<std::uint32_t>(scene.owned_spheres());
    for (const SpherePair& pair : list_.pairs) {
      if (!pair.attached) continue;
      if (pair.a < owned) function(pair.a, partner_id(scene, pair.b));
      if (pair.b < owned) function(pair.b, partner_id(scene, pair.a));
    }
    for (std::size_t k = 0; k < rigid_.size(); ++k)
      if (rigid_[k].attached && (k == 0 || !rigid_[k].same_bodies(rigid_[k - 1])))
        function(rigid_[k].sphere, obstacle_partner(rigid_[k].obstacle));
  }
  /// An obstacle is a partner too: its number stands where a cell's id would; no founder has so small a one.
  [[nodiscard]] static CellId obstacle_partner(std::uint32_t obstacle) { return CellId(obstacle + 1); }
  /// mark(sphere) for those whose partners are others than those that the tissue has.
  template <class Mark>
  void mark_other_partners(const Scene& scene, const Tissue& tissue, const Mark& mark) const;
  /// (sphere, partner) of the marked owned spheres that are attached, sorted.
  [[nodiscard]] std::vector<std::pair<std::uint32_t, CellId>> partners_of(const Scene& scene, const std::vector<char>& marked) const;
  void write_partners(const Scene& scene, const std::vector<char>& marked, Tissue& tissue) const;
  [[nodiscard]] CellId partner_id(const Scene& scene, std::uint32_t sphere) const;

  const Model& model_;
  SurfaceContacts& surfaces_;
  std::uint64_t list_number_ = 0;  ///< of the candidates that the pairs were made from
  cbm::ContactTable table_;        ///< of all materials and walls
  SpherePairs list_;
  std::vector<Sisters> sisters_;  ///< by pair
  std::vector<RigidPair> rigid_;  ///< by sphere, obstacle and part
  std::vector<char> is_curved_;   ///< by obstacle: some smooth part is not flat
  std::vector<double> virial_;    ///< by owned sphere [nN·µm]
  Packing packing_;
  Adhesion adhesion_;
  bool friction_is_frozen_ = false;  ///< a step is under way
};

/// Friction of spheres with the medium, with each other and with obstacles: that of the step's start.
class SphereFriction : public Term {
 public:
  explicit SphereFriction(const SphereContacts& contacts) : contacts_(contacts) {}

  void begin_step(const World& world, StepStart& start) override;
  void add_friction(const World& world, const Way& way, std::span<Vec3d> out, OrderFreeSum& quadratic) override;
  void add_noise(const World& world, const Noise& noise, std::span<Vec3d> force) const override;

 private:
  const SphereContacts& contacts_;
  std::span<const float> medium_;  ///< of the owned spheres, in the step's StepStart::point_friction [nN·s/µm]
};

}  // namespace morula
