#include "scenarios/measures/theory.h"

#include <cmath>
#include <numbers>

namespace morula::scenarios::theory {
namespace {

constexpr double kPi = std::numbers::pi;

/// Height and volume of the drop with b = 1 and contact radius a: with r = 1 − (1 − a) s², the integrands of h = 2∫ tan ψ dr and
/// V = 2π ∫ r² tan ψ dr are smooth at the equator (s = 0), where tan ψ grows like 1/√(1 − r). Simpson's rule.
struct HeightAndVolume {
  double height, volume;
};
HeightAndVolume drop(double a) {
  constexpr int kIntervals = 400;
  const double curvature = 1.0 / (1.0 - a * a);
  HeightAndVolume out{0.0, 0.0};
  for (int i = 0; i <= kIntervals; ++i) {
    const double s = static_cast<double>(i) / kIntervals, r = 1.0 - (1.0 - a) * s * s;
    const double sine = curvature * (r * r - a * a) / r;
    const double less = curvature * (1.0 - r) * (r + a * a) / r;  // 1 − sin ψ, free of cancellation at the equator
    const double value = i == 0 ? 2.0 * (1.0 - a) / std::sqrt(2.0 * curvature * (1.0 - a) * (1.0 + a * a))
                                : sine / std::sqrt(less * (1.0 + sine)) * 2.0 * (1.0 - a) * s;
    const double weight = (i == 0 || i == kIntervals ? 1.0 : i % 2 ? 4.0 : 2.0) / (3.0 * kIntervals);
    out.height += 2.0 * weight * value;
    out.volume += 2.0 * kPi * weight * r * r * value;
  }
  return out;
}

}  // namespace

Cap cap_of_angle(double cosine) {
  const double c = cosine;
  Cap out;
  out.angle = std::acos(c);
  out.radius = std::cbrt(4.0 / (2.0 + 3.0 * c - c * c * c));
  out.contact_radius = out.radius * std::sin(out.angle);
  out.height = out.radius * (1.0 + c);
  out.pressure = 2.0 / out.radius;
  const double contact = out.contact_radius * out.contact_radius, free_part = 2.0 * out.radius * out.height;  // both over π R0²
  out.contact_part = contact / (contact + free_part);
  return out;
}

double part_nearer_than(const Cap& cap, double gap) {
  const double r = cap.radius, center = r * std::cos(cap.angle);  // centres at ± center, the contact in the plane z = 0
  const auto distance = [&](double polar) {                       // of the point at this angle from the axis, seen from its centre
    const double x = r * std::sin(polar), z = center - r * std::cos(polar), away = std::hypot(x, z + center);
    const bool faces_cap = r * (z + center) <= away * center;  // the foot on the other's sphere lies beyond the plane
    return faces_cap ? away - r : std::hypot(x - cap.contact_radius, z);
  };
  double low = cap.angle, high = kPi;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (distance(middle) < gap ? low : high) = middle;
  }
  const double contact = cap.contact_radius * cap.contact_radius;  // all areas over π R0²
  return (contact + 2.0 * r * r * (std::cos(cap.angle) - std::cos(low))) / (contact + 2.0 * r * cap.height);
}

Stretch stretched_sphere(double peak_stress, double radius, double modulus, double poisson, double tension, double bulk_modulus) {
  const double square = radius * radius;
  const double u2 = 2.0 / 3.0 * peak_stress / (4.0 * modulus / ((5.0 + poisson) * square) + 4.0 * tension / square);
  const double u0 = peak_stress / 3.0 / (2.0 * modulus / ((1.0 - poisson) * square) - 2.0 * tension / square + 3.0 * bulk_modulus / radius);
  return {(u0 + u2) / radius, (u0 - 0.5 * u2) / radius};
}

PressedDrop pressed_drop(double height) {
  if (height >= 2.0) return {};
  double low = 0.0, high = 0.9999;  // a/b: the height over V^(1/3) falls with it
  for (int i = 0; i < 60; ++i) {
    const double a = 0.5 * (low + high);
    const auto [h, v] = drop(a);
    (h / std::cbrt(3.0 * v / (4.0 * kPi)) > height ? low : high) = a;
  }
  const double a = 0.5 * (low + high);
  const double scale = 1.0 / std::cbrt(3.0 * drop(a).volume / (4.0 * kPi));
  PressedDrop out;
  out.contact_radius = a * scale;
  out.equator = scale;
  out.pressure = 2.0 / (scale * (1.0 - a * a));
  out.force = out.pressure * kPi * out.contact_radius * out.contact_radius;
  return out;
}

double maugis_pull_off(double lambda) {
  // Load at m = c/a, the outer radius of the adhesive ring over that of the contact: the radius of contact follows from the ring's opening.
  const auto load = [lambda](double m) {
    const double root = std::sqrt(m * m - 1.0), arc = std::acos(1.0 / m);
    const double a = 0.5 * lambda * ((m * m - 2.0) * arc + root), b = 4.0 / 3.0 * lambda * lambda * (root * arc - m + 1.0);
    const double radius = 2.0 / (b + std::sqrt(b * b + 4.0 * a));  // of a r² + b r = 1
    return radius * radius * radius - lambda * radius * radius * (root + m * m * arc);
  };
  double low = std::log(1e-6), high = std::log(1e6);  // of m − 1
  for (int i = 0; i < 200; ++i) {
    const double left = low + (high - low) / 3.0, right = high - (high - low) / 3.0;
    if (load(1.0 + std::exp(left)) < load(1.0 + std::exp(right)))
      high = right;
    else
      low = left;
  }
  return -load(1.0 + std::exp(0.5 * (low + high)));
}

double critical_aspiration(double tension, double pipette_radius, double cell_radius) {
  const double rp = pipette_radius;
  const auto volume = [&](double rc) {  // over π/3
    const double sagitta = rc - std::sqrt(std::max(0.0, rc * rc - rp * rp));
    return 4.0 * rc * rc * rc - sagitta * sagitta * (3.0 * rc - sagitta) + 2.0 * rp * rp * rp;
  };
  double low = rp, high = 2.0 * cell_radius;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (volume(middle) < 4.0 * cell_radius * cell_radius * cell_radius ? low : high) = middle;
  }
  return 2.0 * tension * (1.0 / rp - 1.0 / (0.5 * (low + high)));
}

}  // namespace morula::scenarios::theory
