#pragma once
#include <span>
#include <vector>

#include "cbm/laws/pair_law.h"
#include "core/contact/contact_layer.h"
#include "core/friction/friction_system.h"
#include "coupling/mechanics/scene.h"
#include "coupling/model.h"
#include "coupling/tissue.h"

namespace morula {

/// Contacts of spheres with spheres and with obstacles: JKR or Hertz forces, friction by contact area, and who adheres to whom.
///
/// Candidates come from the contact layer. Whether a pair is attached is state (cbm::Spheres::attached) and fixed within a step.
class SphereContacts {
 public:
  explicit SphereContacts(const Model& model);

  /// New candidates: after the contact layer has found its pairs again.
  void set_pairs(const Scene& scene, const ContactLayer& contacts, const Tissue& tissue);
  /// Radii or time have changed: laws and rest distances of young sisters anew.
  void update_laws(const Scene& scene, const Tissue& tissue);
  /// The time has moved on: rest distances and responses of sisters anew. Returns whether there are any.
  bool renew_sisters(const Scene& scene, const ContactLayer& contacts, const Tissue& tissue);
  /// Responses at the scene's positions.
  void evaluate(const Scene& scene, const ContactLayer& contacts);
  void add_energy(const Scene& scene, OrderFreeSum& sum) const;
  /// Add forces on owned spheres, by point.
  void collect(const Scene& scene, std::span<Vec3d> force) const;

  /// Keep the present friction as that of the step, together with the medium's friction by point [nN·s/µm].
  void begin_step(std::vector<float> medium_friction) {
    step_elements_ = elements_;
    medium_friction_ = std::move(medium_friction);
  }
  void add_step_friction(const Scene& scene, std::span<const Vec3d> displacement, std::span<Vec3d> out, OrderFreeSum& quadratic) const;
  [[nodiscard]] std::span<const SpherePairElement> elements() const { return elements_; }

  /// Flags after the step, into the tissue; responses follow. Returns whether any flag of this rank has changed.
  bool update_attached(const Scene& scene, Tissue& tissue);
  /// Virial pressure p_i = Σ d_ij F_ij/(6 V_i) of each owned sphere (cbm.md §3) [kPa]; its contact area is added to `contact_area` [µm²].
  void add_values(const Scene& scene, const Tissue& tissue, std::span<double> pressure, std::span<double> contact_area) const;
  [[nodiscard]] std::size_t memory() const;

 private:
  struct Pair {
    std::uint32_t a, b;  ///< bodies; b is the obstacle's number if rigid
    Vec3d shift;
    cbm::PairLaw<double> law;
    double overlap_offset = 0;  ///< of young sisters: the law sees δ − offset
    bool attached = false;
    bool rigid = false;
  };
  struct Response {
    Vec3d normal;  ///< from a to b
    double distance = 0.0, overlap = 0.0, force = 0.0, energy = 0.0, area = 0.0;
  };
  void update_law(const Scene& scene, double now, Pair& pair) const;
  void evaluate_pair(const Scene& scene, const ContactLayer& contacts, std::size_t k);
  void make_element(const Pair& pair, const ContactBody& a, const ContactBody* b, const Response& response, double area, double stiffness,
                    SpherePairElement& element) const;

  const Model& model_;
  std::vector<cbm::ContactMaterial> materials_;  ///< cell type × material
  std::vector<Pair> pairs_;
  std::vector<std::uint32_t> sisters_;  ///< pairs of sisters
  std::vector<Response> responses_;
  std::vector<SpherePairElement> elements_, step_elements_;
  std::vector<float> medium_friction_;
  std::vector<std::uint32_t> incident_begin_, incident_;  ///< by sphere body: pairs, and which side in the lowest bit
};

}  // namespace morula
