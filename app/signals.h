#pragma once
#include <atomic>

namespace morula::app {

/// From now on a message that nobody reads (SIGPIPE) is dropped and does not end the program; a run that begins later is asked to stop early.
/// For the time before a run begins, in which the other signals have no checkpoint to leave and end the program.
void outlive_closed_pipes();

/// From now on SIGTERM and SIGUSR1 ask to stop early and SIGINT to be interrupted: the run ends with a checkpoint after the step that it is
/// doing. A second SIGINT ends the program at once (exit 130). Returns what was asked for: a scenarios::StopWish.
///
/// SIGHUP (the terminal went), SIGPIPE (nobody reads what is printed), SIGXCPU (the soft limit of CPU time) and SIGXFSZ (a file at its size
/// limit, where the write fails as well) ask to stop early too; where the caller ignores one of them (`nohup`), it stays ignored.
const std::atomic<int>& watch_signals();

}  // namespace morula::app
