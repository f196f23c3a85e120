#pragma once
#include <filesystem>
#include <string>

#include "core/result.h"
#include "results/run_record.h"

namespace morula::app {

/// What run.json and status.json say, and whether a run that says it is running still does.
struct RunOverview {
  std::filesystem::path path;
  scenarios::RunRecord record;
  scenarios::RunStatus status;  ///< made from the record where there is no status.json yet
  bool lost = false;            ///< says `running`, but its process on this machine is gone (killed, or the machine went down)

  /// `running`, `done`, `stopped`, `failed` or `lost`.
  [[nodiscard]] std::string state_word() const;
};

/// kFile if the folder holds no run.
Result<RunOverview> overview_of(const std::filesystem::path& run);

}  // namespace morula::app
