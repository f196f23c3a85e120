#pragma once
#include <span>

namespace morula::scenarios {

/// A code of a message of the study reader and what it means, for `morula explain E203` and the reference.
struct ErrorCode {
  int code;
  const char* title;
  const char* explanation;
};

/// All codes, in order. E1xx keys and structure, E2xx units, E3xx ranges, E4xx references, E5xx physics that contradicts itself, E6xx files.
std::span<const ErrorCode> error_codes();

/// The code's entry, or null.
const ErrorCode* find_error_code(int code);

}  // namespace morula::scenarios
