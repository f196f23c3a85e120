#include "coupling/mechanics/own_contacts.h"

#include <cmath>

namespace morula {

const cbm::SphereParameters& OwnContacts::parameters(std::size_t type, std::size_t body, int side) {
  const cbm::SphereParameters& usual = model_.types[type].sphere;
  if (own_.stiffness.empty()) return usual;
  auto& copies = of_type_[side];
  copies.resize(model_.types.size());
  if (!copies[type]) copies[type] = usual;
  copies[type]->young = usual.young * own_.stiffness[body];
  return *copies[type];
}

cbm::PairContact OwnContacts::of(const ContactBody& sphere_a, std::size_t a, const ContactBody& sphere_b, std::size_t b) {
  const std::size_t type_a = sphere_a.material, type_b = sphere_b.material;
  cbm::PairContact out = table_.entry(type_a, type_b).contact;
  const double adhesion = model_.pair(type_a, type_b).adhesion * std::sqrt(adhesion_of(a) * adhesion_of(b));
  // From the lower type's side, as in the table.
  out.coefficient = type_b < type_a ? out.law->couple(parameters(type_b, b, 0), &parameters(type_a, a, 1), adhesion)
                                    : out.law->couple(parameters(type_a, a, 0), &parameters(type_b, b, 1), adhesion);
  return out;
}

cbm::PairContact OwnContacts::with_obstacle(const ContactBody& sphere, std::size_t a, std::size_t material) {
  cbm::PairContact out = table_.entry(sphere.material, material).contact;
  const double usual = material < model_.material_count() ? model_.pair(sphere.material, material).adhesion : 0.0;
  out.coefficient = out.law->couple(parameters(sphere.material, a, 0), nullptr, usual * std::sqrt(adhesion_of(a)));
  return out;
}

}  // namespace morula
