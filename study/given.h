#pragma once
#include <string>

#include "study/diagnostics.h"

namespace morula::scenarios {

/// A value of the study file: what it means, how it was written, and where.
template <class T>
struct Given {
  T value{};
  std::string text;    ///< as written, or the default's text; empty when neither exists
  Place place;         ///< of the value; of the enclosing section when it is a default
  bool given = false;  ///< written in the file (or on the command line)

  [[nodiscard]] bool known() const { return !text.empty(); }
};

/// Whether a key was given another value than its default, which the study with all its defaults says, too.
template <class T>
bool is_changed(const Given<T>& value, const char* fallback) {
  return value.given && value.text != fallback;
}

}  // namespace morula::scenarios
