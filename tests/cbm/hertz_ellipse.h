#pragma once
#include <cmath>
#include <numbers>
#include <utility>

namespace morula {

/// Hertz's contact of bodies whose gap has two curvatures: Johnson 1985, Contact Mechanics, eqs. 4.28 to 4.32, solved with complete elliptic integrals.
struct HertzEllipse {
  double overlap = 0.0;  ///< [µm]
  double area = 0.0;     ///< [µm²]
};

/// curvatures a > b of the gap [1/µm], force [nN], modulus E* [nN/µm²].
inline HertzEllipse hertz_ellipse(double a, double b, double force, double modulus) {
  const auto both = [](double q) {  // q: minor over major half axis of the contact
    const double k = std::sqrt(1.0 - q * q);
    return std::pair{std::comp_ellint_1(k), std::comp_ellint_2(k)};
  };
  const auto ratio = [&](double q) {
    const auto [K, E] = both(q);
    return (E / (q * q) - K) / (K - E);
  };
  double low = 1e-4, high = 1.0 - 1e-6;
  for (int k = 0; k < 200; ++k) (ratio(0.5 * (low + high)) > a / b ? low : high) = 0.5 * (low + high);
  const double q = low, e2 = 1.0 - q * q, radius = 1.0 / std::sqrt(a * b);
  const auto [K, E] = both(q);
  const double f1 = std::cbrt(4.0 / (std::numbers::pi * e2) * std::pow(q, 1.5) * std::sqrt((E / (q * q) - K) * (K - E)));
  const double f2 = 2.0 / std::numbers::pi * std::sqrt(q) * K / f1;
  const double mean = std::cbrt(0.75 * force * radius / modulus) * f1;  // √ of the half axes' product
  return {std::cbrt(9.0 * force * force / (16.0 * radius * modulus * modulus)) * f2, std::numbers::pi * mean * mean};
}

}  // namespace morula
