#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "study/given.h"

namespace morula::scenarios {

/// Keys of a section whose values go as they are into members of a `Target`: nothing but their declaration and the member speaks of them.
template <class Target>
class PlainKeys {
 public:
  /// The value of a key that goes into a member.
  template <class T>
  [[nodiscard]] Given<T>& of(const std::string& key, T Target::*member) {
    Key<T>& out = std::get<Keys<T>>(keys_)[key];
    out.member = member;
    return out.given;
  }
  /// Writes all values that could be read.
  void write_to(Target& target) const {
    std::apply([&](const auto&... keys) { (write_each(keys, target), ...); }, keys_);
  }

 private:
  template <class T>
  struct Key {
    Given<T> given;
    T Target::*member = nullptr;
  };
  template <class T>
  using Keys = std::map<std::string, Key<T>>;

  template <class T>
  static void write_each(const Keys<T>& keys, Target& target) {
    for (const auto& [name, key] : keys)
      if (key.given.known()) target.*key.member = key.given.value;
  }

  std::tuple<Keys<double>, Keys<std::uint64_t>, Keys<bool>> keys_;
};

}  // namespace morula::scenarios
