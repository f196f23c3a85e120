#include "cbm/laws/hertz.h"
#include "cbm/pair_loop.h"
#include "cbm/sphere_keys.h"
#include "cbm/spheres.h"

namespace morula::cbm {
namespace {

template <class Real>
struct Hertz {
  Real modulus;  // E*

  ContactResponse<Real> respond(Real reduced_radius, Real overlap) const noexcept {
    PairLaw<Real> law;
    law.modulus = modulus, law.reduced_radius = reduced_radius;
    return hertz_contact(law, overlap);
  }
};

PairCoefficients couple(const SphereParameters& a, const SphereParameters* b, double /*adhesion*/) {
  const ContactMaterial material = b != nullptr ? ContactMaterial::elastic(a.young, a.poisson, b->young, b->poisson, 0.0)
                                                : ContactMaterial::against_rigid(a.young, a.poisson, 0.0);
  return {material.modulus};
}

}  // namespace

std::shared_ptr<const SphereLaw> hertz_law() {
  static const auto law = make_sphere_law<Hertz>({.info = {.name = "hertz",
                                                           .title = "Hertz contact",
                                                           .equation = "F = (4/3) E* √R* δ^(3/2) for δ > 0, a = √(R*δ)",
                                                           .source = "Hertz 1882, doi:10.1515/crll.1882.92.156",
                                                           .parameters = keys::elastic_parameters(),
                                                           .keys = keys::elastic()},
                                                  .word = "hertz",
                                                  .doc = "elastic, adhesion ignored",
                                                  .couple = &couple});
  return law;
}

}  // namespace morula::cbm
