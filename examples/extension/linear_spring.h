#pragma once
#include <memory>

#include <cbm/pair_loop.h>
#include <cbm/spheres.h>

/// A contact law of spheres: F = k δ for an overlap δ > 0, no adhesion; two types in contact share the springs' mean stiffness.
template <class Real>
struct LinearSpring {
  Real stiffness;  // k [nN/µm]

  morula::cbm::ContactResponse<Real> respond(const Real& reduced_radius, const Real& overlap) const noexcept {
    using morula::max, morula::select, morula::sqrt;
    const Real pressed = max(overlap, Real(0.0)), radius_square = reduced_radius * pressed, force = stiffness * pressed;
    return {force, select(overlap > Real(0.0), stiffness, Real(0.0)), sqrt(radius_square), Real(3.141592653589793) * radius_square,
            Real(0.5) * force * pressed};
  }
};

/// The law as a study may name it: `cbm: {law: linear_spring, stiffness: 2 nN/um}`.
inline std::shared_ptr<const morula::cbm::SphereLaw> linear_spring() {
  const morula::KeySpec stiffness{.name = "stiffness",
                                  .doc = "Stiffness of the contact of two such spheres.",
                                  .quantity = morula::Quantity::kTension,
                                  .fallback = "1 nN/um",
                                  .low = 0.0,
                                  .high = 1e4,
                                  .low_open = true,
                                  .example = "2 nN/um",
                                  .source = "chosen: of the order of a Hertz contact of cells at a tenth of their radius"};
  const auto couple = [](const morula::cbm::SphereParameters& a, const morula::cbm::SphereParameters* b, double /*adhesion*/) {
    const double k = a.own("stiffness");
    return morula::cbm::PairCoefficients{b == nullptr ? k : 0.5 * (k + b->own("stiffness"))};
  };
  return morula::cbm::make_sphere_law<LinearSpring>({.info = {.name = "linear_spring",
                                                              .title = "Linear spring between spheres",
                                                              .equation = "F = k δ (δ > 0), k = ½ (k_a + k_b)",
                                                              .source = "Hooke's law; Cundall & Strack 1979, doi:10.1680/geot.1979.29.1.47",
                                                              .parameters = {morula::given_by_study("stiffness", "tension", "nN/µm", "k")},
                                                              .keys = {{"cbm", stiffness}}},
                                                     .word = "linear_spring",
                                                     .doc = "force in proportion to the overlap, no adhesion",
                                                     .own = {stiffness},
                                                     .couple = couple});
}
