#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/contact/contact_layer.h"
#include "coupling/mechanics/term.h"

namespace morula {

/// How strongly surfaces in contact act while a start from overlap is on (time_stepping.md §6).
struct ContactStrength {
  double cap = 0.0;      ///< δ: tractions are no larger than at this depth; 0: no cap [µm]
  double depth = 0.0;    ///< overlap that is seen; 0: what the lists' skin allows [µm]
  double bonding = 1.0;  ///< part of adhesion and contact friction that acts

  bool operator==(const ContactStrength&) const = default;
};

/// Contact of surfaces with surfaces, obstacles and spheres: adhesion and repulsion. What they rub is a term of its own (ContactFriction).
///
/// Surfaces are found once at each place: as long as points, obstacles and strength are what they were, only what presses on spheres is found
/// anew, because their radii and packing may have changed. Candidates of all contacts are found here, those of spheres among themselves, too.
class SurfaceContacts : public Term {
 public:
  SurfaceContacts(const Model& model, RigidSurfaces obstacles, int threads);

  /// Collective.
  void bodies_changed(const World& world) override;
  void bodies_replaced(const World& world, const BodyChanges& changes) override;
  void parameters_changed(const World& world) override;
  [[nodiscard]] bool varies_with_time() const override { return bonds_age_ || tensions_vary_; }
  /// Finds the candidates anew when bodies have gone too far since the last time. Collective.
  void measure(const World& world) override;
  void evaluate(const World& world, Forces& out) override;
  [[nodiscard]] std::optional<CellId> crossed(const World& world, std::span<const Vec3d> start) const override;
  void begin_step(const World& world, StepStart& start) override;
  void end_step(const World&, StepEnd&) override { layer_.end_step(); }
  void assemble(const World& world, double dt, Assembly& out) override;
  [[nodiscard]] std::size_t memory() const override;
  [[nodiscard]] Stage stage() const override { return Stage::kContacts; }

  void set_strength(const ContactStrength& strength);
  /// How far the obstacles have gone from where the study has them [µm]. Says whether they were elsewhere before.
  bool set_offsets(std::span<const Vec3d> offsets);
  /// What was found holds no more: marks of faces have changed.
  void forget() { found_at_.reset(), again_.clear(); }
  /// The matrix is made: what only it needs goes.
  void make_room();

  /// How often candidates were found: what follows from their lists is to be made anew when this has changed.
  [[nodiscard]] std::uint64_t list_number() const { return list_number_; }
  [[nodiscard]] ContactLayer& layer() { return layer_; }
  [[nodiscard]] const ContactLayer& layer() const { return layer_; }
  /// Forces and areas of contact as they were found last.
  [[nodiscard]] const ContactGradient& found() const { return gradient_; }

 private:
  void look_for_new_surfaces(const World& world);
  /// In which the bodies differ from their types. Collective.
  void take_own_factors(const World& world);
  /// Bodies that are to be evaluated again because what they touch has come or gone, by new number; nothing where all are.
  [[nodiscard]] std::vector<char> touched_by(const BodyChanges& changes) const;
  /// What was found goes with the bodies that stay.
  void carry_found(const World& world, const BodyChanges& changes);
  void evaluate_again(const World& world, bool with_spheres);

  int threads_;
  bool bonds_age_ = true;       ///< interfaces of sisters may be new: adhesion depends on the time
  bool tensions_vary_ = false;  ///< of surfaces that adhere by what contact takes of them
  ContactLayer layer_;
  std::vector<std::shared_ptr<const ReferenceShape>> shapes_of_lists_;  ///< of the bodies in the layer's lists: see ContactLayer::reset()
  ContactGradient gradient_;                                            ///< of all contacts of surfaces
  ContactGradient surfaces_only_;                                       ///< without the pairs with a sphere; kept only where there are any
  std::optional<std::uint64_t> found_at_;  ///< Scene::positions_number() where the contacts of surfaces were found
  std::vector<char> again_;                ///< by body: its contacts are to be found again all the same; empty: of none
  std::uint64_t list_number_ = 0;
  std::size_t given_back_ = 0;  ///< bytes that the last evaluation needed beside what it left
};

/// Bodies at their present positions as the contact layer sees them.
ContactScene contact_scene(const Scene& scene, const SurfaceGeometry& geometry);
inline ContactScene contact_scene(const World& world) { return contact_scene(world.scene, world.geometry); }

/// What surfaces in contact rub on each other (dcm.md §1): the friction of the contacts at the step's start.
class ContactFriction : public Term {
 public:
  explicit ContactFriction(const SurfaceContacts& contacts) : contacts_(contacts) {}

  void add_friction(const World& world, const Way& way, std::span<Vec3d> out, OrderFreeSum& quadratic) override;
  void add_noise(const World& world, const Noise& noise, std::span<Vec3d> force) const override;
  /// Friction that does not feel common rotations is a part of the matrix of its own; the plain one is with the contacts' stiffness.
  [[nodiscard]] bool empty() const override { return contacts_.layer().own_friction() == nullptr; }
  void add_product(std::span<const Float4> p, std::span<Float4> q) const override;
  void add_diagonal(std::span<SymMat3<float>> diagonal) const override;
  void add_outside_balance(std::span<const Float4> velocity, std::span<OutsideBalance> by_body) const override;

 private:
  const SurfaceContacts& contacts_;
};

}  // namespace morula
