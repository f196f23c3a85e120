#include "app/signals.h"

#include <signal.h>
#include <unistd.h>

#include "scenarios/run/driver.h"
#include "scenarios/run/exit_code.h"

namespace morula::app {
namespace {

// A signal handler can reach nothing but a global; this is the only one of the program.
std::atomic<int> wish{scenarios::kGoOn};
static_assert(std::atomic<int>::is_always_lock_free);

void on_signal(int signal) {
  if (signal == SIGINT) {
    if (wish.exchange(scenarios::kInterrupt) == scenarios::kInterrupt) _exit(scenarios::exit_code(ErrorKind::kInterrupted));
    return;
  }
  int none = scenarios::kGoOn;
  wish.compare_exchange_strong(none, scenarios::kStopEarly);
}

void take(int signal) {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, nullptr);
}

void take_unless_ignored(int signal) {
  struct sigaction before {};
  sigaction(signal, nullptr, &before);
  if (before.sa_handler != SIG_IGN) take(signal);
}

}  // namespace

void outlive_closed_pipes() { take_unless_ignored(SIGPIPE); }

const std::atomic<int>& watch_signals() {
  for (const int signal : {SIGTERM, SIGUSR1, SIGINT}) take(signal);
  for (const int signal : {SIGHUP, SIGPIPE, SIGXCPU, SIGXFSZ}) take_unless_ignored(signal);
  return wish;
}

}  // namespace morula::app
