#pragma once
#include <string>

#include "study/diagnostics.h"

namespace morula::scenarios {

/// A value of the study file: what it means, how it was written, and where.
template <class T>
struct Given {
  T value{};
  std::string text;                ///< as written, or the default's text; empty when neither exists
  Place place;                     ///< of the value; of the enclosing section when it is a default
  bool given = false;              ///< written in the file (or on the command line)
  const char* fallback = nullptr;  ///< text of the default of a scalar key; null: it has none, or is no scalar

  [[nodiscard]] bool known() const { return !text.empty(); }
  /// Whether another value was given than the default, which the study with all its defaults says, too.
  [[nodiscard]] bool is_changed() const { return given && (fallback == nullptr || text != fallback); }
};

}  // namespace morula::scenarios
