#pragma once
#include "core/result.h"

namespace morula::app {

/// Exit codes of the program, in one place (UX, section 2).
inline constexpr int kDone = 0;

[[nodiscard]] constexpr int exit_code_of(ErrorKind kind) noexcept {
  switch (kind) {
    case ErrorKind::kInternal: return 1;
    case ErrorKind::kInput: return 2;
    case ErrorKind::kFile: return 3;
    case ErrorKind::kPhysics: return 4;
    case ErrorKind::kVerification: return 5;
    case ErrorKind::kResources: return 6;
    case ErrorKind::kStoppedEarly: return 75;
    case ErrorKind::kInterrupted: return 130;
  }
  return 1;
}

}  // namespace morula::app
