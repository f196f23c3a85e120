#pragma once
#include <span>
#include <vector>

#include "cbm/laws/sphere_caps.h"
#include "cbm/pair_forces.h"
#include "core/contact/contact_layer.h"
#include "core/friction/sphere_pairs.h"
#include "coupling/mechanics/scene.h"
#include "coupling/model.h"
#include "coupling/tissue.h"

namespace morula {

/// Contacts of spheres with spheres and with obstacles: JKR or Hertz forces, friction by contact area, and who adheres to whom.
///
/// Candidates come from the contact layer. Whether a pair is attached is state (cbm::Spheres::attached) and fixed within a step. Nothing is
/// kept of a pair but what the solver needs of it: evaluating adds to sums by sphere at once.
class SphereContacts {
 public:
  SphereContacts(const Model& model, int threads);

  /// New candidates: after the contact layer has found its pairs again. Takes the layer's list.
  void set_pairs(const Scene& scene, ContactLayer& contacts, const Tissue& tissue);
  /// Radii or time have changed: rest distances of young sisters anew.
  void update_sisters(const Scene& scene, double now);
  /// Whether any type of the model has a pressure of packing (cbm.md §3).
  [[nodiscard]] bool packs() const { return packs_; }
  /// Packing and pressure of the spheres at the scene's positions, ghosts too, for evaluate() and for the surfaces that press on them.
  /// penetration: what surfaces take of the spheres, by body; empty: nothing. Collective. Precondition: packs().
  void find_packing(const Scene& scene, const ContactLayer& contacts, std::span<const Penetration> penetration, const Comm& comm);
  /// By body (surfaces: nothing); valid after find_packing().
  [[nodiscard]] std::span<const SpherePressure> surface_pressure() const { return surface_pressure_; }
  /// φ of owned sphere i, and whether it is beyond the calibrated range of its type (packing.h).
  [[nodiscard]] double packing(std::size_t i) const { return packs_ ? packing_[i] : 0.0; }
  /// Forces on owned spheres at the scene's positions are added to `force` (by point); energy, pressures and the solver's elements follow.
  void evaluate(const Scene& scene, const ContactLayer& contacts, std::span<Vec3d> force);
  void add_energy(OrderFreeSum& sum) const { sum += energy_; }

  /// From here to end_step() the present friction is that of the step. Precondition: evaluated since the last end_step().
  void begin_step() { in_step_ = true; }
  void end_step() { in_step_ = false; }
  /// The pairs' part of the friction system.
  [[nodiscard]] const SpherePairs& pairs() const { return list_; }

  /// Flags after the step, into the tissue; pressures follow. Returns whether any flag of this rank has changed.
  bool update_attached(const Scene& scene, const ContactLayer& contacts, Tissue& tissue);
  /// The time has moved on: rest distances and pressures of young sisters anew. Returns whether any has changed.
  bool renew_sisters(const Scene& scene, const ContactLayer& contacts, double now);
  /// Σ_k (x_i − x_k)·f_k over the contacts of owned sphere i with spheres and obstacles [nN·µm].
  [[nodiscard]] double virial(std::size_t i) const { return virial_[i]; }
  /// What spheres and obstacles do to a sphere.
  struct Pressing {
    double area = 0.0;         ///< in contact [µm²]
    SymMat3<double> virial{};  ///< Σ_k (x_i − x_k) ⊗ f_k [nN·µm]
  };
  /// Of the owned spheres; evaluates the pairs, for nobody needs this in a step.
  [[nodiscard]] std::vector<Pressing> pressing(const Scene& scene, const ContactLayer& contacts) const;
  /// Contacts of spheres with spheres that this rank counts, and those of them that are larger than their law allows for (cbm/sphere_range.h).
  struct RangeCount {
    std::int64_t contacts = 0, beyond = 0;
  };
  [[nodiscard]] RangeCount count_beyond_range(const Scene& scene, const ContactLayer& contacts) const;
  /// function(owned sphere, obstacle, normal, area) for the spheres that touch obstacles.
  template <class F>
  void for_touched_obstacles(F&& function) const {
    for (const RigidPair& pair : rigid_)
      if (pair.area > 0.0) function(pair.sphere, pair.obstacle, pair.normal, pair.area);
  }
  /// function(obstacle, force on it) for every contact of an owned sphere with an obstacle [nN].
  template <class F>
  void for_pushed_obstacles(F&& function) const {
    for (const RigidPair& pair : rigid_) function(pair.obstacle, pair.normal * pair.force);
  }
  [[nodiscard]] std::size_t memory() const;

