#include "study/color.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace morula::scenarios {

Rgb categorical_color(std::size_t i) {
  static constexpr std::array<Rgb, 7> kOkabeIto = {color_of_hex(0x56B4E9), color_of_hex(0xE69F00), color_of_hex(0x009E73),
                                                   color_of_hex(0xCC79A7), color_of_hex(0xF0E442), color_of_hex(0x0072B2),
                                                   color_of_hex(0xD55E00)};
  const Rgb base = kOkabeIto[i % kOkabeIto.size()];
  const auto round = std::min<std::size_t>(i / kOkabeIto.size(), 3);
  return mix(base, {1.0f, 1.0f, 1.0f}, 0.22f * static_cast<float>(round));
}

std::span<const char* const> color_names() {
  static constexpr std::array<const char*, 7> kNames{"sky", "orange", "green", "pink", "yellow", "blue", "vermilion"};
  return kNames;
}

std::optional<Rgb> color_of_text(std::string_view text) {
  const auto names = color_names();
  for (std::size_t i = 0; i < names.size(); ++i)
    if (text == names[i]) return categorical_color(i);
  std::uint32_t value = 0;
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  const auto [end, problem] = std::from_chars(text.data() + 1, text.data() + text.size(), value, 16);
  if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return color_of_hex(value);
}

}  // namespace morula::scenarios
