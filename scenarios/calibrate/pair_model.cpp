#include "scenarios/calibrate/pair_model.h"

#include <numbers>

#include "cbm/laws/jkr.h"

namespace morula::calibrate {

double pair_modulus(double young, double poisson) { return young / (2.0 * (1.0 - poisson * poisson)); }

PairAnswer jkr_pair(double modulus, double adhesion, double reduced_radius, double overlap, double beyond) {
  const auto law = cbm::make_pair_law(cbm::ContactMaterial::of_modulus(modulus, adhesion), reduced_radius);
  const double fold = cbm::kBreakOverlap * law.length;
  if (overlap >= fold) {
    const auto at = cbm::contact_response(law, overlap, true);
    return {at.force, at.area};
  }
  const double smallest = 0.5 * law.radius;  // a of the fold, x = 1/2
  return {-5.0 / 6.0 * law.force + beyond * (fold - overlap), std::numbers::pi * smallest * smallest};
}

PairModel jkr_model(double young, double poisson, double adhesion) {
  const auto material = cbm::ContactMaterial::of_modulus(pair_modulus(young, poisson), adhesion);
  return [material](double overlap, double reduced_radius) {
    const auto at = cbm::contact_response(cbm::make_pair_law(material, reduced_radius), overlap, true);
    return PairAnswer{at.force, at.area};
  };
}

double resting_overlap(const PairModel& law, double radius) {
  const auto force = [&](double overlap) { return law(overlap, 0.5 * radius).force; };
  if (!(force(0.0) < 0.0)) return -1.0;
  double low = 0.0, high = 0.01 * radius;
  while (force(high) < 0.0) {
    low = high;
    high *= 1.25;
    if (high > 1.9 * radius) return -1.0;
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (force(middle) < 0.0 ? low : high) = middle;
  }
  return low;
}

}  // namespace morula::calibrate
