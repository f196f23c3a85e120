#pragma once
#include <optional>
#include <vector>

#include "cbm/pair_forces.h"
#include "core/contact/contact_layer.h"
#include "coupling/model.h"

namespace morula {

/// Contacts of spheres that differ from their types in stiffness or adhesion: what their law makes of Young's moduli and of an adhesion of their own. For one
/// thread.
class OwnContacts {
 public:
  OwnContacts(const Model& model, const cbm::ContactTable& table, const OwnFactors& own) : model_(model), table_(table), own_(own) {}

  [[nodiscard]] bool vary() const { return !own_.stiffness.empty() || !own_.adhesion.empty(); }
  /// Of two spheres, whose numbers in the scene are a and b.
  [[nodiscard]] cbm::PairContact of(const ContactBody& sphere_a, std::size_t a, const ContactBody& sphere_b, std::size_t b);
  /// Of a sphere and an obstacle or wall of this material.
  [[nodiscard]] cbm::PairContact with_obstacle(const ContactBody& sphere, std::size_t a, std::size_t material);

 private:
  /// Of the type of a sphere, with a modulus of its own; `side`: one of the two that a pair asks for.
  const cbm::SphereParameters& parameters(std::size_t type, std::size_t body, int side);
  [[nodiscard]] double adhesion_of(std::size_t body) const { return own_.adhesion.empty() ? 1.0 : own_.adhesion[body]; }

  const Model& model_;
  const cbm::ContactTable& table_;
  const OwnFactors& own_;
  std::vector<std::optional<cbm::SphereParameters>> of_type_[2];  ///< copies whose modulus changes from sphere to sphere
};

}  // namespace morula
