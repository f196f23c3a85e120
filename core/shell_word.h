#pragma once
#include <string>

namespace morula {

/// A text as one word of a command line of a POSIX shell: as it is where that is safe, else in single quotes.
[[nodiscard]] std::string shell_word(const std::string& text);

}  // namespace morula
