#pragma once
#include <filesystem>

#include "core/parallel/comm.h"
#include "core/result.h"

namespace morula::scenarios {

/// Two programs must not write into one run. The root holds an advisory lock on the run's folder as long as this object lives; the
/// system lets go of it when the process ends, however it ends.
class RunLock {
 public:
  /// Collective. kInput when another program holds it. A file system without locks is taken as it is.
  static Result<RunLock> take(const std::filesystem::path& run, const Comm& comm);
  RunLock(RunLock&& other) noexcept : descriptor_(other.descriptor_) { other.descriptor_ = -1; }
  RunLock& operator=(RunLock&&) = delete;
  ~RunLock();

 private:
  explicit RunLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

}  // namespace morula::scenarios
