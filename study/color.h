#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace morula::scenarios {

/// A colour with components 0..1 as they go to the screen (sRGB, not linear light).
struct Rgb {
  float r = 0.0f, g = 0.0f, b = 0.0f;

  friend Rgb operator+(const Rgb& a, const Rgb& b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
  friend Rgb operator*(const Rgb& a, float s) { return {a.r * s, a.g * s, a.b * s}; }
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// The colour 0xRRGGBB.
constexpr Rgb color_of_hex(std::uint32_t rgb) {
  return {static_cast<float>((rgb >> 16) & 255) / 255.0f, static_cast<float>((rgb >> 8) & 255) / 255.0f,
          static_cast<float>(rgb & 255) / 255.0f};
}

/// a (1−t) + b t
inline Rgb mix(const Rgb& a, const Rgb& b, float t) { return a * (1.0f - t) + b * t; }

/// Colour number i of a list that people with colour-vision deficiency can tell apart; repeats, lighter, after seven.
/// Source: Okabe & Ito 2008, "Color Universal Design", jfly.uni-koeln.de/color (black left out: it is the outline).
Rgb categorical_color(std::size_t i);

/// A colour as a study writes it: `#rrggbb`, or the name of a colour of categorical_color (color_names); nothing for any other text.
std::optional<Rgb> color_of_text(std::string_view text);
/// sky, orange, green, pink, yellow, blue, vermilion.
std::span<const char* const> color_names();

}  // namespace morula::scenarios
