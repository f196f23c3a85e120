#include "app/signals.h"

#include <signal.h>
#include <unistd.h>

#include "app/exit_code.h"

namespace morula::app {
namespace {

// A signal handler can reach nothing but a global; this is the only one of the program.
std::atomic<int> asked{static_cast<int>(StopRequest::kNone)};
static_assert(std::atomic<int>::is_always_lock_free);

void on_signal(int signal) {
  if (signal != SIGINT) {
    int none = static_cast<int>(StopRequest::kNone);
    asked.compare_exchange_strong(none, static_cast<int>(StopRequest::kStop));
    return;
  }
  if (asked.exchange(static_cast<int>(StopRequest::kInterrupt)) == static_cast<int>(StopRequest::kInterrupt)) _exit(exit_code_of(ErrorKind::kInterrupted));
}

}  // namespace

void watch_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGTERM, SIGUSR1, SIGINT}) sigaction(signal, &action, nullptr);
}

StopRequest stop_request() noexcept { return static_cast<StopRequest>(asked.load()); }

}  // namespace morula::app
