#include "report/pictures/palette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/vec3.h"

namespace morula::scenarios {
namespace {

double to_linear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
double from_linear(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055; }

Rgb clipped(double r, double g, double b) {
  return {static_cast<float>(std::clamp(r, 0.0, 1.0)), static_cast<float>(std::clamp(g, 0.0, 1.0)),
          static_cast<float>(std::clamp(b, 0.0, 1.0))};
}

// sRGB to OKLab (Ottosson 2020).
Vec3d to_oklab(const Rgb& color) {
  const double r = to_linear(color.r), g = to_linear(color.g), b = to_linear(color.b);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s, 1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

constexpr Vec3d kWhiteD65{0.95047, 1.0, 1.08883};

// sRGB to CIELAB under D65 (IEC 61966-2-1, CIE 15).
Vec3d to_lab(double r, double g, double b) {
  r = to_linear(r), g = to_linear(g), b = to_linear(b);
  const auto f = [](double t) { return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0; };
  const double fx = f((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / kWhiteD65.x);
  const double fy = f((0.2126729 * r + 0.7151522 * g + 0.0721750 * b) / kWhiteD65.y);
  const double fz = f((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / kWhiteD65.z);
  return {116.0 * fy - 16.0, 500.0 * (fx - fy), 200.0 * (fy - fz)};
}

Rgb from_lab(const Vec3d& lab) {
  const double fy = (lab.x + 16.0) / 116.0, fx = fy + lab.y / 500.0, fz = fy - lab.z / 200.0;
  const auto g = [](double f) { return f * f * f > 216.0 / 24389.0 ? f * f * f : (116.0 * f - 16.0) * 27.0 / 24389.0; };
  const double x = g(fx) * kWhiteD65.x, y = g(fy) * kWhiteD65.y, z = g(fz) * kWhiteD65.z;
  return clipped(from_linear(std::max(0.0, 3.2404542 * x - 1.5371385 * y - 0.4985314 * z)),
                 from_linear(std::max(0.0, -0.9692660 * x + 1.8760108 * y + 0.0415560 * z)),
                 from_linear(std::max(0.0, 0.0556434 * x - 0.2040259 * y + 1.0572252 * z)));
}

// Msh: CIELAB in polar form (magnitude, saturation angle, hue angle), Moreland 2009.
Vec3d to_msh(const Vec3d& lab) {
  const double m = norm(lab);
  return {m, std::acos(lab.x / m), std::atan2(lab.z, lab.y)};
}
Vec3d from_msh(const Vec3d& msh) {
  return {msh.x * std::cos(msh.y), msh.x * std::sin(msh.y) * std::cos(msh.z), msh.x * std::sin(msh.y) * std::sin(msh.z)};
}

// The hue an unsaturated end gets so that the path to the saturated colour does not curve (Moreland 2009, "AdjustHue").
double adjusted_hue(const Vec3d& saturated, double m_unsaturated) {
  if (saturated.x >= m_unsaturated) return saturated.z;
  const double spin =
      saturated.y * std::sqrt(m_unsaturated * m_unsaturated - saturated.x * saturated.x) / (saturated.x * std::sin(saturated.y));
  return saturated.z > -std::numbers::pi / 3.0 ? saturated.z + spin : saturated.z - spin;
}

}  // namespace

Rgb from_oklab(double lightness, double a, double b) {
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3.0);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3.0);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3.0);
  return clipped(from_linear(std::max(0.0, 4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s)),
                 from_linear(std::max(0.0, -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s)),
                 from_linear(std::max(0.0, -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)));
}

Rgb body_color(bool is_shell) { return is_shell ? color_of_hex(0x5F5A8C) : color_of_hex(0xD8D2C4); }

Rgb mark_color(std::size_t i) {
  static constexpr std::array<Rgb, 6> kMuted = {color_of_hex(0x882255), color_of_hex(0x44AA99), color_of_hex(0x999933),
                                                color_of_hex(0x332288), color_of_hex(0xCC6677), color_of_hex(0x117733)};
  const auto round = std::min<std::size_t>(i / kMuted.size(), 3);
  return mix(kMuted[i % kMuted.size()], {1.0f, 1.0f, 1.0f}, 0.25f * static_cast<float>(round));
}

Rgb sequential_color(double t) {
  static constexpr std::array<std::uint32_t, 10> kViridis = {0x440154, 0x482878, 0x3E4A89, 0x31688E, 0x26828E,
                                                             0x1F9E89, 0x35B779, 0x6ECE58, 0xB5DE2B, 0xFDE725};
  const double place = std::clamp(t, 0.0, 1.0) * (kViridis.size() - 1);
  const auto low = std::min<std::size_t>(static_cast<std::size_t>(place), kViridis.size() - 2);
  const double part = place - static_cast<double>(low);
  const Vec3d lab = to_oklab(color_of_hex(kViridis[low])) * (1.0 - part) + to_oklab(color_of_hex(kViridis[low + 1])) * part;
  return from_oklab(lab.x, lab.y, lab.z);
}

Rgb diverging_color(double t) {
  t = std::clamp(t, 0.0, 1.0);
  const bool low = t < 0.5;
  const Vec3d end = low ? to_msh(to_lab(59 / 255.0, 76 / 255.0, 192 / 255.0)) : to_msh(to_lab(180 / 255.0, 4 / 255.0, 38 / 255.0));
  const double white = 88.0;  // magnitude of the middle, as in the source
  const Vec3d middle{white, 0.0, adjusted_hue(end, white)};
  const double part = low ? 2.0 * t : 2.0 * (1.0 - t);  // 0 at the end, 1 in the middle
  return from_lab(from_msh(end * (1.0 - part) + middle * part));
}

Rgb identity_color(CellId id) {
  std::uint64_t h = id.bits() * 0x9E3779B97F4A7C15ull;  // Fibonacci hashing, then mixed once more
  h ^= h >> 29;
  h *= 0xBF58476D1CE4E5B9ull;
  h ^= h >> 32;
  const double hue = 2.0 * std::numbers::pi * static_cast<double>(h & 0xFFFF) / 65536.0;
  const double lightness = 0.78 + 0.10 * static_cast<double>((h >> 16) & 0xFF) / 255.0;
  return from_oklab(lightness, 0.095 * std::cos(hue), 0.095 * std::sin(hue));
}

}  // namespace morula::scenarios
