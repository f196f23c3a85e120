#pragma once
#include <atomic>

namespace morula::app {

/// What a signal asked for.
enum class StopRequest : int { kNone = 0, kStop = 1, kInterrupt = 2 };

/// SIGTERM and SIGUSR1 ask to stop early, SIGINT to be interrupted; the run ends with a checkpoint at the next step. A second SIGINT ends the
/// program at once (exit 130).
void watch_signals();
/// What was asked for so far.
[[nodiscard]] StopRequest stop_request() noexcept;

}  // namespace morula::app
