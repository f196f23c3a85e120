#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace morula {

/// The texts that `as` makes of the items, one after the other, with `between` between them: "a, b, c".
template <class Items, class As = std::identity>
std::string joined(Items&& items, As as = {}, std::string_view between = ", ") {
  std::string out;
  bool first = true;
  for (auto&& item : items) {
    if (!std::exchange(first, false)) out += between;
    out += std::invoke(as, item);
  }
  return out;
}

/// Names as messages have them: "`a`, `b`"; `as` makes them of the items.
template <class Items, class As = std::identity>
std::string listed(Items&& items, As as = {}) {
  return joined(items, [&](const auto& item) { return "`" + std::string(std::invoke(as, item)) + "`"; });
}

}  // namespace morula
