#pragma once
#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace morula {

/// The values of the keys of laws as a study gives them, in internal units, by the names of the keys. A key that says `auto` has no value.
class LawValues {
 public:
  void set(std::string name, double value) {
    const auto at = find(name);
    if (at != values_.end())
      at->second = value;
    else
      values_.emplace_back(std::move(name), value);
  }
  void remove(std::string_view name) {
    std::erase_if(values_, [&](const auto& one) { return one.first == name; });
  }
  [[nodiscard]] bool has(std::string_view name) const { return find(name) != values_.end(); }
  /// Not a number where there is none.
  [[nodiscard]] double operator()(std::string_view name) const {
    const auto at = find(name);
    return at != values_.end() ? at->second : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  using Values = std::vector<std::pair<std::string, double>>;
  [[nodiscard]] Values::const_iterator find(std::string_view name) const {
    return std::find_if(values_.begin(), values_.end(), [&](const auto& one) { return one.first == name; });
  }
  [[nodiscard]] Values::iterator find(std::string_view name) {
    return std::find_if(values_.begin(), values_.end(), [&](const auto& one) { return one.first == name; });
  }

  Values values_;
};

}  // namespace morula
