#include "app/run_state.h"

#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <string>

#include "core/parallel/comm.h"
#include "results/run_folder.h"

namespace morula::app {
namespace {

bool on_this_machine(const std::string& host) {
  char name[256] = "";
  return gethostname(name, sizeof name - 1) == 0 && host == name;
}

/// Also of a process that has ended and that nobody has asked how: it is still listed then.
bool has_ended(pid_t process) {
  if (kill(process, 0) != 0) return errno == ESRCH;
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text);
  const std::size_t name_ends = text.rfind(')');  // the name may hold anything
  return name_ends != std::string::npos && text.substr(name_ends + 1, 2) == " Z";
}

}  // namespace

std::string RunOverview::state_word() const { return lost ? "lost" : scenarios::name_of(record.state); }

Result<RunOverview> overview_of(const std::filesystem::path& run) {
  MORULA_TRY_ASSIGN(const scenarios::RunFolder folder, scenarios::RunFolder::open(run, Comm()));
  RunOverview overview;
  overview.path = folder.path();
  MORULA_TRY_ASSIGN(overview.record, scenarios::read_run_record(folder.record()));
  if (auto status = scenarios::read_run_status(folder.status()); status.ok()) {
    overview.status = *std::move(status);
  } else {  // gone or damaged; the next output writes it anew
    overview.status.wall_time = overview.record.wall_time;
    overview.status.updated = overview.record.started;
  }
  overview.status.state = overview.record.state;
  const auto process = static_cast<pid_t>(overview.status.process);
  if (overview.record.state == scenarios::RunState::kRunning && process > 0 && on_this_machine(overview.record.host))
    overview.lost = has_ended(process);
  return overview;
}

}  // namespace morula::app