 private:
  /// Two daughters of one division; part of their overlap is forgiven for a while.
  struct Sisters {
    std::uint32_t pair;
    double birth_radius_a, birth_radius_b, birth_time;
    double offset = 0.0;  ///< the law sees δ − offset [µm]
  };
  /// An owned sphere near a smooth part of an obstacle. A sphere adheres to an obstacle as a whole: the pairs of both share the flag.
  struct RigidPair {
    std::uint32_t sphere, obstacle, part;
    bool attached = false, attached_next = false;
    Vec3d normal{};
    double distance = 0.0, force = 0.0, energy = 0.0, area = 0.0;
    [[nodiscard]] bool same_bodies(const RigidPair& other) const { return sphere == other.sphere && obstacle == other.obstacle; }
  };

  /// What packing adds to a pair at a distance of the centres [µm]: force apart [nN], stiffness [nN/µm].
  struct PackingForce {
    double force = 0.0, stiffness = 0.0;
    cbm::SphereCaps caps;
  };
  [[nodiscard]] PackingForce packing_force(const Scene& scene, const SpherePair& pair, double distance) const;
  void share_pressures(const Scene& scene, std::span<const double> slopes, std::span<const Penetration> others, const Comm& comm);
  void find_sisters(const Scene& scene, const Tissue& tissue);
  void find_rigid_pairs(const Scene& scene, const ContactLayer& contacts, const Tissue& tissue);
  void keep_step_friction(const Scene& scene, std::vector<SpherePair> old_pairs, std::vector<SpherePairElement> old_elements);
  /// Evaluates the pairs of a share that pass `wanted`: calls sink(number of the pair, block, lane) in their order for those within reach,
  /// and far_away(number) for the others.
  template <class Wanted, class Sink, class FarAway>
  void visit(const SpherePairs::Share& share, const Scene& scene, const ContactLayer& contacts, Wanted&& wanted, Sink&& sink,
             FarAway&& far_away) const;
  void set_element(SpherePairElement& element, const cbm::PairBlock& block, int lane) const;
  /// Where the part of the obstacle bears the sphere, seen from its centre: normal and distance of the pair. False: it does not (foot_on_part()).
  bool locate_rigid(const Scene& scene, const ContactLayer& contacts, RigidPair& pair) const;
  void evaluate_rigid(const Scene& scene, const ContactLayer& contacts, std::size_t k);
  /// Pressures of the marked spheres anew, without touching forces.
  void refresh_values(const Scene& scene, const ContactLayer& contacts, const std::vector<char>& marked);
  void write_partners(const Scene& scene, const std::vector<char>& marked, Tissue& tissue) const;
  [[nodiscard]] CellId partner_id(const Scene& scene, std::uint32_t sphere) const;

  const Model& model_;
  int threads_;
  bool packs_ = false;
  cbm::ContactTable table_;  ///< of all materials and walls
  SpherePairs list_;
  std::vector<Sisters> sisters_;                  ///< by pair
  std::vector<RigidPair> rigid_;                  ///< by sphere, obstacle and part
  std::vector<double> virial_;                    ///< by owned sphere [nN·µm]
  std::vector<double> packing_;                   ///< by owned sphere: φ; empty where no type packs, as the next two
  std::vector<double> pressed_;                   ///< by sphere, ghosts too: p [kPa]
  std::vector<SpherePressure> surface_pressure_;  ///< by body
  OrderFreeSum energy_;
  std::vector<std::vector<std::uint32_t>> flips_;  ///< by share: pairs whose flag changes if the step ends where they were evaluated last
  bool in_step_ = false;
  bool partners_stale_ = false;  ///< a sphere has partners that are no pair of the list any more
};

}  // namespace morula
