#include "study/key_range.h"

#include <array>
#include <cmath>
#include <numbers>

#include "core/numbers/joined.h"
#include "core/numbers/number_text.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

/// Smallest size that is not 0, and largest size, of a quantity; in internal units.
struct QuantitySize {
  double smallest, largest;
  const char* reason;
};

constexpr std::array<QuantitySize, kQuantityCount> kSizes{{
    {1e-15, 1e9, "plain numbers are ratios, counts and directions; a double has 16 digits"},
    {1e-15, 1.0, "a part of a whole"},
    {1e-9, 2.0 * std::numbers::pi, "a whole turn"},
    {1e-6, 1e6, "from 1 pm, far below an atom, to 1 m, beyond any tissue"},
    {1e-12, 1e12, "from 1 pm^2 to 1 m^2"},
    {1e-18, 1e18, "from 1 pm^3 to 1 m^3"},
    {1e-9, 3.2e9, "from 1 ns, below any motion of a cell, to 100 years, the life of an animal"},
    {1e-12, 1e9, "from once in 30,000 years to once in 1 ns"},
    {1e-12, 1e6, "from 1 um in 30,000 years to 1 m/s"},
    {1e-9, 1e9, "from 1 aN, below the thermal force of a molecule, to 1 N"},
    {1e-9, 1e9, "from 1 uPa to 1 TPa, the stiffness of diamond"},
    {1e-12, 1e3, "from 1 pN/m to 1 N/m, above the tension of any liquid but metals"},
    {1e-12, 1e9, "1 TPa over 1 um"},
    {1e-9, 1e9, "from 1e-24 J, far below the thermal energy, to 1 uJ"},
    {1e-12, 1e9, "from 1 nPa s, below any gas, to 1e12 Pa s, a glass"},
    {1e-12, 1e12, "the drag of a ball of 1 m in a glass is not more"},
    {1e-12, 1e9, "from below that of air to 1e18 N s/m^3"},
    {1e-7, 1e18, "from less than a molecule to 1 mol"},
    {1e-12, 1e12, "from a molecule in days to 1 umol/s"},
    {1e-12, 5.6e4, "from a molecule in 1 mm^3 to 56 M, the water in water"},
    {1e-9, 1e8, "from a solid to hydrogen in air"},
    {1e-12, 1e6, "from no pore at all to a hole"},
}};

}  // namespace

KeyRange range_of(const KeySpec& key) {
  const QuantitySize& size = kSizes[static_cast<std::size_t>(key.quantity)];
  KeyRange range{key.low, key.high, key.low_open, key.high_open, "", ""};
  if (!std::isfinite(key.low)) {
    range.low = -size.largest;
    range.low_reason = size.reason;
  } else if (key.low == 0.0 && key.low_open) {
    range.low = size.smallest;
    range.low_open = false;
    range.low_reason = size.reason;
  }
  if (!std::isfinite(key.high)) {
    range.high = size.largest;
    range.high_reason = size.reason;
  }
  return range;
}

std::string KeyRange::reason_against(double x) const {
  const char* reason = x > low ? high_reason : low_reason;
  return *reason ? " (" + std::string(reason) + ")" : "";
}

std::string range_words(const KeySpec& key) {
  const KeyRange range = range_of(key);
  const std::string unit(describe(key.quantity).internal_unit);
  const auto bound = [&unit](double x) {
    const std::string text = short_number(x);
    const bool is_whole = std::floor(x) == x && std::stod(text) != x;  // that six digits do not hold
    return (is_whole ? number_text("%.17g", x) : text) + (unit.empty() ? "" : " " + unit);
  };
  if (range.low == range.high) return bound(range.low);
  if (!range.low_open && !range.high_open) return "between " + bound(range.low) + " and " + bound(range.high);
  return (range.low_open ? "above " : "at least ") + bound(range.low) + " and " + (range.high_open ? "below " : "at most ") +
         bound(range.high);
}

std::string allowed_values(const KeySpec& key) {
  if (!key.words.empty()) return "one of " + joined(key.words);
  const KeySpec any;
  return key.quantity == any.quantity && key.low == any.low && key.high == any.high ? "" : range_words(key);
}

}  // namespace morula::scenarios
