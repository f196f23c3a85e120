#pragma once
#include "core/result.h"

namespace morula::scenarios {

/// Exit code of the program for a kind of failure (0 is success): what run.json records too.
constexpr int exit_code(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kInternal:
      return 1;
    case ErrorKind::kInput:
      return 2;
    case ErrorKind::kFile:
      return 3;
    case ErrorKind::kPhysics:
      return 4;
    case ErrorKind::kVerification:
      return 5;
    case ErrorKind::kResources:
      return 6;
    case ErrorKind::kStoppedEarly:
      return 75;
    case ErrorKind::kInterrupted:
      return 130;
  }
  return 1;
}

}  // namespace morula::scenarios
