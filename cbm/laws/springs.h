#pragma once
#include <cmath>
#include <memory>
#include <numbers>
#include <type_traits>

#include "cbm/pair_loop.h"
#include "cbm/spheres.h"

namespace morula::cbm {
/// Springs of overlapping spheres, as chains of cells in the literature have them: k δ, k δ²/l and k l ln(1 + δ/l). They push only.
namespace springs {

inline constexpr const char* kSource =
    "Murray et al. 2012, doi:10.1103/PhysRevE.85.021921 (chains of cells with force laws that are not linear)";

/// Force, slope and energy at an overlap that is not negative, with the area of contact of two spheres that are hardly deformed, a² = R* δ, on which
/// friction acts; nothing out of contact.
template <class Real>
ContactResponse<Real> response(const Real& reduced_radius, const Real& pressed, const Real& force, const Real& slope, const Real& energy) {
  const Real square = reduced_radius * pressed;
  return {force, select(pressed > Real(0.0), slope, Real(0.0)), sqrt(square), Real(std::numbers::pi) * square, energy};
}

template <class Real>
Real log_of_one_and(const Real& x) noexcept {
  if constexpr (std::is_same_v<Real, double>) {
    return std::log1p(x);
  } else {
    Real out;
    for (int lane = 0; lane < Real::width; ++lane) out.set(lane, std::log1p(x[lane]));
    return out;
  }
}

/// F = k δ.
template <class Real>
struct Linear {
  Real stiffness;  // k [nN/µm]

  ContactResponse<Real> respond(const Real& reduced_radius, const Real& overlap) const noexcept {
    const Real pressed = max(overlap, Real(0.0)), force = stiffness * pressed;
    return response<Real>(reduced_radius, pressed, force, stiffness, Real(0.5) * force * pressed);
  }
};

/// F = k δ²/l.
template <class Real>
struct Quadratic {
  Real stiffness;  // k [nN/µm]
  Real length;     // l [µm]

  ContactResponse<Real> respond(const Real& reduced_radius, const Real& overlap) const noexcept {
    const Real pressed = max(overlap, Real(0.0)), slope = stiffness * pressed / length, force = slope * pressed;
    return response<Real>(reduced_radius, pressed, force, Real(2.0) * slope, Real(1.0 / 3.0) * force * pressed);
  }
};

/// F = k l ln(1 + δ/l), U = k l² [(1 + x) ln(1 + x) − x] with x = δ/l.
template <class Real>
struct Logarithmic {
  Real stiffness;  // k [nN/µm]
  Real length;     // l [µm]

  ContactResponse<Real> respond(const Real& reduced_radius, const Real& overlap) const noexcept {
    const Real pressed = max(overlap, Real(0.0)), x = pressed / length, whole = Real(1.0) + x, log = log_of_one_and(x);
    const Real unit = stiffness * length;
    return response<Real>(reduced_radius, pressed, unit * log, stiffness / whole, unit * length * (whole * log - x));
  }
};

inline KeySpec stiffness() {
  return {.name = "spring_stiffness",
          .doc = "Stiffness k of the spring of two such spheres in contact; of two types, and of two values, the harmonic mean.",
          .quantity = Quantity::kTension,
          .fallback = "1 nN/um",
          .low = 0.0,
          .high = 1e4,
          .low_open = true,
          .example = "2 nN/um",
          .source = "chosen: of the order of a Hertz contact of cells at a tenth of their radius"};
}

inline KeySpec length() {
  return {.name = "spring_length",
          .doc = "Length l of springs that are not linear: an overlap beside which the force bends; the arithmetic mean of two types.",
          .quantity = Quantity::kLength,
          .fallback = "1 um",
          .low = 1e-3,
          .high = 1e3,
          .example = "1 um",
          .source = "chosen: forces k δ² and k ln(1 + δ) with δ in um"};
}

inline double harmonic_mean(double a, double b) { return 2.0 * a * b / (a + b); }

/// Against an obstacle as against another such sphere.
inline PairCoefficients couple(const SphereParameters& a, const SphereParameters* b, double /*adhesion*/) {
  const double k = a.own("spring_stiffness");
  return {b == nullptr ? k : harmonic_mean(k, b->own("spring_stiffness"))};
}
inline PairCoefficients couple_with_length(const SphereParameters& a, const SphereParameters* b, double adhesion) {
  const double l = a.own("spring_length");
  return {couple(a, b, adhesion)[0], b == nullptr ? l : 0.5 * (l + b->own("spring_length"))};
}

inline LawInfo info(const char* word, const char* title, const char* equation, const std::vector<KeySpec>& own) {
  LawInfo out{.name = word,
              .title = title,
              .equation = equation,
              .source = kSource,
              .parameters = {given_by_study("spring_stiffness", "tension", "nN/µm", "Stiffness k.")}};
  if (own.size() > 1) out.parameters.push_back(given_by_study("spring_length", "length", "µm", "Length l."));
  for (const KeySpec& key : own) out.keys.push_back({"cbm", key});
  return out;
}

template <template <class> class Law>
std::shared_ptr<const SphereLaw> spring(const char* word, const char* title, const char* doc, const char* equation,
                                        std::vector<KeySpec> own) {
  const bool has_length = own.size() > 1;
  return make_sphere_law<Law>({.info = info(word, title, equation, own),
                               .word = word,
                               .doc = doc,
                               .own = std::move(own),
                               .couple = has_length ? &couple_with_length : &couple});
}

}  // namespace springs

inline std::shared_ptr<const SphereLaw> linear_law() {
  static const auto law = springs::spring<springs::Linear>("linear", "Linear spring between spheres", "a spring F = k overlap, no adhesion",
                                                           "F = k δ for δ > 0", {springs::stiffness()});
  return law;
}

inline std::shared_ptr<const SphereLaw> quadratic_law() {
  static const auto law =
      springs::spring<springs::Quadratic>("quadratic", "Spring between spheres that hardens", "a spring F = k overlap^2/l, no adhesion",
                                          "F = k δ²/l for δ > 0", {springs::stiffness(), springs::length()});
  return law;
}

inline std::shared_ptr<const SphereLaw> logarithmic_law() {
  static const auto law = springs::spring<springs::Logarithmic>("logarithmic", "Spring between spheres that softens",
                                                                "a spring F = k l ln(1 + overlap/l), no adhesion",
                                                                "F = k l ln(1 + δ/l) for δ > 0", {springs::stiffness(), springs::length()});
  return law;
}

}  // namespace morula::cbm
