#include "scenarios/run/run_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "core/shell_word.h"
#include "results/file_io.h"

namespace morula::scenarios {

Result<RunLock> RunLock::take(const std::filesystem::path& run, const Comm& comm) {
  Status status;
  int descriptor = -1;
  if (comm.is_root()) {
    descriptor = ::open(run.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      status = Error{ErrorKind::kInput, "'" + run.string() + "' is being written by another program",
                     "wait for it, or stop it; `morula status " + shell_word(run.string()) + "` shows where it stands"};
  }
  RunLock lock(descriptor);
  MORULA_TRY(agree(std::move(status), comm));
  return lock;
}

RunLock::~RunLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace morula::scenarios
